#include "run/receive.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "walk/backward.hpp"
#include "walk/direct_light.hpp"

namespace lichtmc {

namespace {

using Clock = std::chrono::steady_clock;

// Histories that a thread takes at a time: some waves, so that the lock that ends them costs nothing.
constexpr std::uint64_t histories_at_a_time = 8192;

[[noreturn]] void refuse_on_emitter(const Room& room, std::size_t receiver, std::size_t emitter) {
  throw InputError("Receiver " + std::to_string(receiver) + ", " + in_quotes(room.receivers[receiver].name) + ", of " +
                   room.source + " lies on the emitter " + in_quotes(room.emitters[emitter].name) +
                   " (allowed: some distance), where irradiance has no value. Move it away.");
}

class Reception {
 public:
  Reception(const Room& room, const Scene& scene, const Settings& settings, const Control& control, unsigned threads,
            Result& result)
      : room_(room),
        scene_(scene),
        settings_(settings),
        control_(control),
        threads_(threads),
        result_(result),
        light_(room, *scene.tracer),
        scale_(room),
        sums_(room.receivers.size()),
        direct_errors_(room.receivers.size()),
        began_(Clock::now()),
        reported_(began_) {}

  void run() {
    result_.receiver_results.resize(room_.receivers.size());
    for_all_threads([this] { take_direct_light(); });
    if (!stopped_) {
      result_.backward.stopped_by = simulate();
    } else {
      result_.backward.stopped_by = *stopped_;
    }
    if (samples_ == 0) {
      throw RuntimeError(
          "The run was stopped before the first walk from the receivers was simulated: there is no result. Give it "
          "more "
          "time.");
    }
    fill_in();
  }

 private:
  void for_all_threads(const std::function<void()>& work);
  void take_direct_light();
  StopReason simulate();
  void simulate_up_to(std::uint64_t samples);
  void take_samples(std::uint64_t first_sample, std::uint64_t last_sample);
  bool should_stop();
  void report(std::uint64_t histories);
  void fill_in();
  double rms_relative_error() const;
  double indirect_error(std::size_t k) const;
  double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

  const Room& room_;
  const Scene& scene_;
  const Settings& settings_;
  const Control& control_;
  unsigned threads_;
  Result& result_;
  DirectLight light_;
  ReceiverScale scale_;
  std::vector<ReceiverSums> sums_;
  std::vector<float> direct_errors_;  // of surface emitters
  std::uint64_t samples_ = 0;         // done for every receiver
  std::uint64_t target_ = 0;          // histories
  std::atomic<std::uint64_t> next_{0};
  std::atomic<bool> stop_{false};
  std::optional<StopReason> stopped_;
  std::mutex mutex_;  // guards what follows, stopped_ and the sums
  std::exception_ptr failure_;
  TraceCount traced_;
  std::uint64_t histories_done_ = 0;
  double error_ = std::numeric_limits<double>::quiet_NaN();  // at the last look
  Clock::time_point began_;
  Clock::time_point reported_;
};

void Reception::for_all_threads(const std::function<void()>& work) {
  next_ = 0;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned k = 1; k < threads_; ++k) helpers.emplace_back(guarded);
    guarded();
  }
  if (failure_) std::rethrow_exception(failure_);
}

void Reception::take_direct_light() {
  constexpr std::uint64_t at_a_time = 64;
  const Stream stream(settings_.seed, Way::backward);
  const std::uint64_t count = room_.receivers.size();
  TraceCount traced;
  while (!should_stop()) {
    const std::uint64_t first = next_.fetch_add(at_a_time);
    if (first >= count) break;
    for (std::uint64_t k = first; k < std::min(count, first + at_a_time); ++k) {
      const Receiver& receiver = room_.receivers[k];
      if (receiver.half_angle_deg == 0.0) continue;  // it sees nothing
      const Outlook outlook = outlook_of(receiver);
      if (const auto emitter = light_.emitter_at(outlook)) refuse_on_emitter(room_, k, *emitter);
      const DirectIrradiance direct = light_.at(outlook, stream, k, traced);
      result_.receiver_results[k].direct = direct.value;
      direct_errors_[k] = static_cast<float>(direct.standard_error);
    }
  }
  const std::lock_guard lock(mutex_);
  traced_.rays += traced.rays;
  traced_.shadow_rays += traced.shadow_rays;
}

// As many samples for every receiver; the target error is looked at after numbers of them that depend on the settings
// alone.
StopReason Reception::simulate() {
  const std::uint64_t receivers = room_.receivers.size();
  const std::uint64_t last =
      std::max<std::uint64_t>(2, settings_.photons / receivers + (settings_.photons % receivers != 0));
  target_ = last > std::numeric_limits<std::uint64_t>::max() / receivers ? std::numeric_limits<std::uint64_t>::max()
                                                                         : last * receivers;
  constexpr std::uint64_t first_look = 256;  // an error from so many samples is known to 4 %
  // Without a target error looks serve progress and the end by time: sums are whole at each.
  std::uint64_t look = std::min(first_look, last);
  for (;;) {
    simulate_up_to(look);
    if (stopped_) return *stopped_;
    samples_ = look;
    error_ = rms_relative_error();
    if (settings_.target_error && error_ <= *settings_.target_error) return StopReason::target_error;
    if (look == last) return StopReason::photons;
    const std::uint64_t more = std::max<std::uint64_t>(1, look / 4);
    look = last - look > more ? look + more : last;
  }
}

