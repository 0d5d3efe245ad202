#include "store/state_layout.hpp"

#include <array>
#include <bit>
#include <cstdio>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "base/message.hpp"
#include "store/state_check.hpp"

namespace lichtmc {

namespace {

static_assert(std::endian::native == std::endian::little, "integers of 128 bits are written low word first");

// A field of a thing that holds only 64-bit numbers, as rows of them.
template <class Number, class Thing>
constexpr std::uint64_t columns_of = sizeof(Thing) / sizeof(Number);

// The beginning of a text, for messages.
std::string printable(const std::string& text) {
  constexpr std::size_t most = 40;
  std::string shown = text.substr(0, most);
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return in_quotes(shown);
}

class Writer {
 public:
  explicit Writer(Hdf5File& file) : file_(file) {}
  static constexpr bool reads = false;

  template <class Part>
  bool part(const std::string& group, const std::optional<Part>& value) {
    if (value) file_.enter(group);
    return value.has_value();
  }
  void group(const std::string& name) { file_.enter(name); }

  void field(const char* name, std::uint64_t value) { file_.write(name, value); }
  void field(const char* name, std::uint32_t value) { file_.write(name, std::uint64_t{value}); }
  void field(const char* name, bool value) { file_.write(name, std::uint64_t{value}); }
  void field(const char* name, double value) { file_.write(name, value); }
  void field(const char* name, const std::string& value) { file_.write(name, value); }
  // 0 or NaN where there is none.
  void field(const char* name, const std::optional<std::uint32_t>& value) { field(name, value.value_or(0)); }
  void field(const char* name, const std::optional<double>& value) {
    field(name, value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  template <class Choice, std::size_t n>
  void field(const char* name, Choice value, const std::array<Choice, n>& /*values*/) {
    file_.write(name, std::string(to_string(value)));
  }
  template <class Number, class Thing>
  void rows(const char* name, const std::vector<Thing>& things) {
    file_.write(name, reinterpret_cast<const Number*>(things.data()), {things.size(), columns_of<Number, Thing>});
  }
  template <class Thing>
  void wide(const char* name, const Thing& thing) {
    file_.write(name, reinterpret_cast<const std::uint64_t*>(&thing), {1, columns_of<std::uint64_t, Thing>});
  }

 private:
  Hdf5File& file_;
};

class Reader {
 public:
  explicit Reader(Hdf5File& file) : file_(file) {}
  static constexpr bool reads = true;

  template <class Part>
  bool part(const std::string& group, std::optional<Part>& value) {
    if (!file_.has_group(group)) return false;
    value.emplace();
    file_.enter(group);
    return true;
  }
  void group(const std::string& name) { file_.enter(name); }

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
  template <class Choice, std::size_t n>
  void field(const char* name, Choice& value, const std::array<Choice, n>& values) {
    std::string word;
    file_.read(name, word);
    for (const Choice& one : values) {
      if (to_string(one) != word) continue;
      value = one;
      return;
    }
    refuse(name, printable(word));
  }
  template <class Number, class Thing>
  void rows(const char* name, std::vector<Thing>& things) {
    constexpr std::uint64_t columns = columns_of<Number, Thing>;
    things.resize(file_.rows(name, columns));
    file_.read(name, reinterpret_cast<Number*>(things.data()), {things.size(), columns});
  }
  template <class Thing>
  void wide(const char* name, Thing& thing) {
    constexpr std::uint64_t columns = columns_of<std::uint64_t, Thing>;
    const std::uint64_t rows = file_.rows(name, columns);
    if (rows != 1) throw Hdf5Error(std::string("array ") + name + " has " + std::to_string(rows) + " rows, not one");
    file_.read(name, reinterpret_cast<std::uint64_t*>(&thing), {1, columns});
  }

 private:
  [[noreturn]] static void refuse(const char* name, const std::string& value) {
    throw Hdf5Error(std::string("the value of ") + name + " is not known: " + value);
  }
  Hdf5File& file_;
};

constexpr std::array all_estimators{Estimator::weight, Estimator::collision, Estimator::absorption,
                                    Estimator::automatic};
constexpr std::array all_engines{Engine::automatic, Engine::cuboid, Engine::embree, Engine::embree_fast};

// `Thing` is const when writing.
template <class Archive, class Thing>
void exchange_walked(Archive& archive, Thing& walked) {
  archive.field("estimator", walked.estimator, all_estimators);
  archive.field("choice", walked.choice);
  archive.field("seconds", walked.seconds);
  archive.template rows<std::uint64_t>("ranges", walked.ranges);
}

template <class Archive, class Count>
void exchange_traced(Archive& archive, Count& traced) {
  archive.field("rays", traced.rays);
  archive.field("retraced", traced.retraced);
  archive.field("shadow_rays", traced.shadow_rays);
}

// ErrorLook has an integer among its numbers: three columns of double hold it to 2⁵³.
void exchange_looks(Writer& archive, const std::vector<ConvergencePoint>& looks) {
  std::vector<std::array<double, 3>> rows;
  rows.reserve(looks.size());
  for (const ConvergencePoint& look : looks)
    rows.push_back({static_cast<double>(look.histories), look.seconds, look.rms_relative_error});
  archive.rows<double>("convergence", rows);
}
void exchange_looks(Reader& archive, std::vector<ConvergencePoint>& looks) {
  std::vector<std::array<double, 3>> rows;
  archive.rows<double>("convergence", rows);
  for (const auto& [histories, seconds, error] : rows) {
    if (!(histories >= 0.0 && histories < 0x1p64))
      throw Hdf5Error("array convergence has a look after " + to_text(histories) + " histories");
    looks.push_back({static_cast<std::uint64_t>(histories), seconds, error});
  }
}

template <class Archive, class Sums>
void exchange_totals(Archive& archive, Sums& totals) {
  archive.field("histories", totals.histories);
  archive.field("impacts", totals.impacts);
  exchange_traced(archive, totals.traced);
  archive.wide("absorbed", totals.ends.absorbed);
  archive.wide("escaped", totals.ends.escaped);
  archive.wide("residual", totals.ends.residual);
  archive.wide("lost", totals.ends.lost);
  archive.field("lost_histories", totals.ends.lost_histories);
  archive.wide("incident", totals.incident);
  archive.template rows<std::uint64_t>("tiles", totals.tiles);
  archive.template rows<std::uint64_t>("hits", totals.hits);
  archive.template rows<std::uint64_t>("maps", totals.maps);
  archive.template rows<std::uint64_t>("behind", totals.behind);
}

template <class Archive, class Photons>
void exchange_photons(Archive& archive, Photons& photons) {
  if (!archive.part("/photons", photons)) return;
  exchange_walked(archive, *photons);
  exchange_looks(archive, photons->convergence);
  archive.field("pilot", photons->pilot);
  if constexpr (Archive::reads) {
    const auto totals = std::make_shared<Totals>(0, 0, Hits::are_the_score);
    exchange_totals(archive, *totals);
    photons->totals = totals;
  } else {
    exchange_totals(archive, *photons->totals);
  }
}

template <class Archive, class Walks>
void exchange_walks(Archive& archive, const std::string& group, Walks& walks) {
  if (!archive.part(group, walks)) return;
  exchange_walked(archive, *walks);
  exchange_looks(archive, walks->convergence);
  archive.field("group", walks->group);
  archive.field("impacts", walks->count.impacts);
  exchange_traced(archive, walks->count.traced);
  if constexpr (Archive::reads) {
    const auto sums = std::make_shared<std::vector<BackwardSums>>();
    archive.template rows<std::uint64_t>("sums", *sums);
    walks->sums = sums;
  } else {
    archive.template rows<std::uint64_t>("sums", *walks->sums);
  }
}

template <class Archive, class AnySettings>
void exchange_settings(Archive& archive, AnySettings& settings) {
  archive.group("/settings");
  archive.field("seed", settings.seed);
  archive.field("tile_edge_m", settings.tile_edge_m);
  archive.field("estimator", settings.estimator, all_estimators);
  archive.field("engine", settings.engine, all_engines);
  archive.field("only", settings.measured, std::array{Measured::all, Measured::tiles, Measured::receivers});
  archive.field("tiles", settings.tile_walk, std::array{WalkDirection::forward, WalkDirection::backward});
  archive.field("direct", settings.direct, std::array{Direct::sampled, Direct::analytic});
  archive.field("max_bounces", settings.max_bounces);
  archive.field("first_history", settings.first_history);
  archive.field("part", settings.part);
  archive.field("photons", settings.photons);
  archive.field("target_error", settings.target_error);
  archive.field("max_seconds", settings.max_seconds);
}

template <class Archive, class Data>
void exchange(Archive& archive, Data& data) {
  archive.group("/");
  archive.field("version", data.version);
  archive.field("room_low", data.room[0]);
  archive.field("room_high", data.room[1]);
  archive.field("engine", data.engine, all_engines);
  archive.field("note", data.note);
  exchange_settings(archive, data.settings);
  exchange_photons(archive, data.photons);
  exchange_walks(archive, "/tile_walks", data.tile_walks);
  exchange_walks(archive, "/receivers", data.receivers);
}

// Groups and arrays that nobody has asked for would go unnoticed: what is missing may only have another name.
void check_members(const Hdf5File& file, const StateData& data) {
  const std::uint64_t known = 1U + (data.photons ? 1U : 0U) + (data.tile_walks ? 1U : 0U) + (data.receivers ? 1U : 0U);
  if (file.members() != known)
    throw Hdf5Error("it has " + std::to_string(file.members()) + " groups, of which " + std::to_string(known) +
                    " are known");
}

}  // namespace

void write_layout(Hdf5File& file, const StateData& data) {
  Writer writer(file);
  exchange(writer, data);
}

StateData read_layout(Hdf5File& file) {
  StateData data;
  Reader reader(file);
  exchange(reader, data);
  check_members(file, data);
  check_state(data);
  return data;
}

}  // namespace lichtmc
