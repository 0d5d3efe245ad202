// Fuzz target: any bytes as a photometric file end with a luminaire or an InputError. The intensities of a luminaire
// that was read are within its range in all directions, its samples are directions, and written as an IES file it comes
// back. What a file contains does not depend on its line ends or on a byte order mark.
//
// Built like fuzz_gltf. Seeds: tests/data/luminaires/.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

#include "chance/candela_sampler.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/visible_text.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

std::optional<lichtmc::Photometry> read(std::string_view bytes, const lichtmc::PhotometryOptions& options = {}) {
  try {
    return lichtmc::parse_photometry(bytes, "lamp", options);
  } catch (const lichtmc::InputError& error) {  // the result for malformed files; its text is for a terminal
    const std::string text = error.what();
    require(lichtmc::visible_text(text) == text && text.rfind("lamp", 0) == 0);
    return std::nullopt;
  }
}

void check_intensity(const lichtmc::CandelaTable& table) {
  const double most = table.peak().candela;
  require(table.flux() > 0.0 && std::isfinite(table.flux()) && most > 0.0 && std::isfinite(most));
  const double front = table.flux_towards_aim();
  require(front >= 0.0 && front <= table.flux() * (1.0 + 1e-9));
  require(table.half_angle() > 0.0 && table.half_angle() < 3.1416 && table.width() > 0.0);
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const double candela = table.candela(glm::normalize(glm::dvec3(x, y, z)));
        require(candela >= 0.0 && candela <= most * (1.0 + 1e-9));
      }
    }
  }
}

bool is_direction(double x, double y, double z, double allowed) {
  return std::abs(x * x + y * y + z * z - 1.0) <= allowed;
}

void check_samples(const lichtmc::CandelaTable& table) {
  constexpr std::size_t n = 64;
  std::array<std::uint32_t, n> polar{};
  std::array<std::uint32_t, n> azimuth{};
  std::array<float, n> x{};
  std::array<float, n> y{};
  std::array<float, n> z{};
  for (std::size_t k = 0; k < n; ++k) {
    polar[k] = static_cast<std::uint32_t>(k * 0x04104104U);  // 0 … 2³² − 1
    azimuth[k] = static_cast<std::uint32_t>(k * 0x9E3779B9U);
    const glm::dvec3 d = table.sample((polar[k] + 0.5) * 0x1p-32, azimuth[k] * 0x1p-32);
    require(is_direction(d.x, d.y, d.z, 1e-9));
  }
  table.sampler().sample(n, polar.data(), azimuth.data(), x.data(), y.data(), z.data());
  for (std::size_t k = 0; k < n; ++k) require(is_direction(x[k], y[k], z[k], 1e-5));
}

// Written as an IES file and read again.
void check_again(const lichtmc::Photometry& photometry) {
  const std::string text = lichtmc::ies_text(photometry);
  const lichtmc::CandelaTable::Grid& grid = photometry.candela->grid();
  const std::optional<lichtmc::Photometry> again = read(text);
  // Planes that do not begin at 0° are completed by one there, which may be too near to the next; H that is above 0
  // when it counts the other way, by dark ones.
  const bool type_c = grid.type == lichtmc::PhotometricType::c;
  const bool whole = grid.symmetry == lichtmc::PhotometricSymmetry::none;
  const bool completed =
      type_c ? whole && grid.horizontal_deg.front() != 0.0 : grid.flip_horizontal && grid.horizontal_deg.back() <= 0.0;
  if (completed) return;
  require(again.has_value());
  require(std::abs(again->flux() - photometry.flux()) <= 1e-9 * photometry.flux());
  require(lichtmc::ies_text(*again) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  lichtmc::PhotometryOptions options;
  options.flip_horizontal = true;
  options.needs_flux = false;
  for (const std::optional<lichtmc::Photometry>& photometry : {read(bytes), read(bytes, options)}) {
    if (!photometry) continue;
    check_intensity(*photometry->candela);
    check_samples(*photometry->candela);
    check_again(*photometry);
  }
  const std::optional<lichtmc::Photometry> photometry = read(bytes);
  if (!photometry || static_cast<unsigned char>(bytes.front()) >= 0x80) return 0;
  const std::optional<lichtmc::Photometry> marked = read("\xEF\xBB\xBF" + bytes);
  require(marked && marked->candela->grid().candela == photometry->candela->grid().candela);
  if (bytes.find('\r') != std::string::npos) return 0;
  std::string carriage = bytes;
  for (char& c : carriage) c = c == '\n' ? '\r' : c;
  const std::optional<lichtmc::Photometry> other = read(carriage);
  require(other && other->candela->grid().candela == photometry->candela->grid().candela &&
          other->texts == photometry->texts);
  return 0;
}
