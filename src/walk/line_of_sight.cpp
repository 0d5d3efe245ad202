#include "walk/line_of_sight.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "room/emitter_shape.hpp"
#include "room/nearest_on_triangle.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/opening_sampling.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

class Sight {
 public:
  Sight(const Room& room, const ChannelAxes& axes, const DirectLight& light, const Tracer& tracer,
        const ReferencePoint& receiver, const Stream& stream, std::uint64_t number)
      : room_(room),
        axes_(axes),
        light_(light),
        tracer_(tracer),
        receiver_(receiver),
        stream_(stream),
        number_(number) {
    found_.first.resize(axes.groups);
    hidden_.resize(axes.groups, std::numeric_limits<double>::infinity());
  }

  LineOfSight find() {
    for (std::size_t k = 0; k < light_.sources(); ++k) {
      const LightSource& source = light_.source(k);
      if (source.kind == LightSource::Kind::point) {
        add_point(light_.points()[source.index], source.emitter);
      } else if (source.kind == LightSource::Kind::opening) {
        add_opening(light_.openings()[source.index], source.emitter);
      } else if (!receiver_.way_out) {  // the walls lie between area lights, which are walls, and points outside
        add_area(light_.areas()[source.index], source.emitter);
      }
    }
    // Light of points that are nearer, but not in sight, may be reflected, or come past what hides others of them.
    for (std::size_t group = 0; group < hidden_.size(); ++group) {
      FirstSight& first = found_.first[group];
      first.exact = first.exact && first.length_m <= hidden_[group];
    }
    return std::move(found_);
  }

 private:
  void add_point(const PointLight& light, std::size_t emitter) {
    const LightSample sample = light.sample_light(receiver_);
    const double length = glm::length(light.position() - receiver_.point) + axes_.delay_m[emitter];
    if (!(sample.irradiance > 0.0) || is_blocked(tracer_, receiver_, sample.target, count_)) {
      hide(emitter, length);
      return;
    }
    found_.paths.push_back({axes_.group_of_emitter[emitter], length, sample.irradiance, SightPath::exact});
    see(emitter, length, true);
  }

  void see(std::size_t emitter, double length, bool exact) {
    FirstSight& first = found_.first[axes_.group_of_emitter[emitter]];
    if (length < first.length_m || (exact && length == first.length_m)) first = {length, exact};
  }

  // No light of an emitter comes by a shorter path, but its light does not come straight, or not from there.
  void hide(std::size_t emitter, double length) {
    double& hidden = hidden_[axes_.group_of_emitter[emitter]];
    hidden = std::min(hidden, length);
  }

