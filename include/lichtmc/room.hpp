// The room: diffusely reflecting surfaces, emitters, receivers.
//
// Plain data in world coordinates: metres, right-handed, Y up as in glTF. Fill it in, or use make_cuboid() or
// read_gltf(). All other functions only read it; check_room() checks whether it is valid. Power means radiant flux (W)
// or luminous flux (lm), as Room::quantity states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/area.hpp"
#include "lichtmc/emitter_law.hpp"
#include "lichtmc/luminous_opening.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

// Which sides of a surface have a tile map of their own.
enum class Sides {
  one,   // both sides score on one tile map; the fraction of the back is reported
  both,  // front (counter-clockwise) and back have one tile map each
};

// Where the reflectance of a surface comes from.
enum class ReflectanceSource {
  given,           // by the program that made the room, or by set_reflectance()
  property,        // custom property 'reflectance' of the material
  base_colour,     // base colour factor of the material
  texture,         // base colour texture, times the factor
  vertex_colours,  // colours of the vertices, times factor and texture
  default_white,   // glTF's default: no material, or a material without a base colour
};

// The continuation of a texture map outside of u, v = 0 … 1.
enum class Wrap { repeat, clamp, mirror };

// A quantity that varies over a surface: values over texture coordinates u, v = 0 … 1, bilinear between their centres.
struct TextureMap {
  std::string name;           // for messages: name of the image
  std::uint32_t columns = 0;  // ≥ 1, along u
  std::uint32_t rows = 0;     // ≥ 1, along v; row 0 lies at v = 0
  std::vector<float> values;  // row by row
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  // Of reflectance maps for surfaces with vertex colours: red, green and blue of the same pixels, linear, 0 … 1.
  // Elsewhere none.
  std::vector<glm::vec3> colours{};
};

using ReflectanceMap = TextureMap;  // its values are ρ, 0 … 1
using EmissionMap = TextureMap;     // its values are luminances in any unit, finite and ≥ 0

// A surface: a mesh of triangles with one reflectance, or one that varies by a reflectance map or by vertex colours or
// by the product of both. It reflects by Lambert's law on the side that is hit, for either winding of its triangles;
// the winding only determines which side is the front.
struct Surface {
  std::string name;      // unique in the room; names the tile map's file
  std::string material;  // for messages and tables; may be empty
  // ρ, fraction of the incident power that is reflected, 0 … 1. If ρ varies: its mean, for tables.
  double reflectance = 0.5;
  ReflectanceSource reflectance_source = ReflectanceSource::given;  // for messages and tables
  Sides sides = Sides::one;
  std::vector<glm::dvec3> positions;           // m, world coordinates
  std::vector<glm::dvec2> uvs;                 // texture coordinates for the tiles: one per position, or none
  std::vector<glm::uvec3> triangles;           // three indices into positions; seen from the front counter-clockwise
  std::optional<std::size_t> reflectance_map;  // index into Room::reflectance_maps
  std::vector<glm::dvec2> reflectance_uvs;     // coordinates on that map: one per position
  // Vertex colours, one per position or none: red, green and blue, linear, 0 … 1, interpolated linearly over each
  // triangle. ρ is the Rec. 709 luminance of their product with the map's colours (with its values, if it has no
  // colours); without a map, of the vertex colours alone.
  std::vector<glm::dvec3> vertex_colours;
  double highest_reflectance = 1.0;  // 0 … 1; where vertex colours would give a higher ρ, ρ has this value
  // Whether its irradiance is measured. Other surfaces only reflect: results do not include them.
  bool measured = true;
  std::size_t without_area = 0;  // number of triangles of the source left out because they have no area
};

// A point emitter with the same intensity in every direction: I = Φ/4π.
struct IsotropicEmitter {
  glm::dvec3 position{0.0};  // m

  IsotropicLaw law() const { return {}; }
};

// A point emitter by the generalized Lambert law: I(θ) = Φ (m+1)/(2π) cos^m θ over the hemisphere about its axis.
struct LambertEmitter {
  glm::dvec3 position{0.0};         // m
  glm::dvec3 axis{0.0, -1.0, 0.0};  // direction of the beam, any length but 0
  double exponent = 1.0;            // m ≥ 0: 0 uniform hemisphere, 1 Lambert, large a narrow beam

  LambertLaw law() const { return {exponent}; }
};

// A spot with a soft edge, or with inner = outer a hard one: I(θ) = I₀ inside the inner cone, I₀ a² between the cones
// with a = (cos θ − cos outer)/(cos inner − cos outer), 0 outside. Hence Φ = 2π I₀ [(1 − cos inner) + (cos inner − cos
// outer)/3].
struct SpotEmitter {
  glm::dvec3 position{0.0};          // m
  glm::dvec3 axis{0.0, -1.0, 0.0};   // direction of the beam, any length but 0
  double inner = 0.0;                // rad, half angle of the cone of full intensity, 0 ≤ inner ≤ outer
  double outer = 0.785398163397448;  // rad, half angle of the cone that contains all light, 1e-6 ≤ outer ≤ π/2

  SpotLaw law() const { return {inner, outer}; }
};

// Area light: every point of a surface's front emits by the generalized Lambert law about the normal. The exitance is
// uniform per area or, with an emission map, proportional to the map's value at the point. With m = 1 and a uniform
// exitance it is M = Φ/A, and the radiance M/π.
struct SurfaceEmitter {
  std::size_t surface = 0;                    // index into Room::surfaces
  double exponent = 1.0;                      // m ≥ 0
  std::optional<std::size_t> emission_map{};  // index into Room::emission_maps
  std::vector<glm::dvec2> emission_uvs{};     // coordinates on that map: one per position of the surface

