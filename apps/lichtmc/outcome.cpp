#include "outcome.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "lichtmc/output.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/visible_text.hpp"
#include "progress_line.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

std::string percent(double fraction) {
  if (!std::isfinite(fraction)) return "unknown";
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * fraction);
  return text;
}

const char* describe(StopReason reason) {
  switch (reason) {
    case StopReason::photons:
      return "all photons simulated";
    case StopReason::target_error:
      return "target error reached";
    case StopReason::max_time:
      return "time is over";
    case StopReason::interrupt:
      return "interrupted";
  }
  return "";
}

// Reports a target error that was not reached, with the number of photons that it requires.
void warn_of_missed_target(const Settings& settings, StopReason stopped_by, double error, double histories,
                           double to_target, double seconds, const char* remedy) {
  if (!settings.target_error || stopped_by == StopReason::target_error) return;
  std::cerr << "The target error of " << percent(*settings.target_error) << " was not reached: the error is "
            << percent(error) << '.';
  // Extrapolated from the error checks; without one, the error falls with the square root of the number of histories.
  if (!std::isfinite(to_target)) to_target = histories * std::pow(error / *settings.target_error, 2);
  if (std::isfinite(to_target)) {
    std::cerr << " It requires about " << short_count(to_target) << " photons ("
              << short_time(to_target / histories * seconds) << " on this machine)" << remedy << '.';
  }
  std::cerr << '\n';
}

// One example, if possible of those that may change results, and where the list is.
void print_ignored(const std::vector<Ignored>& ignored) {
  if (ignored.empty()) return;
  const auto changes_results = [](const Ignored& item) { return item.effect == Effect::figures; };
  const auto first = std::find_if(ignored.begin(), ignored.end(), changes_results);
  const auto count = std::count_if(ignored.begin(), ignored.end(), changes_results);
  std::cerr << "Not modelled: " << ignored.size() << (ignored.size() == 1 ? " item" : " items") << " of the room; "
            << count << " may change results. Example: "
            << visible_text((first == ignored.end() ? ignored.front() : *first).what)
            << " The list is in summary.json under \"ignored\".\n";
}

// The balance of powers, known only with photons from the emitters.
void print_balance(const Result& result) {
  const std::string unit(power_unit(result.quantity));
  const Balance& balance = result.balance;
  std::cerr << "Emitted " << four_digits(balance.emitted) << ' ' << unit << ": absorbed "
            << four_digits(balance.absorbed) << ", escaped " << four_digits(balance.escaped);
  if (balance.residual != 0.0) std::cerr << ", residual " << four_digits(balance.residual);
  std::cerr << ", lost " << four_digits(balance.lost) << ".\n";
}

void print_tiles(const Result& result) {
  const bool forward = result.settings.tile_walk == WalkDirection::forward;
  std::cerr << short_count(static_cast<double>(result.walk.histories))
            << (forward ? " photons, " : " backward histories from the tiles, ")
            << short_count(static_cast<double>(result.walk.impacts)) << " impacts in "
            << four_digits(result.walk.seconds) << " s (" << describe(result.walk.stopped_by) << "; engine "
            << to_string(result.engine) << ", estimator " << to_string(result.walk.estimator)
            << (direct_is_apart(result) ? ", direct light integrated" : "") << ").\n";
  if (forward) print_balance(result);
  std::cerr << result.tiles.size() << " tiles, relative standard error " << percent(result.walk.rms_relative_error)
            << " (area-weighted rms)";
  if (result.tiles_without_hits > 0) std::cerr << "; " << result.tiles_without_hits << " without hits";
  std::cerr << ". " << error_text(result, Measured::tiles) << '\n';
  if (const std::string left_out = unreached_text(result); !left_out.empty()) std::cerr << left_out << '\n';
  warn_of_missed_target(result.settings, result.walk.stopped_by, result.walk.rms_relative_error,
                        static_cast<double>(result.walk.histories), result.walk.histories_to_target,
                        result.walk.seconds, ", or larger tiles");
}

