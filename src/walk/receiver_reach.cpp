#include "walk/receiver_reach.hpp"

#include <cassert>

namespace lichtmc {

ReceiverReach::ReceiverReach(PlaceTree cells, std::size_t cluster, std::size_t clusters,
                             std::vector<std::uint8_t> reached)
    : cells_(std::move(cells)), cluster_(cluster), clusters_(clusters), reached_(std::move(reached)) {
  assert(reached_.size() == cells_.size() * clusters_);
  reached_.resize((cells_.size() + 1) * clusters_, 1);
}

}  // namespace lichtmc