  // Paths from samples of an extended light, in sets. sample(same point, number, accuracy, record): its irradiance.
  // Returns the shortest path.
  template <class Sample>
  double add_sampled(std::size_t emitter, const Sample& sample) {
    const std::uint32_t group = axes_.group_of_emitter[emitter];
    // Sets of a single channel determine only how its light is spread over time: the direct irradiance is known. Else
    // each set has an error of 0.6 % and all together have 0.1 %.
    const SamplingAccuracy accuracy{axes_.groups == 1 ? 0.05 : 6e-3, 0.0, 1024};
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint32_t set = 0; set < jackknife_groups; ++set) {
      const std::size_t begin = found_.paths.size();
      double sum = 0.0;
      const auto same_point = [this](std::uint32_t) { return receiver_; };
      const auto record = [&](double irradiance, double length_m) {
        const double length = length_m + axes_.delay_m[emitter];
        found_.paths.push_back({group, length, irradiance, set});
        sum += irradiance;
        shortest = std::min(shortest, length);
      };
      // Other random words than those of the direct irradiance.
      const std::uint64_t number =
          ((number_ * room_.emitters.size() + emitter) * jackknife_groups + set) | std::uint64_t{1} << 62;
      const DirectIrradiance mean = sample(same_point, number, accuracy, record);
      for (std::size_t k = begin; k < found_.paths.size(); ++k) found_.paths[k].irradiance *= mean.value / sum;
    }
    return shortest;
  }

  // The first arrival is known as that of a sample: an upper bound. The least possible distance is that of the box
  // around the opening.
  void add_opening(const PointLight& light, std::size_t emitter) {
    const double shortest = add_sampled(emitter, [&](const auto& same_point, std::uint64_t number,
                                                     const SamplingAccuracy& accuracy, const auto& record) {
      return sample_opening(light, tracer_, same_point, stream_, number, accuracy, count_, record);
    });
    if (shortest < std::numeric_limits<double>::infinity()) see(emitter, shortest, false);
    const double nearest = std::max(0.0, glm::length(light.position() - receiver_.point) - light.reach_m());
    hide(emitter, nearest + axes_.delay_m[emitter]);
  }

  void add_area(const AreaLight& light, std::size_t emitter) {
    const double shortest = add_sampled(emitter, [&](const auto& same_point, std::uint64_t number,
                                                     const SamplingAccuracy& accuracy, const auto& record) {
      return AreaLightSampler(light, tracer_, same_point, stream_, number, count_, record).sample(accuracy);
    });
    const NearestPoint nearest = nearest_point(emitter);
    const double length = nearest.length_m + axes_.delay_m[emitter];
    // Samples are on the triangles to rounding.
    constexpr double rounding = 1e-12;
    const bool exact = length <= shortest * (1.0 + rounding) && is_seen(nearest, emitter);
    if (shortest < std::numeric_limits<double>::infinity()) see(emitter, exact ? length : shortest, exact);
    if (!exact) hide(emitter, length);
  }

  struct NearestPoint {
    glm::dvec3 point{0.0};
    double length_m = std::numeric_limits<double>::infinity();
    bool is_front = false;
  };

  // The point of an area light that is nearest to the receiver.
  NearestPoint nearest_point(std::size_t emitter) const {
    const Surface& surface = room_.surfaces[*emitting_surface(room_.emitters[emitter])];
    NearestPoint nearest;
    for (const glm::uvec3& corner : surface.triangles) {
      const glm::dvec3& a = surface.positions[corner.x];
      const glm::dvec3& b = surface.positions[corner.y];
      const glm::dvec3& c = surface.positions[corner.z];
      const glm::dvec3 point = nearest_on_triangle(receiver_.point, a, b, c);
      const double length = glm::length(point - receiver_.point);
      const bool is_front = glm::dot(glm::cross(b - a, c - a), receiver_.point - a) > 0.0;
      // Of two triangles with a common edge the one that shines here.
      if (length < nearest.length_m || (length == nearest.length_m && is_front)) nearest = {point, length, is_front};
    }
    return nearest;
  }

  // Whether light comes straight from there; with an emission map it may be dark.
  bool is_seen(const NearestPoint& nearest, std::size_t emitter) {
    if (!nearest.is_front || !(nearest.length_m > 0.0) || tracer_.faces_in_one_plane() != nullptr) return false;
    if (std::get<SurfaceEmitter>(room_.emitters[emitter].shape).emission_map) return false;
    const glm::dvec3 towards = (nearest.point - receiver_.point) / nearest.length_m;
    return receiver_.weight(towards) > 0.0 && !is_blocked(tracer_, receiver_, nearest.point, count_);
  }

  const Room& room_;
  const ChannelAxes& axes_;
  const DirectLight& light_;
  const Tracer& tracer_;
  const ReferencePoint& receiver_;
  const Stream& stream_;
  std::uint64_t number_;
  TraceCount count_;
  LineOfSight found_;
  std::vector<double>
      hidden_;  // of each group: the least distance of its emitters, with their delays, that are not in sight
};

}  // namespace

LineOfSight line_of_sight(const Room& room, const ChannelAxes& axes, const DirectLight& light, const Tracer& tracer,
                          const ReferencePoint& receiver, const Stream& stream, std::uint64_t number) {
  return Sight(room, axes, light, tracer, receiver, stream, number).find();
}

}  // namespace lichtmc
