#include "plain_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "chance/directions.hpp"
#include "chance/places.hpp"
#include "walk/in_beam.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc::bench {

namespace {

constexpr double pi = std::numbers::pi;

// An emitter with more triangles is sampled: the closed form would cost more than the rays.
constexpr std::size_t most_triangles = 64;

// The integrated sub-triangles of a face.
using Leaves = std::vector<IntegratedTriangle>;

// Integrates light(reference point) over the pieces of a face for which may_receive(reference point) is true.
template <class Light, class MayReceive, class Coarse, class IsZero>
Leaves integrate_face(const TileFaces& faces, std::size_t face, const Light& light, const MayReceive& may_receive,
                      const Coarse& coarse, const IsZero& is_zero, double relative, double absolute) {
  const Surface& surface = faces.surface(face);
  const std::span<const TilePiece> pieces = faces.pieces(face);
  Leaves leaves;
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const TilePiece& piece = pieces[n];
    ReferencePoint reference = faces.reference(face, {piece.triangle, piece.weights[0]});
    if (!may_receive(reference)) continue;
    const auto at = [&](const glm::dvec3& point) {
      reference.point = point;
      return light(reference);
    };
    const Triangle triangle{point_at(surface, piece.triangle, piece.weights[0]),
                            point_at(surface, piece.triangle, piece.weights[1]),
                            point_at(surface, piece.triangle, piece.weights[2])};
    const std::size_t before = leaves.size();
    integrate(triangle, at, coarse, is_zero, relative, absolute, leaves);
    for (std::size_t k = before; k < leaves.size(); ++k) leaves[k].part = n;
  }
  return leaves;
}

double sum_of(const Leaves& leaves) {
  double sum = 0.0;
  for (const IntegratedTriangle& leaf : leaves) sum += leaf.integral;
  return sum;
}

double error_of(const Leaves& leaves) {
  double sum = 0.0;
  for (const IntegratedTriangle& leaf : leaves) sum += leaf.error;
  return sum;
}

// The fraction of the unshadowed flux that arrives on a face: the mean over pairs of points in s × s strata.
struct VisibleFraction {
  double value = 1.0;
  double standard_error = 0.0;
};

struct Sample {
  double weight = 0.0;  // flux that it represents, relative to the others
  bool visible = false;
};

// The ratio Σ weight·visible/Σ weight over pairs, two samples in each stratum, and its error by the differences within
// the pairs.
VisibleFraction ratio_of(const std::vector<Sample>& samples) {
  double all = 0.0;
  double visible = 0.0;
  for (const Sample& sample : samples) {
    all += sample.weight;
    if (sample.visible) visible += sample.weight;
  }
  if (!(all > 0.0)) return {};
  VisibleFraction result{visible / all, 0.0};
  const auto residual = [&](const Sample& sample) {
    return sample.weight * ((sample.visible ? 1.0 : 0.0) - result.value);
  };
  double squares = 0.0;
  for (std::size_t k = 0; k + 1 < samples.size(); k += 2) {
    const double difference = residual(samples[k]) - residual(samples[k + 1]);
    squares += difference * difference;
  }
  result.standard_error = std::sqrt(squares) / all;
  return result;
}

// A point of the leaves: u chooses a leaf in proportion to its integral; the point is uniform on that leaf.
struct LitPoint {
  ReferencePoint reference;
  double density = 0.0;  // integral per area of the chosen leaf
};

class LitPoints {
 public:
  LitPoints(const Leaves& leaves, const TileFaces& faces, std::size_t face)
      : leaves_(leaves), faces_(faces), face_(face), all_(sum_of(leaves)) {
    double sum = 0.0;
    for (const IntegratedTriangle& leaf : leaves) up_to_.push_back(sum += leaf.integral);
  }
  LitPoint at(double u, double v) const {
    const double light = u * all_;
    const auto found = std::upper_bound(up_to_.begin(), up_to_.end(), light);
    const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(found - up_to_.begin()), leaves_.size() - 1);
    const IntegratedTriangle& leaf = leaves_[k];
    const double within = (light - (up_to_[k] - leaf.integral)) / leaf.integral;
    const Triangle& t = leaf.triangle;
    const glm::dvec2 weights = uniform_on_triangle(std::clamp(within, 0.0, 1.0), v);
    return {reference(leaf, point_of_triangle(t[0], t[1], t[2], weights)), leaf.integral / area_of(t)};
  }
  // The reference point at a point of a leaf.
  ReferencePoint reference(const IntegratedTriangle& leaf, const glm::dvec3& point) const {
    const TilePiece& piece = faces_.pieces(face_)[leaf.part];
    ReferencePoint result = faces_.reference(face_, {piece.triangle, piece.weights[0]});
    result.point = point;
    return result;
  }

 private:
  const Leaves& leaves_;
  const TileFaces& faces_;
  std::size_t face_;
  double all_;
  std::vector<double> up_to_;
};

