#include "output/luminaire_schedule.hpp"

#include <algorithm>

#include "base/csv.hpp"
#include "base/decimal_shift.hpp"
#include "base/message.hpp"
#include "output/json.hpp"
#include "output/table_rows.hpp"
#include "room/emitter_place.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

// The same content, even if it was read twice.
bool is_same_file(const Photometry& a, const Photometry& b) {
  if (&a == &b) return true;
  const CandelaTable::Grid& one = a.candela->grid();
  const CandelaTable::Grid& other = b.candela->grid();
  return a.source == b.source && a.lamp_set == b.lamp_set && one.flip_horizontal == other.flip_horizontal &&
         one.type == other.type && one.symmetry == other.symmetry && one.horizontal_deg == other.horizontal_deg &&
         one.vertical_deg == other.vertical_deg && one.candela == other.candela;
}

std::string vector_fields(const std::optional<glm::dvec3>& vector) {
  if (!vector) return ",,";
  const auto text = [](double value) { return to_text(value + 0.0); };  // no "-0"
  return text(vector->x) + ',' + text(vector->y) + ',' + text(vector->z);
}

}  // namespace

std::optional<double> ScheduleRow::scale(Quantity quantity) const {
  if (quantity != Quantity::photometric) return std::nullopt;
  return initial_power() / photometry->flux();
}

std::vector<ScheduleRow> luminaire_schedule(const Room& room) {
  std::vector<ScheduleRow> rows;
  std::vector<const Photometry*> files;
  for (std::size_t k = 0; k < room.emitters.size(); ++k) {
    const Emitter& emitter = room.emitters[k];
    const Photometry* photometry = photometry_of(emitter);
    if (photometry == nullptr) continue;
    const auto known = std::find_if(files.begin(), files.end(),
                                    [&](const Photometry* file) { return is_same_file(*file, *photometry); });
    const auto file = static_cast<std::size_t>(known - files.begin());
    if (known == files.end()) files.push_back(photometry);
    const bool area = opening_of(emitter) != nullptr;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const ScheduleRow& other) {
      return other.file == file && other.power == emitter.power &&
             other.maintenance_factor == emitter.maintenance_factor && other.area == area;
    });
    if (row != rows.end()) {
      row->emitters.push_back(k);
    } else {
      rows.push_back({files[file], file, emitter.power, emitter.maintenance_factor, area, {k}});
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ScheduleRow& a, const ScheduleRow& b) { return a.file < b.file; });
  return rows;
}

std::string emitters_csv(const Room& room) {
  std::string table =
      "emitter,name,kind,file,power,unit,scale,watts,x,y,z,aim_x,aim_y,aim_z,c0_x,c0_y,c0_z,light_from,delay_ns,"
      "maintenance_factor,initial_power\n";
  const std::string unit(power_unit(room.quantity));
  for (std::size_t k = 0; k < room.emitters.size(); ++k) {
    const Emitter& emitter = room.emitters[k];
    const Photometry* photometry = photometry_of(emitter);
    const EmitterDirections directions = directions_of(emitter);
    const bool scaled = photometry != nullptr && room.quantity == Quantity::photometric;
    const double initial = emitter.power / emitter.maintenance_factor;
    const bool surface = emitting_surface(emitter).has_value();
    append_row(table, std::to_string(k), csv_field(emitter.name), std::string(kind_of(emitter)),
               photometry != nullptr ? csv_field(photometry->source) : std::string(), to_text(emitter.power), unit,
               scaled ? to_text(initial / photometry->flux()) : std::string(),
               photometry != nullptr && photometry->watts > 0.0 ? to_text(photometry->watts) : std::string(),
               vector_fields(place_of(room, emitter)), vector_fields(directions.aim), vector_fields(directions.c0),
               std::string(surface                          ? "surface"
                           : opening_of(emitter) != nullptr ? "opening"
                                                            : "point"),
               to_text(shift_decimals(emitter.delay_s, 9)), to_text(emitter.maintenance_factor), to_text(initial));
  }
  return table;
}

}  // namespace lichtmc
