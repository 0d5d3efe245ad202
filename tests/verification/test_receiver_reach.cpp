// Impacts that serve only the receivers that they probably reach: the same means, whatever the table says, and a table
// only where it pays.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "walk/direct_light.hpp"
#include "walk/learn_reach.hpp"
#include "walk/receiver_points.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Closed rooms of 3 m × 2.5 m × 3 m in a row along x, 0.1 m apart, with a lamp and 81 receivers each.
Room rooms_in_a_row(int rooms) {
  constexpr double width = 3.0;
  Room all;
  for (int k = 0; k < rooms; ++k) {
    const glm::dvec3 corner(k * (width + 0.1), 0.0, 0.0);
    for (Surface surface : make_cuboid({width, 2.5, width}, {0.3, 0.7, 0.5, 0.5, 0.5, 0.5}).surfaces) {
      surface.name += std::to_string(k);
      for (glm::dvec3& p : surface.positions) p += corner;
      all.surfaces.push_back(surface);
    }
    all.emitters.push_back(isotropic(corner + glm::dvec3(1.0, 2.0, 1.2), 100.0 * (1 + k)));
    for (int i = 0; i < 81; ++i)
      all.receivers.push_back(
          {"r", corner + glm::dvec3(0.2 + 0.31 * (i % 9), 0.8, 0.2 + 0.31 * (i / 9)), {0, 1, 0}, 90.0, 1.0});
  }
  return all;
}

class Prepared {
 public:
  explicit Prepared(Room room, Engine engine = Engine::embree)
      : room_(std::move(room)),
        tiling_(make_tiling(room_, 1.0)),
        scene_(room_, tiling_, engine),
        light_(room_, *scene_.tracer),
        points_(receiver_points(room_, *scene_.tracer)),
        blocks_(points_, *scene_.tracer) {}

  std::optional<LearnedReach> learn() const { return learn_reach(scene_, points_, blocks_); }

  // A table of the same cells as learned, with other entries: reached(cell, cluster).
  template <class Reached>
  ReceiverReach table(const Reached& reached) const {
    std::vector<Place> places;
    for (int k = 0; k < 400; ++k) {
      const glm::dvec3 point(0.0155 * k, 0.0, 3.0 * std::fmod(0.618 * k, 1.0));
      for (const double side : {-1.0, 1.0}) {
        places.push_back({point, {0, side, 0}});
        places.push_back({point, {side, 0, 0}});
        places.push_back({point, {0, 0, side}});
      }
    }
    PlaceTree cells(places, 32, 32);
    const std::size_t clusters = (points_.size() + 15) / 16;
    std::vector<std::uint8_t> entries;
    for (std::size_t k = 0; k < cells.size() * clusters; ++k)
      entries.push_back(reached(k / clusters, k % clusters) ? 1 : 0);
    return {std::move(cells), 16, clusters, std::move(entries)};
  }

  // The irradiance of every round and receiver, `together` rounds at a time.
  std::vector<double> rounds(const ReceiverReach* reach, const RoundPlan& plan, Estimator estimator,
                             std::uint64_t number, std::uint64_t together, std::uint64_t seed,
                             BackwardCount& count) const {
    const Settings settings = settings_of(estimator, Engine::embree, 1.0, seed);
    const auto walk = make_receiver_walk({room_, scene_, light_, blocks_, reach}, BackwardScale(room_), settings, plan);
    std::vector<double> all;
    for (std::uint64_t first = 0; first < number; first += together) {
      std::vector<double> some(together * points_.size(), 0.0);
      walk->collect({0, points_.size(), first, first + together}, some, count, [] { return false; });
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  // Mean and standard error of each receiver.
  std::vector<std::pair<double, double>> means(const ReceiverReach* reach, const RoundPlan& plan, Estimator estimator,
                                               std::uint64_t seed) const {
    constexpr std::uint64_t number = 1024;
    BackwardCount count;
    const std::vector<double> scores = rounds(reach, plan, estimator, number, 64, seed, count);
    const std::size_t n = points_.size();
    std::vector<std::pair<double, double>> found;
    for (std::size_t k = 0; k < n; ++k) {
      double sum = 0.0;
      double squares = 0.0;
      for (std::uint64_t r = 0; r < number; ++r) {
        sum += scores[r * n + k];
        squares += scores[r * n + k] * scores[r * n + k];
      }
      const double mean = sum / number;
      found.emplace_back(mean, std::sqrt((squares / number - mean * mean) / (number - 1)));
    }
    return found;
  }

  const Scene& scene() const { return scene_; }

 private:
  Room room_;
  Tiling tiling_;
  Scene scene_;
  DirectLight light_;
  std::vector<ReferencePoint> points_;
  ReceiverBlocks blocks_;
};

std::vector<Compared> against(const std::vector<std::pair<double, double>>& found,
                              const std::vector<std::pair<double, double>>& expected, double factor = 1.0) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < found.size(); ++k)
    figures.push_back({factor * found[k].first, factor * found[k].second, expected[k].first, expected[k].second});
  return figures;
}

}  // namespace

