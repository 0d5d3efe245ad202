// Emitters and receivers of nodes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// An emitter with the quantity of its power.
struct FileEmitter {
  Emitter emitter;
  Quantity quantity = Quantity::photometric;
};

// The light of KHR_lights_punctual of a node, as JSON; null without. Throws InputError if its number is not that of a
// light of the file.
const tinygltf::Value* find_light(const Document& document, const tinygltf::Node& node, const std::string& where);

// Its custom properties; an empty value for null.
const tinygltf::Value& extras_of(const tinygltf::Value* light);

// Luminance of its colour: the intensity in the file is per colour channel.
double colour_of(const Document& document, const tinygltf::Value& light, const std::string& where);

// The direction of a node, −Z, of length 1. Throws InputError if its scale is 0.
glm::dvec3 axis_of(const Document& document, const PlacedNode& placed);

// The emitter of a node: its KHR_lights_punctual light, or a generalized Lambert emitter made of extras alone. None
// if the node has neither, or a directional light, which is added to `ignored`. Throws InputError naming the node
// and the value. Nodes with a photometric file: see gltf/luminaires.hpp.
std::optional<FileEmitter> read_light(const Document& document, const PlacedNode& placed,
                                      std::vector<Ignored>& ignored);

// Sets the delay of a node that has one for all that it emits: it precedes those of its light and of the materials of
// its mesh, which several nodes may share. first: its first emitter in the room, the others follow. A delay of nothing
// is added to Room::ignored.
void set_delay_of_node(const Document& document, const PlacedNode& placed, std::size_t first, Room& room);

// The same for the maintenance factor; then the powers of these emitters, which are those of new ones until here, become
// the maintained ones.
void set_maintenance_of_node(const Document& document, const PlacedNode& placed, std::size_t first, Room& room);

// The receiver of a node with extras.receiver.
std::optional<Receiver> read_receiver(const Document& document, const PlacedNode& placed);

}  // namespace lichtmc
