#include "store/state_layout.hpp"

#include <array>
#include <bit>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/fields.hpp"
#include "base/message.hpp"
#include "room/settings_fields.hpp"
#include "store/state_check.hpp"

namespace lichtmc {

namespace {

static_assert(std::endian::native == std::endian::little, "integers of 128 bits are written low word first");

template <class Thing>
constexpr std::uint64_t words_in = sizeof(Thing) / sizeof(std::uint64_t);

// The beginning of a text, for messages.
std::string printable(const std::string& text) {
  constexpr std::size_t most = 40;
  std::string shown = text.substr(0, most);
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return in_quotes(shown);
}

[[noreturn]] void refuse(const char* name, const std::string& value) {
  throw Hdf5Error(std::string("the value of ") + name + " is not known: " + value);
}

// One row of the array "convergence"; integers are exact up to 2⁵³.
using ConvergenceRow = std::array<double, 3>;

// Sums that a state may be without.
template <class Sums>
concept OptionalSums = std::same_as<Sums, ChannelSums> || std::same_as<Sums, PartSums>;

// Both archives have one function per type of field. Nested structs are written into the same group; settings and walks
// are groups.
class Writer {
 public:
  explicit Writer(Hdf5File& file) : file_(file) {}

  template <class Thing>
  void fields(const Thing& thing) {
    visit_fields(
        [this](const Field& field, const auto& value) {
          if (field.role != FieldRole::machine) this->field(field.name, value);
        },
        thing);
  }

