// state.h5: reading gives what was written, and damaged files are refused.
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/state_bytes.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/state_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace fs = std::filesystem;

namespace {

// A state with every part: photons with weights, receivers, a choice of the estimator.
State small_state() {
  Room room = unit_cube(0.5, paper_emitter());
  room.receivers.push_back({"desk", {0.5, 0.3, 0.5}, {0, 1, 0}, 90.0, 1.0});
  Settings settings = settings_of(Estimator::automatic, Engine::automatic, 20'000, 1, 0.5);
  settings.target_error = 1e-9;
  settings.max_seconds = 1000.0;
  return simulate(room, settings).state;
}

bool is_refused(const fs::path& file) {
  try {
    read_state(file);
  } catch (const InputError&) {
    return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a state reads back as it was written") {
  const Scratch scratch;
  const State state = small_state();
  write_state(state, scratch.file(), "a note of the caller, in Zürich");
  const State read = read_state(scratch.file());
  CHECK(read.note() == "a note of the caller, in Zürich");
  CHECK(read.room() == state.room());
  CHECK(read.version() == state.version());
  CHECK(read.histories() == state.histories());
  CHECK(read.receiver_histories() == state.receiver_histories());
  CHECK(read.seconds() == state.seconds());
  const Settings& a = state.settings();
  const Settings& b = read.settings();
  CHECK(a.estimator == b.estimator);
  CHECK(a.photons == b.photons);
  CHECK(a.target_error == b.target_error);
  CHECK(a.max_seconds == b.max_seconds);
  CHECK(a.max_bounces == b.max_bounces);
  CHECK(a.seed == b.seed);
  // Written again it is the same file.
  const std::string first = bytes_of(scratch.file());
  write_state(read, scratch.file(), read.note());
  CHECK(bytes_of(scratch.file()) == first);
}

TEST_CASE("the bytes of a state are those of its file") {
  const Scratch scratch;
  const State state = small_state();
  write_state(state, scratch.file(), "note");
  const std::string bytes = state_bytes(state, "note");
  CHECK(bytes == bytes_of(scratch.file()));
  CHECK(state_bytes(parse_state(bytes, "bytes"), "note") == bytes);
  std::size_t accepted = 0;
  for (std::size_t place = 0; place < bytes.size(); place += place < 1024 ? 1 : 37) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 8);
    for (const std::string& changed : {damaged, bytes.substr(0, place)}) {
      try {
        parse_state(changed, "bytes");
        ++accepted;
      } catch (const InputError&) {
      }
    }
  }
  CHECK(accepted == 0);
  CHECK_THROWS_WITH(parse_state("", "the pickle"), ContainsSubstring("the pickle") && ContainsSubstring("no state"));
  CHECK_THROWS_AS(state_bytes({}), InputError);
}

TEST_CASE("a changed bit anywhere in a state is detected") {
  const Scratch scratch;
  write_state(small_state(), scratch.file(), "note");
  const std::string whole = bytes_of(scratch.file());
  REQUIRE_FALSE(is_refused(scratch.file()));
  std::mt19937 random(1);
  // Every byte once, so every field of the structure; then random positions.
  std::vector<std::size_t> places(whole.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = k;
  for (int k = 0; k < 500; ++k) places.push_back(random() % whole.size());
  std::size_t accepted = 0;
  for (const std::size_t place : places) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << (random() % 8)));
    write_bytes(scratch.file(), damaged);
    if (!is_refused(scratch.file())) ++accepted;
  }
  CHECK(accepted == 0);
}

TEST_CASE("a state that was truncated or extended is refused") {
  const Scratch scratch;
  write_state(small_state(), scratch.file());
  const std::string whole = bytes_of(scratch.file());
  std::size_t accepted = 0;
  for (std::size_t size = 0; size < whole.size(); size += size < 1024 ? 1 : 37) {
    write_bytes(scratch.file(), whole.substr(0, size));
    if (!is_refused(scratch.file())) ++accepted;
  }
  write_bytes(scratch.file(), whole + '\0');
  if (!is_refused(scratch.file())) ++accepted;
  CHECK(accepted == 0);
}

TEST_CASE("files that are no state are refused with what they are") {
  const Scratch scratch;
  CHECK_THROWS_WITH(read_state(scratch.file()), ContainsSubstring("No such file"));
  CHECK_THROWS_WITH(read_state(scratch.file().parent_path()), ContainsSubstring("no state of lichtmc"));
  write_bytes(scratch.file(), "tile,surface,column\n");
  CHECK_THROWS_WITH(read_state(scratch.file()), ContainsSubstring("no state of lichtmc"));
  write_state(small_state(), scratch.file());
  std::string other = bytes_of(scratch.file());
  other.replace(other.find("layout 7"), 8, "layout 1");
  write_bytes(scratch.file(), other);
  CHECK_THROWS_WITH(
      read_state(scratch.file()),
      ContainsSubstring("'lichtmc state, layout 1', as lichtmc 0.1.0 writes it (allowed: 'lichtmc state, layout 7'"));
}

TEST_CASE("a state that cannot be written leaves the old one") {
  const Scratch scratch;
  const State state = small_state();
  write_state(state, scratch.file(), "old");
  CHECK_THROWS_AS(write_state(state, scratch.file().parent_path() / "missing" / "state.h5"), RuntimeError);
  CHECK_THROWS_AS(write_state({}, scratch.file()), InputError);
  CHECK(read_state(scratch.file()).note() == "old");
}