void print_receivers(const Result& result) {
  const WalkReport& walk = result.receiver_walk;
  const auto histories = static_cast<double>(walk.histories);
  std::cerr << result.receiver_results.size() << (result.receiver_results.size() == 1 ? " receiver, " : " receivers, ")
            << short_count(histories) << " histories in " << four_digits(walk.seconds) << " s ("
            << describe(walk.stopped_by) << "; " << to_string(walk.receiver_walk) << ", estimator "
            << to_string(walk.estimator) << "), " << short_count(static_cast<double>(walk.shadow_rays))
            << (walk.shadow_rays == 1 ? " shadow ray; relative" : " shadow rays; relative") << " standard error "
            << percent(walk.rms_relative_error) << (result.areas.empty() ? " (rms). " : " (of Em and Emin). ")
            << error_text(result, Measured::receivers) << '\n';
  warn_of_missed_target(result.settings, walk.stopped_by, walk.rms_relative_error, histories, walk.histories_to_target,
                        walk.seconds, "");
}

// A figure with its relative standard error.
std::string with_error(const Figure& figure, double scale, const std::string& unit) {
  std::string text = four_digits(scale * figure.value) + unit;
  if (figure.standard_error > 0.0) text += " ± " + percent(figure.standard_error / figure.value);
  return text;
}

// The first channels, a line each.
void print_channels(const ImpulseResponses& responses) {
  constexpr std::size_t most = 4;
  constexpr double per_ns = 1e9;
  const std::size_t count = responses.channels.size();
  for (std::size_t k = 0; k < std::min(most, count); ++k) {
    const Channel& channel = responses.channels[k];
    std::cerr << "Channel from '" << visible_text(responses.emitters[channel.emitter]) << "' to '"
              << visible_text(responses.receivers[k % responses.receivers.size()]) << "': ";
    if (!(channel.gain.value > 0.0)) {
      std::cerr << "no light.\n";
      continue;
    }
    std::cerr << "gain H(0) " << four_digits(10.0 * std::log10(channel.gain.value)) << " dB ± "
              << percent(channel.gain.standard_error / channel.gain.value) << ", first arrival "
              << (channel.first_arrival_is_exact ? "" : "at the latest ")
              << four_digits(per_ns * channel.first_arrival_s) << " ns, rms delay spread "
              << with_error(channel.rms_delay_spread_s, per_ns, " ns") << ", "
              << percent(channel.beyond.value / channel.gain.value) << " later than the time span of "
              << four_digits(per_ns * static_cast<double>(responses.bins) * responses.bin_width_s) << " ns.\n";
  }
  if (count > most) std::cerr << "channels.csv contains all " << count << " channels.\n";
}

}  // namespace

std::vector<std::string> without_repeated(std::vector<std::string> warnings, const std::vector<std::string>& of_check) {
  std::erase_if(warnings, [&of_check](const std::string& warning) {
    return std::any_of(of_check.begin(), of_check.end(),
                       [&warning](const std::string& line) { return line.starts_with(warning); });
  });
  return warnings;
}

void print_outcome(const Room& room, const Result& result, const std::filesystem::path& folder, bool with_report,
                   bool with_images) {
  if (!result.tiles.empty()) print_tiles(result);
  if (!result.receiver_results.empty()) print_receivers(result);
  if (result.channels) print_channels(*result.channels);
  for (const AreaResult& area : result.areas) std::cerr << visible_text(area_line(area, result.quantity)) << '\n';
  if (const std::string maintained = maintained_text(room); !maintained.empty()) std::cerr << maintained << ".\n";
  for (const Measured what : {Measured::tiles, Measured::receivers}) {
    const std::string options = options_to_repeat(result, what);
    if (!options.empty()) std::cerr << "The same figures, to the last digit, without a clock: " << options << '\n';
  }
  for (const std::string& choice : result.choices) std::cerr << visible_text(choice) << '\n';
  for (const std::string& warning : result.warnings) std::cerr << "Warning: " << visible_text(warning) << '\n';
  print_ignored(result.ignored);
  std::cerr << "Results are in " << visible_text(folder.string())
            << (result.tiles.empty() ? ": " : ": surfaces.csv (one row per surface), tiles.csv, ")
            << (result.tiles.empty() || !with_images ? "" : "tiles/*.exr, ")
            << (result.receiver_results.empty() ? "" : "receivers.csv, ")
            << (result.areas.empty() ? "" : "areas.csv, areas/*.csv, areas/*.svg, areas/*.dxf, ")
            << (result.channels ? "channels.csv, impulse_response.csv, channels.h5, " : "")
            << (result.channels && files_left_out(result).empty() ? "channels.mat, " : "")
            << "emitters.csv, summary.json.\n";
  if (!with_report) return;
  std::cerr << "Open " << visible_text((folder / "report.html").string()) << " in a browser"
            << (result.tiles.empty() ? "" : ", room_lit.glb in any glTF viewer") << ".\n";
}

}  // namespace lichtmc::app
