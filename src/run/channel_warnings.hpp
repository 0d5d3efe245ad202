// Warnings about impulse responses.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// One or two sentences each.
std::vector<std::string> channel_warnings(const Result& result);

}  // namespace lichtmc
