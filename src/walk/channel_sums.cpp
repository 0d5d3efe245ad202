#include "walk/channel_sums.hpp"

#include <cstring>

namespace lichtmc {

void move_sums(ChannelSums& all, ChannelSums& some) {
  visit_fields(
      [](const Field& /*field*/, auto& to, auto& from) {
        using Row = std::remove_cvref_t<decltype(from[0])>;
        const Row zero{};
        for (std::size_t k = 0; k < from.size(); ++k) {
          if (std::memcmp(&from[k], &zero, sizeof(Row)) == 0) continue;
          add_fields(to[k], from[k]);
          from[k] = zero;
        }
      },
      all, some);
}

}  // namespace lichtmc