void Reception::simulate_up_to(std::uint64_t samples) {
  // What is simulated in part when a stop comes is thrown away: every receiver has the same samples.
  const std::vector<ReceiverSums> before = sums_;
  for_all_threads([&] { take_samples(samples_, samples); });
  if (stopped_) sums_ = before;
}

void Reception::take_samples(std::uint64_t first_sample, std::uint64_t last_sample) {
  const auto walk = make_backward_walk(scene_, light_, room_.receivers, scale_, settings_);
  const std::uint64_t receivers = room_.receivers.size();
  const std::uint64_t samples = last_sample - first_sample;
  // Many receivers with few samples, or one receiver with some of its samples.
  const std::uint64_t together = std::max<std::uint64_t>(1, histories_at_a_time / samples);
  const std::uint64_t parts = together > 1 ? 1 : (samples + histories_at_a_time - 1) / histories_at_a_time;
  const std::uint64_t pieces = (receivers + together - 1) / together * parts;
  std::vector<ReceiverSums> sums;
  while (!should_stop()) {
    const std::uint64_t piece = next_.fetch_add(1);
    if (piece >= pieces) break;
    ReceiverWork work;
    work.first = piece / parts * together;
    work.last = std::min(receivers, work.first + together);
    work.first_sample = first_sample + samples * (piece % parts) / parts;
    work.last_sample = first_sample + samples * (piece % parts + 1) / parts;
    sums.assign(work.last - work.first, {});
    TraceCount traced;
    walk->simulate(work, sums, traced, [this] {
      report(0);
      return should_stop();
    });
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t k = 0; k < sums.size(); ++k) sums_[work.first + k].add(sums[k]);
      traced_.rays += traced.rays;
      traced_.shadow_rays += traced.shadow_rays;
    }
    report((work.last - work.first) * (work.last_sample - work.first_sample));
  }
}

bool Reception::should_stop() {
  if (stop_) return true;
  std::optional<StopReason> reason;
  if (control_.stop.stop_requested()) reason = StopReason::interrupt;
  if (settings_.max_seconds && seconds() >= *settings_.max_seconds) reason = StopReason::max_time;
  if (!reason) return false;
  const std::lock_guard lock(mutex_);
  if (!stopped_) stopped_ = reason;
  stop_ = true;
  return true;
}

void Reception::report(std::uint64_t histories) {
  constexpr std::chrono::milliseconds interval{100};
  const std::lock_guard lock(mutex_);
  histories_done_ += histories;
  const Clock::time_point now = Clock::now();
  if (!control_.progress || now - reported_ < interval) return;
  reported_ = now;
  Progress progress;
  progress.stage = Progress::Stage::receivers;
  progress.histories = histories_done_;
  progress.target = target_;
  progress.impacts = traced_.rays;
  progress.seconds = seconds();
  progress.rms_relative_error = error_;
  control_.progress(progress);
}

// Histories are independent: the variance of their mean from their own spread.
double Reception::indirect_error(std::size_t k) const {
  if (samples_ < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<long double>(samples_);
  const auto sum = static_cast<long double>(sums_[k].sum);
  const long double between = static_cast<long double>(sums_[k].squares) - sum / n * sum;
  return static_cast<double>(std::sqrt(std::max(between, 0.0L) / (n - 1) / n)) * scale_.unit;
}

double Reception::rms_relative_error() const {
  double squares = 0.0;
  std::size_t lit = 0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const double indirect = static_cast<double>(sums_[k].sum) / static_cast<double>(samples_) * scale_.unit;
    const double irradiance = result_.receiver_results[k].direct + indirect;
    if (!(irradiance > 0.0)) continue;
    const double error = std::hypot(indirect_error(k), double{direct_errors_[k]});
    squares += error * error / (irradiance * irradiance);
    ++lit;
  }
  return lit > 0 ? std::sqrt(squares / static_cast<double>(lit)) : std::numeric_limits<double>::quiet_NaN();
}

void Reception::fill_in() {
  const double power = total_power(room_);
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    ReceiverResult& one = result_.receiver_results[k];
    one.indirect = static_cast<double>(sums_[k].sum) / static_cast<double>(samples_) * scale_.unit;
    one.irradiance = one.direct + one.indirect;
    one.standard_error = std::hypot(indirect_error(k), double{direct_errors_[k]});
    one.gain = one.irradiance * room_.receivers[k].area_m2 / power;
  }
  BackwardResult& backward = result_.backward;
  backward.histories = samples_ * room_.receivers.size();
  backward.rays = traced_.rays;
  backward.shadow_rays = traced_.shadow_rays;
  backward.seconds = seconds();
  backward.rms_relative_error = rms_relative_error();
  backward.figure_of_merit = 1.0 / (backward.rms_relative_error * backward.rms_relative_error * backward.seconds);
}

}  // namespace

void receive(const Room& room, const Scene& scene, const Settings& settings, const Control& control, unsigned threads,
             Result& result) {
  Reception(room, scene, settings, control, threads, result).run();
}

}  // namespace lichtmc