// Samples in increasingly fine strata until the error is small enough. sample_at(u, v, n): sample n at a point of the
// unit square. If all samples are visible, or none, confirms(all) returns whether that is confirmed.
template <class SampleAt, class Confirm>
VisibleFraction visible_fraction(const SampleAt& sample_at, const Confirm& confirms, const Stream& stream,
                                 std::uint64_t number, double allowed) {
  constexpr std::uint32_t coarsest = 8;  // strata along each side
  constexpr std::uint32_t finest = 32;
  VisibleFraction result;
  std::vector<Sample> samples;
  std::uint32_t drawn = 0;
  for (std::uint32_t s = coarsest; s <= finest; s *= 2) {
    samples.clear();
    for (std::uint32_t k = 0; k < 2 * s * s; ++k, ++drawn) {
      const Words words = stream.draw(number, drawn, Purpose::direct_place);
      const std::uint32_t column = k / 2 % s;
      const std::uint32_t row = k / 2 / s;
      samples.push_back(sample_at((column + unit_open(words[0])) / s, (row + unit_open(words[1])) / s, drawn));
    }
    result = ratio_of(samples);
    if (result.standard_error > allowed) continue;
    const bool unanimous = result.value == 0.0 || result.value == 1.0;
    if (s > coarsest || !unanimous || confirms(result.value == 1.0)) break;
  }
  return result;
}

// The first point where a ray hits the front of the emitter, if nothing else is hit before.
std::optional<glm::dvec3> nearest_hit(const AreaLight& source, const ReferencePoint& reference,
                                      const glm::dvec3& direction) {
  std::vector<LightSample> hits;
  source.add_fronts_hit(reference, direction, hits);
  const auto distance = [&](const LightSample& hit) { return glm::length(hit.target - reference.point); };
  const auto nearest = std::min_element(
      hits.begin(), hits.end(), [&](const LightSample& a, const LightSample& b) { return distance(a) < distance(b); });
  return nearest == hits.end() ? std::nullopt : std::optional(nearest->target);
}

}  // namespace

double PlainTiles::accuracy(double target_error) {
  constexpr double coarsest = 3e-3;
  constexpr double finest = 1e-4;
  return std::clamp(target_error / 3.0, finest, coarsest);
}

PlainTiles::PlainTiles(const DirectLight& light, const TileFaces& faces, const Tracer& tracer, const Stream& stream,
                       double relative, double level)
    : light_(&light), faces_(&faces), tracer_(&tracer), stream_(stream), relative_(relative), level_(level) {}

// The flux of the leaves times the visible fraction. sample_at(reference point, n): sample n at a point of the face.
template <class SampleAt>
DirectIrradiance PlainTiles::shadowed(const Leaves& leaves, std::size_t face, std::uint64_t number,
                                      const SampleAt& sample_at) const {
  if (leaves.empty()) return {};
  const double unshadowed = sum_of(leaves) / faces_->area_m2(face);
  const double by_rules = error_of(leaves) / faces_->area_m2(face);
  if (!tracer_->casts_shadows()) return {unshadowed, by_rules};
  const LitPoints points(leaves, *faces_, face);
  // The edge of a shadow, or of a patch of light, on a part of a tile mostly crosses the boundary of the tile. Points
  // close to it, some on each side of each triangle, detect it.
  const auto confirms = [&](bool all) {
    constexpr double to_rim = 0.99;
    constexpr int on_side = 6;
    std::uint32_t n = std::uint32_t{1} << 24;  // beyond the numbers of the samples
    for (const IntegratedTriangle& leaf : leaves) {
      const glm::dvec3 middle = centroid_of(leaf.triangle);
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 side = leaf.triangle[(k + 1) % 3] - leaf.triangle[k];
        for (int i = 0; i < on_side; ++i) {
          const glm::dvec3 rim = leaf.triangle[k] + (static_cast<double>(i) / on_side) * side;
          const Sample sample = sample_at(points.reference(leaf, middle + to_rim * (rim - middle)), n++);
          if (sample.weight > 0.0 && sample.visible != all) return false;
        }
      }
    }
    return true;
  };
  const auto weighted_sample = [&](double u, double v, std::uint32_t n) {
    const LitPoint chosen = points.at(u, v);
    Sample sample = sample_at(chosen.reference, n);
    sample.weight /= chosen.density;
    return sample;
  };
  const VisibleFraction fraction =
      visible_fraction(weighted_sample, confirms, stream_, number, relative_ * std::max(1.0, level_ / unshadowed));
  return {unshadowed * fraction.value, std::hypot(unshadowed * fraction.standard_error, fraction.value * by_rules)};
}

