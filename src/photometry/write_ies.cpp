// A luminaire as a file of LM-63-2002.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/photometry.hpp"
#include "photometry/file_lines.hpp"
#include "photometry/ies.hpp"

namespace lichtmc {

namespace {

// Lines of the standard have at most 256 characters with their end; older programs read 132 of tables.
constexpr std::size_t most_of_text = 250;
constexpr std::size_t most_of_numbers = 130;

class Writer {
 public:
  void line(const std::string& text) { text_ += text + "\r\n"; }

  // A keyword, or a label if it is empty. Long texts continue in lines of [MORE], which begin where a blank was.
  void keyword(const std::string& name, std::string_view text) {
    std::string rest;
    for (const char c : text) rest += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    std::string start = name.empty() ? "" : "[" + name + "] ";
    while (start.size() + rest.size() > most_of_text) {
      const std::size_t blank = last_blank(rest, most_of_text - start.size());
      if (blank == std::string::npos) break;
      line(start + rest.substr(0, blank));
      rest.erase(0, blank + 1);
      start = "[MORE] ";
    }
    line(start + rest);
  }

  void number(double value) { word(to_text(value)); }
  void number(std::size_t value) { word(std::to_string(value)); }
  void end_numbers() {
    if (!row_.empty()) line(row_);
    row_.clear();
  }

  std::string take() { return std::move(text_); }

 private:
  // The last single blank before `end`: where a text can be divided, and put together again with a blank.
  static std::size_t last_blank(const std::string& text, std::size_t end) {
    for (std::size_t k = std::min(end, text.size() - 1); k-- > 1;) {
      if (text[k] == ' ' && text[k - 1] != ' ' && text[k + 1] != ' ') return k;
    }
    return std::string::npos;
  }

  void word(const std::string& text) {
    if (row_.size() + text.size() >= most_of_numbers) end_numbers();
    if (!row_.empty()) row_ += ' ';
    row_ += text;
  }

  std::string text_;
  std::string row_;
};

// Keyword of a named line of a EULUMDAT file.
std::string ies_keyword(const std::string& name) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {{"company", "MANUFAC"},     {"report", "TEST"},
                                                                     {"luminaire", "LUMINAIRE"}, {"number", "LUMCAT"},
                                                                     {"file", "_FILE"},          {"date", "ISSUEDATE"}};
  for (const auto& [line, keyword] : names) {
    if (name == line) return std::string(keyword);
  }
  return name;
}

void write_texts(const Photometry& photometry, const LampSet& lamps, Writer& writer) {
  std::vector<std::string> written;
  for (const auto& [name, text] : photometry.texts) {
    std::string keyword = photometry.format == PhotometryFormat::eulumdat ? ies_keyword(name) : name;
    if (keyword.empty() && text.empty()) continue;
    // Labels that would be read as something else.
    const bool like_keyword = text.starts_with("[") && text.find(']') != std::string::npos;
    if (keyword.empty() && (like_keyword || find_tilt(text))) keyword = "OTHER";
    writer.keyword(keyword, text);
    written.push_back(keyword);
  }
  const auto is_written = [&written](std::string_view keyword) {
    return std::any_of(written.begin(), written.end(),
                       [keyword](const std::string& other) { return same_word(other, keyword); });
  };
  const auto add = [&](const char* keyword, const std::string& text) {
    if (!text.empty() && !is_written(keyword)) writer.keyword(keyword, text);
  };
  add("MANUFAC", photometry.manufacturer);
  // Without a keyword it is the first label.
  const bool label =
      !photometry.texts.empty() && photometry.texts.front() == std::pair(std::string(), photometry.luminaire);
  if (!label) add("LUMINAIRE", photometry.luminaire);
  add("LUMCAT", photometry.catalogue);
  add("TEST", photometry.test);
  if (!is_written("LAMPCAT")) add("LAMP", lamps.type);
  add("_LAMPCOLOUR", lamps.colour);
  add("_LAMPRENDERING", lamps.rendering_index);
  if (photometry.intensity_unit != "cd") add("_INTENSITYUNITS", photometry.intensity_unit);
  if (photometry.absolute && photometry.stated_lm && !is_written("_TOTALLUMINAIRELUMENS"))
    add("_ABSOLUTELUMENS", to_text(*photometry.stated_lm));
}

// Width, length and height with the signs of LM-63-2002.
glm::dvec3 signed_sizes(const LuminousOpening& opening) {
  const double length = opening.size_m.x;
  const double width = opening.size_m.y;
  const double height = opening.size_m.z;
  switch (opening.form) {
    case OpeningForm::point:
      return glm::dvec3(0.0);
    case OpeningForm::rectangle:
      return {width, length, 0.0};
    case OpeningForm::box:
      return {width, length, height};
    case OpeningForm::ellipse:
      return {-width, -length, 0.0};
    case OpeningForm::cylinder:
      return {-width, -length, height};
    case OpeningForm::cylinder_c0:  // of length 0: an upright disc
      return {-width, length, -height};
    case OpeningForm::cylinder_c90:
      return {width, -length, -height};
    case OpeningForm::ellipsoid:
      return {-width, -length, -height};
  }
  return glm::dvec3(0.0);
}

// A plane that is written: its angle, and the planes of the table between which it is, equal if it is one of them.
struct Plane {
  double angle = 0.0;
  std::size_t first = 0;
  std::size_t second = 0;
  double share = 0.0;
  bool dark = false;  // 0 at all angles
};

// Planes from h to h + 360 as 0 … 360: the one at 0 and 360 may be between two others.
std::vector<Plane> from_zero(const std::vector<double>& angles) {
  std::vector<Plane> planes;
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    const double turned = angles[k] - 360.0 * std::floor(angles[k] / 360.0);
    planes.push_back({turned, k, k});
  }
  std::sort(planes.begin(), planes.end(), [](const Plane& a, const Plane& b) { return a.angle < b.angle; });
  if (planes.front().angle > 0.0) {
    const Plane& after = planes.front();
    const Plane& before = planes.back();
    const double gap = after.angle + 360.0 - before.angle;
    planes.insert(planes.begin(), Plane{0.0, before.first, after.first, (360.0 - before.angle) / gap});
  }
  planes.push_back(planes.front());
  planes.back().angle = 360.0;
  return planes;
}

