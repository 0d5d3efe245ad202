#include <functional>
#include <string>
#include <string_view>

#include "base/atomic_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state.hpp"
#include "lichtmc/state_bytes.hpp"
#include "store/sealed_file.hpp"
#include "store/state_layout.hpp"

namespace lichtmc {

namespace {

// The expected size, so that the memory for the file is allocated once.
std::uint64_t size_of(const StateData& data) {
  std::uint64_t bytes = std::uint64_t{1} << 17;  // groups and attributes
  if (data.photons) {
    const Totals& totals = *data.photons->totals;
    bytes +=
        (totals.tiles.size() + totals.tile_maps.size()) * sizeof(Moments) + totals.hits.size() * sizeof(std::uint64_t);
  }
  if (data.tile_walks) bytes += data.tile_walks->sums->size() * sizeof(BackwardSums);
  if (data.receivers) bytes += data.receivers->sums->size() * sizeof(BackwardSums);
  const auto add_lists = [&](const Field& /*field*/, const auto& list) { bytes += list.size() * sizeof(list[0]); };
  if (data.channels) visit_fields(add_lists, *data.channels);
  if (data.parts) visit_fields(add_lists, *data.parts);
  return bytes;
}

// Passes the seal and the rest of the file to `take`. what: what is made of it, for messages.
void produce(const State& state, std::string_view note, const std::string& what,
             const std::function<void(const std::string& seal, std::string_view rest)>& take) {
  if (state.empty()) throw InputError("The state is empty (allowed: one that simulate() has returned).");
  StateData data = state.data();
  data.note = note;
  try {
    Hdf5File hdf5 = Hdf5File::in_memory(seal_bytes, size_of(data));
    write_layout(hdf5, data);
    const std::string_view rest = hdf5.image();
    take(seal_of(state_title, rest), rest);
  } catch (const Hdf5Error& error) {
    throw RuntimeError("Cannot write " + what + " (" + error.what() +
                       "). There may be too little memory: use larger tiles.");
  }
}

}  // namespace

void write_state(const State& state, const std::filesystem::path& file, std::string_view note) {
  produce(state, note, file.string(), [&](const std::string& seal, std::string_view rest) {
    write_file_atomically(file, [&](const Sink& sink) {
      sink(seal);
      sink(rest);
    });
  });
}

std::string state_bytes(const State& state, std::string_view note) {
  std::string bytes;
  produce(state, note, "the state", [&](const std::string& seal, std::string_view rest) {
    bytes.reserve(seal.size() + rest.size());
    bytes += seal;
    bytes += rest;
  });
  return bytes;
}

}  // namespace lichtmc
