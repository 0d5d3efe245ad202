// Draws plans of surfaces: each large flat piece in its plane, curved surfaces as their tile maps.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/picture.hpp"
#include "room/nearest_tile.hpp"
#include "view/colours.hpp"
#include "view/isolines.hpp"
#include "view/plan_subjects.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t field_side = 240;      // points along the longer side of the field for the isolines
constexpr double min_step_in_errors = 6.0;   // step between isolines, in standard errors of the smoothed field
constexpr double min_line_length_px = 36.0;  // shorter isolines are left out
constexpr double levels_in_range = 6.0;      // about this many isolines

struct Axes {
  glm::dvec3 across{1.0, 0.0, 0.0};  // length 1
  glm::dvec3 down{0.0, 0.0, 1.0};
};

// Directions of the picture for a piece whose normal points to the eye.
Axes axes_for(const glm::dvec3& normal) {
  constexpr double steep = 0.7;
  Axes axes;
  if (std::abs(normal.y) > steep) {
    // Floors and ceilings from above: the same position in both pictures has the same x and z.
    const glm::dvec3 x(1.0, 0.0, 0.0);
    axes.across = glm::normalize(x - glm::dot(x, normal) * normal);
    axes.down = glm::cross(axes.across, normal);
    if (axes.down.z < 0.0) axes.down = -axes.down;
    return axes;
  }
  const glm::dvec3 up(0.0, 1.0, 0.0);
  axes.down = -glm::normalize(up - glm::dot(up, normal) * normal);
  axes.across = glm::cross(normal, axes.down);  // to the right in front of the piece
  return axes;
}

Picture empty_picture(double width, double height) {
  Picture picture;
  picture.width = static_cast<std::size_t>(std::max(1.0, std::round(width)));
  picture.height = static_cast<std::size_t>(std::max(1.0, std::round(height)));
  picture.colour.resize(picture.width * picture.height);
  picture.irradiance.resize(picture.width * picture.height, std::numeric_limits<float>::quiet_NaN());
  return picture;
}

class PlanDrawer {
 public:
  PlanDrawer(const Room& room, const Result& result, const ColourScale& scale, double longer_side)
      : room_(&room), result_(&result), scale_(&scale), longer_side_(longer_side) {}

  SurfacePlan draw(const PlanSubject& subject) {
    SurfacePlan plan;
    plan.map = subject.map;
    plan.area_m2 = subject.piece.area_m2;
    tile_of_cell_ = nearest_tiles(result_->tiling.maps[subject.map]);
    tile_of_pixel_.clear();
    if (subject.piece.triangles.empty()) {
      draw_map(plan);
      plan.why_no_isolines = "Tile map (curved, or many parts): no isolines.";
    } else {
      draw_piece(subject, plan);
      add_isolines(plan);
    }
    return plan;
  }

 private:
  // A point in the picture (pixels) and on the tile map (cells).
  struct Corner {
    glm::dvec2 pixel{0.0};
    glm::dvec2 cell{0.0};
  };

  // Standard error and edge of the tiles in the picture: root mean squares over its pixels.
  struct TypicalTile {
    double error = 0.0;
    double edge_m = 0.0;
  };

  void draw_piece(const PlanSubject& subject, SurfacePlan& plan);
  void draw_map(SurfacePlan& plan);
  void fill(const std::array<Corner, 3>& triangle, SurfacePlan& plan);
  void set_statistics(SurfacePlan& plan) const;
  void set_pixel(SurfacePlan& plan, std::size_t pixel, std::uint32_t tile);
  std::optional<TypicalTile> typical_tile() const;  // none if the picture contains no tile
  void add_isolines(SurfacePlan& plan) const;
  std::optional<double> smoothing_radius(const SurfacePlan& plan, const IrradianceField& field, double step,
                                         const TypicalTile& tile) const;
  IrradianceField field_of(const SurfacePlan& plan, double step) const;

  const Room* room_;
  const Result* result_;
  const ColourScale* scale_;
  double longer_side_;
  std::vector<std::uint32_t> tile_of_cell_;
  std::vector<std::uint32_t> tile_of_pixel_;
};

void PlanDrawer::set_pixel(SurfacePlan& plan, std::size_t pixel, std::uint32_t tile) {
  if (tile == no_tile) return;
  const double irradiance = result_->tiles[tile].irradiance;
  const Colour colour = colour_of(*scale_, irradiance);
  plan.picture.colour[pixel] = glm::vec4(light_of(colour), 1.0F);
  plan.picture.irradiance[pixel] = static_cast<float>(irradiance);
  tile_of_pixel_[pixel] = tile;
}

