#include "room/emission.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/clip.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

using UvCorners = std::array<glm::dvec2, 3>;

UvCorners corners_on_map(const std::vector<glm::dvec2>& uvs, const glm::uvec3& t) {
  return {uvs[t.x], uvs[t.y], uvs[t.z]};
}

double twice_area(const Surface& surface, const glm::uvec3& t) {
  const glm::dvec3& a = surface.positions[t.x];
  return glm::length(glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a));
}

// A triangle on the grid whose lines pass through the centres of the pixels.
struct OnPixels {
  OnPixels(const UvCorners& corner, const TextureMap& map) {
    const glm::dvec2 size(map.columns, map.rows);
    for (std::size_t k = 0; k < 3; ++k) corners[k] = corner[k] * size - 0.5;
    const glm::dvec2 low = glm::floor(glm::min(corners[0], glm::min(corners[1], corners[2])));
    const glm::dvec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    for (glm::dvec2& c : corners) c -= low;
    span = glm::floor(high - low) + 1.0;
  }
  double cells() const { return span.x * span.y; }

  UvCorners corners{};
  glm::dvec2 span{1.0};
};

// Between the centres of neighbouring pixels the value is the product of a linear function of u and one of v; the rule
// of the three midpoints of the sides is exact for polynomials of degree 2.
double exact_mean(const UvCorners& corner, const TextureMap& map, std::vector<CellTriangle>& parts) {
  const OnPixels grid(corner, map);
  cut_into_triangles(grid.corners, static_cast<std::uint32_t>(grid.span.x), static_cast<std::uint32_t>(grid.span.y),
                     parts);
  const auto at = [&](const glm::dvec2& weights) {
    const glm::dvec2 uv = corner[0] + weights.x * (corner[1] - corner[0]) + weights.y * (corner[2] - corner[0]);
    return value_at(map, uv.x, uv.y);
  };
  double sum = 0.0;
  double shares = 0.0;
  for (const CellTriangle& part : parts) {
    double mean = 0.0;
    for (std::size_t k = 0; k < 3; ++k) mean += at(0.5 * (part.weights[k] + part.weights[(k + 1) % 3])) / 3.0;
    sum += part.share * mean;
    shares += part.share;
  }
  return shares > 0.0 ? sum / shares : at({1.0 / 3.0, 1.0 / 3.0});
}

// The mean over n × n congruent parts, each evaluated at its centroid.
double mean_of_parts(const UvCorners& corner, const TextureMap& map, int n) {
  const glm::dvec2 a = (corner[1] - corner[0]) / static_cast<double>(n);
  const glm::dvec2 b = (corner[2] - corner[0]) / static_cast<double>(n);
  double sum = 0.0;
  const auto add = [&](double i, double j) {
    const glm::dvec2 uv = corner[0] + i * a + j * b;
    sum += value_at(map, uv.x, uv.y);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  return sum / (double{1} * n * n);
}

// Whether one of some points of a triangle is not black.
bool is_lit_somewhere(const UvCorners& corner, const TextureMap& map) {
  constexpr int n = 16;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const glm::dvec2 uv =
          corner[0] + (double{1} * i / n) * (corner[1] - corner[0]) + (double{1} * j / n) * (corner[2] - corner[0]);
      if (value_at(map, uv.x, uv.y) > 0.0) return true;
    }
  }
  return false;
}

}  // namespace

double mean_emission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs,
                     TriangleMeans& known) {
  constexpr double most_cells = 0x1p18;
  constexpr double most_parts = 0x1p22;
  constexpr double worth_keeping = 64.0;  // cells: below, the look-up costs as much as the mean
  double cells = 0.0;
  for (const glm::uvec3& t : surface.triangles) cells += OnPixels(corners_on_map(uvs, t), map).cells();
  const bool exact = cells <= most_cells;
  const double per_cell = std::min(1.0, most_parts / cells);
  double sum = 0.0;
  double area = 0.0;
  std::vector<CellTriangle> parts;
  for (const glm::uvec3& t : surface.triangles) {
    const UvCorners corner = corners_on_map(uvs, t);
    const double own_cells = OnPixels(corner, map).cells();
    // Coordinates may be so large that these numbers are not finite: then one part.
    const double across = std::ceil(std::sqrt(per_cell * own_cells));
    const double n = across >= 1.0 ? std::min(across, 2048.0) : 1.0;
    const auto compute = [&] {
      return exact ? exact_mean(corner, map, parts) : mean_of_parts(corner, map, static_cast<int>(n));
    };
    double mean = 0.0;
    if (own_cells > worth_keeping) {
      const auto [entry, fresh] = known.try_emplace(
          {exact ? 0.0 : n, corner[0].x, corner[0].y, corner[1].x, corner[1].y, corner[2].x, corner[2].y}, 0.0);
      if (fresh) entry->second = compute();
      mean = entry->second;
    } else {
      mean = compute();
    }
    const double twice = twice_area(surface, t);
    sum += twice * mean;
    area += twice;
  }
  return area > 0.0 ? sum / area : 0.0;
}

double mean_emission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs) {
  TriangleMeans known;
  return mean_emission(surface, map, uvs, known);
}

bool emits(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs) {
  for (const glm::uvec3& t : surface.triangles) {
    if (twice_area(surface, t) > 0.0 && is_lit_somewhere(corners_on_map(uvs, t), map)) return true;
  }
  return mean_emission(surface, map, uvs) > 0.0;
}

