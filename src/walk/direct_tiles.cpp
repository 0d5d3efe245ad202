#include "walk/direct_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "chance/paired_strata.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

// Binary logarithms of numbers of strata.
constexpr std::uint32_t first_doublings = 5;  // of the samples that tell how many are needed: 64
constexpr std::uint32_t least_doublings = 4;
constexpr std::uint32_t last_doublings = 12;  // at most: 8192 samples

// The variance of strata falls faster than that of independent points. Of functions with edges in d dimensions, such as
// shadows, as n^−(1 + 1/d) (J. Matoušek, Geometric Discrepancy, 1999, ch. 3): the exponent is 1.5 on a tile, 1.25 for
// pairs of points of a tile and a light.
double exponent_of(const LightOnFace& light) {
  return 1.0 + 1.0 / static_cast<double>(light.dimensions().size());
}

// One emitter's light on a face.
class Part {
 public:
  Part(std::unique_ptr<LightOnFace> light, std::uint64_t number)
      : light_(std::move(light)), number_(number), exponent_(exponent_of(*light_)) {}

  LightOnFace& light() const { return *light_; }
  double exponent() const { return exponent_; }

  // Takes samples in 2^doublings strata, in addition to those before, whose random words are others.
  void sample(std::uint32_t doublings, const FaceTriangles& face, const Stream& stream, const Tracer& tracer,
              TraceCount& count);
  void forget_samples() { levels_.clear(); }
  std::uint32_t doublings() const { return doublings_; }
  double samples() const { return std::exp2(doublings_ + 1.0); }

  // If the light without shadows is known, samples tell what shadows take away, relative to this fraction of it that is
  // visible by the samples so far; those that follow are unbiased for any fraction.
  void fix_factor() {
    const PairSums& first = levels_.front();
    factor_ = light_->unshadowed() && first.w > 0.0 ? first.v / first.w : 0.0;
  }
  // Nothing casts a shadow: the light without shadows is all.
  void set_exact() {
    exact_ = true;
    factor_ = 1.0;
  }
  bool is_exact() const { return exact_; }

  double value() const { return factor_ * light_->unshadowed().value_or(0.0) + of_samples().first; }
  double variance() const { return of_samples().second; }
  double error_of_rules() const { return factor_ * light_->error_of_unshadowed(); }
  double unshadowed() const {
    if (const auto known = light_->unshadowed()) return *known;
    return levels_.front().mean_w();
  }
  bool all_visible() const { return levels_.front().v == levels_.front().w; }

 private:
  // Mean and variance. Each level is an independent estimate with a weight proportional to the reciprocal of its likely
  // variance.
  std::pair<double, double> of_samples() const {
    double weights = 0.0;
    double mean = 0.0;
    double variance = 0.0;
    for (const PairSums& level : levels_) {
      const double weight = std::pow(static_cast<double>(level.points), exponent_);
      weights += weight;
      mean += weight * level.mean(factor_);
      variance += weight * weight * level.variance(factor_);
    }
    if (levels_.empty()) return {0.0, 0.0};
    return {mean / weights, variance / (weights * weights)};
  }

  std::unique_ptr<LightOnFace> light_;
  std::uint64_t number_;
  double exponent_;
  double factor_ = 0.0;
  std::vector<PairSums> levels_;  // v: of the light that arrives, w: of all without shadows
  std::uint32_t doublings_ = 0;   // of the last of them
  std::uint32_t drawn_ = 0;       // of all, and of those that are forgotten
  bool exact_ = false;
};

void Part::sample(std::uint32_t doublings, const FaceTriangles& face, const Stream& stream, const Tracer& tracer,
                  TraceCount& count) {
  const PairedStrata strata(doublings, light_->dimensions());
  doublings_ = doublings;
  constexpr std::uint32_t boxes_at_a_time = 256;
  PairSums sums;
  std::vector<Connection> found;
  std::vector<std::array<double, 2>> visible;  // of each box
  std::vector<std::array<double, 2>> all;
  struct Tested {
    double* sum;
    double irradiance;
  };
  std::vector<Tested> tested;
  ShadowRays rays(4 * boxes_at_a_time);
  for (std::uint32_t first = 0; first < strata.boxes(); first += boxes_at_a_time) {
    const std::uint32_t boxes = std::min(boxes_at_a_time, strata.boxes() - first);
    visible.assign(boxes, {});
    all.assign(boxes, {});
    tested.clear();
    rays.clear();
    for (std::uint32_t k = 0; k < 2 * boxes; ++k, ++drawn_) {
      const Words words = stream.draw(number_, drawn_, Purpose::direct_place);
      found.clear();
      light_->sample(strata.point(first + k / 2, words), found);
      double& sum = visible[k / 2][k % 2];
      for (const Connection& one : found) {
        all[k / 2][k % 2] += one.irradiance;
        const glm::dvec3 start = face.start(one.from);
        const auto segment = tracer.casts_shadows() ? shadow_segment(tracer, start, one.target) : std::nullopt;
        if (!segment) {
          sum += one.irradiance;
          continue;
        }
        tested.push_back({&sum, one.irradiance});
        rays.add(glm::vec3(start), *segment);
      }
    }
    if (rays.size > 0) tracer.find_blocked(rays, count);
    for (std::size_t k = 0; k < tested.size(); ++k) {
      if (rays.blocked[k] == 0) *tested[k].sum += tested[k].irradiance;
    }
    for (std::uint32_t k = 0; k < boxes; ++k) sums.add(visible[k], all[k]);
  }
  levels_.push_back(sums);
}

}  // namespace

