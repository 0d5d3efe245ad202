#include <cmath>
#include <string>

#include "base/message.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// A wall lies at the low or high end of an axis.
struct Wall {
  const char* name;
  int axis;
  bool high;
  double CuboidReflectances::*reflectance;
};

constexpr Wall walls[] = {
    {"floor", 1, false, &CuboidReflectances::floor}, {"ceiling", 1, true, &CuboidReflectances::ceiling},
    {"wall_x0", 0, false, &CuboidReflectances::x0},  {"wall_x1", 0, true, &CuboidReflectances::x1},
    {"wall_z0", 2, false, &CuboidReflectances::z0},  {"wall_z1", 2, true, &CuboidReflectances::z1},
};

Surface make_wall(const Wall& wall, const glm::dvec3& size, double reflectance) {
  Surface surface;
  surface.name = wall.name;
  surface.material = "reflectance " + to_text(reflectance);
  surface.reflectance = reflectance;
  const int u = wall.axis == 0 ? 1 : 0;
  const int v = wall.axis == 2 ? 1 : 2;
  for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
    glm::dvec3 corner(0.0);
    corner[wall.axis] = wall.high ? size[wall.axis] : 0.0;
    corner[u] = uv.x * size[u];
    corner[v] = uv.y * size[v];
    surface.positions.push_back(corner);
    surface.uvs.push_back(uv);
  }
  // u × v points along +axis for axes 0 and 2, along −axis for axis 1 (x × z = −y); the front faces inwards.
  const bool along_axis = wall.axis != 1;
  if (along_axis != wall.high) {
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  } else {
    surface.triangles = {{0, 2, 1}, {0, 3, 2}};
  }
  return surface;
}

void check_edge(double edge, const char* axis) {
  if (std::isfinite(edge) && edge > 0.0) return;
  throw InputError("The cuboid's edge along " + std::string(axis) + " is " + to_text(edge) +
                   " m (allowed: a finite number above 0). Give its three edges in metres.");
}

void check_reflectance(double reflectance, const char* wall) {
  if (reflectance >= 0.0 && reflectance <= 1.0) return;
  throw InputError("The reflectance of the cuboid's " + std::string(wall) + " is " + to_text(reflectance) +
                   " (allowed: 0 to 1). Give the share of light that it reflects.");
}

}  // namespace

CuboidReflectances uniform_reflectance(double reflectance) {
  return {reflectance, reflectance, reflectance, reflectance, reflectance, reflectance};
}

Room make_cuboid(const glm::dvec3& size_m, const CuboidReflectances& reflectances) {
  check_edge(size_m.x, "X");
  check_edge(size_m.y, "Y");
  check_edge(size_m.z, "Z");
  Room room;
  room.source = "cuboid";
  for (const Wall& wall : walls) {
    const double reflectance = reflectances.*wall.reflectance;
    check_reflectance(reflectance, wall.name);
    room.surfaces.push_back(make_wall(wall, size_m, reflectance));
  }
  return room;
}

}  // namespace lichtmc
