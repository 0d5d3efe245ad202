#include "support/luminaires.hpp"

#include <cmath>
#include <numbers>

namespace lichtmc::test {

std::shared_ptr<Photometry> skew_luminaire() {
  CandelaTable::Grid grid;
  grid.type = PhotometricType::c;
  grid.symmetry = PhotometricSymmetry::none;
  for (int c = 0; c <= 360; c += 30) grid.horizontal_deg.push_back(c);
  for (int g = 0; g <= 180; g += 15) grid.vertical_deg.push_back(g);
  for (const double c : grid.horizontal_deg) {
    for (const double g : grid.vertical_deg) {
      const double azimuth = (c < 360.0 ? c : 0.0) * std::numbers::pi / 180.0;
      const double polar = g * std::numbers::pi / 180.0;
      grid.candela.push_back(std::round(
          100.0 * (2.0 + std::cos(polar) + std::sin(polar) * (0.6 * std::cos(azimuth) + 0.3 * std::sin(azimuth)))));
    }
  }
  auto photometry = std::make_shared<Photometry>();
  photometry->source = "skew.ies";
  photometry->version = "LM-63-2002";
  photometry->intensity_unit = "cd";
  photometry->absolute = true;
  photometry->lamp_sets = {{1, 0.0, "", "", "", 50.0}};
  photometry->watts = 50.0;
  photometry->candela = std::make_shared<const CandelaTable>(std::move(grid));
  photometry->opening = {OpeningForm::rectangle, {0.6, 0.3, 0.0}};
  return photometry;
}

}  // namespace lichtmc::test
