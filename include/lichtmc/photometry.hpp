// Photometric files of luminaires: IES LM-63 (1986 to 2019) and EULUMDAT.
//
// The intensity of a file: the table, times the candela multiplier and the ballast factor (LM-63; in files of 1986 and
// 1991 also the ballast-lamp photometric factor), or times the flux of the lamp set/1000 and the conversion factor
// (EULUMDAT). The luminaire's flux is the integral of this intensity; fluxes that a file states are information. TILT
// factors are read and not applied. docs/luminaires.md has the rules, with their sources.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/candela_table.hpp"
#include "lichtmc/luminous_opening.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

enum class PhotometryFormat { ies, eulumdat };

// Lamps with which the luminaire was measured. EULUMDAT files have one or more sets, of which one is used.
struct LampSet {
  int lamps = 1;         // number of lamps, without its sign
  double flux_lm = 0.0;  // of all lamps of the set
  std::string type;
  std::string colour;           // colour temperature or appearance, as written; EULUMDAT
  std::string rendering_index;  // colour rendering index or group, as written; EULUMDAT
  double watts = 0.0;           // input power with ballast
};

struct Photometry {
  std::string source;  // the file, for messages
  PhotometryFormat format = PhotometryFormat::ies;
  std::string version;  // "LM-63-1986" … "LM-63-2019", "EULUMDAT"
  // Texts of the file as UTF-8, empty if it has none.
  std::string manufacturer;
  std::string luminaire;  // name or description
  std::string catalogue;  // number of the catalogue
  std::string test;       // number of the test report
  // All keywords of an IES file ("[LUMCAT]" without brackets) or named lines of a EULUMDAT file, with their texts.
  std::vector<std::pair<std::string, std::string>> texts;

  std::shared_ptr<const CandelaTable> candela;  // with all factors, in cd (or `intensity_unit`)
  std::string intensity_unit;                   // "cd"; what [_INTENSITYUNITS] says otherwise, for example "mW/sr"

  double factor = 1.0;        // by which the numbers of the table were multiplied
  double multiplier = 1.0;    // candela multiplier of an IES file
  double ballast = 1.0;       // ballast factor of an IES file
  double ballast_lamp = 1.0;  // ballast-lamp photometric factor of files of 1986 and 1991
  double conversion = 1.0;    // conversion factor of a EULUMDAT file

  bool absolute = false;                 // absolute photometry: the flux that is stated is that of the luminaire
  std::vector<LampSet> lamp_sets;        // one or more
  std::size_t lamp_set = 0;              // that is used, an index
  std::optional<double> stated_lm;       // flux of the luminaire that the file states or implies (LORL · lamps' flux)
  std::optional<double> lamp_lm;         // flux of its lamps
  std::optional<double> output_ratio;    // EULUMDAT: LORL, fraction
  std::optional<double> downward_share;  // EULUMDAT: DFF, fraction
  double watts = 0.0;                    // input power, 0: not stated
  std::optional<std::pair<double, double>> tilt_factors;  // least and greatest, if the file has any

  LuminousOpening opening;
  // Accepted, but to be told, one sentence each. Warnings may change figures: TILT factors, a conversion factor, fluxes
  // that differ, values or planes that are not as the format demands. Notes do not: encodings, empty lines, and the
  // like.
  std::vector<std::string> warnings;
  std::vector<std::string> notes;

  // Its flux in lm, or the radiant flux in the unit that follows from `intensity_unit`.
  double flux() const { return candela->flux(); }
  // lm/W; none without watts, and if its intensity is not in cd.
  std::optional<double> efficacy() const;
};

struct PhotometryOptions {
  std::size_t lamp_set = 1;      // of EULUMDAT files, counted from 1
  bool flip_horizontal = false;  // types A and B: H counts the other way
  bool needs_flux = true;        // false: a EULUMDAT file whose lamps have no flux is accepted; its table is relative
};

// Reads a file of either format, which is recognised by its content. Throws InputError: file, line, value, what is
// allowed, what to do. Limits: 16 MiB, 2 to 20 000 vertical and 1 to 20 000 horizontal angles, 4 million values.
Photometry read_photometry(const std::filesystem::path& file, const PhotometryOptions& options = {});

// The same, of the content of a file. source: its name for messages; folder: where a tilt file that it names may be,
// none: such a file is refused.
Photometry parse_photometry(std::string_view content, const std::string& source, const PhotometryOptions& options = {},
                            const std::optional<std::filesystem::path>& folder = std::nullopt);

// The file in format LM-63-2002: read_photometry() returns the same table, opening, lamps and texts. Type C within
// −90 … 90° becomes 90 … 270°; TILT factors, which do not count, are left out. Texts of a EULUMDAT file become the
// keywords of their meaning.
std::string ies_text(const Photometry& photometry);

// What is to be told about a file in a room that uses it: its warnings and notes, with its name.
std::vector<Ignored> remarks_of(const Photometry& photometry);

// How a luminaire is mounted and what it is scaled to; at most one of lumens, scale and watts.
struct LuminaireOptions {
  std::optional<double> lumens = std::nullopt;  // its flux in lm
  std::optional<double> scale = std::nullopt;   // its intensity is that of the file times this
  std::optional<double> watts = std::nullopt;   // radiant flux in W, as of ultraviolet: the file gives the shape
  double rotation_deg = 0.0;                    // about its aim, from C0 towards C90
  bool area = false;                            // light starts all over the opening, not at its centre
};

// Directions of a luminaire in the world: unit vectors, perpendicular to each other, of either handedness.
struct LuminaireAxes {
  glm::dvec3 aim{0.0, -1.0, 0.0};
  glm::dvec3 c0{1.0, 0.0, 0.0};
  glm::dvec3 c90{0.0, 0.0, -1.0};
};

// The default axes, turned by the shortest rotation so that they aim at `aim` (any length but 0); for upwards by half a
// turn about X.
LuminaireAxes axes_towards(const glm::dvec3& aim);

// An emitter of this luminaire, and the quantity of its power. Throws InputError if a number of the options is out of
// range, more than one of them scales it, `area` is required of a luminaire without an opening, or its intensities are
// not in cd and `watts` is missing. `where`: what it belongs to, for messages.
struct LuminaireEmitter {
  MeasuredEmitter shape;
  double power = 0.0;
  Quantity quantity = Quantity::photometric;
};
LuminaireEmitter mount(std::shared_ptr<const Photometry> photometry, const glm::dvec3& position,
                       const LuminaireAxes& axes, const LuminaireOptions& options, const std::string& where);

}  // namespace lichtmc