 private:
  void field(const char* name, std::uint64_t value) { file_.write(name, value); }
  void field(const char* name, std::uint32_t value) { file_.write(name, std::uint64_t{value}); }
  void field(const char* name, bool value) { file_.write(name, std::uint64_t{value}); }
  void field(const char* name, double value) { file_.write(name, value); }
  void field(const char* name, const std::string& value) { file_.write(name, value); }
  // 0 or NaN if there is none.
  void field(const char* name, const std::optional<std::uint32_t>& value) { field(name, value.value_or(0)); }
  void field(const char* name, const std::optional<double>& value) {
    field(name, value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void field(const char* name, Choice value) { file_.write(name, std::string(to_string(value))); }

  void field(const char* name, const Fingerprint& value) { file_.write(name, value.data(), {1, value.size()}); }
  template <RowOfWords Row>
  void field(const char* name, const Row& row) {
    file_.write(name, reinterpret_cast<const std::uint64_t*>(&row), {1, words_in<Row>});
  }
  void field(const char* name, const std::vector<std::uint64_t>& list) {
    file_.write(name, list.data(), {list.size(), 1});
  }
  template <RowOfWords Row>
  void field(const char* name, const std::vector<Row>& rows) {
    file_.write(name, reinterpret_cast<const std::uint64_t*>(rows.data()), {rows.size(), words_in<Row>});
  }
  void field(const char* name, const std::vector<ConvergencePoint>& points) {
    std::vector<ConvergenceRow> rows;
    rows.reserve(points.size());
    for (const ConvergencePoint& point : points)
      rows.push_back({static_cast<double>(point.histories), point.seconds, point.rms_relative_error});
    file_.write(name, reinterpret_cast<const double*>(rows.data()), {rows.size(), 3});
  }

  template <class Thing>
  requires(HasFields<Thing> && !RowOfWords<Thing>) void field(const char* name, const Thing& thing) {
    if constexpr (std::same_as<Thing, Settings>) file_.enter(std::string("/") + name);
    fields(thing);
  }
  template <class Thing>
  void field(const char* name, const std::shared_ptr<const Thing>& thing) {
    field(name, *thing);
  }
  // Has a group of its own; none if there are no such sums.
  template <OptionalSums Sums>
  void field(const char* name, const std::shared_ptr<const Sums>& sums) {
    if (sums == nullptr) return;
    file_.enter(std::string("/") + name);
    fields(*sums);
  }
  template <std::derived_from<Walked> WalkState>
  void field(const char* name, const std::optional<WalkState>& walks) {
    if (!walks) return;
    file_.enter(std::string("/") + name);
    fields(*walks);
  }

  Hdf5File& file_;
};

class Reader {
 public:
  explicit Reader(Hdf5File& file) : file_(file) {}

  template <class Thing>
  void fields(Thing& thing) {
    visit_fields(
        [this](const Field& field, auto& value) {
          if (field.role != FieldRole::machine) this->field(field.name, value);
        },
        thing);
  }

 private:
  void field(const char* name, std::uint64_t& value) { file_.read(name, value); }
  void field(const char* name, std::uint32_t& value) {
    std::uint64_t wide = 0;
    file_.read(name, wide);
    if (wide > std::numeric_limits<std::uint32_t>::max()) refuse(name, std::to_string(wide));
    value = static_cast<std::uint32_t>(wide);
  }
  void field(const char* name, bool& value) {
    std::uint64_t word = 0;
    file_.read(name, word);
    if (word > 1) refuse(name, std::to_string(word));
    value = word != 0;
  }
  void field(const char* name, double& value) { file_.read(name, value); }
  void field(const char* name, std::string& value) { file_.read(name, value); }
  void field(const char* name, std::optional<std::uint32_t>& value) {
    std::uint32_t number = 0;
    field(name, number);
    if (number != 0) value = number;
  }
  void field(const char* name, std::optional<double>& value) {
    double number = 0.0;
    field(name, number);
    if (number == number) value = number;
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void field(const char* name, Choice& value) {
    static_assert(!all_values<Choice>.empty());
    std::string word;
    file_.read(name, word);
    for (const Choice& one : all_values<Choice>) {
      if (to_string(one) != word) continue;
      value = one;
      return;
    }
    refuse(name, printable(word));
  }

  void field(const char* name, Fingerprint& value) { read_row(name, value.data(), value.size()); }
  template <RowOfWords Row>
  void field(const char* name, Row& row) {
    read_row(name, reinterpret_cast<std::uint64_t*>(&row), words_in<Row>);
  }
  void field(const char* name, std::vector<std::uint64_t>& list) {
    list.resize(file_.rows(name, 1));
    file_.read(name, list.data(), {list.size(), 1});
  }
  template <RowOfWords Row>
  void field(const char* name, std::vector<Row>& rows) {
    rows.resize(file_.rows(name, words_in<Row>));
    file_.read(name, reinterpret_cast<std::uint64_t*>(rows.data()), {rows.size(), words_in<Row>});
  }
  void field(const char* name, std::vector<ConvergencePoint>& points) {
    std::vector<ConvergenceRow> rows(file_.rows(name, 3));
    file_.read(name, reinterpret_cast<double*>(rows.data()), {rows.size(), 3});
    for (const auto& [histories, seconds, error] : rows) {
      if (!(histories >= 0.0 && histories < 0x1p64))
        throw Hdf5Error(std::string("array ") + name + " has a row after " + to_text(histories) + " histories");
      points.push_back({static_cast<std::uint64_t>(histories), seconds, error});
    }
  }

  template <class Thing>
  requires(HasFields<Thing> && !RowOfWords<Thing>) void field(const char* name, Thing& thing) {
    if constexpr (std::same_as<Thing, Settings>) file_.enter(std::string("/") + name);
    fields(thing);
  }
  template <class Thing>
  void field(const char* name, std::shared_ptr<const Thing>& thing) {
    const auto read = std::make_shared<Thing>();
    field(name, *read);
    thing = read;
  }
  template <OptionalSums Sums>
  void field(const char* name, std::shared_ptr<const Sums>& sums) {
    const std::string group = std::string("/") + name;
    if (!file_.has_group(group)) return;
    file_.enter(group);
    const auto read = std::make_shared<Sums>();
    fields(*read);
    sums = read;
  }
  template <std::derived_from<Walked> WalkState>
  void field(const char* name, std::optional<WalkState>& walks) {
    const std::string group = std::string("/") + name;
    if (!file_.has_group(group)) return;
    file_.enter(group);
    fields(walks.emplace());
  }

  void read_row(const char* name, std::uint64_t* words, std::uint64_t count) {
    const std::uint64_t rows = file_.rows(name, count);
    if (rows != 1) throw Hdf5Error(std::string("array ") + name + " has " + std::to_string(rows) + " rows, not one");
    file_.read(name, words, {1, count});
  }

  Hdf5File& file_;
};

// Refuses groups and arrays that are not fields: one of them may be a missing field under a wrong name. /settings and
// the array "room" always exist.
void check_members(const Hdf5File& file, const StateData& data) {
  const std::uint64_t known = 2U + (data.photons ? 1U : 0U) + (data.tile_walks ? 1U : 0U) + (data.receivers ? 1U : 0U) +
                              (data.channels ? 1U : 0U) + (data.parts ? 1U : 0U);
  if (file.members() != known)
    throw Hdf5Error("it has " + std::to_string(file.members()) + " groups and arrays, of which " +
                    std::to_string(known) + " are known");
}

}  // namespace

void write_layout(Hdf5File& file, const StateData& data) {
  file.enter("/");
  Writer(file).fields(data);
}

StateData read_layout(Hdf5File& file) {
  StateData data;
  file.enter("/");
  Reader(file).fields(data);
  check_members(file, data);
  check_state(data);
  return data;
}

}  // namespace lichtmc