DirectIrradiance PlainTiles::by_point(const PointLight& source, std::size_t face, std::uint64_t number,
                                      TraceCount& count) const {
  const InBeam beam{source};
  const Leaves leaves = integrate_face(
      *faces_, face, [&](const ReferencePoint& reference) { return source.sample_light(reference).irradiance; },
      [&](const ReferencePoint& reference) {
        return glm::dot(source.position() - reference.point, reference.normal) > 0.0;
      },
      [&](const Triangle& t, int depth) { return beam.coarse(t, depth); },
      [&](const Triangle& t) { return beam.is_outside(t); }, relative_, relative_ * level_);
  const auto sample_at = [&](const ReferencePoint& reference, std::uint32_t) {
    return Sample{source.sample_light(reference).irradiance,
                  !is_blocked(*tracer_, reference, source.position(), count)};
  };
  return shadowed(leaves, face, number, sample_at);
}

DirectIrradiance PlainTiles::by_surface(std::size_t k, std::size_t face, std::uint64_t number,
                                        TraceCount& count) const {
  const AreaLight& source = light_->areas()[k];
  if (!source.has_closed_form() || source.triangles() > most_triangles) {
    const auto random_place = [&](std::uint32_t n) {
      const Words words = stream_.draw(number, n, Purpose::direct_place);
      return faces_->reference(face, faces_->place(face, unit_open(words[0]), unit_open(words[1])));
    };
    constexpr std::uint32_t most = 4096;
    DirectIrradiance result = sample_area_light(source, *tracer_, random_place, stream_, number,
                                                {relative_, relative_ * level_, most}, count);
    result.value *= faces_->uncovered_share(face);
    result.standard_error *= faces_->uncovered_share(face);
    return result;
  }
  const auto no = [](const Triangle&, int = 0) { return false; };
  const Leaves leaves = integrate_face(
      *faces_, face, [&](const ReferencePoint& reference) { return source.polygon_irradiance(reference); },
      [&](const ReferencePoint& reference) { return source.reaches_above_horizon(reference); }, no, no, relative_,
      relative_ * level_);
  // Points sampled uniformly on a near emitter rarely lie where it contributes most. Near emitters are sampled by
  // flights with Lambert's law instead, which hit the emitter with the probability of its projected solid angle over π.
  constexpr double close = 0.1;
  const double whole_hemisphere = pi * source.radiance(1.0);
  const auto sample_at = [&](const ReferencePoint& reference, std::uint32_t n) {
    const Words words = stream_.draw(number, n, Purpose::direct_point);
    if (source.polygon_irradiance(reference) > close * whole_hemisphere) {
      const glm::dvec3 local(sample_lambert(words[0], words[1]));
      const Frame frame = frame_about(reference.normal);
      const auto target =
          nearest_hit(source, reference, local.x * frame.tangent + local.y * frame.bitangent + local.z * frame.normal);
      if (!target) return Sample{};
      return Sample{whole_hemisphere, !is_blocked(*tracer_, reference, *target, count)};
    }
    const LightSample sample =
        source.sample_light(reference, unit_open(words[0]), unit_open(words[1]), unit_open(words[2]));
    if (!(sample.irradiance > 0.0)) return Sample{};
    return Sample{sample.irradiance, !is_blocked(*tracer_, reference, sample.target, count)};
  };
  return shadowed(leaves, face, number, sample_at);
}

DirectIrradiance PlainTiles::mean(std::size_t face, TraceCount& count) const {
  DirectIrradiance sum;
  double variance = 0.0;
  const std::size_t points = light_->points().size();
  const std::size_t sources = points + light_->areas().size();
  for (std::size_t k = 0; k < sources; ++k) {
    const std::uint64_t number = face * sources + k;
    const DirectIrradiance part =
        k < points ? by_point(light_->points()[k], face, number, count) : by_surface(k - points, face, number, count);
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

}  // namespace lichtmc::bench
