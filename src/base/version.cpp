#include "lichtmc/version.hpp"

namespace lichtmc {

std::string_view version() {
  return LICHTMC_VERSION;
}

}  // namespace lichtmc
