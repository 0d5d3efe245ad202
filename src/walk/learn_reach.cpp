#include "walk/learn_reach.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "walk/marked_points.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 0x9E3779B97F4A7C15;  // any

constexpr std::size_t least_receivers = 128;
constexpr std::size_t most_clusters = 256;  // of smaller sizes than a block

// Test rays of a pair of cell and cluster: a cluster of which the cell sees a fifth is missed once in 36 times.
constexpr std::size_t tests_of_pair = 16;
// Some 10⁶ test rays.
constexpr std::size_t most_pairs = 65'536;
constexpr std::size_t least_cells = 64;
constexpr std::size_t most_cells = 1024;

// Points where photons arrive: in three flights each, some 24 for a cell.
constexpr std::uint32_t flights = 3;
constexpr std::size_t photons_of_cell = 8;
constexpr std::size_t points_of_cell = 32;  // at most

// Larger cells, from which the share of the pairs that do not see each other is estimated first, in some milliseconds.
constexpr std::size_t trial_cells = 64;
// Less would save less than half of the work, at the risk of more variance.
constexpr double least_blind = 0.5;

class SurfacePointsGoal : public GoalBase {
 public:
  SurfacePointsGoal(const Scene& scene, const Stream& stream, MarkedPoints& points)
      : scene_(scene), stream_(stream), points_(points) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    scene_.launcher->launch_all(stream_, first_history_, n, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_.misses; }

  void reflect(const Wave& wave, std::uint32_t /*flight*/) { points_.mark(wave, *scene_.tracer); }

 private:
  const Scene& scene_;
  const Stream& stream_;
  MarkedPoints& points_;
};

MarkedPoints mark_points(const Scene& scene, std::size_t cells) {
  const Stream stream(seed);
  MarkedPoints points;
  SurfacePointsGoal goal(scene, stream, points);
  fly_unabsorbed(scene, stream, flights, photons_of_cell * cells, goal);
  return points;
}

// The smallest clusters of which there are not too many; at most a block of receivers.
std::size_t cluster_size_for(std::size_t receivers) {
  std::size_t size = most_lanes;
  while (size < ReceiverBlocks::size && receivers > most_clusters * size) size *= 2;
  return size;
}

class ReachTest {
 public:
  ReachTest(const Tracer& tracer, const MarkedPoints& points, const PlaceTree& cells,
            const std::vector<ReferencePoint>& receivers, const ReceiverBlocks& blocks, std::size_t cluster)
      : tracer_(tracer),
        points_(points),
        cells_(cells),
        clusters_((receivers.size() + cluster - 1) / cluster),
        faces_(clusters_),
        reached_(cells.size() * clusters_, 0) {
    for (std::size_t test = 0; test < tests_of_pair; ++test) {
      std::vector<ReferencePoint> picked;
      for (std::size_t first = 0; first < receivers.size(); first += cluster) {
        const std::size_t size = std::min(cluster, receivers.size() - first);
        const std::size_t k = first + test * size / tests_of_pair;
        const std::size_t block = k / ReceiverBlocks::size;
        picked.push_back(receivers[block * ReceiverBlocks::size + blocks.at(k).number(k % ReceiverBlocks::size)]);
      }
      picks_.emplace_back(picked, tracer, 0, picked.size());
    }
  }

  void test_all() {
    for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) test(cell);
  }

  // Of the pairs tested that face each other.
  double blind_share() const { return facing_ > 0 ? static_cast<double>(blind_) / static_cast<double>(facing_) : 0.0; }
  std::size_t clusters() const { return clusters_; }
  std::vector<std::uint8_t> take_table() { return std::move(reached_); }

 private:
  // Tests the pairs of a cell and all clusters.
  void test(std::uint32_t cell) {
    std::fill(faces_.begin(), faces_.end(), 0);
    std::uint8_t* reached = &reached_[cell * clusters_];
    const std::span<const std::uint32_t> members = cells_.members(cell);
    for (std::size_t k = 0; k < tests_of_pair; ++k) {
      // Each pick of receivers once; which of them goes with which point differs from cell to cell.
      const ReceiverLanes& picked = picks_[(k + cell) % tests_of_pair];
      const Impact impact = impact_at(members[k * members.size() / tests_of_pair], picked);
      picked.irradiate_unshadowed(impact, value_);
      mark(picked, faces_.data());
      // Tested whether they face each other or not: other points of the cell may face other receivers of the cluster,
      // and just where few do, at the edge of a wall beside a receiver, they send it much light.
      std::fill(value_.begin(), value_.end(), 1.0F);
      picked.darken_blocked(impact, tracer_, value_, count_);
      mark(picked, reached);
    }
    for (std::size_t c = 0; c < clusters_; ++c) {
      facing_ += faces_[c];
      blind_ += faces_[c] != 0 && reached[c] == 0 ? 1U : 0U;
    }
  }

  Impact impact_at(std::uint32_t point, const ReceiverLanes& receivers) const {
    Impact impact;
    impact.start = points_.starts[point];
    impact.point = receivers.point(impact.start);
    impact.normal = glm::vec3(points_.places[point].normal);
    impact.weight = 1.0F;
    return impact;
  }

  void mark(const ReceiverLanes& picked, std::uint8_t* clusters) const {
    for (std::size_t k = 0; k < picked.size(); ++k) {
      if (value_[k] > 0.0F) clusters[picked.number(k)] = 1;
    }
  }

  const Tracer& tracer_;
  const MarkedPoints& points_;
  const PlaceTree& cells_;
  std::size_t clusters_;
  std::vector<ReceiverLanes> picks_;  // each has one receiver of every cluster
  std::vector<std::uint8_t> faces_;   // by cluster
  std::vector<std::uint8_t> reached_;
  std::vector<float> value_;
  std::uint64_t facing_ = 0;
  std::uint64_t blind_ = 0;
  TraceCount count_;
};

double blind_share_of_trial(const Scene& scene, const std::vector<ReferencePoint>& receivers,
                            const ReceiverBlocks& blocks, std::size_t cluster) {
  const MarkedPoints points = mark_points(scene, trial_cells);
  if (points.places.empty()) return 0.0;
  const PlaceTree cells(points.places, points_of_cell, points_of_cell);
  ReachTest test(*scene.tracer, points, cells, receivers, blocks, cluster);
  test.test_all();
  return test.blind_share();
}

}  // namespace

std::optional<LearnedReach> learn_reach(const Scene& scene, const std::vector<ReferencePoint>& receivers,
                                        const ReceiverBlocks& blocks) {
  if (receivers.size() < least_receivers || !scene.tracer->casts_shadows()) return std::nullopt;
  const std::size_t cluster = cluster_size_for(receivers.size());
  const std::size_t clusters = (receivers.size() + cluster - 1) / cluster;
  if (blind_share_of_trial(scene, receivers, blocks, cluster) < least_blind) return std::nullopt;
  const MarkedPoints points = mark_points(scene, std::clamp(most_pairs / clusters, least_cells, most_cells));
  PlaceTree cells(points.places, points_of_cell, points_of_cell);
  ReachTest test(*scene.tracer, points, cells, receivers, blocks, cluster);
  test.test_all();
  const double served = 1.0 - test.blind_share() * (1.0 - 1.0 / ReceiverReach::one_in);
  return LearnedReach{ReceiverReach(std::move(cells), cluster, clusters, test.take_table()), served};
}

}  // namespace lichtmc
