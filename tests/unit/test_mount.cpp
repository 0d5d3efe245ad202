// How luminaires are mounted: directions in the world, and what their light is scaled to.
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

void check_near(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int k = 0; k < 3; ++k) CHECK(std::abs(found[k] - expected[k]) < 1e-15);
}

// Unit vectors at right angles, with C90 where the default axes have it.
void check_axes(const LuminaireAxes& axes) {
  check_near(glm::cross(axes.c0, axes.aim), axes.c90);
  for (const auto* one : {&axes.aim, &axes.c0, &axes.c90}) CHECK(std::abs(glm::length(*one) - 1.0) < 1e-15);
  CHECK(std::abs(glm::dot(axes.aim, axes.c0)) < 1e-15);
}

std::string message_of(const Photometry& photometry, const LuminaireOptions& options) {
  try {
    mount(std::make_shared<const Photometry>(photometry), glm::dvec3(0.0), LuminaireAxes{}, options, "lamp");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a luminaire is turned to its aim by the shortest rotation") {
  const LuminaireAxes down = axes_towards({0.0, -2.0, 0.0});
  check_near(down.aim, {0.0, -1.0, 0.0});
  check_near(down.c0, {1.0, 0.0, 0.0});
  check_near(down.c90, {0.0, 0.0, -1.0});
  // About Z, about X, and half a turn about X for upwards.
  check_near(axes_towards({1.0, 0.0, 0.0}).c0, {0.0, 1.0, 0.0});
  check_near(axes_towards({1.0, 0.0, 0.0}).c90, {0.0, 0.0, -1.0});
  check_near(axes_towards({0.0, 0.0, -1.0}).c0, {1.0, 0.0, 0.0});
  check_near(axes_towards({0.0, 0.0, -1.0}).c90, {0.0, 1.0, 0.0});
  const LuminaireAxes up = axes_towards({0.0, 1.0, 0.0});
  check_near(up.aim, {0.0, 1.0, 0.0});
  check_near(up.c0, {1.0, 0.0, 0.0});
  check_near(up.c90, {0.0, 0.0, 1.0});

  const double tiny = 1e-9;
  for (const glm::dvec3& aim : {glm::dvec3(0.5, -1.0, 0.2), glm::dvec3(0.0, 1.0, tiny), glm::dvec3(tiny, 1.0, -tiny),
                                glm::dvec3(tiny, -1.0, tiny), glm::dvec3(1e-300, 0.0, 2e-300),
                                glm::dvec3(-1e300, 1e300, 1e300), glm::dvec3(0.3, 0.9, -0.1)}) {
    INFO(aim.x << " " << aim.y << " " << aim.z);
    const LuminaireAxes axes = axes_towards(aim);
    check_axes(axes);
    const glm::dvec3 to = glm::normalize(aim / std::max({std::abs(aim.x), std::abs(aim.y), std::abs(aim.z)}));
    check_near(axes.aim, to);
    // A rotation about an axis leaves that axis where it is: the normal of the old aim and the new.
    const glm::dvec3 normal = glm::cross(glm::dvec3(0.0, -1.0, 0.0), to);
    const LuminaireAxes old;
    if (glm::length(normal) < 1e-6) continue;
    CHECK(std::abs(glm::dot(axes.c0, normal) - glm::dot(old.c0, normal)) < 1e-15);
    CHECK(std::abs(glm::dot(axes.c90, normal) - glm::dot(old.c90, normal)) < 1e-15);
  }
  CHECK_THROWS_WITH(axes_towards({0.0, 0.0, 0.0}), ContainsSubstring("(allowed: finite numbers, not all 0)"));
  CHECK_THROWS_AS(axes_towards({0.0, std::numeric_limits<double>::infinity(), 0.0}), InputError);
}

TEST_CASE("a luminaire is rotated from C0 towards C90") {
  const auto skew = skew_luminaire();
  const auto turned = [&](double degrees) {
    LuminaireOptions options;
    options.rotation_deg = degrees;
    return mount(skew, {1.0, 2.0, 3.0}, axes_towards({0.0, -1.0, 0.0}), options, "lamp").shape;
  };
  check_near(turned(90.0).c0, {0.0, 0.0, -1.0});
  check_near(turned(90.0).c90, {-1.0, 0.0, 0.0});
  check_near(turned(-90.0).c0, {0.0, 0.0, 1.0});
  check_near(turned(180.0).c0, {-1.0, 0.0, 0.0});
  check_near(turned(270.0).c0, {0.0, 0.0, 1.0});
  check_near(turned(30.0).c0, {std::sqrt(0.75), 0.0, -0.5});
  check_near(turned(30.0 - 36000.0).c0, {std::sqrt(0.75), 0.0, -0.5});
  CHECK(turned(90.0).c0 == glm::dvec3(0.0, 0.0, -1.0));  // a quarter turn is exact
  CHECK(turned(30.0).position == glm::dvec3(1.0, 2.0, 3.0));
  CHECK(turned(30.0).axis == glm::dvec3(0.0, -1.0, 0.0));
}

TEST_CASE("the power of a luminaire is the flux of its file, unless it is scaled") {
  const auto skew = skew_luminaire();
  const auto mounted = [&](const LuminaireOptions& options) {
    return mount(skew, glm::dvec3(0.0), LuminaireAxes{}, options, "lamp");
  };
  CHECK(mounted({}).power == skew->flux());
  CHECK(mounted({}).quantity == Quantity::photometric);
  CHECK(mounted({.scale = 0.25}).power == 0.25 * skew->flux());
  CHECK(mounted({.scale = 0.0}).power == 0.0);
  CHECK(mounted({.lumens = 1000.0}).power == 1000.0);
  CHECK(mounted({.watts = 2.5}).power == 2.5);
  CHECK(mounted({.watts = 2.5}).quantity == Quantity::radiometric);
  CHECK(!mounted({}).shape.opening);
  CHECK(mounted({.area = true}).shape.opening->size_m == glm::dvec3(0.6, 0.3, 0.0));
}

TEST_CASE("options of a luminaire that are out of range are refused") {
  const Photometry skew = *skew_luminaire();
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK_THAT(message_of(skew, {.lumens = 0.0}),
             ContainsSubstring("lamp: its luminous flux is 0 lm (allowed: a finite number above 0)"));
  CHECK_THAT(message_of(skew, {.lumens = infinite}), ContainsSubstring("is inf lm"));
  CHECK_THAT(message_of(skew, {.watts = -1.0}), ContainsSubstring("its radiant flux is -1 W"));
  CHECK_THAT(message_of(skew, {.scale = -0.5}), ContainsSubstring("is -0.5 (allowed: a finite number, 0 or more)"));
  CHECK_THAT(message_of(skew, {.scale = std::nan("")}), ContainsSubstring("is nan"));
  CHECK_THAT(message_of(skew, {.rotation_deg = infinite}), ContainsSubstring("its rotation is inf degrees"));
  CHECK_THAT(message_of(skew, {.lumens = 1.0, .scale = 1.0}), ContainsSubstring("more than one number scales"));

  Photometry point = skew;
  point.opening = {};
  CHECK_THAT(message_of(point, {.area = true}), ContainsSubstring("skew.ies states no size of the luminous opening"));

  Photometry ultraviolet = skew;
  ultraviolet.intensity_unit = "mW/sr";
  CHECK_THAT(message_of(ultraviolet, {}), ContainsSubstring("skew.ies are in mW/sr, not in cd"));
  CHECK_THAT(message_of(ultraviolet, {.lumens = 1.0}), ContainsSubstring("Give W="));
  CHECK(message_of(ultraviolet, {.watts = 0.1}).empty());
}
