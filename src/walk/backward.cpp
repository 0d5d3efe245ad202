#include "walk/backward.hpp"

#include <cassert>

namespace lichtmc {

BackwardScale::BackwardScale(const Room& room) {
  double area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  unit = total_power(room) / area * 0x1p-24;
}

std::uint64_t BackwardScale::score(double irradiance) const {
  const double units = irradiance / unit;
  return units < static_cast<double>(largest_score) ? static_cast<std::uint64_t>(units + 0.5) : largest_score;
}

ReceiverOrigins::ReceiverOrigins(const std::vector<ReferencePoint>& receivers, const Tracer& tracer) {
  places_.reserve(receivers.size());
  for (const ReferencePoint& one : receivers) {
    Place place{glm::vec3(start_of(one, tracer)), {}, one.point};
    place.view.normal = glm::vec3(one.normal);
    place.view.least_cosine = one.least_cosine;
    place.view.law = one.law;
    place.view.facing = glm::vec3(one.facing);
    place.view.least_height_m = one.least_height_m;
    if (one.way_out) place.view.way_out = glm::vec3(*one.way_out);
    places_.push_back(place);
  }
}

CellOrigins::CellOrigins(const std::vector<ReferencePoint>& receivers, const Tracer& tracer)
    : points_(receivers, tracer) {
  for (const ReferencePoint& one : receivers)
    edges_.push_back({glm::vec3(tracer.tracer_vector(one.cell_u)), glm::vec3(tracer.tracer_vector(one.cell_v))});
}

OriginView CellOrigins::start(std::uint64_t receiver, double u, double v, Rays& rays, std::size_t i) const {
  const OriginView view = points_.start(receiver, rays, i);
  const Edges& edges = edges_[receiver];
  rays.set_start(i, rays.start(i) + static_cast<float>(u - 0.5) * edges.u + static_cast<float>(v - 0.5) * edges.v);
  return view;
}

}  // namespace lichtmc
