// The luminaire schedule of a room: which luminaires it has, and how many of each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Luminaires of one photometric file with the same power and maintenance factor.
struct ScheduleRow {
  const Photometry* photometry = nullptr;
  std::size_t file = 0;  // number of the file, counted from 0 in the order of the emitters
  double power = 0.0;    // of each, W or lm; the maintained one
  double maintenance_factor = 1.0;
  bool area = false;                  // light starts all over the opening
  std::vector<std::size_t> emitters;  // indices into Room::emitters

  double count() const { return static_cast<double>(emitters.size()); }
  // Of each when new, W or lm.
  double initial_power() const { return power / maintenance_factor; }
  // initial_power()/flux of the file; none if the power is not in lm.
  std::optional<double> scale(Quantity quantity) const;
};

// Rows of one file follow each other, both in the order of the emitters. Emitters without a file are left out.
std::vector<ScheduleRow> luminaire_schedule(const Room& room);

// emitter,name,kind,file,power,unit,scale,watts,x,y,z,aim_x,aim_y,aim_z,c0_x,c0_y,c0_z,light_from,delay_ns,
//   maintenance_factor,initial_power
// One row per emitter. scale: initial power over the flux of the file; watts: input power that the file states;
// position in m; unit vectors of the aim and of the plane C0; light_from: "point", "opening" or "surface". What an
// emitter does not have is empty.
std::string emitters_csv(const Room& room);

}  // namespace lichtmc
