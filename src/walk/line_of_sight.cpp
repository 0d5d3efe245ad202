#include "walk/line_of_sight.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "room/emitter_shape.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

// The point of a triangle that is nearest to p (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
glm::dvec3 nearest_of_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 ap = p - a;
  const double d1 = glm::dot(ab, ap);
  const double d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp);
  const double d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp);
  const double d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

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
  }

  LineOfSight find() {
    for (std::size_t k = 0; k < light_.sources(); ++k) {
      const LightSource& source = light_.source(k);
      if (!source.is_area) {
        add_point(*light_.point_light(k), source.emitter);
      } else if (!receiver_.way_out) {  // the walls lie between area lights, which are walls, and points outside
        add_area(light_.areas()[source.index], source.emitter);
      }
    }
    return std::move(found_);
  }

 private:
  void add_point(const PointLight& light, std::size_t emitter) {
    const LightSample sample = light.sample_light(receiver_);
    if (!(sample.irradiance > 0.0) || is_blocked(tracer_, receiver_, sample.target, count_)) return;
    const double length = glm::length(light.position() - receiver_.point) + axes_.delay_m[emitter];
    found_.paths.push_back({axes_.group_of_emitter[emitter], length, sample.irradiance, SightPath::exact});
    see(emitter, length, true);
  }

  void see(std::size_t emitter, double length, bool exact) {
    FirstSight& first = found_.first[axes_.group_of_emitter[emitter]];
    if (length < first.length_m || (exact && length == first.length_m)) first = {length, exact};
  }

  void add_area(const AreaLight& light, std::size_t emitter) {
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
      const DirectIrradiance mean =
          AreaLightSampler(light, tracer_, same_point, stream_, number, count_, record).sample(accuracy);
      for (std::size_t k = begin; k < found_.paths.size(); ++k) found_.paths[k].irradiance *= mean.value / sum;
    }
    if (shortest == std::numeric_limits<double>::infinity()) return;
    const double nearest = nearest_length(emitter) + axes_.delay_m[emitter];
    const bool exact = nearest <= shortest;
    see(emitter, exact ? nearest : shortest, exact);
  }

  // The length of the shortest path from an area light, if it is free; else infinite.
  double nearest_length(std::size_t emitter) {
    const Surface& surface = room_.surfaces[*emitting_surface(room_.emitters[emitter])];
    double shortest = std::numeric_limits<double>::infinity();
    glm::dvec3 nearest(0.0);
    for (const glm::uvec3& corner : surface.triangles) {
      const glm::dvec3& a = surface.positions[corner.x];
      const glm::dvec3& b = surface.positions[corner.y];
      const glm::dvec3& c = surface.positions[corner.z];
      if (glm::dot(glm::cross(b - a, c - a), receiver_.point - a) <= 0.0) continue;  // its back
      const glm::dvec3 point = nearest_of_triangle(receiver_.point, a, b, c);
      const double length = glm::length(point - receiver_.point);
      if (length >= shortest) continue;
      shortest = length;
      nearest = point;
    }
    const double cosine = glm::dot(nearest - receiver_.point, receiver_.normal) / shortest;
    const bool is_free = shortest > 0.0 && cosine > std::max(0.0, receiver_.least_cosine) &&
                         tracer_.faces_in_one_plane() == nullptr && !is_blocked(tracer_, receiver_, nearest, count_);
    return is_free ? shortest : std::numeric_limits<double>::infinity();
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
};

}  // namespace

LineOfSight line_of_sight(const Room& room, const ChannelAxes& axes, const DirectLight& light, const Tracer& tracer,
                          const ReferencePoint& receiver, const Stream& stream, std::uint64_t number) {
  return Sight(room, axes, light, tracer, receiver, stream, number).find();
}

}  // namespace lichtmc
