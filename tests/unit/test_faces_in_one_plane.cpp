// Faces in one plane: which pairs are found, which face counts on which side, covered areas.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "room/faces_in_one_plane.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

enum class Faces { up, down, both };

// A horizontal rectangle [x, x + dx] × [z, z + dz] at height y, of n × n quads, with the diagonal turned if asked.
Surface sheet(const std::string& name, double x, double z, double dx, double dz, Faces faces = Faces::up, int n = 1,
              double y = 0.0) {
  Surface surface;
  surface.name = name;
  surface.sides = faces == Faces::both ? Sides::both : Sides::one;
  const glm::dvec3 along_x(dx / n, 0.0, 0.0);
  const glm::dvec3 along_z(0.0, 0.0, dz / n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      // Corners by multiplication, so that neighbours share them exactly.
      const glm::dvec3 a(x + dx * i / n, y, z + dz * j / n);
      const glm::dvec3 b(x + dx * (i + 1) / n, y, z + dz * (j + 1) / n);
      const glm::dvec3 ax(b.x, y, a.z);
      const glm::dvec3 az(a.x, y, b.z);
      if (faces == Faces::down) {
        add_triangle(surface, a, ax, b);
        add_triangle(surface, a, b, az);
      } else {
        add_triangle(surface, a, b, ax);
        add_triangle(surface, a, az, b);
      }
    }
  }
  return surface;
}

// A ceiling makes the room as high as it is wide.
Room room_of(std::vector<Surface> surfaces) {
  Room room;
  room.surfaces = std::move(surfaces);
  room.surfaces.push_back(sheet("ceiling", 0.0, 0.0, 4.0, 4.0, Faces::down, 1, 3.0));
  return room;
}

double area_under(const Room& room, const FacesInOnePlane& planes, const std::string& over, const std::string& under,
                  bool behind = false) {
  double area = 0.0;
  for (const Cover& cover : planes.covers()) {
    if (room.surfaces[cover.over].name == over && room.surfaces[cover.under].name == under && cover.behind == behind)
      area += cover.area_m2;
  }
  return area;
}

double undecided_area(const FacesInOnePlane& planes) {
  double area = 0.0;
  for (const Cover& cover : planes.covers()) area += cover.undecided_m2;
  return area;
}

// The surface that counts where light arrives at (x, 0, z) from above or below, whichever triangle was hit.
std::string counting_at(const Room& room, const FacesInOnePlane& planes, double x, double z, bool from_above) {
  std::string name;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3 corner = surface.triangles[n];
      const glm::dvec3 a = surface.positions[corner.x];
      const glm::dvec3 b = surface.positions[corner.y] - a;
      const glm::dvec3 c = surface.positions[corner.z] - a;
      const double area = b.z * c.x - b.x * c.z;  // above 0 if it faces up
      const double s = ((z - a.z) * c.x - (x - a.x) * c.z) / area;
      const double t = (b.z * (x - a.x) - b.x * (z - a.z)) / area;
      if (a.y != 0.0 || s < 0.0 || t < 0.0 || s + t > 1.0) continue;
      const auto number = static_cast<std::uint32_t>(planes.number_of(k, n));
      std::string found = surface.name;
      if (planes.has_others(number)) {
        bool undecided = false;
        const FacePlace place = planes.counting({number, s, t, (area > 0.0) != from_above}, undecided);
        std::size_t owner = 0;
        while (owner + 1 < room.surfaces.size() && planes.number_of(owner + 1, 0) <= place.triangle) ++owner;
        found = room.surfaces[owner].name;
      }
      // All of the faces in this place lead to the same one.
      if (!name.empty()) CHECK(found == name);
      name = found;
    }
  }
  return name;
}

Room turned(Room room, const glm::dmat3& turn, double scale, const glm::dvec3& shift) {
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& position : surface.positions) position = shift + scale * (turn * position);
  }
  return room;
}

// As a file has them: rounded to float before the shift.
Room rounded(Room room) {
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& position : surface.positions) position = glm::dvec3(glm::vec3(position));
  }
  return room;
}

glm::dmat3 some_turn() {
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0.0, 1.0, 0.0)));
  return {b, a, glm::cross(b, a)};
}

}  // namespace