// Sets the pixels with their middle inside the triangle.
void PlanDrawer::fill(const std::array<Corner, 3>& t, SurfacePlan& plan) {
  const TileMap& map = result_->tiling.maps[plan.map];
  const glm::dvec2 b = t[1].pixel - t[0].pixel;
  const glm::dvec2 c = t[2].pixel - t[0].pixel;
  const double area = b.x * c.y - b.y * c.x;
  if (area == 0.0) return;
  const glm::dvec2 low = glm::min(t[0].pixel, glm::min(t[1].pixel, t[2].pixel));
  const glm::dvec2 high = glm::max(t[0].pixel, glm::max(t[1].pixel, t[2].pixel));
  const auto clip = [](double value, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  for (std::size_t y = clip(std::floor(low.y), plan.picture.height); y < clip(std::ceil(high.y), plan.picture.height);
       ++y) {
    for (std::size_t x = clip(std::floor(low.x), plan.picture.width); x < clip(std::ceil(high.x), plan.picture.width);
         ++x) {
      const glm::dvec2 p = glm::dvec2(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5) - t[0].pixel;
      const double s = (p.x * c.y - p.y * c.x) / area;
      const double r = (b.x * p.y - b.y * p.x) / area;
      constexpr double tolerance = 1e-9;  // by rounding, a pixel on the edge of two triangles must not miss both
      if (s < -tolerance || r < -tolerance || s + r > 1.0 + tolerance) continue;
      const glm::dvec2 cell = t[0].cell + s * (t[1].cell - t[0].cell) + r * (t[2].cell - t[0].cell);
      const auto column = std::min(static_cast<std::size_t>(std::max(cell.x, 0.0)), std::size_t{map.columns} - 1);
      const auto row = std::min(static_cast<std::size_t>(std::max(cell.y, 0.0)), std::size_t{map.rows} - 1);
      set_pixel(plan, y * plan.picture.width + x, tile_of_cell_[row * map.columns + column]);
    }
  }
}

void PlanDrawer::draw_piece(const PlanSubject& subject, SurfacePlan& plan) {
  const TileMap& map = result_->tiling.maps[subject.map];
  const Surface& surface = room_->surfaces[map.surface];
  const Axes axes = axes_for(subject.from_behind ? -subject.piece.normal : subject.piece.normal);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  double depth = 0.0;
  const glm::dvec3 normal = subject.piece.normal;
  const auto flat = [&](const glm::dvec3& p) { return glm::dvec2(glm::dot(p, axes.across), glm::dot(p, axes.down)); };
  for (const std::uint32_t n : subject.piece.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = surface.positions[surface.triangles[n][k]];
      low = glm::min(low, flat(p));
      high = glm::max(high, flat(p));
      depth = glm::dot(p, normal);
    }
  }
  const double metre = longer_side_ / std::max(high.x - low.x, high.y - low.y);  // pixels
  plan.picture = empty_picture(metre * (high.x - low.x), metre * (high.y - low.y));
  tile_of_pixel_.assign(plan.picture.colour.size(), no_tile);
  plan.corner = low.x * axes.across + low.y * axes.down + depth * normal;
  plan.across = axes.across / metre;
  plan.down = axes.down / metre;
  for (const std::uint32_t n : subject.piece.triangles) {
    std::array<Corner, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& p = surface.positions[surface.triangles[n][static_cast<int>(k)]];
      triangle[k] = {metre * (flat(p) - low), result_->tiling.cells[map.surface][n][k]};
    }
    fill(triangle, plan);
  }
  set_statistics(plan);
}

// Mean, lowest and highest irradiance of the tiles in the picture; each tile counts with its whole area.
void PlanDrawer::set_statistics(SurfacePlan& plan) const {
  double power = 0.0;
  double area = 0.0;
  std::vector<bool> counted(result_->tiles.size());
  plan.min_irradiance = std::numeric_limits<double>::infinity();
  for (const std::uint32_t tile : tile_of_pixel_) {
    if (tile == no_tile || counted[tile]) continue;
    counted[tile] = true;
    const TileResult& found = result_->tiles[tile];
    power += found.irradiance * result_->tiling.tiles[tile].area_m2;
    area += result_->tiling.tiles[tile].area_m2;
    plan.min_irradiance = std::min(plan.min_irradiance, found.irradiance);
    plan.max_irradiance = std::max(plan.max_irradiance, found.irradiance);
  }
  if (!(area > 0.0)) plan.min_irradiance = 0.0;
  plan.mean_irradiance = area > 0.0 ? power / area : 0.0;
}

