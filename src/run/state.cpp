#include "lichtmc/state.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/checksum.hpp"
#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "room/settings_fields.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

static_assert(State::batch == batch_histories);

const Settings& State::settings() const {
  return data_->settings;
}
const Fingerprint& State::room() const {
  return data_->room;
}
const std::string& State::version() const {
  return data_->version;
}
const std::string& State::note() const {
  return data_->note;
}
std::vector<HistoryRange> State::histories() const {
  return data_->photons ? data_->photons->ranges : std::vector<HistoryRange>{};
}
std::uint64_t State::receiver_histories() const {
  const std::optional<BackwardState>& walks = data_->receivers;
  return walks ? walks->size() * walks->plan.histories(walks->sums->size()) : 0;
}
std::vector<HistoryRange> State::receiver_rounds() const {
  return data_->receivers ? data_->receivers->ranges : std::vector<HistoryRange>{};
}
double State::seconds() const {
  double sum = 0.0;
  if (data_->photons) sum += data_->photons->seconds;
  if (data_->tile_walks) sum += data_->tile_walks->seconds;
  if (data_->receivers) sum += data_->receivers->seconds;
  return sum;
}

std::uint64_t count_of(const std::vector<HistoryRange>& ranges) {
  std::uint64_t sum = 0;
  for (const HistoryRange& range : ranges) sum += range.last - range.first;
  return sum;
}

namespace {

// Adds fields to a checksum: lists with their lengths, optional fields with a flag for their presence.
class StateChecksum {
 public:
  template <class Thing>
  void fields(const Thing& thing) {
    visit_fields(
        [this](const Field& field, const auto& value) {
          if (field.role != FieldRole::record && field.role != FieldRole::machine) this->add(value);
        },
        thing);
  }
  Fingerprint value() const { return sum_.value(); }

 private:
  template <class Number>
  requires(std::is_arithmetic_v<Number> && !RowOfWords<Number>) void add(Number value) { sum_.add(value); }
  void add(const std::string& text) { sum_.add(text); }
  void add(const Fingerprint& words) { sum_.add(words.data(), sizeof words); }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void add(Choice choice) { sum_.add(static_cast<std::uint8_t>(choice)); }
  template <RowOfWords Row>
  void add(const Row& row) {
    static_assert(std::has_unique_object_representations_v<Row>);
    sum_.add(&row, sizeof row);
  }
  void add(const std::vector<ConvergencePoint>& /*record*/) {}
  template <class Element>
  void add(const std::vector<Element>& list) {
    static_assert(std::has_unique_object_representations_v<Element>);
    sum_.add(std::uint64_t{list.size()});
    sum_.add(list.data(), list.size() * sizeof(Element));
  }
  template <class Thing>
  requires(HasFields<Thing> && !RowOfWords<Thing>) void add(const Thing& thing) { fields(thing); }
  template <class Thing>
  void add(const std::shared_ptr<const Thing>& thing) {
    if (thing != nullptr) add(*thing);
  }
  template <class Thing>
  void add(const std::optional<Thing>& thing) {
    sum_.add(std::uint8_t{thing.has_value()});
    if (thing) add(*thing);
  }

  Checksum sum_;
};

}  // namespace

Fingerprint fingerprint(const StateData& data) {
  StateChecksum sum;
  sum.fields(data);
  return sum.value();
}

void check_version(const State& state) {
  if (state.version() == version()) return;
  throw InputError("The state was made by lichtmc " + state.version() + ", this is " + std::string(version()) +
                   " (allowed: the same version, because figures could differ). Use that version, or start a new run.");
}

namespace {

// A range, and the index of its state.
struct Owned {
  HistoryRange range;
  std::size_t state = 0;
};

std::string in_words(const HistoryRange& range) {
  return std::to_string(range.first) + ":" + std::to_string(range.last);
}

class Merger {
 public:
  Merger(const std::vector<State>& states, const std::vector<std::string>& names) : states_(states), names_(names) {}

  StateData merge() {
    StateData sum = states_.front().data();
    for (std::size_t k = 1; k < states_.size(); ++k) check_same(states_.front().data(), states_[k].data(), k);
    merge_photons(sum);
    merge_walks(sum, &StateData::tile_walks);
    merge_walks(sum, &StateData::receivers);
    merge_sums(sum, &StateData::channels, "have different numbers of bins");
    merge_sums(sum, &StateData::parts, "have different parts of emitters");
    if (states_.size() > 1) set_rules(sum);
    return sum;
  }

 private:
  // The stop rules of the parts do not apply to their sum; only the number of histories to simulate is kept.
  void set_rules(StateData& sum) const {
    Settings& settings = sum.settings;
    settings.target_error.reset();
    settings.max_seconds.reset();
    std::uint64_t last = 0;
    for (const State& state : states_) {
      const Settings& part = state.settings();
      settings.first_history = std::min(settings.first_history, part.first_history);
      last = std::max(last, part.first_history + part.photons);
    }
    settings.photons = last - settings.first_history;
    if (sum.photons) settings.photons = sum.photons->size();
    settings.part = settings.first_history > 0;
  }

  [[noreturn]] void refuse(std::size_t k, const std::string& what) const {
    throw InputError("The states in " + names_.front() + " and " + names_[k] + " " + what +
                     " (allowed: the same). Merge parts of one run only.");
  }

