// SVG pictures with title, legend with unit, labels and isolines. Text is stored as text, not as outlines.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/output.hpp"  // png_of(), room_svg()
#include "lichtmc/paths.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The pixels as an OpenEXR file of floats: R, G, B, A as in Picture::colour; Y is the irradiance (NaN without a
// surface). Throws RuntimeError if OpenEXR or the allocation of memory fails.
std::string exr_of(const Picture& picture, const Result& result);

// A plan with its isolines; `png`: png_of(picture) of the plan; `name`: its title.
std::string plan_svg(const Result& result, const SurfacePlan& plan, const std::string& png, const ColourScale& scale,
                     const std::string& name);

// Photon paths, coloured by the number of the flight, and the edges of the room.
std::string paths_svg(const Room& room, const std::vector<PhotonPath>& paths);

// Titles of plans, also used for file names: the name of the tile map, with a number if it has several plans. Unique.
std::vector<std::string> plan_names(const Result& result, const std::vector<SurfacePlan>& plans);

}  // namespace lichtmc
