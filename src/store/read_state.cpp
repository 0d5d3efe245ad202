#include <memory>
#include <new>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state.hpp"
#include "store/sealed_file.hpp"
#include "store/state_layout.hpp"

namespace lichtmc {

State read_state(const std::filesystem::path& file) {
  check_seal(file, state_title);
  try {
    Hdf5File hdf5(file);
    return State(std::make_shared<const StateData>(read_layout(hdf5)));
  } catch (const Hdf5Error& error) {
    throw InputError("Cannot read the state " + in_quotes(file.string()) + ": " + error.what() +
                     " (allowed: a file state.h5 that lichtmc has written). Start a new run.");
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory to read the state " + in_quotes(file.string()) +
                       ". Free some, or use a machine that has more.");
  }
}

}  // namespace lichtmc
