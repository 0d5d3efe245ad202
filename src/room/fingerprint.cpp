#include <map>
#include <variant>

#include "base/checksum.hpp"
#include "lichtmc/fingerprint.hpp"
#include "lichtmc/photometry.hpp"

namespace lichtmc {

namespace {

class RoomChecksum {
 public:
  void add(const Room& room) {
    sum_.add(static_cast<std::uint8_t>(room.quantity));
    add_all(room.surfaces);
    add_all(room.emitters);
    add_all(room.receivers);
    add_all(room.reflectance_maps);
    // Here and below: rooms without these parts keep the checksum that they had before lichtmc knew them.
    if (!room.emission_maps.empty()) add_all(room.emission_maps);
  }
  Fingerprint value() const { return sum_.value(); }

 private:
  void add(const glm::dvec2& v) { sum_.add(&v, sizeof v); }
  void add(const glm::vec3& v) { sum_.add(&v, sizeof v); }
  void add(const glm::dvec3& v) { sum_.add(&v, sizeof v); }
  void add(const glm::uvec3& v) { sum_.add(&v, sizeof v); }
  void add(float value) { sum_.add(value); }

  void add(const Surface& surface) {
    sum_.add(surface.name);
    sum_.add(surface.material);
    sum_.add(surface.reflectance);
    sum_.add(static_cast<std::uint8_t>(surface.sides));
    add_all(surface.positions);
    add_all(surface.uvs);
    add_all(surface.triangles);
    sum_.add(std::uint64_t{surface.reflectance_map ? *surface.reflectance_map + 1 : 0});
    add_all(surface.reflectance_uvs);
    if (!surface.vertex_colours.empty()) {
      add_all(surface.vertex_colours);
      sum_.add(surface.highest_reflectance);
    }
    if (!surface.measured) sum_.add(std::uint8_t{1});
  }
  void add(const TextureMap& map) {
    sum_.add(map.columns);
    sum_.add(map.rows);
    add_all(map.values);
    sum_.add(static_cast<std::uint8_t>(map.wrap_u));
    sum_.add(static_cast<std::uint8_t>(map.wrap_v));
    if (!map.colours.empty()) add_all(map.colours);
  }

  void add(const IsotropicEmitter& emitter) { add(emitter.position); }
  void add(const LambertEmitter& emitter) {
    add(emitter.position);
    add(emitter.axis);
    sum_.add(emitter.exponent);
  }
  void add(const SpotEmitter& emitter) {
    add(emitter.position);
    add(emitter.axis);
    sum_.add(emitter.inner);
    sum_.add(emitter.outer);
  }
  void add(const SurfaceEmitter& emitter) {
    sum_.add(std::uint64_t{emitter.surface});
    sum_.add(emitter.exponent);
    if (emitter.emission_map) {
      sum_.add(std::uint64_t{*emitter.emission_map + 1});
      add_all(emitter.emission_uvs);
    }
  }
  // The same table of many luminaires is read once.
  void add(const CandelaTable& table) {
    const auto [found, is_new] = tables_.try_emplace(&table);
    if (is_new) {
      const CandelaTable::Grid& grid = table.grid();
      Checksum own;
      own.add(static_cast<std::uint8_t>(grid.type));
      own.add(static_cast<std::uint8_t>(grid.symmetry));
      own.add(static_cast<std::uint8_t>(grid.flip_horizontal));
      for (const auto* numbers : {&grid.horizontal_deg, &grid.vertical_deg, &grid.candela}) {
        own.add(std::uint64_t{numbers->size()});
        own.add(numbers->data(), numbers->size() * sizeof(double));
      }
      found->second = own.value();
    }
    sum_.add(&found->second, sizeof found->second);
  }
  void add(const MeasuredEmitter& emitter) {
    for (const auto* vector : {&emitter.position, &emitter.axis, &emitter.c0, &emitter.c90}) add(*vector);
    add(*emitter.photometry->candela);
    if (!emitter.opening) return;
    sum_.add(static_cast<std::uint8_t>(emitter.opening->form));
    add(emitter.opening->size_m);
  }
  void add(const Emitter& emitter) {
    sum_.add(emitter.name);
    sum_.add(emitter.power);
    sum_.add(emitter.delay_s);
    if (emitter.maintenance_factor != 1.0) sum_.add(emitter.maintenance_factor);
    sum_.add(std::uint64_t{emitter.shape.index()});
    std::visit([this](const auto& shape) { add(shape); }, emitter.shape);
  }
  void add(const Receiver& receiver) {
    sum_.add(receiver.name);
    add(receiver.position);
    add(receiver.normal);
    sum_.add(receiver.half_angle_deg);
    sum_.add(receiver.area_m2);
    sum_.add(receiver.concentrator_index.value_or(0.0));
    sum_.add(receiver.filter_gain);
    if (receiver.law != ReceiverLaw::planar) {
      sum_.add(static_cast<std::uint8_t>(receiver.law));
      if (receiver.law == ReceiverLaw::semicylindrical) add(receiver.facing);
    }
    if (!receiver.is_cell()) return;
    add(receiver.cell_u);
    add(receiver.cell_v);
  }

  template <class Thing>
  void add_all(const std::vector<Thing>& things) {
    sum_.add(std::uint64_t{things.size()});
    for (const Thing& thing : things) add(thing);
  }

  Checksum sum_;
  std::map<const CandelaTable*, Fingerprint> tables_;
};

}  // namespace

Fingerprint fingerprint(const Room& room) {
  RoomChecksum sum;
  sum.add(room);
  return sum.value();
}

}  // namespace lichtmc
