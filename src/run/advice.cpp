#include "run/advice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/message.hpp"

namespace lichtmc {

namespace {

bool same_setting(const StudyRow& a, const StudyRow& b) {
  return a.direction == b.direction && a.estimator == b.estimator && a.engine == b.engine &&
         a.max_bounces == b.max_bounces && a.tile_edge_m == b.tile_edge_m && a.direct == b.direct;
}

// The bias of a row: the part of its error that its standard error does not explain.
double bias_of(const StudyRow& row) {
  // Only truncated walks are biased; the others differ from the reference by statistical error only.
  if (!row.max_bounces) return 0.0;
  return std::sqrt(std::max(row.rms_error * row.rms_error - row.standard_error * row.standard_error, 0.0));
}

std::string options_of(const StudyRow& row) {
  std::string text =
      " --tile " + short_number(row.tile_edge_m) + " --estimator " + std::string(to_string(row.estimator));
  if (row.max_bounces) text += " --max-bounces " + std::to_string(*row.max_bounces);
  if (row.direction == WalkDirection::backward) {
    text += " --tiles backward";
  } else if (row.direct == Direct::analytic) {
    text += " --direct analytic";
  }
  if (row.engine == Engine::embree_fast) text += " --engine embree-fast";
  return text;
}

std::string time_text(double seconds) {
  if (seconds < 120.0) return short_number(seconds) + " s";
  if (seconds < 7200.0) return short_number(seconds / 60.0) + " min";
  return short_number(seconds / 3600.0) + " h";
}

std::optional<Advice> forecast(const StudyRow& row, double error) {
  const double bias = bias_of(row);
  const double allowed = error * error - bias * bias;
  // With a bias of more than half of the allowed error, the standard error that a run reports would not describe its
  // error.
  if (!(row.standard_error > 0.0) || !std::isfinite(row.standard_error) || 2.0 * bias > error) return {};
  const double more = row.standard_error * row.standard_error / allowed;
  Advice advice;
  advice.error = error;
  advice.setting = row;
  advice.histories = std::max(more * static_cast<double>(row.histories), 1.0);
  advice.seconds = row.direct_seconds + more * (row.seconds - row.direct_seconds);
  return advice;
}

}  // namespace

std::vector<Advice> advice_from(const std::vector<StudyRow>& rows, double tile_edge_m, const std::string& room) {
  std::vector<Advice> all;
  for (const double error : {0.1, 0.01, 0.001}) {
    std::optional<Advice> best;
    for (const StudyRow& row : rows) {
      if (row.tile_edge_m != tile_edge_m) continue;
      // Of each setting the longest run is used: its figures have the smallest errors.
      const bool longest = std::none_of(rows.begin(), rows.end(), [&](const StudyRow& other) {
        return same_setting(other, row) && other.histories > row.histories;
      });
      if (!longest) continue;
      const std::optional<Advice> one = forecast(row, error);
      if (one && (!best || one->seconds < best->seconds)) best = one;
    }
    if (!best) continue;
    const std::string percent = short_number(100.0 * error);
    best->sentence = "For " + percent + " %: lichtmc run " + room + options_of(best->setting) + " --target-error " +
                     percent + "%   (about " + short_number(best->histories) + " photons, " + time_text(best->seconds) +
                     ")";
    all.push_back(*best);
  }
  return all;
}

}  // namespace lichtmc