// The light of all emitters on a face.
class DirectTiles::Sum {
 public:
  Sum(const DirectTiles& tiles, std::size_t face, TraceCount& count)
      : tiles_(tiles),
        face_(face),
        triangles_(*tiles.faces_, face, *tiles.tracer_),
        floor_(tiles.accuracy_.floor),
        count_(count) {
    const std::vector<double>& least = tiles.accuracy_.least;
    if (!least.empty()) floor_ = std::max(floor_, least[(*tiles.faces_)[face].tile]);
    const std::size_t points = tiles.light_->points().size();
    const std::size_t areas = points + tiles.light_->areas().size();
    sources_ = areas + tiles.light_->openings().size();
    for (std::size_t k = 0; k < points; ++k) add_point(k, tiles.light_->points()[k]);
    for (std::size_t k = points; k < areas; ++k) add_area(k, tiles.light_->areas()[k - points]);
    for (std::size_t k = areas; k < sources_; ++k) add_opening(k, tiles.light_->openings()[k - areas]);
  }

  // The first samples determine how many are needed, and are not used otherwise: so neither the mean nor its error is
  // biased by the choice. If they have missed what most of the variance comes from, such as a small patch of light,
  // more follow.
  DirectIrradiance compute() {
    for (Part& part : parts_) {
      if (part.is_exact()) continue;
      sample(part, first_doublings);
      part.fix_factor();
    }
    std::erase_if(parts_, [](const Part& part) { return !(part.unshadowed() > 0.0); });
    for (Part& part : parts_) integrate_if_cheaper(part);
    std::vector<std::uint32_t> needed = needed_doublings();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (parts_[k].is_exact()) continue;
      parts_[k].forget_samples();
      sample(parts_[k], needed[k]);
    }
    constexpr double far_above = 2.0;
    if (total().standard_error <= far_above * allowed()) return total();
    needed = needed_doublings();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (needed[k] > parts_[k].doublings()) sample(parts_[k], needed[k]);
    }
    return total();
  }

 private:
  void sample(Part& part, std::uint32_t doublings) {
    part.sample(doublings, triangles_, tiles_.stream_, *tiles_.tracer_, count_);
  }

  DirectIrradiance total() const {
    DirectIrradiance sum = apart_;
    double variance = sum.standard_error * sum.standard_error;
    for (const Part& part : parts_) {
      const double of_rules = part.error_of_rules();
      sum.value += part.value();
      variance += part.variance() + of_rules * of_rules;
    }
    sum.standard_error = std::sqrt(variance);
    return sum;
  }

  // The error that the sum may have, W/m² or lx.
  double allowed() const { return tiles_.accuracy_.relative * std::max(total().value, floor_); }

  // A third of the whole, because it adds to the error of the samples.
  IntegralAccuracy of_integrals() const {
    const double relative = tiles_.accuracy_.relative / 3.0;
    return {relative, relative * floor_};
  }

  void add_point(std::size_t k, const PointLight& source) {
    auto light = std::make_unique<PointOnFace>(triangles_, source, of_integrals());
    if (light->is_dark()) return;
    parts_.emplace_back(std::move(light), face_ * sources_ + k);
    if (!tiles_.tracer_->casts_shadows()) parts_.back().set_exact();
  }

  void add_opening(std::size_t k, const PointLight& source) {
    auto light = std::make_unique<OpeningOnFace>(triangles_, source);
    if (!light->is_dark()) parts_.emplace_back(std::move(light), face_ * sources_ + k);
  }

  void add_area(std::size_t k, const AreaLight& source) {
    auto light = std::make_unique<AreaOnFace>(triangles_, source);
    if (light->is_dark()) return;
    if (light->is_near() && light->has_many_triangles()) {
      add_with_traced_flights(source, face_ * sources_ + k);
      return;
    }
    const bool exact = !tiles_.tracer_->casts_shadows() && light->integrate(of_integrals());
    parts_.emplace_back(std::move(light), face_ * sources_ + k);
    if (exact) parts_.back().set_exact();
  }

  // As at receivers, from random points of the face.
  void add_with_traced_flights(const AreaLight& source, std::uint64_t number) {
    const auto random_place = [&](std::uint32_t n) {
      const Words words = tiles_.stream_.draw(number, n, Purpose::direct_place);
      return tiles_.faces_->reference(face_, tiles_.faces_->place(face_, unit_open(words[0]), unit_open(words[1])));
    };
    constexpr std::uint32_t most = 4096;
    const double relative = tiles_.accuracy_.relative;
    const DirectIrradiance part = sample_area_light(source, *tiles_.tracer_, random_place, tiles_.stream_, number,
                                                    {relative, relative * floor_, most}, count_);
    const double share = tiles_.faces_->uncovered_share(face_);
    apart_.value += share * part.value;
    apart_.standard_error = std::hypot(apart_.standard_error, share * part.standard_error);
  }

  // If nothing was in the way, a light with a closed form may be integrated instead.
  void integrate_if_cheaper(Part& part) {
    if (part.is_exact() || part.light().unshadowed() || !part.all_visible()) return;
    const double excess = 2.0 * part.variance() / (allowed() * allowed());
    const double needed = part.samples() * std::pow(excess, 1.0 / part.exponent());
    if (excess > 1.0 && needed > part.light().integration_cost() && part.light().integrate(of_integrals()))
      part.fix_factor();
  }

  // A patch of light or shadow may lie between the samples of a part. There are at least so many that the share of the
  // tile between them contributes no more than is allowed.
  std::uint32_t least_doublings_of(const Part& part) const {
    constexpr double most = 256.0;
    if (part.is_exact()) return 0;
    if (!tiles_.tracer_->casts_shadows()) return least_doublings;
    const double samples = std::min(most, part.unshadowed() / allowed());
    return std::max(least_doublings, static_cast<std::uint32_t>(std::ceil(std::log2(std::max(1.0, 0.5 * samples)))));
  }

  // The doublings of each part: more where they reduce the expected variance most for their number, until the sum is
  // as accurate as required.
  std::vector<std::uint32_t> needed_doublings() const {
    struct Expected {
      double variance = 0.0;
      std::uint32_t doublings = 0;
      // Twice the samples: so much less.
      double gain(double exponent) const { return variance * (1.0 - std::exp2(-exponent)); }
    };
    std::vector<Expected> expected;
    double variance = 0.0;
    for (const Part& part : parts_) {
      const std::uint32_t least = least_doublings_of(part);
      const double change = static_cast<double>(least) - static_cast<double>(part.doublings());
      expected.push_back({part.variance() * std::exp2(-part.exponent() * change), least});
      variance += expected.back().variance;
    }
    const double limit = allowed() * allowed();
    while (variance > limit) {
      std::size_t best = parts_.size();
      double most = 0.0;
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        const double gain =
            expected[k].gain(parts_[k].exponent()) * std::exp2(-static_cast<double>(expected[k].doublings));
        if (expected[k].doublings >= last_doublings || !(gain > most)) continue;
        most = gain;
        best = k;
      }
      if (best == parts_.size()) break;
      const double gain = expected[best].gain(parts_[best].exponent());
      variance -= gain;
      expected[best].variance -= gain;
      ++expected[best].doublings;
    }
    std::vector<std::uint32_t> doublings;
    for (const Expected& one : expected) doublings.push_back(one.doublings);
    return doublings;
  }

  const DirectTiles& tiles_;
  std::size_t face_;
  FaceTriangles triangles_;
  double floor_;  // W/m² or lx: errors are relative to at least this
  TraceCount& count_;
  std::size_t sources_ = 0;
  std::vector<Part> parts_;
  DirectIrradiance apart_;  // of emitters that are sampled otherwise
};

DirectTiles::DirectTiles(const DirectLight& light, const TileFaces& faces, const Tracer& tracer, const Stream& stream,
                         TileAccuracy accuracy)
    : light_(&light), faces_(&faces), tracer_(&tracer), stream_(stream), accuracy_(std::move(accuracy)) {}

DirectIrradiance DirectTiles::mean(std::size_t face, TraceCount& count) const {
  return Sum(*this, face, count).compute();
}

}  // namespace lichtmc
