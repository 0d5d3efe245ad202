// Receivers as reference points, and the side of the surfaces that they lie on.
//
// A receiver on a surface has the irradiance of one side: the limit for a distance from the surface that goes to 0. It
// is the side that the receiver looks to. If it looks along the surface (its normal lies in the plane), or to both
// sides (cylinders), it is the side of the room: the one that is enclosed by the same closed shells as an emitter; if
// both or none are, the one from which an emitter is visible; if both or none are, the front of the surface. A receiver
// lies on a surface if its distance is within the rounding of float coordinates (NearPlane); if it is farther away, but
// closer than the tracer can separate, it stays on its side.
#pragma once

#include <vector>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// One for each receiver of the room. Those on surfaces, unless they look along the normal of the only one, are moved
// off by as little as the tracer can separate, some 10⁻⁶ of the room's size.
std::vector<ReferencePoint> receiver_points(const Room& room, const Tracer& tracer);

}  // namespace lichtmc
