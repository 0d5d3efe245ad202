#include "plain_backward.hpp"

#include "base/frame.hpp"
#include "chance/places.hpp"
#include "walk/estimators.hpp"
#include "walk/kernel.hpp"
#include "walk/visibility.hpp"

namespace lichtmc::bench {

namespace {

class PlainGoal : public GoalBase {
 public:
  PlainGoal(const Scene& scene, const DirectLight& light, const std::vector<ReferencePoint>& receivers,
            const Stream& stream)
      : scene_(&scene),
        light_(&light),
        receivers_(&receivers),
        stream_(stream),
        ids_(batch_histories),
        origin_(batch_histories),
        irradiance_(batch_histories),
        found_(batch_histories),
        direct_(batch_histories) {}

  void prepare(std::size_t i, std::uint64_t origin, std::uint64_t sample) {
    origin_[i] = origin;
    ids_[i] = sample * receivers_->size() + origin;
  }
  double irradiance(std::uint32_t i) const { return irradiance_[i]; }
  std::uint64_t origin(std::uint32_t i) const { return origin_[i]; }

  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const ReferencePoint& reference = (*receivers_)[origin_[i]];
      wave.rays.facet[i] = no_facet;
      wave.rays.set_start(i, glm::vec3(start_of(reference, *scene_->tracer)));
      const Words words = stream_.draw(ids_[i], 0, Purpose::emission);
      const ConeDirection flight =
          sample_cosine_cone(frame_about(reference.normal), 1.0, unit_open(words[0]), unit_open(words[1]));
      wave.rays.set_direction(i, glm::vec3(scene_->tracer->directions() * flight.direction));
      found_[i] = 0.0;
    }
  }
  void number_histories(Wave& wave) const {
    for (std::size_t i = 0; i < wave.rays.size; ++i) wave.history[i] = ids_[wave.photon[i]];
  }
  void escape(const Wave& wave, std::size_t i) { finish(wave, i); }
  static constexpr bool watches_absorption = true;
  void absorb(const Wave& wave, std::size_t i, double /*reflectance*/) { finish(wave, i); }
  void cut_off(const Wave& wave, std::size_t i) { finish(wave, i); }
  void move(Wave& /*wave*/, std::size_t from, std::size_t to) { found_[to] = found_[from]; }

  void reflect(const Wave& wave, std::uint32_t flight) {
    const std::size_t n = wave.rays.size;
    for (std::size_t i = 0; i < n; ++i) direct_[i] = 0.0;
    for (std::size_t k = 0; k < light_->light_samples_per_point(); ++k) {
      for (std::size_t i = 0; i < n; ++i) add_light_sample(wave, flight, i, k);
    }
    for (std::size_t i = 0; i < n; ++i) found_[i] += wave.weight[i] * direct_[i];
  }

 private:
  void add_light_sample(const Wave& wave, std::uint32_t flight, std::size_t i, std::size_t k) {
    const Rays& rays = wave.rays;
    const Tracer& tracer = *scene_->tracer;
    const glm::dvec3 start(rays.start(i));
    const glm::dvec3 normal = world_normal(tracer, tracer.facets()[rays.facet[i]]);
    const ReferencePoint reference{tracer.world_point(start), rays.behind[i] != 0 ? -normal : normal, 0.0};
    const auto number = static_cast<std::uint32_t>(flight * light_->light_samples_per_point() + k);
    const Words which = stream_.draw(ids_[wave.photon[i]], number, Purpose::light);
    const LightSample sample = light_->sample_light(k, light_->cell_of(reference), reference, which, Words{});
    if (!(sample.irradiance > 0.0)) return;
    const auto segment = tracer.casts_shadows() ? shadow_segment(tracer, start, sample.target) : std::nullopt;
    if (!segment || !tracer.is_blocked(rays.start(i), *segment, traced())) direct_[i] += sample.irradiance;
  }
  void finish(const Wave& wave, std::size_t i) { irradiance_[wave.photon[i]] = found_[i]; }

  const Scene* scene_;
  const DirectLight* light_;
  const std::vector<ReferencePoint>* receivers_;
  Stream stream_;
  std::vector<std::uint64_t> ids_;
  std::vector<std::uint64_t> origin_;
  std::vector<double> irradiance_;
  std::vector<double> found_;
  std::vector<double> direct_;
};

}  // namespace

struct PlainBackward::Parts {
  Parts(const Scene& scene, const DirectLight& light, const std::vector<ReferencePoint>& all)
      : receivers(all.size()),
        goal(scene, light, all, Stream(1, WalkDirection::backward)),
        kernel(scene, Stream(1, WalkDirection::backward), 0) {}

  std::size_t receivers;
  PlainGoal goal;
  Kernel<RouletteWeightPolicy, SurfaceReflectance, PlainGoal> kernel;
};

PlainBackward::PlainBackward(const Scene& scene, const DirectLight& light, const std::vector<ReferencePoint>& receivers)
    : parts_(std::make_unique<Parts>(scene, light, receivers)) {}

PlainBackward::~PlainBackward() = default;

void PlainBackward::walk(std::uint64_t first, std::uint64_t n, std::vector<double>& sums,
                         std::vector<double>& squares) {
  std::uint32_t in_wave = 0;
  PlainGoal& goal = parts_->goal;
  const auto fly = [&] {
    parts_->kernel.fly(in_wave, goal, [] { return false; });
    for (std::uint32_t i = 0; i < in_wave; ++i) {
      sums[goal.origin(i)] += goal.irradiance(i);
      squares[goal.origin(i)] += goal.irradiance(i) * goal.irradiance(i);
    }
    in_wave = 0;
  };
  for (std::uint64_t origin = 0; origin < parts_->receivers; ++origin) {
    for (std::uint64_t sample = first; sample < first + n; ++sample) {
      goal.prepare(in_wave++, origin, sample);
      if (in_wave == batch_histories) fly();
    }
  }
  if (in_wave > 0) fly();
}

}  // namespace lichtmc::bench
