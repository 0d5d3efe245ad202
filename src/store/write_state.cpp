#include "base/atomic_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state.hpp"
#include "store/sealed_file.hpp"
#include "store/state_layout.hpp"

namespace lichtmc {

void write_state(const State& state, const std::filesystem::path& file, std::string_view note) {
  if (state.empty()) throw InputError("The state is empty (allowed: one that simulate() has returned).");
  StateData data = state.data();
  data.note = note;
  try {
    make_file_atomically(file, [&](const std::filesystem::path& temporary) {
      Hdf5File hdf5(temporary, Hdf5File::Mode::write, seal_bytes);
      write_layout(hdf5, data);
      hdf5.close();
      seal(temporary, state_title);
    });
  } catch (const Hdf5Error& error) {
    throw RuntimeError("Cannot write " + file.string() + " (" + error.what() +
                       "). Check that its folder is there and has room, or choose another.");
  }
}

}  // namespace lichtmc
