// The figures of a luminaire that follow from its photometric file: for people who choose one, and for tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lichtmc/intensity_cut.hpp"
#include "lichtmc/photometry.hpp"

namespace lichtmc {

// The angles of a table along one axis, in degrees.
struct AngleRange {
  std::size_t count = 0;
  double from = 0.0;
  double to = 0.0;
  double least_step = 0.0;  // 0 with one angle
  double greatest_step = 0.0;

  bool is_even() const;  // up to the rounding of the numbers in files
};

// A plane through the aim with the widths of the beam in it.
struct LuminairePlane {
  std::string name;        // "C0–C180"; types A and B: "H = 0", "V = 0"
  double plane_deg = 0.0;  // as in intensity_cut()
  IntensityCut cut;
  BeamWidth beam;   // at 50 % of the highest intensity in this plane
  BeamWidth field;  // at 10 % of it
};

// The luminous flux at angles to the aim of from … to.
struct FluxZone {
  double from_deg = 0.0;
  double to_deg = 0.0;
  double flux = 0.0;
};

struct LuminaireFigures {
  std::string flux_unit;  // "lm"; of a file in mW/sr "mW"
  AngleRange horizontal;
  AngleRange vertical;
  double flux = 0.0;  // the integral of the intensity
  // (flux − stated)/stated; none if the file states none.
  std::optional<double> over_stated;
  // flux/flux of the lamps, relative photometry only.
  std::optional<double> output_ratio;
  double share_towards_aim = 0.0;      // of the flux, within 90° of the aim
  std::vector<FluxZone> zones;         // type C: 0 – 30 – 60 – 90 – 180°; else none
  std::vector<LuminairePlane> planes;  // two: through C0, and through C90
};

LuminaireFigures luminaire_figures(const Photometry& photometry);

// "C 65°, γ 62.5°"; types A and B: "H 0°, V 10°".
std::string direction_text(const Photometry& photometry, double horizontal_deg, double vertical_deg);

// The angle between a direction of the file and the aim, in degrees.
double angle_to_aim(const Photometry& photometry, double horizontal_deg, double vertical_deg);

// Manufacturer and name, or the catalogue number, or the file without its folder: not empty.
std::string luminaire_title(const Photometry& photometry);

// "rectangle 1.2 × 0.3 m"; along_c0: which side lies along C0, a sentence, empty for round ones and points.
std::string opening_text(const LuminousOpening& opening);
std::string along_c0(const LuminousOpening& opening);

}  // namespace lichtmc
