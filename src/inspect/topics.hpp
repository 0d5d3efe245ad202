// The findings of an inspection, one function per topic. Each adds to facts.findings what it has to say about the facts
// and the room; findings.cpp has the list in which they are called.
#pragma once

#include "lichtmc/inspect.hpp"
#include "lichtmc/room.hpp"
#include "room/enclosure.hpp"

namespace lichtmc {

// findings_size.cpp
// The room's size with its height along y, also if the room probably lies on its side.
glm::dvec3 upright(const Inspection& facts);
void find_size(const Room& room, Inspection& facts);
void find_up_axis(const Room& room, Inspection& facts);

// findings_emitters.cpp
void find_emitters(const Room& room, const Enclosure& enclosure, Inspection& facts);
void find_receivers(const Room& room, const Enclosure& enclosure, Inspection& facts);
void find_maintenance(const Room& room, Inspection& facts);

// findings_areas.cpp: calculation areas
void find_areas(const Room& room, Inspection& facts);

// findings_area_lights.cpp: area lights of a shape that is seldom meant
void find_area_lights(const Room& room, Inspection& facts);

// findings_emitter_light.cpp: emitters whose light does not get into the room
void find_emitter_light(const Room& room, Inspection& facts);

// findings_luminaires.cpp: luminaires with photometric files
void find_luminaires(const Room& room, Inspection& facts);

// findings_file.cpp: contents of the file that are not modelled
void find_not_modelled(const Room& room, Inspection& facts);

// findings_openings.cpp
void find_openings(const Room& room, Inspection& facts);
void find_open_edges(const Room& room, Inspection& facts);
void find_shape(const Room& room, Inspection& facts);

// findings_surfaces.cpp
void find_seen_from_behind(const Room& room, Inspection& facts);
void find_faces_in_one_plane(const Room& room, Inspection& facts);
void find_zero_area(const Room& room, Inspection& facts);
void find_reflectances(const Room& room, Inspection& facts);

// findings_tiles.cpp
void find_texture_coordinates(const Room& room, Inspection& facts);
void find_tiles(const Room& room, Inspection& facts);

}  // namespace lichtmc
