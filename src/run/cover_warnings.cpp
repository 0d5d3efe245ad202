#include "run/cover_warnings.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "base/message.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

double area_of(const Cover& cover, bool undecided) {
  return undecided ? cover.undecided_m2 : cover.area_m2;
}

// A two-sided surface that is covered on both sides by the same one is named once, with the larger area.
std::vector<Cover> pairs_of(const std::vector<Cover>& covers, bool undecided) {
  std::map<std::pair<std::size_t, std::size_t>, Cover> by_pair;
  for (const Cover& cover : covers) {
    Cover& pair = by_pair.try_emplace({cover.over, cover.under}, cover).first->second;
    if (area_of(cover, undecided) > area_of(pair, undecided)) pair = cover;
  }
  std::vector<Cover> pairs;
  for (const auto& [which, cover] : by_pair) {
    if (area_of(cover, undecided) > 0.0) pairs.push_back(cover);
  }
  std::stable_sort(pairs.begin(), pairs.end(), [undecided](const Cover& a, const Cover& b) {
    return area_of(a, undecided) > area_of(b, undecided);
  });
  return pairs;
}

}  // namespace

std::string text_of_covers(const Room& room, const std::vector<Cover>& covers, std::size_t most, bool undecided) {
  const std::vector<Cover> pairs = pairs_of(covers, undecided);
  std::string text;
  for (std::size_t n = 0; n < std::min(most, pairs.size()); ++n) {
    const Cover& pair = pairs[n];
    const std::string& over = room.surfaces[pair.over].name;
    const std::string& under = room.surfaces[pair.under].name;
    text += (n > 0 ? ", " : "") + in_quotes(over) + " covers " + short_number(area_of(pair, undecided)) + " m² of " +
            (pair.over == pair.under ? "itself" : in_quotes(under));
  }
  if (pairs.size() > most) text += " and " + std::to_string(pairs.size() - most) + " more";
  return text;
}

std::vector<CoverWarning> covered_emitters(const Room& room, const std::vector<Cover>& covers) {
  constexpr double noticeable = 0.001;
  std::vector<CoverWarning> warnings;
  for (const Emitter& emitter : room.emitters) {
    const std::optional<std::size_t> number = emitting_surface(emitter);
    if (!number || *number >= room.surfaces.size() || emitter.power == 0.0) continue;
    double area = 0.0;
    std::vector<Cover> over_it;
    for (const Cover& cover : covers) {
      if (cover.under != *number || cover.behind) continue;
      area += cover.area_m2;
      over_it.push_back(cover);
    }
    const double share = area / surface_area(room.surfaces[*number]);
    if (!(share > noticeable)) continue;
    warnings.push_back(
        {percent(share) + " of the area light " + in_quotes(emitter.name) + " is covered by surfaces in its plane: " +
             text_of_covers(room, over_it, 3, false) + ". " + short_number(share * emitter.power) + " " +
             std::string(power_unit(room.quantity)) + " of its light are absorbed there.",
         "If this light should reach the room, move the emissive surface a millimetre in front of the others."});
  }
  return warnings;
}

std::vector<CoverWarning> undecided_covers(const Room& room, const std::vector<Cover>& covers, std::uint64_t undecided,
                                           std::uint64_t impacts) {
  if (undecided == 0) return {};
  const double share = static_cast<double>(undecided) / static_cast<double>(std::max(undecided, impacts));
  return {
      {"Surfaces lie in one place, have the same area and face the same way, so that no rule decides which of them "
       "light meets: " +
           text_of_covers(room, covers, 3, true) + ". The first in the file counts, the other receives nothing; " +
           percent(share) + " of all impacts are there.",
       "Remove one of the two (in Blender: Merge by Distance), or move the one that should be seen by a "
       "millimetre."}};
}

}  // namespace lichtmc