// Row 0 of the tile map is the top row, as in its OpenEXR image.
void PlanDrawer::draw_map(SurfacePlan& plan) {
  const TileMap& map = result_->tiling.maps[plan.map];
  plan.flat = false;
  const double cell = std::max(1.0, std::floor(longer_side_ / std::max(map.columns, map.rows)));
  const double shrink = std::min(1.0, longer_side_ / std::max(map.columns, map.rows));
  plan.picture = empty_picture(cell * shrink * map.columns, cell * shrink * map.rows);
  tile_of_pixel_.assign(plan.picture.colour.size(), no_tile);
  for (std::size_t y = 0; y < plan.picture.height; ++y) {
    for (std::size_t x = 0; x < plan.picture.width; ++x) {
      const std::size_t column = x * map.columns / plan.picture.width;
      const std::size_t row = y * map.rows / plan.picture.height;
      set_pixel(plan, y * plan.picture.width + x, map.tile_of_cell[row * map.columns + column]);
    }
  }
  const SurfaceResult& surface = result_->surfaces[plan.map];
  plan.mean_irradiance = surface.mean_irradiance;
  plan.min_irradiance = surface.min_irradiance;
  plan.max_irradiance = surface.max_irradiance;
}

// The irradiance of the tiles at points `step` pixels apart.
IrradianceField PlanDrawer::field_of(const SurfacePlan& plan, double step) const {
  IrradianceField field;
  field.columns = static_cast<std::size_t>(std::ceil(static_cast<double>(plan.picture.width) / step));
  field.rows = static_cast<std::size_t>(std::ceil(static_cast<double>(plan.picture.height) / step));
  const auto pixel_at = [&](std::size_t k, std::size_t most) {
    return std::min(static_cast<std::size_t>((static_cast<double>(k) + 0.5) * step), most - 1);
  };
  for (std::size_t y = 0; y < field.rows; ++y) {
    for (std::size_t x = 0; x < field.columns; ++x) {
      const std::size_t pixel = pixel_at(y, plan.picture.height) * plan.picture.width + pixel_at(x, plan.picture.width);
      const bool there = tile_of_pixel_[pixel] != no_tile;
      field.values.push_back(there ? result_->tiles[tile_of_pixel_[pixel]].irradiance : 0.0);
      field.weight.push_back(there ? 1.0 : 0.0);
    }
  }
  return field;
}

// The 1 % quantile, the median and the 99 % quantile of a field on the surface.
struct Range {
  double low = 0.0;
  double middle = 0.0;
  double high = 0.0;
};

Range range_of(const IrradianceField& field) {
  std::vector<double> values;
  for (std::size_t k = 0; k < field.values.size(); ++k) {
    if (field.weight[k] > 0.0) values.push_back(field.values[k]);
  }
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[n / 100], values[n / 2], values[n - 1 - n / 100]};
}

double length_of(const Isoline& line) {
  double length = 0.0;
  for (std::size_t k = 1; k < line.points.size(); ++k) length += glm::length(line.points[k] - line.points[k - 1]);
  return length;
}

