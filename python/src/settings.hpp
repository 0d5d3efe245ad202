// Settings as the keyword arguments of simulate().
#pragma once

#include <nanobind/nanobind.h>

#include "lichtmc/settings.hpp"

namespace lichtmc::python {

// simulate(room, **keywords_of(settings)) has these settings.
nanobind::dict keywords_of(const Settings& settings);

}  // namespace lichtmc::python
