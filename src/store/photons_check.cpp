#include "store/photons_check.hpp"

#include <string>

#include "chance/moments.hpp"
#include "store/hdf5_file.hpp"
#include "store/possible_sums.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Hdf5Error(what);
}

class PhotonsCheck {
 public:
  PhotonsCheck(const Counted& photons, Direct direct, bool truncated)
      : photons_(photons),
        totals_(*photons.totals),
        direct_(direct),
        truncated_(truncated),
        weighted_(photons.estimator == Estimator::weight),
        hits_apart_(weighted_ || !totals_.hits.empty()),
        unit_(hits_apart_ ? static_cast<std::uint64_t>(weight_units) : 1),
        batches_(totals_.histories / batch_histories) {}

  void check() const {
    check_histories();
    check_lengths();
    check_ends();
    check_sums();
    check_hits();
  }

 private:
  void check_histories() const {
    std::uint64_t whole = 0;
    for (const HistoryRange& range : photons_.ranges) whole += (range.last - range.first) / batch_histories;
    whole *= batch_histories;
    if (totals_.histories != whole)
      refuse("/photons sums " + std::to_string(totals_.histories) + " histories, its ranges have " +
             std::to_string(whole) + " in whole batches");
  }

  void check_lengths() const {
    const auto differ = [](const char* a, std::size_t n_a, const char* b, std::size_t n_b) {
      refuse(std::string("/photons has ") + a + " of " + std::to_string(n_a) + " rows and " + b + " of " +
             std::to_string(n_b));
    };
    const std::size_t hits = totals_.hits.size();
    if (hits_apart_ && hits != totals_.tiles.size()) differ("hits", hits, "tiles", totals_.tiles.size());
    if (photons_.estimator == Estimator::collision && hits > 0)
      refuse("/photons has hits beside the scores of 'collision', which are hits");
    if (totals_.behind.size() != totals_.maps.size())
      differ("behind", totals_.behind.size(), "maps", totals_.maps.size());
  }

  // Where the power of the photons went. Modulo 2¹²⁸ first, which no number in a file can overflow: with three of the
  // four within bounds, the fourth is.
  void check_ends() const {
    const Ends& ends = totals_.ends;
    const uint128 most = uint128{totals_.histories} * unit_;
    const uint128 gone = static_cast<uint128>(ends.absorbed) + static_cast<uint128>(ends.escaped) +
                         static_cast<uint128>(ends.residual) + static_cast<uint128>(ends.lost);
    if (gone != most) refuse("in /photons absorbed, escaped, residual and lost do not add up to what was emitted");
    // Each impact absorbs at most a whole photon, and each history leaves once.
    const auto within = [](int128 value, uint128 bound) { return value >= 0 && static_cast<uint128>(value) <= bound; };
    if (!within(ends.absorbed, uint128{totals_.impacts} * unit_) || !within(ends.escaped, most))
      refuse("/photons has more absorbed, or escaped, than there were photons");
    if (ends.lost_histories > totals_.histories || !within(ends.lost, uint128{ends.lost_histories} * unit_) ||
        static_cast<uint128>(ends.lost) < ends.lost_histories)
      refuse("in /photons lost does not fit " + std::to_string(ends.lost_histories) + " lost_histories");
    // Only weights are cut off, and only roulette adds some.
    if ((!weighted_ && ends.residual != 0) || (truncated_ && ends.residual < 0))
      refuse("/photons has a residual that its estimator does not leave");
  }

  // Of whole batches, as states have only such, Σ x_b² is a whole number.
  bool are_possible(const Moments& moments) const {
    constexpr std::uint64_t one = square_units / batch_histories;
    return moments.squares % one == 0 && lichtmc::are_possible(moments.sum, moments.squares / one, batches_);
  }

  // Scores of parts against those of all together; returns by how much their squares are fewer.
  uint128 check_parts(const std::vector<Moments>& parts, const char* name) const {
    Moments left = totals_.incident;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (!are_possible(parts[k]))
        refuse("row " + std::to_string(k) + " of " + name + " in /photons is not the moments of " +
               std::to_string(batches_) + " batches");
      // The squares too: (x + y)² ≥ x² + y².
      if (parts[k].sum > left.sum || parts[k].squares > left.squares)
        refuse(std::string("in /photons ") + name + " has more than incident");
      left.sum -= parts[k].sum;
      left.squares -= parts[k].squares;
    }
    if (left.sum != 0) refuse(std::string("in /photons ") + name + " has less than incident");
    return left.squares;
  }

  void check_sums() const {
    if (!are_possible(totals_.incident))
      refuse("incident in /photons is not the moments of " + std::to_string(batches_) + " batches");
    if (check_parts(totals_.tiles, "tiles") < check_parts(totals_.maps, "maps"))
      refuse("in /photons the squares of tiles are more than those of maps");
    for (std::size_t k = 0; k < totals_.behind.size(); ++k) {
      if (totals_.behind[k] > totals_.maps[k].sum)
        refuse("row " + std::to_string(k) + " of behind in /photons is more than the score of the map");
    }
  }

  void check_hits() const {
    uint128 hits = hits_apart_ ? 0 : totals_.incident.sum;
    for (std::size_t k = 0; k < totals_.hits.size(); ++k) {
      const uint128 score = totals_.tiles[k].sum;
      const uint128 all = uint128{totals_.hits[k]} * unit_;
      // A weight is at most 1 and not 0; 1/(1 − ρ) is at least 1, and without hits nothing scores.
      const bool fits = weighted_ ? totals_.hits[k] <= score && score <= all : all <= score && (all > 0 || score == 0);
      if (!fits) refuse("row " + std::to_string(k) + " of hits in /photons does not fit the score of the tile");
      hits += totals_.hits[k];
    }
    const bool at_absorption = photons_.estimator == Estimator::absorption;
    const auto absorbed = static_cast<uint128>(totals_.ends.absorbed);
    const uint128 events = at_absorption ? absorbed / unit_ : totals_.impacts;
    const std::uint64_t most_unscored = direct_ == Direct::analytic ? totals_.histories : 0;
    const bool whole = !at_absorption || absorbed % unit_ == 0;
    if (!whole || hits > events || events - hits > most_unscored)
      refuse(std::string("in /photons the hits of tiles do not fit ") + (at_absorption ? "absorbed" : "impacts"));
  }

  const Counted& photons_;
  const Totals& totals_;
  Direct direct_;
  bool truncated_;
  bool weighted_;
  bool hits_apart_;
  std::uint64_t unit_;  // of the scores: what a photon is
  std::uint64_t batches_;
};

}  // namespace

void check_photons(const Counted& photons, Direct direct, bool truncated) {
  PhotonsCheck(photons, direct, truncated).check();
}

}  // namespace lichtmc
