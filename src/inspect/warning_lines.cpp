#include <algorithm>

#include "base/message.hpp"
#include "lichtmc/inspect.hpp"

namespace lichtmc {

namespace {

// The findings of one severity and topic.
struct Kind {
  const Finding* first = nullptr;
  std::size_t count = 0;
};

std::vector<Kind> kinds_of(const Inspection& inspection) {
  std::vector<Kind> kinds;
  for (const Finding& finding : inspection.findings) {
    if (finding.severity == Severity::note || finding.topic == "tiles") continue;
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) {
      return kind.first->topic == finding.topic && kind.first->severity == finding.severity;
    });
    if (same == kinds.end()) {
      kinds.push_back({&finding, 1});
    } else {
      ++same->count;
    }
  }
  return kinds;
}

}  // namespace

std::vector<std::string> warning_lines(const Room& room, const Inspection& inspection, std::size_t most) {
  const std::vector<Kind> kinds = kinds_of(inspection);
  const std::size_t shown = kinds.size() > most ? most - 1 : kinds.size();
  const std::string command =
      "lichtmc check " + room.source + (room.overrides.empty() ? "" : ", with the same options");
  std::vector<std::string> lines;
  std::size_t rest = 0;
  for (const Kind& kind : kinds) {
    if (lines.size() == shown) {
      rest += kind.count;
      continue;
    }
    lines.push_back(kind.first->text + " " + kind.first->advice);
    if (kind.count > 1) lines.back() += " (" + std::to_string(kind.count - 1) + " more like this: " + command + ".)";
  }
  if (rest > 0) lines.push_back(to_text(rest, "more warning") + ": " + command + ".");
  return lines;
}

}  // namespace lichtmc
