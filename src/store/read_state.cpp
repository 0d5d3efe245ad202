#include <functional>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state.hpp"
#include "lichtmc/state_bytes.hpp"
#include "store/sealed_file.hpp"
#include "store/state_layout.hpp"

namespace lichtmc {

namespace {

State read(const std::function<Hdf5File()>& open, const std::string& source) {
  try {
    Hdf5File hdf5 = open();
    return State(std::make_shared<const StateData>(read_layout(hdf5)));
  } catch (const Hdf5Error& error) {
    throw InputError("Cannot read the state " + in_quotes(source) + ": " + error.what() +
                     " (allowed: a file state.h5 that lichtmc has written). Start a new run.");
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory to read the state " + in_quotes(source) +
                       ". Free some, or use a machine that has more.");
  }
}

}  // namespace

State read_state(const std::filesystem::path& file) {
  check_seal(file, state_title);
  return read([&] { return Hdf5File(file); }, file.string());
}

State parse_state(std::string_view bytes, const std::string& source) {
  check_seal(bytes, source, state_title);
  return read([&] { return Hdf5File::of_bytes(bytes); }, source);
}

}  // namespace lichtmc