  LambertLaw law() const { return {exponent}; }
};

struct Photometry;

// A luminaire with a photometric file (lichtmc/photometry.hpp): its intensity is the file's in shape, Φ is its flux.
// Its light starts at its position or, with an opening, all over that, with the same intensity everywhere.
struct MeasuredEmitter {
  std::shared_ptr<const Photometry> photometry;
  glm::dvec3 position{0.0};  // m
  // Unit vectors, perpendicular to each other, of either handedness: a mirrored luminaire has mirrored light.
  glm::dvec3 axis{0.0, -1.0, 0.0};           // its aim
  glm::dvec3 c0{1.0, 0.0, 0.0};              // towards the plane C0
  glm::dvec3 c90{0.0, 0.0, -1.0};            // towards the plane C90
  std::optional<LuminousOpening> opening{};  // that light leaves; none: the position alone

  MeasuredLaw law() const;
};

struct Emitter {
  std::string name;    // for messages and tables
  double power = 1.0;  // Φ: radiant flux in W or luminous flux in lm, ≥ 0; the maintained one
  std::variant<IsotropicEmitter, LambertEmitter, SpotEmitter, SurfaceEmitter, MeasuredEmitter> shape;
  double delay_s = 0.0;  // s, ≥ 0: of its light behind the signal, for impulse responses
  // Share of the power of a new emitter, above 0 and up to 1, that `power` is: light sources age, and dust gathers.
  double maintenance_factor = 1.0;
  bool own_maintenance = false;  // its file gave the factor: set_maintenance_factor() keeps it, also if it is 1
};

// The directional law of an emitter.
inline EmitterLaw law_of(const Emitter& emitter) {
  return std::visit([](const auto& shape) -> EmitterLaw { return shape.law(); }, emitter.shape);
}

// How a receiver weighs the radiance L that comes from a direction ω; E = ∫ L w(ω) dω.
enum class ReceiverLaw {
  planar,           // w = cos θ, θ the angle to the normal, 0 behind: irradiance
  cylindrical,      // w = sin ε/π, ε the angle to the normal, which is the axis of a small cylinder
  semicylindrical,  // w = sin ε (1 + cos α)/π, α the angle about the axis, from the direction that it faces
};

// "planar", "cylindrical" or "semicylindrical".
std::string_view to_string(ReceiverLaw law);

// A point at which irradiance is computed.
struct Receiver {
  std::string name;
  glm::dvec3 position{0.0};          // m
  glm::dvec3 normal{0.0, 1.0, 0.0};  // axis of the field of view, any length but 0
  double half_angle_deg = 90.0;      // half angle of the field of view, 0 … 90
  double area_m2 = 1.0;              // for its gain H = E·A·g·T/Φ, ≥ 0
  // Refractive index n ≥ 1 of an ideal concentrator: within the field of view it has the gain g = n²/sin² Ψ, Ψ the half
  // angle. None: g = 1.
  std::optional<double> concentrator_index = std::nullopt;
  double filter_gain = 1.0;  // T ≥ 0 of an optical filter
  // A cell of a calculation grid: the irradiance is the mean over the parallelogram with these edges, in m, about the
  // position. Both 0: the irradiance at the position.
  glm::dvec3 cell_u{0.0};
  glm::dvec3 cell_v{0.0};

  // Other laws than `planar` have the whole sphere as their field of view, and no cells.
  ReceiverLaw law = ReceiverLaw::planar;
  glm::dvec3 facing{1.0, 0.0, 0.0};  // of a half cylinder; its part at right angles to the normal counts

  bool is_cell() const { return cell_u != glm::dvec3(0.0) || cell_v != glm::dvec3(0.0); }
  // g·T: received power over incident power; 1 without concentrator and filter, 0 with an empty field of view and a
  // concentrator.
  double optical_gain() const;
};

// Whether something has an influence on the figures.
enum class Effect { none, figures };

// A part of the source that the room does not model.
struct Ignored {
  std::string what;              // a sentence or two
  Effect effect = Effect::none;  // whether it may change the figures
  std::string advice = {};       // what to do, a sentence; empty: what its effect demands
};

struct Room {
  std::string source;  // origin, for messages: a file name, "cuboid", …
  Quantity quantity = Quantity::photometric;
  std::vector<Surface> surfaces;
  std::vector<Emitter> emitters;
  std::vector<Receiver> receivers;
  std::vector<Area> areas;                 // whose points are some of the receivers
  std::vector<AreaRequest> area_requests;  // areas without a grid: lay_areas() gives them one
  std::vector<ReflectanceMap> reflectance_maps;
  std::vector<EmissionMap> emission_maps;
  std::vector<Ignored> ignored;        // parts of the source that are not modelled
  std::vector<std::string> overrides;  // input overrides: changes on request after reading, one sentence each
};

// Checks whether a room can be simulated: at least one triangle with an area and one emitter; 0 ≤ ρ ≤ 1; finite
// positions; indices in range; axes with a length; exponents, cones, powers and receivers in their ranges; the sum of
// powers above 0. Throws InputError naming the room's source, the surface or emitter, the value and what is allowed.
void check_room(const Room& room);

// The mean of a surface's reflectance over its area; if it varies, by dividing its triangles, with a reflectance map to
// about the size of the map's pixels.
double mean_reflectance(const Room& room, const Surface& surface);

// Area of a surface in m², one side.
double surface_area(const Surface& surface);

// Sum of the emitters' powers in W or lm.
double total_power(const Room& room);

}  // namespace lichtmc