TEST_CASE("one plane: a rug covers the floor from both sides, whatever its sides and winding on the upper one") {
  for (const Faces rug : {Faces::up, Faces::both}) {
    const Room room = room_of({sheet("floor", 0, 0, 4, 4), sheet("rug", 1, 1, 2, 1, rug)});
    const FacesInOnePlane planes(room);
    REQUIRE_FALSE(planes.empty());
    CHECK(area_under(room, planes, "rug", "floor") == Approx(2.0).epsilon(1e-12));
    CHECK(planes.covered_m2(0, false) == Approx(2.0).epsilon(1e-12));
    CHECK(planes.covered_m2(1, false) == 0.0);
    CHECK(undecided_area(planes) == 0.0);
    for (const bool above : {true, false}) {
      CHECK(counting_at(room, planes, 1.3, 1.4, above) == "rug");
      CHECK(counting_at(room, planes, 0.3, 1.4, above) == "floor");
    }
  }
}

TEST_CASE("one plane: the order in the room has no influence") {
  const Room room = room_of({sheet("rug", 1, 1, 2, 1), sheet("floor", 0, 0, 4, 4)});
  const FacesInOnePlane planes(room);
  CHECK(area_under(room, planes, "rug", "floor") == Approx(2.0).epsilon(1e-12));
  CHECK(planes.covers().size() == 1);
}

TEST_CASE("one plane: opposite faces count on their own sides") {
  SECTION("one-sided, of any size") {
    const Room room = room_of(
        {sheet("below", 0, 0, 4, 4, Faces::down), sheet("floor", 0, 0, 4, 4, Faces::up, 3), sheet("rug", 1, 1, 2, 1)});
    const FacesInOnePlane planes(room);
    CHECK(counting_at(room, planes, 1.3, 1.4, true) == "rug");
    CHECK(counting_at(room, planes, 0.3, 1.4, true) == "floor");
    CHECK(counting_at(room, planes, 1.3, 1.4, false) == "below");
    CHECK(counting_at(room, planes, 0.3, 1.4, false) == "below");
    CHECK(area_under(room, planes, "rug", "floor") == Approx(2.0).epsilon(1e-12));
    CHECK(planes.covers().size() == 1);
    double back_to_back = 0.0;
    for (const Cover& pair : planes.opposites()) back_to_back += pair.area_m2;
    CHECK(back_to_back == Approx(18.0).epsilon(1e-9));  // floor and rug, each with what is below
  }
  SECTION("two-sided of equal size: the front decides") {
    Surface below = sheet("below", 0, 0, 4, 4, Faces::down);
    below.sides = Sides::both;
    const Room room = room_of({below, sheet("floor", 0, 0, 4, 4, Faces::both)});
    const FacesInOnePlane planes(room);
    CHECK(counting_at(room, planes, 1.3, 1.4, true) == "floor");
    CHECK(counting_at(room, planes, 1.3, 1.4, false) == "below");
    CHECK(undecided_area(planes) == 0.0);
  }
}

TEST_CASE("one plane: equal areas with the same orientation cannot be decided") {
  const Room room = room_of({sheet("floor", 0, 0, 4, 4), sheet("again", 0, 0, 4, 4, Faces::up, 2)});
  const FacesInOnePlane planes(room);
  CHECK(area_under(room, planes, "floor", "again") == Approx(16.0).epsilon(1e-12));
  CHECK(undecided_area(planes) == Approx(16.0).epsilon(1e-12));
  CHECK(counting_at(room, planes, 1.3, 1.4, true) == "floor");
  bool undecided = false;
  planes.counting({0, 0.2, 0.2, false}, undecided);
  CHECK(undecided);
}

TEST_CASE("one plane: paper on a rug on a floor, each of many triangles") {
  const Room room = room_of({sheet("floor", 0, 0, 4, 4, Faces::up, 7), sheet("rug", 0.9, 1.1, 2, 1.5, Faces::up, 5),
                             sheet("paper", 1.3, 1.2, 0.3, 0.2, Faces::up, 3)});
  const FacesInOnePlane planes(room);
  CHECK(area_under(room, planes, "paper", "rug") == Approx(0.06).epsilon(1e-9));
  CHECK(area_under(room, planes, "paper", "floor") == Approx(0.06).epsilon(1e-9));
  CHECK(area_under(room, planes, "rug", "floor") == Approx(2.94).epsilon(1e-9));
  CHECK(planes.covered_m2(0, false) == Approx(3.0).epsilon(1e-9));
  CHECK(counting_at(room, planes, 1.41, 1.29, true) == "paper");
  CHECK(counting_at(room, planes, 2.41, 1.29, true) == "rug");
}

TEST_CASE("one plane: a part beyond the edge covers nothing") {
  const Room room = room_of({sheet("floor", 0, 0, 4, 4), sheet("rug", 3, 1, 2, 1)});
  const FacesInOnePlane planes(room);
  CHECK(area_under(room, planes, "rug", "floor") == Approx(1.0).epsilon(1e-12));
  CHECK(counting_at(room, planes, 4.5, 1.4, true) == "rug");
}

