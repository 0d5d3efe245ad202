#include "store/photons_check.hpp"

#include <string>

#include "chance/moments.hpp"
#include "store/hdf5_file.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Hdf5Error(what);
}

class PhotonsCheck {
 public:
  PhotonsCheck(const Counted& photons, bool truncated)
      : photons_(photons),
        totals_(*photons.totals),
        truncated_(truncated),
        weighted_(photons.estimator == Estimator::weight),
        hits_apart_(weighted_ || !totals_.hits.empty()),
        unit_(hits_apart_ ? static_cast<std::uint64_t>(weight_units) : 1) {}

  void check() const {
    check_histories();
    check_lengths();
    check_balance();
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
    if (totals_.behind.size() != totals_.tile_maps.size())
      differ("behind", totals_.behind.size(), "tile_maps", totals_.tile_maps.size());
    if (!totals_.absorbed_by.empty() && totals_.absorbed_by.size() != totals_.tile_maps.size())
      differ("absorbed_by", totals_.absorbed_by.size(), "tile_maps", totals_.tile_maps.size());
  }

  // The balance: emitted = absorbed + escaped + residual + lost. First modulo 2¹²⁸, which no number in a file can
  // overflow; if three of the four are within bounds, the fourth is too.
  void check_balance() const {
    const Ends& ends = totals_.ends;
    const uint128 most = uint128{totals_.histories} * unit_;
    const uint128 gone = static_cast<uint128>(ends.absorbed) + static_cast<uint128>(ends.escaped) +
                         static_cast<uint128>(ends.residual) + static_cast<uint128>(ends.lost);
    if (gone != most) refuse("in /photons absorbed, escaped, residual and lost do not add up to what was emitted");
    // Each impact absorbs at most one photon, and each history escapes at most once.
    const auto within = [](int128 value, uint128 bound) { return value >= 0 && static_cast<uint128>(value) <= bound; };
    if (!within(ends.absorbed, uint128{totals_.impacts} * unit_) || !within(ends.escaped, most))
      refuse("/photons has more absorbed, or escaped, than there were photons");
    if (!totals_.absorbed_by.empty()) {
      uint128 sum = 0;
      for (const uint128 units : totals_.absorbed_by) sum += units;
      if (sum != static_cast<uint128>(ends.absorbed)) refuse("in /photons absorbed_by does not add up to absorbed");
    }
    if (ends.lost_histories > totals_.histories || !within(ends.lost, uint128{ends.lost_histories} * unit_) ||
        static_cast<uint128>(ends.lost) < ends.lost_histories)
      refuse("in /photons lost does not fit " + std::to_string(ends.lost_histories) + " lost_histories");
    // Only weights have a residual, and only Russian roulette adds weight.
    if ((!weighted_ && ends.residual != 0) || (truncated_ && ends.residual < 0))
      refuse("/photons has a residual that its estimator does not leave");
  }

  const Counted& photons_;
  const Totals& totals_;
  bool truncated_;
  bool weighted_;
  bool hits_apart_;
  std::uint64_t unit_;  // of the scores: units per photon
};

}  // namespace

void check_photons(const Counted& photons, bool truncated) {
  PhotonsCheck(photons, truncated).check();
}

}  // namespace lichtmc
