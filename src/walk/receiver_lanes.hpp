// Receivers as arrays, several of which one vector instruction treats at a time; for next-event estimation.
//
// Positions are in the room's own coordinates: relative to the tracer's origin, in units of `size_m`, so that they are
// at most some units wherever and however large the room is, and floats resolve them to 10⁻⁷ of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "base/lanes.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/receiver_reach.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

class ChannelScores;
struct ImpactPath;

// A point of a surface from which light is scattered to receivers.
struct Impact {
  glm::vec3 point{0.0F};   // in the receivers' coordinates
  glm::vec3 normal{0.0F};  // world, length 1, on the side that was hit
  glm::vec3 start{0.0F};   // of shadow rays, in the tracer's coordinates
  float weight = 0.0F;     // of the photon
  // Backward over forward: the density with which walks from receivers would have made the photon's path, except for
  // their first flight, divided by that of photons from the emitters; in the receivers' units of area. 0: no walks.
  float backward_ratio = 0.0F;
  std::uint32_t row = 0;  // of the sums that it scores in: its round, or its round and group of emitters
  // Only where receivers are chosen (receiver_reach.hpp): the cell of the surfaces, and a random number below one_in.
  std::uint32_t cell = 0;
  std::uint32_t turn = 0;
  // Where in the cells of receivers it contributes, −½ … ½ along their edges.
  float in_cell_u = 0.0F;
  float in_cell_v = 0.0F;
};

// Where the scores of impulse responses go: the paths of all impacts, and the unit of their irradiances, W/m² or lx.
struct ImpactRecord {
  ChannelScores* scores = nullptr;
  std::span<const ImpactPath> paths;
  double unit = 1.0;
};

class ReceiverLanes {
 public:
  // receivers: see receiver_points.hpp; a part of them, first … last − 1.
  ReceiverLanes(const std::vector<ReferencePoint>& receivers, const Tracer& tracer, std::size_t first,
                std::size_t last);

  std::size_t size() const { return number_.size(); }
  // The receiver at position k of the arrays, counted from `first`.
  std::uint32_t number(std::size_t k) const { return number_[k]; }
  const std::vector<std::uint32_t>& numbers() const { return number_; }
  // Whether a receiver is a cell: then impacts have places in cells.
  bool has_cells() const { return !edges_.empty(); }
  // m: the unit of length.
  double size_m() const { return size_m_; }
  // A point in the tracer's coordinates → the receivers' coordinates.
  glm::vec3 point(const glm::vec3& in_tracer) const { return glm::vec3(to_lanes_ * glm::dvec3(in_tracer)); }

  // Adds the irradiance that impacts cause at every receiver, in units of the photon's power per size_m², to
  // sums[row · whole_lanes(size()) + k], k the position in the arrays. reach: which receivers each impact serves;
  // null: all. value: memory for it; shadow rays are counted. record: receives what each impact sends to each receiver;
  // null: nothing does; not for cells. Returns the number of pairs of impact and receiver.
  std::uint64_t irradiate(std::span<const Impact> impacts, const Tracer& tracer, const ReceiverReach* reach,
                          std::vector<float>& value, std::vector<double>& sums, TraceCount& count,
                          const ImpactRecord* record = nullptr) const;

  // The irradiance by one impact without shadows; value[k] at position k, for whole_lanes(size()) positions.
  void irradiate_unshadowed(const Impact& impact, std::vector<float>& value) const;
  // Sets value[k] to 0 where a surface lies between the impact and the receiver at position k.
  void darken_blocked(const Impact& impact, const Tracer& tracer, std::vector<float>& value, TraceCount& count) const {
    tracer.darken_blocked(impact.start, ends_, 0, size(), value.data(), count);
  }

 private:
  // The receivers at positions begin … end − 1.
  // Returns whether one of them may see the impact.
  bool irradiate_some(const Impact& impact, std::size_t begin, std::size_t end, const Tracer& tracer, float* value,
                      double* sums, TraceCount& count) const;

  // As irradiate(), with receivers shifted within their cells. All are served.
  std::uint64_t irradiate_cells(std::span<const Impact> impacts, const Tracer& tracer, std::vector<float>& value,
                                std::vector<double>& sums, TraceCount& count) const;
  void set_laws(const std::vector<ReferencePoint>& receivers);
  void set_edges(std::size_t k, const ReferencePoint& receiver, const Tracer& tracer);

  std::size_t first_ = 0;
  glm::dmat3 to_lanes_{1.0};
  double size_m_ = 1.0;
  std::vector<std::uint32_t> number_;
  // Position, normal or axis, squared least cosine of the field of view, 1/sin² of its half angle.
  std::array<std::vector<float>, 8> arrays_;
  EndPoints ends_;  // of shadow rays
  // Only if a receiver is a cell: its edges, u and then v, in the receivers' and then in the tracer's coordinates.
  std::vector<std::vector<float>> edges_;
  // Only if a receiver is a cylinder: the direction that it faces, whether it is one, its least height over impacts.
  std::vector<std::vector<float>> laws_;
};

}  // namespace lichtmc