TEST_CASE("one plane: a floor of small surfaces is one patch") {
  std::vector<Surface> surfaces;
  SECTION("tiles in two colours, some wholly under the rug") {
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        if (i + j > 0) surfaces.push_back(sheet("tile", 0.5 * i, 0.5 * j, 0.5, 0.5));
      }
    }
    surfaces.push_back(sheet("rug", 1.0, 1.0, 1.5, 1.5));  // its edges lie on joints
  }
  SECTION("staggered planks") {
    for (int row = 0; row < 10; ++row) {
      for (int k = 0; k < 4; ++k) surfaces.push_back(sheet("plank", k + (row % 2) * 0.4, 0.4 * row, 1.0, 0.4));
    }
    surfaces.push_back(sheet("rug", 0.7, 0.7, 2.1, 1.9));
  }
  const Room room = room_of(surfaces);
  const FacesInOnePlane planes(room);
  const double rug = area_of(surfaces.back());
  double covered = 0.0;
  for (const Cover& cover : planes.covers()) {
    CHECK(room.surfaces[cover.over].name == "rug");
    covered += cover.area_m2;
  }
  CHECK(covered == Approx(rug).epsilon(1e-9));
}

TEST_CASE("one plane: in place of one tile of a floor another cannot be decided") {
  std::vector<Surface> surfaces;
  for (int i = 0; i < 4; ++i) surfaces.push_back(sheet("tile", i, 0, 1, 1));
  surfaces.push_back(sheet("other", 1, 0, 1, 1));
  const Room room = room_of(surfaces);
  CHECK(undecided_area(FacesInOnePlane(room)) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("one plane: a poster that touches the wall above stays on its own wall") {
  // The poster ends at the joint of two walls. It is not a part of the upper one.
  const Room room =
      room_of({sheet("lower", 0, 0, 4, 2), sheet("upper", 0, 2, 4, 6), sheet("poster", 1, 1, 1, 1, Faces::both)});
  const FacesInOnePlane planes(room);
  CHECK(area_under(room, planes, "poster", "lower") == Approx(1.0).epsilon(1e-12));
  CHECK(planes.covers().size() == 1);
}

TEST_CASE("one plane: neighbours, boxes and faces above each other do not overlap") {
  CHECK(FacesInOnePlane(make_cuboid({5, 2.6, 4}, {})).empty());
  CHECK(FacesInOnePlane(room_of({sheet("floor", 0, 0, 4, 4, Faces::up, 20)})).empty());
  CHECK(FacesInOnePlane(room_of({sheet("floor", 0, 0, 4, 4), sheet("rug", 1, 1, 2, 1, Faces::up, 1, 0.001)})).empty());
  CHECK(FacesInOnePlane(room_of({sheet("floor", 0, 0, 4, 4), sheet("hall", 4, 0, 4, 4)})).empty());
  Room sphere;
  sphere.surfaces = {make_sphere(40)};
  CHECK(FacesInOnePlane(sphere).empty());
}

TEST_CASE("one plane: turned, far away, in millimetres and kilometres, with the rounding of files") {
  const Room room = room_of({sheet("floor", 0, 0, 4, 4, Faces::up, 3), sheet("rug", 0.9, 1.1, 2, 1.5, Faces::up, 4)});
  const glm::dmat3 upright(1.0);
  struct Form {
    glm::dmat3 turn;
    double scale;
    glm::dvec3 shift;
  };
  for (const Form& form :
       {Form{some_turn(), 1.0, {}}, Form{some_turn(), 1e-3, {}}, Form{some_turn(), 1e3, {}}, Form{upright, 1e-3, {}},
        Form{upright, 1e3, {}}, Form{some_turn(), 1.0, {7.0, -3.0, 11.0}}}) {
    // The rug, 0.3 % of the room higher, is another plane.
    const Room flush = rounded(turned(room, form.turn, form.scale, form.shift));
    Room higher = room;
    for (glm::dvec3& position : higher.surfaces[1].positions) position.y += 0.01;
    const Room raised = rounded(turned(higher, form.turn, form.scale, form.shift));
    const glm::dvec3 far(4.5e5, 60.0, 5.4e6);
    for (const glm::dvec3& shift : {glm::dvec3(0.0), far}) {
      const Room placed = turned(flush, upright, 1.0, shift);
      const FacesInOnePlane planes(placed);
      REQUIRE(planes.covers().size() == 1);
      CHECK(area_under(placed, planes, "rug", "floor") == Approx(3.0 * form.scale * form.scale).epsilon(1e-5));
      CHECK(FacesInOnePlane(turned(raised, upright, 1.0, shift)).empty());
    }
  }
}

TEST_CASE("one plane: random triangles, compared with the rule face by face") {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> place(0.0, 4.0);
  for (int round = 0; round < 20; ++round) {
    std::vector<Surface> surfaces;
    for (int n = 0; n < 30; ++n) {
      Surface& surface = surfaces.emplace_back();
      surface.name = std::to_string(n);
      surface.sides = n % 3 == 0 ? Sides::both : Sides::one;
      add_triangle(surface, {place(random), 0, place(random)}, {place(random), 0, place(random)},
                   {place(random), 0, place(random)});
    }
    const Room room = room_of(surfaces);
    const FacesInOnePlane planes(room);
    double sampled = 0.0;
    constexpr int points = 4000;
    for (int k = 0; k < points; ++k) {
      const double x = place(random);
      const double z = place(random);
      const bool above = k % 2 == 0;
      const Surface* best = nullptr;
      bool best_faces = false;
      std::size_t here = 0;
      for (const Surface& surface : surfaces) {
        const glm::dvec3& a = surface.positions[0];
        const glm::dvec3 b = surface.positions[1] - a;
        const glm::dvec3 c = surface.positions[2] - a;
        const double area = b.z * c.x - b.x * c.z;
        const double s = ((z - a.z) * c.x - (x - a.x) * c.z) / area;
        const double t = (b.z * (x - a.x) - b.x * (z - a.z)) / area;
        if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
        const bool faces = surface.sides == Sides::both || (area > 0.0) == above;
        if (above && faces) ++here;
        const bool better =
            best == nullptr || (faces && !best_faces) || (faces == best_faces && area_of(surface) < area_of(*best));
        if (better) {
          best = &surface;
          best_faces = faces;
        }
      }
      if (above && here > 0) sampled += static_cast<double>(here - 1);
      CHECK(counting_at(room, planes, x, z, above) == (best == nullptr ? "" : best->name));
    }
    // The covered areas, seen from above: of fronts, and of backs of two-sided faces.
    double covered = 0.0;
    for (const Cover& cover : planes.covers()) {
      if ((first_normal(room.surfaces[cover.under]).y > 0.0) != cover.behind) covered += cover.area_m2;
    }
    const double expected = 16.0 * sampled / (points / 2);
    // Some 6 faces lie at a point, ± 4: the mean of 2000 points is uncertain by 0.1, six times of which is allowed.
    CHECK(std::abs(covered - expected) < 16.0 * 0.6);
  }
}

TEST_CASE("one plane: uncovered parts of a face and its covered part fill it") {
  const Room room = room_of({sheet("floor", 0, 0, 4, 4), sheet("rug", 0.9, 1.1, 2, 1.5, Faces::up, 12)});
  const FacesInOnePlane planes(room);
  double area = 0.0;
  for (const std::size_t triangle : {std::size_t{0}, std::size_t{1}}) {
    for (const ConvexPolygon& part : planes.uncovered(triangle, false, {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}))
      area += 8.0 * std::abs(twice_signed_area(part));
  }
  CHECK(area == Approx(13.0).epsilon(1e-9));
  const auto front = planes.uncovered_front(room, 0);
  REQUIRE(front);
  CHECK(area_of(*front) == Approx(13.0).epsilon(1e-9));
  CHECK_FALSE(planes.uncovered_front(room, 1));
}

TEST_CASE("one plane: two floors of 20 000 triangles, and stacks of sheets") {
  const Room fine = room_of({sheet("floor", 0, 0, 4, 4, Faces::up, 100), sheet("rug", 0.5, 0.5, 3, 3, Faces::up, 97)});
  const FacesInOnePlane planes(fine);
  CHECK(area_under(fine, planes, "rug", "floor") == Approx(9.0).epsilon(1e-6));
  const Room coarse = room_of({sheet("floor", 0, 0, 4, 4), sheet("rug", 0.5, 0.5, 3, 3, Faces::up, 100)});
  const FacesInOnePlane few_and_many(coarse);
  CHECK(area_under(coarse, few_and_many, "rug", "floor") == Approx(9.0).epsilon(1e-6));
  CHECK(counting_at(coarse, few_and_many, 1.237, 2.193, true) == "rug");
  std::vector<Surface> sheets;
  for (int n = 0; n < 60; ++n) sheets.push_back(sheet(std::to_string(n), 0, 0, 4, 4));
  const Room stacked = room_of(sheets);
  const FacesInOnePlane stack(stacked);
  CHECK(undecided_area(stack) == Approx(59.0 * 16.0).epsilon(1e-9));
}
