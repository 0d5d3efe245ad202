#include "inspect/topics.hpp"

#include "inspect/finding_text.hpp"

namespace lichtmc {

void find_not_modelled(const Room& room, Inspection& facts) {
  for (const Ignored& thing : room.ignored) {
    const bool matters = thing.effect == Effect::figures;
    add(facts, matters ? Severity::warning : Severity::note, "not-modelled", thing.what,
        !thing.advice.empty() ? thing.advice
        : matters             ? "This may change the figures: remove it from the room, or take it into account."
                              : "Nothing to do: it has no influence on the figures.");
  }
}

}  // namespace lichtmc
