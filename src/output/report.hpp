// The report as a web page.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// What the page shows, made before. Pictures are SVG; those that are empty are left out.
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

// One file with everything in it: styles, scripts, pictures, the room for its 3-D view.
std::string report_html(const ReportContent& content);

}  // namespace lichtmc
