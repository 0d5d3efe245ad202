// The symmetry of the table of an IES file, which its ranges of angles give.
#include <string>

#include "base/message.hpp"
#include "photometry/ies.hpp"

namespace lichtmc {

namespace {

PhotometricSymmetry symmetry_of_type_c(const Origin& origin, std::size_t line, const std::vector<double>& planes) {
  const double first = planes.front();
  const double last = planes.back();
  if (planes.size() == 1) return PhotometricSymmetry::rotational;
  if (first == 90.0 && last == 270.0) return PhotometricSymmetry::c90_c270;
  if (first == 0.0 && last == 90.0) return PhotometricSymmetry::quadrants;
  if (first == 0.0 && last == 180.0) return PhotometricSymmetry::c0_c180;
  // The plane at 360° may be missing.
  if (first == 0.0 && 360.0 - last <= widest_step(planes) + least_step_deg) return PhotometricSymmetry::none;
  origin.refuse(line, "horizontal angles run from " + to_text(first) + " to " + to_text(last) +
                          "; type C allows 0, 0-90, 0-180, 90-270 or 0-360. Correct the angles.");
}

PhotometricSymmetry symmetry_of_types_a_b(const Origin& origin, std::size_t line, PhotometricType type,
                                          const std::vector<double>& vertical, const std::vector<double>& horizontal,
                                          std::vector<std::string>& warnings) {
  if (horizontal.size() < 2)
    origin.refuse(line, "1 horizontal angle; type " + std::string(name_of(type)) +
                            " needs 2 or more. Only type C has files with one plane.");
  const bool mirror_h = horizontal.front() >= 0.0;
  const bool mirror_v = type == PhotometricType::b && vertical.front() >= 0.0;
  const auto note = [&warnings](const char* which, double first) {
    if (first > 0.0)
      warnings.push_back(std::string("The ") + which + " angles begin at " + to_text(first) +
                         "° and are mirrored to those below 0; between them the intensity is 0.");
  };
  if (mirror_h) note("horizontal", horizontal.front());
  if (mirror_v) note("vertical", vertical.front());
  if (mirror_h) return mirror_v ? PhotometricSymmetry::both : PhotometricSymmetry::horizontal;
  return mirror_v ? PhotometricSymmetry::vertical : PhotometricSymmetry::none;
}

}  // namespace

void set_ies_symmetry(const Origin& origin, std::size_t line, CandelaTable::Grid& grid, MeasuredValues& table,
                      std::vector<std::string>& warnings) {
  if (grid.type != PhotometricType::c) {
    grid.symmetry = symmetry_of_types_a_b(origin, line, grid.type, grid.vertical_deg, grid.horizontal_deg, warnings);
    return;
  }
  grid.symmetry = symmetry_of_type_c(origin, line, grid.horizontal_deg);
  if (grid.symmetry == PhotometricSymmetry::rotational) {
    if (grid.horizontal_deg.front() != 0.0)
      warnings.push_back("The only horizontal angle is " + to_text(grid.horizontal_deg.front()) +
                         "°, not 0; the luminaire is rotationally symmetric all the same.");
    grid.horizontal_deg.front() = 0.0;
  }
  if (grid.symmetry != PhotometricSymmetry::none) return;
  const double last = grid.horizontal_deg.back();
  if (last < 360.0) {
    repeat_first_plane(grid, table);
    warnings.push_back("The horizontal angles end at " + to_text(last) + "°; the plane at 0° is repeated at 360°.");
  }
  compare_seam(grid, table, warnings);
}

}  // namespace lichtmc
