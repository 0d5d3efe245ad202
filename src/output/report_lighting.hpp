// The pages of a lighting report that are for the client.
#pragma once

#include <string>

#include "output/report_content.hpp"

namespace lichtmc {

// What the calculation is about, for the title of the page: the project or, without one, the file of the room.
std::string subject_of(const ReportContent& content);

// Title, verdicts and plans of the calculation areas, luminaires, pictures of the room, surfaces, and how sure the
// figures are, in plain words. HTML.
std::string lighting_pages(const ReportContent& content);

}  // namespace lichtmc
