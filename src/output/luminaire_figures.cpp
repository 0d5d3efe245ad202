#include "lichtmc/luminaire_figures.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/message.hpp"
#include "chance/candela_zones.hpp"

namespace lichtmc {

namespace {

constexpr double beam_share = 0.5;
constexpr double field_share = 0.1;

AngleRange range_of(const std::vector<double>& angles) {
  AngleRange range{angles.size(), angles.front(), angles.back(), 0.0, 0.0};
  for (std::size_t k = 1; k < angles.size(); ++k) {
    const double step = angles[k] - angles[k - 1];
    range.least_step = k == 1 ? step : std::min(range.least_step, step);
    range.greatest_step = std::max(range.greatest_step, step);
  }
  return range;
}

LuminairePlane plane_of(const CandelaTable& table, double plane_deg) {
  LuminairePlane plane;
  // Type A has its H in the plane of C0, type B its V.
  const bool through_h = (table.grid().type == PhotometricType::a) == (plane_deg == 90.0);
  plane.name = table.grid().type != PhotometricType::c ? (through_h ? "H = 0" : "V = 0")
               : plane_deg == 0.0                      ? "C0–C180"
                                                       : "C90–C270";
  plane.plane_deg = plane_deg;
  plane.cut = intensity_cut(table, plane_deg);
  plane.beam = beam_width(plane.cut, beam_share);
  plane.field = beam_width(plane.cut, field_share);
  return plane;
}

// A length in m, to a tenth of a millimetre.
std::string length_text(double metres) {
  return decimal(metres, 4);
}

std::string product_text(double a, double b) {
  return length_text(a) + " × " + length_text(b) + " m";
}

}  // namespace

bool AngleRange::is_even() const {
  constexpr double rounding_deg = 0.02;  // files have 7.5, 22.5 or 33.33, 66.67
  return greatest_step - least_step <= rounding_deg;
}

LuminaireFigures luminaire_figures(const Photometry& photometry) {
  const CandelaTable& table = *photometry.candela;
  LuminaireFigures figures;
  const std::string& unit = photometry.intensity_unit;
  const std::size_t slash = unit.find("/sr");
  figures.flux_unit = unit == "cd" || unit.empty() ? "lm"
                      : slash != std::string::npos ? unit.substr(0, slash)
                                                   : unit + "·sr";
  figures.horizontal = range_of(table.grid().horizontal_deg);
  figures.vertical = range_of(table.grid().vertical_deg);
  figures.flux = table.flux();
  if (photometry.stated_lm && *photometry.stated_lm > 0.0)
    figures.over_stated = (figures.flux - *photometry.stated_lm) / *photometry.stated_lm;
  if (!photometry.absolute && photometry.lamp_lm && *photometry.lamp_lm > 0.0)
    figures.output_ratio = figures.flux / *photometry.lamp_lm;
  figures.share_towards_aim = std::min(1.0, table.flux_towards_aim() / figures.flux);
  if (table.grid().type == PhotometricType::c) {
    constexpr double limits[] = {0.0, 30.0, 60.0, 90.0, 180.0};
    for (std::size_t k = 0; k + 1 < std::size(limits); ++k)
      figures.zones.push_back({limits[k], limits[k + 1], flux_between(table.grid(), limits[k], limits[k + 1])});
  }
  figures.planes = {plane_of(table, 0.0), plane_of(table, 90.0)};
  return figures;
}

std::string direction_text(const Photometry& photometry, double horizontal_deg, double vertical_deg) {
  const bool type_c = photometry.candela->grid().type == PhotometricType::c;
  return (type_c ? "C " : "H ") + decimal(horizontal_deg, 3) + "°, " + (type_c ? "γ " : "V ") +
         decimal(vertical_deg, 3) + "°";
}

double angle_to_aim(const Photometry& photometry, double horizontal_deg, double vertical_deg) {
  if (photometry.candela->grid().type == PhotometricType::c) return vertical_deg;
  const double cosine = std::cos(vertical_deg * radians_per_degree) * std::cos(horizontal_deg * radians_per_degree);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) / radians_per_degree;
}

std::string luminaire_title(const Photometry& photometry) {
  std::string title = photometry.manufacturer;
  const std::string& name = photometry.luminaire.empty() ? photometry.catalogue : photometry.luminaire;
  if (!name.empty() && name != title) title += (title.empty() ? "" : ", ") + name;
  if (title.empty()) title = std::filesystem::path(photometry.source).filename().string();
  return title.empty() ? "luminaire" : title;
}

std::string opening_text(const LuminousOpening& opening) {
  const glm::dvec3& size = opening.size_m;
  const std::string name(name_of(opening.form));
  const auto round = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); };
  switch (opening.form) {
    case OpeningForm::point:
      return name;
    case OpeningForm::rectangle:
      return name + ", " + product_text(size.x, size.y) + " (C0 × C90)";
    case OpeningForm::ellipse:
      return round(size.x, size.y) ? "disc, diameter " + length_text(size.x) + " m"
                                   : name + ", diameters " + product_text(size.x, size.y) + " (C0 × C90)";
    case OpeningForm::box:
      return name + ", " + length_text(size.x) + " × " + product_text(size.y, size.z) + " (C0 × C90 × height)";
    case OpeningForm::cylinder:
      return name + " along the aim, " +
             (round(size.x, size.y) ? "diameter " + length_text(size.x) + " m"
                                    : "diameters " + product_text(size.x, size.y) + " (C0 × C90)") +
             ", height " + length_text(size.z) + " m";
    case OpeningForm::cylinder_c0:
      if (size.x == 0.0) return "disc across C0, " + product_text(size.y, size.z) + " (C90 × height)";
      return name + ", length " + length_text(size.x) + " m, diameters " + product_text(size.y, size.z);
    case OpeningForm::cylinder_c90:
      if (size.y == 0.0) return "disc across C90, " + product_text(size.x, size.z) + " (C0 × height)";
      return name + ", length " + length_text(size.y) + " m, diameters " + product_text(size.x, size.z);
    case OpeningForm::ellipsoid:
      if (round(size.x, size.y) && round(size.x, size.z)) return "sphere, diameter " + length_text(size.x) + " m";
      return name + ", " + length_text(size.x) + " × " + product_text(size.y, size.z) + " (C0 × C90 × height)";
  }
  return name;
}

std::string along_c0(const LuminousOpening& opening) {
  const double along = opening.size_m.x;
  const double across = opening.size_m.y;
  const bool has_sides = opening.form == OpeningForm::rectangle || opening.form == OpeningForm::box ||
                         opening.form == OpeningForm::ellipse || opening.form == OpeningForm::ellipsoid;
  if (!has_sides) return {};
  if (std::abs(along - across) <= 1e-3 * std::max(along, across))
    return opening.form == OpeningForm::rectangle || opening.form == OpeningForm::box
               ? "C0 lies along one of its equal sides."
               : std::string();
  return "C0 lies along its " + std::string(along > across ? "longer" : "shorter") + " side, " + length_text(along) +
         " m.";
}

}  // namespace lichtmc
