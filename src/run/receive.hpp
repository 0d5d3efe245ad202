// The backward part of a run: receivers → threads → stop rule → irradiance at each.
#pragma once

#include <optional>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// Fills in Result::receiver_results and Result::backward. The room has receivers. Throws InputError naming a receiver
// that lies on an emitter.
void receive(const Room& room, const Scene& scene, const Settings& settings, const Control& control, unsigned threads,
             Result& result);

}  // namespace lichtmc
