// Scripts and style sheets of report.html, from src/output/assets/.
#pragma once

#include <string_view>

namespace lichtmc {

extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view viewer_css;
extern const std::string_view viewer_js;

}  // namespace lichtmc