std::optional<PlanDrawer::TypicalTile> PlanDrawer::typical_tile() const {
  double variance = 0.0;
  double area = 0.0;
  double count = 0.0;
  for (const std::uint32_t tile : tile_of_pixel_) {
    if (tile == no_tile) continue;
    variance += std::pow(result_->tiles[tile].standard_error, 2);
    area += result_->tiling.tiles[tile].area_m2;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return TypicalTile{std::sqrt(variance / count), std::sqrt(area / count)};
}

// The radius in m of the Gaussian that makes the noise small compared with the step between isolines; none if no radius
// does.
std::optional<double> PlanDrawer::smoothing_radius(const SurfacePlan& plan, const IrradianceField& field, double step,
                                                   const TypicalTile& tile) const {
  const double metre = 1.0 / glm::length(plan.across);  // pixels
  const auto shorter = static_cast<double>(std::min(plan.picture.width, plan.picture.height));
  // Averaged over a Gaussian of radius r, tiles of edge h with an error σ have the error σ·h/(2√π·r).
  const double one = tile.error * tile.edge_m / (2.0 * std::sqrt(std::numbers::pi));
  const double max_radius = std::max(0.1 * shorter / metre, 0.5 * tile.edge_m);  // m
  const Range coarse = range_of(smoothed(field, std::clamp(max_radius * metre / step, 0.5, 1e3)));
  const double wanted_step = (coarse.high - coarse.low) / levels_in_range;
  const double radius =
      std::clamp(min_step_in_errors * one / std::max(wanted_step, 1e-300), 0.6 * tile.edge_m, max_radius);
  if (one / radius > 0.5 * wanted_step) return std::nullopt;
  return radius;
}

void PlanDrawer::add_isolines(SurfacePlan& plan) const {
  const auto longer = static_cast<double>(std::max(plan.picture.width, plan.picture.height));
  const double step = std::max(1.0, longer / field_side);  // pixels between points of the field
  const auto tile = typical_tile();
  if (!tile) {
    plan.why_no_isolines = "No isolines: the surface is too narrow.";
    return;
  }
  if (!std::isfinite(tile->error)) {
    plan.why_no_isolines = "No isolines: too few photons.";
    return;
  }
  const IrradianceField field = field_of(plan, step);
  const auto radius = smoothing_radius(plan, field, step, *tile);
  if (!radius) {
    plan.why_no_isolines = "No isolines: differences within the errors.";
    return;
  }
  plan.smoothing_m = *radius;
  const double metre = 1.0 / glm::length(plan.across);  // pixels
  const IrradianceField smooth = smoothed(field, std::max(0.5, *radius * metre / step));
  const Range range = range_of(smooth);
  // A small bright area on a dark wall would contain all levels of a linear scale.
  const bool logarithmic = range.high > 8.0 * range.middle;
  for (const double level : round_levels(range.low, range.high, logarithmic)) {
    for (Isoline& line : lines_of(smooth, level)) {
      for (glm::dvec2& point : line.points) point = (point + 0.5) * step;
      if (length_of(line) >= min_line_length_px) plan.isolines.push_back(std::move(line));
    }
  }
  if (plan.isolines.empty()) plan.why_no_isolines = "No isolines: nearly uniform.";
}

// Whether a plan has the bottom colour of the scale nearly everywhere, so that it shows nothing.
bool is_dark(const SurfacePlan& plan, const ColourScale& scale) {
  constexpr double dark = 0.05;  // of the scale: colours that are hardly distinguishable
  constexpr double nearly_all = 0.99;
  double shown = 0.0;
  double dim = 0.0;
  for (const float irradiance : plan.picture.irradiance) {
    if (std::isnan(irradiance)) continue;
    shown += 1.0;
    dim += scale.share(double{irradiance}) < dark ? 1.0 : 0.0;
  }
  return dim >= nearly_all * shown;
}

// A sentence with the names of some tile maps; none without maps.
void add_sentence(std::vector<std::string>& sentences, const std::string& beginning, std::vector<std::size_t> maps,
                  const Result& result) {
  constexpr std::size_t max_names = 5;
  std::sort(maps.begin(), maps.end());
  maps.erase(std::unique(maps.begin(), maps.end()), maps.end());
  if (maps.empty()) return;
  std::string names;
  for (std::size_t k = 0; k < std::min(maps.size(), max_names); ++k)
    names += (k > 0 ? ", " : "") + result.tiling.maps[maps[k]].name;
  if (maps.size() > max_names) names += " and " + to_text(maps.size() - max_names, "other");
  sentences.push_back(beginning + names + ".");
}

}  // namespace

SurfacePlans draw_plans(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale,
                        std::size_t max_plans, std::size_t longer_side) {
  if (longer_side < 16 || longer_side > 4096)
    throw InputError("The longer side of a plan is " + std::to_string(longer_side) +
                     " pixels (allowed: 16 to 4096). Choose another size.");
  SurfacePlans drawn;
  PlanDrawer drawer(room, result, scale, static_cast<double>(longer_side));
  PlanSubjects found = plan_subjects(room, result, lit);
  std::vector<std::size_t> dark;
  std::vector<std::size_t> further;
  for (const PlanSubject& subject : found.subjects) {
    if (drawn.plans.size() == max_plans) {
      further.push_back(subject.map);
      continue;
    }
    SurfacePlan plan = drawer.draw(subject);
    if (is_dark(plan, scale))
      dark.push_back(subject.map);
    else
      drawn.plans.push_back(std::move(plan));
  }
  add_sentence(drawn.left_out, "Plans would have the lowest colour nearly everywhere of parts of: ", dark, result);
  add_sentence(drawn.left_out, "In many or small parts, therefore without a plan: ", found.small_parts, result);
  add_sentence(drawn.left_out,
               "There are more than " + to_text(max_plans, "plan") + "; not shown are parts of: ", further, result);
  return drawn;
}

}  // namespace lichtmc
