// All headers of lichtmc.
#pragma once

#include "lichtmc/communicator.hpp"    // IWYU pragma: export
#include "lichtmc/compare.hpp"         // IWYU pragma: export
#include "lichtmc/control.hpp"         // IWYU pragma: export
#include "lichtmc/cover.hpp"           // IWYU pragma: export
#include "lichtmc/cuboid.hpp"          // IWYU pragma: export
#include "lichtmc/emitter_law.hpp"     // IWYU pragma: export
#include "lichtmc/error.hpp"           // IWYU pragma: export
#include "lichtmc/fingerprint.hpp"     // IWYU pragma: export
#include "lichtmc/folder_lock.hpp"     // IWYU pragma: export
#include "lichtmc/gltf.hpp"            // IWYU pragma: export
#include "lichtmc/inspect.hpp"         // IWYU pragma: export
#include "lichtmc/lit_room.hpp"        // IWYU pragma: export
#include "lichtmc/output.hpp"          // IWYU pragma: export
#include "lichtmc/overrides.hpp"       // IWYU pragma: export
#include "lichtmc/paths.hpp"           // IWYU pragma: export
#include "lichtmc/picture.hpp"         // IWYU pragma: export
#include "lichtmc/prepared_room.hpp"   // IWYU pragma: export
#include "lichtmc/progress.hpp"        // IWYU pragma: export
#include "lichtmc/receiver_table.hpp"  // IWYU pragma: export
#include "lichtmc/receivers.hpp"       // IWYU pragma: export
#include "lichtmc/result.hpp"          // IWYU pragma: export
#include "lichtmc/room.hpp"            // IWYU pragma: export
#include "lichtmc/settings.hpp"        // IWYU pragma: export
#include "lichtmc/simulate.hpp"        // IWYU pragma: export
#include "lichtmc/state.hpp"           // IWYU pragma: export
#include "lichtmc/study.hpp"           // IWYU pragma: export
#include "lichtmc/tiles.hpp"           // IWYU pragma: export
#include "lichtmc/units.hpp"           // IWYU pragma: export
#include "lichtmc/version.hpp"         // IWYU pragma: export
#include "lichtmc/visible_text.hpp"    // IWYU pragma: export
#include "lichtmc/walk_direction.hpp"  // IWYU pragma: export
