#include "base/atomic_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state.hpp"
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

}  // namespace

void write_state(const State& state, const std::filesystem::path& file, std::string_view note) {
  if (state.empty()) throw InputError("The state is empty (allowed: one that simulate() has returned).");
  StateData data = state.data();
  data.note = note;
  try {
    Hdf5File hdf5 = Hdf5File::in_memory(seal_bytes, size_of(data));
    write_layout(hdf5, data);
    const std::string_view rest = hdf5.image();
    write_file_atomically(file, [rest](const Sink& sink) {
      sink(seal_of(state_title, rest));
      sink(rest);
    });
  } catch (const Hdf5Error& error) {
    throw RuntimeError("Cannot write " + file.string() + " (" + error.what() +
                       "). There may be too little memory: use larger tiles.");
  }
}

}  // namespace lichtmc