TEST_CASE("receiver reach: the means do not depend on the table") {
  const Prepared rooms(rooms_in_a_row(2));
  // Half of the pairs, in no order; then none: all light arrives by roulette.
  const ReceiverReach half =
      rooms.table([](std::size_t cell, std::size_t cluster) { return (7 * cell + 3 * cluster) % 5 < 2; });
  const ReceiverReach none = rooms.table([](std::size_t, std::size_t) { return false; });
  for (const RoundPlan plan : {RoundPlan{16, 0}, RoundPlan{16, 1}}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      const auto expected = rooms.means(nullptr, plan, estimator, 1);
      for (const ReceiverReach* reach : {&half, &none}) {
        const auto found = rooms.means(reach, plan, estimator, 2);
        const Judgement verdict = compare(against(found, expected), Deviations::correlated);
        INFO(plan.backward << " walks, " << to_string(estimator) << ": " << verdict.text);
        WARN(plan.backward << " walks, " << to_string(estimator) << ": " << verdict.text);
        CHECK(verdict.agrees);
        // Without the factor of the roulette a photon's light would be 1/one_in of what it is.
        const double mutation = 1.0 / ReceiverReach::one_in;
        if (plan.backward == 0 && reach == &none)
          CHECK_FALSE(compare(against(found, expected, mutation), Deviations::correlated).agrees);
      }
    }
  }
}

TEST_CASE("receiver reach: the learned table spares most of the pairs, at nearly the same variance") {
  const Prepared rooms(rooms_in_a_row(6));
  const auto learned = rooms.learn();
  REQUIRE(learned);
  // Five of six rooms are behind walls; clusters of 16 that two rooms share count for both.
  CHECK(learned->served_share < 0.4);
  CHECK(learned->served_share > 1.0 / 6.0);
  const RoundPlan plan{32, 0};
  BackwardCount all;
  BackwardCount chosen;
  rooms.rounds(nullptr, plan, Estimator::weight, 64, 64, 1, all);
  rooms.rounds(&learned->reach, plan, Estimator::weight, 64, 64, 1, chosen);
  CHECK(chosen.impacts == all.impacts);  // the photons are the same
  CHECK(static_cast<double>(chosen.connections) < 0.4 * static_cast<double>(all.connections));

  const auto expected = rooms.means(nullptr, plan, Estimator::weight, 1);
  const auto found = rooms.means(&learned->reach, plan, Estimator::weight, 2);
  const Judgement verdict = compare(against(found, expected), Deviations::correlated);
  INFO(verdict.text);
  WARN(verdict.text);
  CHECK(verdict.agrees);
  double ratio = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double relative = found[k].second / expected[k].second;
    ratio += relative * relative / static_cast<double>(found.size());
  }
  // The variances from 1024 rounds are known to some 6 % each, the mean ratio of the 486 receivers to less.
  CHECK(ratio < 1.15);
}

TEST_CASE("receiver reach: the choice does not depend on how rounds are put together") {
  const Prepared rooms(rooms_in_a_row(6));
  const auto learned = rooms.learn();
  REQUIRE(learned);
  for (const Estimator estimator : {Estimator::weight, Estimator::absorption}) {
    for (const RoundPlan plan : {RoundPlan{16, 0}, RoundPlan{4, 1}}) {
      BackwardCount together;
      BackwardCount one_by_one;
      CHECK(rooms.rounds(&learned->reach, plan, estimator, 16, 16, 5, together) ==
            rooms.rounds(&learned->reach, plan, estimator, 16, 1, 5, one_by_one));
      CHECK(together.connections == one_by_one.connections);
    }
  }
}

TEST_CASE("receiver reach: no table where it does not pay") {
  CHECK_FALSE(Prepared(rooms_in_a_row(1)).learn());  // few receivers
  Room one = rooms_in_a_row(1);
  for (int k = 0; k < 4; ++k)
    one.receivers.insert(one.receivers.end(), one.receivers.begin(), one.receivers.begin() + 81);
  CHECK_FALSE(Prepared(one).learn());  // nothing casts a shadow
  Surface table = make_floor(0.5, 0.5);
  for (glm::dvec3& p : table.positions) p += glm::dvec3(1.2, 0.7, 1.2);
  table.sides = Sides::both;
  one.surfaces.push_back(table);
  const Prepared furnished(one);
  REQUIRE(furnished.scene().tracer->casts_shadows());
  CHECK_FALSE(furnished.learn());  // most places see most receivers
}