// Types A and B: H of 0 or more only would be read as mirrored. Dark planes end the table below 0: its first plane then
// fades within 10⁻⁵°.
void end_below_zero(std::vector<Plane>& planes) {
  constexpr double edge_deg = 1e-5;
  const double first = planes.front().angle;
  if (first < 0.0) return;
  planes.insert(planes.begin(), Plane{first - edge_deg, 0, 0, 0.0, true});
  if (first >= edge_deg) planes.insert(planes.begin(), Plane{-1.0, 0, 0, 0.0, true});
}

std::vector<Plane> planes_of(const CandelaTable::Grid& grid) {
  const std::vector<double>& angles = grid.horizontal_deg;
  if (grid.type == PhotometricType::c && grid.symmetry == PhotometricSymmetry::none && angles.front() != 0.0)
    return from_zero(angles);
  std::vector<Plane> planes;
  for (std::size_t k = 0; k < angles.size(); ++k) planes.push_back({angles[k], k, k});
  if (grid.symmetry == PhotometricSymmetry::rotational) planes.front().angle = 0.0;
  const bool half_in_front = grid.symmetry == PhotometricSymmetry::c90_c270 && angles.back() <= 180.0;
  // Where H is mirrored, its sense does not matter.
  const bool other_sense =
      grid.flip_horizontal && grid.type != PhotometricType::c &&
      (grid.symmetry == PhotometricSymmetry::none || grid.symmetry == PhotometricSymmetry::vertical);
  if (half_in_front || other_sense) {
    std::reverse(planes.begin(), planes.end());
    for (Plane& plane : planes) plane.angle = (half_in_front ? 180.0 : 0.0) - plane.angle;
  }
  if (other_sense) end_below_zero(planes);
  return planes;
}

void write_table(const CandelaTable::Grid& grid, const std::vector<Plane>& planes, Writer& writer) {
  for (const double angle : grid.vertical_deg) writer.number(angle);
  writer.end_numbers();
  for (const Plane& plane : planes) writer.number(plane.angle);
  writer.end_numbers();
  const std::size_t rows = grid.vertical_deg.size();
  for (const Plane& plane : planes) {
    for (std::size_t i = 0; i < rows; ++i) {
      const double first = grid.candela[plane.first * rows + i];
      writer.number(plane.dark ? 0.0 : first + plane.share * (grid.candela[plane.second * rows + i] - first));
    }
    writer.end_numbers();
  }
}

}  // namespace

std::string ies_text(const Photometry& photometry) {
  const CandelaTable::Grid& grid = photometry.candela->grid();
  const LampSet lamps =
      photometry.lamp_set < photometry.lamp_sets.size() ? photometry.lamp_sets[photometry.lamp_set] : LampSet();
  Writer writer;
  writer.line("IESNA:LM-63-2002");
  write_texts(photometry, lamps, writer);
  writer.line("TILT=NONE");
  const std::vector<Plane> planes = planes_of(grid);
  // All factors are in the table. Lumens per lamp of −1: absolute photometry.
  const auto number_of_lamps = static_cast<std::size_t>(std::max(lamps.lamps, lamps.flux_lm > 0.0 ? 1 : 0));
  writer.number(number_of_lamps);
  writer.number(photometry.absolute
                    ? -1.0
                    : std::max(lamps.flux_lm, 0.0) / static_cast<double>(std::max<std::size_t>(number_of_lamps, 1)));
  writer.number(std::size_t{1});
  writer.number(grid.vertical_deg.size());
  writer.number(planes.size());
  writer.number(
      static_cast<std::size_t>(grid.type == PhotometricType::c ? 1 : (grid.type == PhotometricType::b ? 2 : 3)));
  writer.number(std::size_t{2});
  const glm::dvec3 opening = signed_sizes(photometry.opening);
  for (int k = 0; k < 3; ++k) writer.number(opening[k] + 0.0);
  writer.end_numbers();
  writer.number(1.0);
  writer.number(1.0);
  writer.number(std::max(photometry.watts, 0.0));
  writer.end_numbers();
  write_table(grid, planes, writer);
  return writer.take();
}

}  // namespace lichtmc