  void check_same(const StateData& a, const StateData& b, std::size_t k) const {
    if (a.version != b.version) refuse(k, "are of lichtmc " + a.version + " and " + b.version);
    if (a.room != b.room) refuse(k, "are of different rooms");
    if (a.engine != b.engine)
      refuse(k, "were traced by the engines " + std::string(to_string(a.engine)) + " and " +
                    std::string(to_string(b.engine)));
    visit_fields(
        [&](const Field& field, const auto& one, const auto& other) {
          if (field.role == FieldRole::same && one != other)
            refuse(k, std::string("differ in the setting '") + field.label + "' (" + field.option +
                          "): " + setting_text(one) + " and " + setting_text(other));
        },
        a.settings, b.settings);
  }

  void check_same_walk(const Walked& a, const Walked& b, std::size_t k) const {
    if (a.estimator != b.estimator)
      refuse(k, "have the estimators " + std::string(to_string(a.estimator)) + " and " +
                    std::string(to_string(b.estimator)));
  }

  // Joins ranges in order; adjacent ones become one. batch: all ranges except the last end with a whole batch.
  std::vector<HistoryRange> join(std::vector<Owned> owned, std::uint64_t batch, const std::string& of_what) const {
    std::sort(owned.begin(), owned.end(), [](const Owned& a, const Owned& b) {
      return std::pair(a.range.first, a.range.last) < std::pair(b.range.first, b.range.last);
    });
    for (std::size_t k = 1; k < owned.size(); ++k) {
      if (owned[k].range.first < owned[k - 1].range.last) {
        throw InputError("The " + of_what + " " + in_words(owned[k - 1].range) + " of " + names_[owned[k - 1].state] +
                         " and " + in_words(owned[k].range) + " of " + names_[owned[k].state] +
                         " overlap (allowed: every one once; otherwise it would count twice). Leave one state out.");
      }
    }
    std::vector<HistoryRange> joined;
    for (std::size_t k = 0; k < owned.size(); ++k) {
      if (k + 1 < owned.size() && owned[k].range.last % batch != 0) {
        throw InputError("The " + of_what + " " + in_words(owned[k].range) + " of " + names_[owned[k].state] +
                         " end within a batch of " + std::to_string(batch) +
                         " (allowed for the last range only). Give that part of the run --histories that end at a "
                         "multiple of " +
                         std::to_string(batch) + ".");
      }
      if (!joined.empty() && joined.back().last == owned[k].range.first) {
        joined.back().last = owned[k].range.last;
      } else {
        joined.push_back(owned[k].range);
      }
    }
    return joined;
  }

  void merge_photons(StateData& sum) const {
    std::vector<Owned> owned;
    std::shared_ptr<Totals> totals;
    double seconds = 0.0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const std::optional<Counted>& counted = states_[k].data().photons;
      if (!counted) continue;
      for (const HistoryRange& range : counted->ranges) owned.push_back({range, k});
      seconds += counted->seconds;
      if (totals == nullptr) {
        totals = std::make_shared<Totals>(*counted->totals);
        sum.photons = counted;
        continue;
      }
      check_same_walk(*sum.photons, *counted, k);
      const Totals& more = *counted->totals;
      if (totals->tiles.size() != more.tiles.size() || totals->tile_maps.size() != more.tile_maps.size() ||
          totals->hits.size() != more.hits.size() || totals->absorbed_by.size() != more.absorbed_by.size())
        refuse(k, "have different numbers of tiles");
      totals->add(more);
    }
    if (!sum.photons) return;
    sum.photons->ranges = join(std::move(owned), batch_histories, "histories");
    sum.photons->totals = std::move(totals);
    sum.photons->seconds = seconds;
    if (states_.size() > 1) sum.photons->convergence.clear();
  }

  void merge_walks(StateData& sum, std::optional<BackwardState> StateData::*slot) const {
    std::vector<Owned> owned;
    std::shared_ptr<std::vector<BackwardSums>> sums;
    std::optional<BackwardState> merged;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const std::optional<BackwardState>& walks = states_[k].data().*slot;
      if (!walks) continue;
      for (const HistoryRange& range : walks->ranges) owned.push_back({range, k});
      if (!merged) {
        merged = walks;
        sums = std::make_shared<std::vector<BackwardSums>>(*walks->sums);
        continue;
      }
      check_same_walk(*merged, *walks, k);
      if (sums->size() != walks->sums->size() || merged->plan != walks->plan)
        refuse(k, "have different numbers of receivers or tiles");
      add_fields(*sums, *walks->sums);
      add_fields(merged->count, walks->count);
      merged->seconds += walks->seconds;
    }
    sum.*slot = merged;
    if (!merged) return;
    (sum.*slot)->ranges = join(std::move(owned), 1, "rounds of backward walks");
    (sum.*slot)->sums = std::move(sums);
    if (states_.size() > 1) (sum.*slot)->convergence.clear();
  }

  // Impulse responses or parts, of the same rounds as the walks from the receivers.
  template <class Sums>
  void merge_sums(StateData& sum, std::shared_ptr<const Sums> StateData::*slot,
                  const std::string& if_sizes_differ) const {
    std::shared_ptr<Sums> sums;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const StateData& data = states_[k].data();
      if (!data.receivers) continue;
      if (!(data.*slot)) return;
      if (sums == nullptr) {
        sums = std::make_shared<Sums>(*(data.*slot));
        continue;
      }
      if (!sums->has_size_of(*(data.*slot))) refuse(k, if_sizes_differ);
      add_fields(*sums, *(data.*slot));
    }
    sum.*slot = std::move(sums);
  }

  const std::vector<State>& states_;
  const std::vector<std::string>& names_;
};

}  // namespace

State merge(const std::vector<State>& states, const std::vector<std::string>& names) {
  if (states.empty()) throw InputError("There is no state to merge (allowed: one or more).");
  return State(std::make_shared<const StateData>(Merger(states, names).merge()));
}

}  // namespace lichtmc