// Divides triangles into pieces, those first that would lose most proposals.
class SurfaceEmission::Division {
 public:
  Division(const Surface& surface, const std::vector<glm::dvec2>& uvs, const ValueBounds& bounds)
      : surface_(surface), uvs_(uvs), bounds_(bounds) {}

  void divide(std::size_t most_pieces) {
    for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
      const double area = twice_area(surface_, surface_.triangles[n]);
      if (area > 0.0) add({static_cast<std::uint32_t>(n), {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}}, area);
    }
    constexpr double accepted = 0.75;
    while (!queue_.empty() && done_.size() + queue_.size() < most_pieces && lost_ > (1.0 - accepted) * proposed_)
      divide_first();
    while (!queue_.empty()) {
      done_.push_back(queue_.top());
      queue_.pop();
    }
  }

  // Pieces that emit, and their areas times their highest values.
  void take(std::vector<Piece>& pieces, std::vector<double>& shares) const {
    for (const Weighed& one : done_) {
      pieces.push_back(one.piece);
      shares.push_back(one.area * double{one.piece.highest});
    }
  }

 private:
  struct Weighed {
    Piece piece;
    double area = 0.0;
    double lost() const { return area * (double{piece.highest} - double{piece.lowest}); }
    bool operator<(const Weighed& other) const { return lost() < other.lost(); }
  };

  void add(Piece piece, double area) {
    const glm::uvec3 t = surface_.triangles[piece.triangle];
    const UvCorners corner = corners_on_map(uvs_, t);
    UvCorners uv{};
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 at(piece.corners[k]);
      uv[k] = corner[0] + at.x * (corner[1] - corner[0]) + at.y * (corner[2] - corner[0]);
    }
    const ValueRange range =
        bounds_.over(glm::min(uv[0], glm::min(uv[1], uv[2])), glm::max(uv[0], glm::max(uv[1], uv[2])));
    if (!(range.high > 0.0F)) return;
    piece.lowest = range.low;
    piece.highest = range.high;
    const Weighed one{piece, area};
    lost_ += one.lost();
    proposed_ += area * double{range.high};
    // UvCorners of smaller pieces would not be exact in float.
    constexpr float smallest = 0x1p-20F;
    const glm::vec2 side = piece.corners[1] - piece.corners[0];
    if (one.lost() > 0.0 && std::max(std::abs(side.x), std::abs(side.y)) > smallest) {
      queue_.push(one);
    } else {
      done_.push_back(one);
    }
  }

  void divide_first() {
    const Weighed whole = queue_.top();
    queue_.pop();
    lost_ -= whole.lost();
    proposed_ -= whole.area * double{whole.piece.highest};
    const auto& [a, b, c] = whole.piece.corners;
    const glm::vec2 ab = 0.5F * (a + b);
    const glm::vec2 bc = 0.5F * (b + c);
    const glm::vec2 ca = 0.5F * (c + a);
    const std::array<std::array<glm::vec2, 3>, 4> parts{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    for (const auto& part : parts) add({whole.piece.triangle, part}, 0.25 * whole.area);
  }

  const Surface& surface_;
  const std::vector<glm::dvec2>& uvs_;
  const ValueBounds& bounds_;
  std::priority_queue<Weighed> queue_;
  std::vector<Weighed> done_;
  double lost_ = 0.0;      // areas times (highest − lowest value): no more proposals are lost
  double proposed_ = 0.0;  // areas times highest value
};

SurfaceEmission::SurfaceEmission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs,
                                 const ValueBounds& bounds, double mean, std::size_t most_pieces)
    : surface_(&surface), map_(&map), uvs_(&uvs), mean_(mean) {
  Division division(surface, uvs, bounds);
  division.divide(most_pieces);
  std::vector<double> shares;
  division.take(pieces_, shares);
  shares_up_to_ = cumulative(shares);
  double area = 0.0;
  float lowest = pieces_.front().lowest;
  highest_ = pieces_.front().highest;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    lowest = std::min(lowest, pieces_[k].lowest);
    highest_ = std::max(highest_, pieces_[k].highest);
    area += shares[k] / double{pieces_[k].highest};
  }
  // Dark pieces were left out.
  const double whole = 2.0 * surface_area(*surface_);
  constexpr float same = 1e-5F;
  uniform_ = highest_ - lowest <= same * highest_ && area > whole * (1.0 - 1e-9);
}

EmissionOfRoom::EmissionOfRoom(const Room& room) : room_(&room) {
  const auto count = std::count_if(room.emitters.begin(), room.emitters.end(), has_emission_map);
  // Fewer pieces only cost more proposals.
  constexpr std::size_t least = 1024;
  most_pieces_ =
      std::max(least, SurfaceEmission::most_pieces_of_room / std::max<std::size_t>(1, static_cast<std::size_t>(count)));
}

std::optional<SurfaceEmission> EmissionOfRoom::of(const SurfaceEmitter& emitter) {
  if (!emitter.emission_map) return std::nullopt;
  const std::size_t number = *emitter.emission_map;
  const EmissionMap& map = room_->emission_maps[number];
  const Surface& surface = room_->surfaces[emitter.surface];
  const ValueBounds& bounds = bounds_.try_emplace(number, map).first->second;
  const double mean = mean_emission(surface, map, emitter.emission_uvs, means_[number]);
  return SurfaceEmission(surface, map, emitter.emission_uvs, bounds, mean, most_pieces_);
}

}  // namespace lichtmc
