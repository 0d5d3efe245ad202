// Pictures with what explains them: title, legend with unit, names, isolines; text is text.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/paths.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The pixels as a PNG file with transparency.
std::string png_of(const Picture& picture);

// The pixels as an OpenEXR file of floats: R, G, B, A as Picture::colour, Y the irradiance (NaN where nothing is to be
// seen). Throws RuntimeError where OpenEXR or the memory refuses.
std::string exr_of(const Picture& picture, const Result& result);

// The room with lamps marked and receivers as dots of their colour.
// `png`: png_of(picture), as in plan_svg().
std::string room_svg(const Room& room, const Result& result, const Picture& picture, const std::string& png,
                     const ColourScale& scale, View view);

// A plan with its isolines; `name`: what it is of.
std::string plan_svg(const Result& result, const SurfacePlan& plan, const std::string& png, const ColourScale& scale,
                     const std::string& name);

// Photon paths with the room's edges, coloured by the number of the flight.
std::string paths_svg(const Room& room, const std::vector<PhotonPath>& paths);

// The names of plans for people and for files: the surface's, with a number where it has several. No two alike.
std::vector<std::string> plan_names(const Result& result, const std::vector<SurfacePlan>& plans);

}  // namespace lichtmc
