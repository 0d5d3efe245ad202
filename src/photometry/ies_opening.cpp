#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/message.hpp"
#include "photometry/ies.hpp"

namespace lichtmc {

namespace {

int sign_of(double value) {
  return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0);
}

// Signs of width, length and height, and what they mean.
struct Signs {
  int width;
  int length;
  int height;
  OpeningForm form;
};

// What all versions of the standard, or the only ones that use these signs, agree on.
constexpr std::array<Signs, 17> common_signs{{
    {0, 0, 0, OpeningForm::point},
    {1, 1, 0, OpeningForm::rectangle},
    {1, 0, 0, OpeningForm::rectangle},  // a line
    {0, 1, 0, OpeningForm::rectangle},
    {1, 1, 1, OpeningForm::box},
    {1, 0, 1, OpeningForm::box},  // an upright rectangle
    {0, 1, 1, OpeningForm::box},
    {-1, 0, 0, OpeningForm::ellipse},
    {-1, -1, 0, OpeningForm::ellipse},
    {-1, 1, 0, OpeningForm::ellipse},
    {1, -1, 0, OpeningForm::ellipse},
    {-1, 0, 1, OpeningForm::cylinder},
    {-1, -1, 1, OpeningForm::cylinder},
    {-1, -1, -1, OpeningForm::ellipsoid},
    {0, 1, -1, OpeningForm::cylinder_c0},
    {1, 0, -1, OpeningForm::cylinder_c90},
    {0, -1, -1, OpeningForm::cylinder_c90},  // its end: an upright disc
}};
// LM-63-1986 and 1991.
constexpr std::array<Signs, 1> early_signs{{{-1, 1, 1, OpeningForm::ellipsoid}}};
// LM-63-1995 and before.
constexpr std::array<Signs, 5> signs_until_1995{{
    {-1, 1, 1, OpeningForm::cylinder},
    {1, -1, 1, OpeningForm::cylinder},
    {-1, 0, -1, OpeningForm::ellipsoid},
    {-1, 1, -1, OpeningForm::ellipsoid},
    {1, -1, -1, OpeningForm::ellipsoid},
}};
// LM-63-2002 and later.
constexpr std::array<Signs, 5> signs_since_2002{{
    {-1, 1, 1, OpeningForm::cylinder},  // as in 1995: no other meaning
    {1, -1, 1, OpeningForm::cylinder},
    {-1, 0, -1, OpeningForm::cylinder_c0},  // its end: an upright disc
    {-1, 1, -1, OpeningForm::cylinder_c0},
    {1, -1, -1, OpeningForm::cylinder_c90},
}};

template <std::size_t count>
const Signs* find_signs(const std::array<Signs, count>& list, int width, int length, int height) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Signs& s) {
    return s.width == width && s.length == length && s.height == height;
  });
  return found == list.end() ? nullptr : &*found;
}

// Diameters that the code of a form does not give are equal to the other one.
glm::dvec3 size_of(OpeningForm form, double x, double y, double z) {
  switch (form) {
    case OpeningForm::ellipse:
    case OpeningForm::cylinder:
    case OpeningForm::ellipsoid:
      return {x > 0.0 ? x : y, y, z};
    case OpeningForm::cylinder_c0:
      return {x, y > 0.0 ? y : z, z};
    case OpeningForm::cylinder_c90:
      return {x > 0.0 ? x : z, y, z};
    case OpeningForm::point:
    case OpeningForm::rectangle:
    case OpeningForm::box:
      break;
  }
  return {x, y, z};
}

}  // namespace

LuminousOpening ies_opening(IesVersion version, double width_m, double length_m, double height_m,
                            std::vector<std::string>& warnings) {
  const int w = sign_of(width_m);
  const int l = sign_of(length_m);
  const int h = sign_of(height_m);
  const Signs* signs = find_signs(common_signs, w, l, h);
  if (signs == nullptr && version <= IesVersion::lm_63_1991) signs = find_signs(early_signs, w, l, h);
  if (signs == nullptr)
    signs = version <= IesVersion::lm_63_1995 ? find_signs(signs_until_1995, w, l, h)
                                              : find_signs(signs_since_2002, w, l, h);
  const double x = std::abs(length_m);
  const double y = std::abs(width_m);
  const double z = std::abs(height_m);
  if (signs != nullptr) return {signs->form, size_of(signs->form, x, y, z)};
  const bool upright_line = x == 0.0 && y == 0.0;
  const OpeningForm form = upright_line ? OpeningForm::point : (z > 0.0 ? OpeningForm::box : OpeningForm::rectangle);
  warnings.push_back("The luminous opening has width " + to_text(width_m) + " m, length " + to_text(length_m) +
                     " m and height " + to_text(height_m) +
                     " m, signs that the standard does not define; it is taken as a " + std::string(name_of(form)) +
                     (upright_line ? "." : " of these sizes."));
  return {form, upright_line ? glm::dvec3(0.0) : glm::dvec3(x, y, z)};
}

}  // namespace lichtmc
