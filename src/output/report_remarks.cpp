#include "output/report_remarks.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/message.hpp"
#include "lichtmc/output.hpp"
#include "output/html.hpp"

namespace lichtmc {

std::vector<std::string> remarks_of(const ReportContent& content) {
  const Result& result = *content.result;
  std::vector<std::string> sentences = result.warnings;
  for (std::string& sentence : files_left_out(result)) sentences.push_back(std::move(sentence));
  for (std::string& line : warning_lines(*content.room, content.inspection)) {
    if (std::find(sentences.begin(), sentences.end(), line) == sentences.end()) sentences.push_back(std::move(line));
  }
  std::size_t ignored = 0;
  for (const Ignored& thing : result.ignored) ignored += thing.effect == Effect::figures ? 1 : 0;
  if (ignored > 0)
    sentences.push_back(to_text(ignored, "item") + " of the file " + (ignored == 1 ? "was" : "were") +
                        " not modelled and may change the figures: see the list below.");
  const StopReason interrupt = StopReason::interrupt;
  if (result.walk.stopped_by == interrupt || result.receiver_walk.stopped_by == interrupt)
    sentences.emplace_back("The run was interrupted: the figures are from the histories simulated until then.");
  return sentences;
}

std::string remarks_section(const ReportContent& content) {
  const std::vector<std::string> sentences = remarks_of(content);
  if (sentences.empty()) return {};
  return element("section", text_element("h2", "Before you use these figures") + list_of(sentences),
                 " class=\"attention\" id=\"remarks\"");
}

}  // namespace lichtmc
