// What the page of a report is made of.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "output/channel_pictures.hpp"

namespace lichtmc {

// The content of the page. Pictures are SVG; empty pictures are left out.
struct ReportContent {
  const Room* room = nullptr;
  const Result* result = nullptr;
  ReportStyle style = ReportStyle::technical;  // not automatic
  std::string project, author, date;
  ColourScale scale;
  std::string command;
  bool tile_images = true;  // tiles/*.exr were written
  Inspection inspection;
  std::string room_picture;
  std::string above_picture;
  std::string paths_picture;
  std::vector<SurfacePlan> plans;
  std::vector<std::string> without_plan;  // sentences: which large surfaces have no plan, and why
  std::vector<std::string> plan_pictures;
  std::vector<std::string> area_plans;  // of Result::areas
  std::vector<std::string> lit_sides;   // which sides of each tile map get light, in words; empty: unknown
  std::string lit_room;                 // room_lit.glb
  std::vector<ChannelPictures> channels;
};

}  // namespace lichtmc
