// The picture of photon paths.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/lit_room.hpp"
#include "output/picture_parts.hpp"
#include "output/picture_svg.hpp"
#include "output/svg.hpp"
#include "room/welded_mesh.hpp"

namespace lichtmc {

namespace {

constexpr double flights_width = 110.0;  // of the legend

// The visible edges of a room: edges that are not shared by exactly two triangles, and edges between planes that differ
// by more than 20°. At most 3000, the longest.
std::vector<std::array<glm::dvec3, 2>> edges_of(const Room& room) {
  constexpr std::size_t max_edges = 3000;
  constexpr double crease_cosine = 0.94;  // cos 20°
  const WeldedMesh mesh(room);
  const auto normal = [&](std::size_t triangle) {
    const WeldedMesh::Corners& c = mesh.corners(triangle);
    const glm::dvec3 cross = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double length = glm::length(cross);
    return length > 0.0 ? cross / length : glm::dvec3(0.0);
  };
  std::vector<std::array<glm::dvec3, 2>> edges;
  for_each_edge(mesh.edges(), [&](std::size_t first, std::size_t end) {
    bool visible = end - first != 2;
    if (!visible)
      visible = std::abs(glm::dot(normal(mesh.edges()[first].triangle), normal(mesh.edges()[first + 1].triangle))) <
                crease_cosine;
    if (visible) edges.push_back({mesh.places()[mesh.edges()[first].from], mesh.places()[mesh.edges()[first].to]});
  });
  const auto longer = [](const auto& a, const auto& b) { return glm::length(a[1] - a[0]) > glm::length(b[1] - b[0]); };
  std::stable_sort(edges.begin(), edges.end(), longer);
  if (edges.size() > max_edges) edges.resize(max_edges);
  return edges;
}

}  // namespace

std::string paths_svg(const Room& room, const std::vector<PhotonPath>& paths) {
  constexpr double width = 900.0;
  constexpr double height = 620.0;
  const glm::dmat4 view = view_onto(room, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  const auto at = [&](const glm::dvec3& p) { return glm::dvec2(picture_side, picture_top) + pixel_of(view, p); };
  std::string svg = svg_head(picture_side + width + flights_width, picture_top + height + 34.0,
                             to_text(paths.size(), "photon path"), picture_side);
  for (const auto& edge : edges_of(room)) {
    const glm::dvec2 a = at(edge[0]);
    const glm::dvec2 b = at(edge[1]);
    svg += svg_line(a.x, a.y, b.x, b.y, "class=\"frame\" stroke-opacity=\"0.6\"");
  }
  for (const PhotonPath& path : paths) {
    svg += "<g stroke-width=\"1.3\" stroke-opacity=\"0.85\"><title>photon " + std::to_string(path.history) + ": " +
           to_text(path.points.size() - 1, "flight") + ", " + std::string(to_string(path.end)) + "</title>\n";
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const glm::dvec2 a = at(path.points[k - 1].place);
      const glm::dvec2 b = at(path.points[k].place);
      svg += svg_line(a.x, a.y, b.x, b.y, "stroke=\"" + css(colour_of_flight(k)) + "\"");
    }
    const glm::dvec2 end = at(path.points.back().place);
    const bool absorbed = path.end == PathEnd::absorbed;
    svg += svg_circle(end, 2.5, absorbed ? "fill=\"#888\" stroke=\"none\"" : "fill=\"none\" stroke=\"#888\"",
                      std::string(to_string(path.end)));
    svg += "</g>\n";
  }
  const double x = picture_side + width + 10.0;
  svg += svg_text(x, picture_top + 12.0, "flight");
  for (std::size_t k = 1; k <= 10; ++k) {
    const double y = picture_top + 14.0 + 20.0 * static_cast<double>(k);
    svg += svg_line(x, y - 4.0, x + 26.0, y - 4.0, "stroke-width=\"4\" stroke=\"" + css(colour_of_flight(k)) + "\"");
    svg += svg_text(x + 34.0, y, k < 10 ? std::to_string(k) : "10 …");
  }
  svg += svg_text(picture_side + width, picture_top + height + 18.5,
                  "filled dots: absorbed; open dots: escaped, cut off or lost",
                  " class=\"muted\" text-anchor=\"end\" font-size=\"12\"");
  return svg + "</svg>\n";
}

}  // namespace lichtmc
