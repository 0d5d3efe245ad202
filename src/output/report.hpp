// The report as an HTML page.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The content of the page. Pictures are SVG; empty pictures are left out.
struct ReportContent {
  const Room* room = nullptr;
  const Result* result = nullptr;
  ColourScale scale;
  std::string command;
  Inspection inspection;
  std::string room_picture;
  std::string above_picture;
  std::string paths_picture;
  std::vector<SurfacePlan> plans;
  std::vector<std::string> plan_pictures;
  std::string lit_room;  // room_lit.glb
};

// One self-contained file: style sheets, scripts, pictures, and the room for the 3-D view.
std::string report_html(const ReportContent& content);

}  // namespace lichtmc
