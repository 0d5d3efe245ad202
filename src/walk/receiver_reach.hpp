// Which receivers the impacts of photons serve: those that they probably reach, and of the others a random part.
//
// The surfaces of the room are divided into cells (place_tree.hpp), the receivers into clusters of neighbours. A table
// says for each pair whether light from the cell reaches a receiver of the cluster, as far as test rays have shown
// (learn_reach.hpp). An impact serves the clusters that its cell reaches, and each other cluster with the probability
// 1/one_in; then its contribution is multiplied by one_in (Russian roulette: J. Spanier, E. M. Gelbard, Monte Carlo
// Principles and Neutron Transport Problems, 1969). So the mean is the same whatever the table says; the table decides
// about work and variance only.
//
// One random number of an impact serves all clusters: cluster c is taken if c mod one_in is that number. Every cluster
// has the same probability, and an impact always takes nearly the same number of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "walk/place_tree.hpp"

namespace lichtmc {

class ReceiverReach {
 public:
  static constexpr std::uint32_t one_in = 32;

  // cluster: receivers of a cluster, a multiple of most_lanes. reached: cells.size() rows of `clusters` elements, 1 or
  // 0.
  ReceiverReach(PlaceTree cells, std::size_t cluster, std::size_t clusters, std::vector<std::uint8_t> reached);

  // The cell of a point on a surface: in m; normal of the side, of length 1.
  std::uint32_t cell_of(const glm::dvec3& point, const glm::dvec3& normal) const {
    return cells_.cell_of(point, normal);
  }

  // Calls serve(begin, end, factor) for the parts of receivers first … first + n − 1 that an impact serves; begin and
  // end are counted from `first`, which is a multiple of the size of a cluster. turn: uniform in 0 … one_in − 1.
  template <class Serve>
  void choose(std::uint32_t cell, std::uint32_t turn, std::size_t first, std::size_t n, const Serve& serve) const {
    const std::size_t before = first / cluster_;
    const std::size_t count = (n + cluster_ - 1) / cluster_;
    const std::uint8_t* reached = &reached_[cell * clusters_ + before];
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t begin = c;
      if (reached[c] != 0) {
        while (c + 1 < count && reached[c + 1] != 0) ++c;
      } else if ((before + c) % one_in != turn) {
        continue;
      }
      serve(begin * cluster_, std::min((c + 1) * cluster_, n), reached[begin] != 0 ? 1.0F : static_cast<float>(one_in));
    }
  }

 private:
  PlaceTree cells_;
  std::size_t cluster_;
  std::size_t clusters_;
  std::vector<std::uint8_t> reached_;  // by cell and cluster; of places without cell: 1
};

}  // namespace lichtmc
