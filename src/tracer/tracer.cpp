#include "tracer/tracer.hpp"

namespace lichtmc {

void Tracer::darken_blocked(const glm::vec3& start, const EndPoints& ends, std::size_t first, std::size_t last,
                            float* value, TraceCount& count) const {
  for (std::size_t k = first; k < last; ++k) {
    if (!(value[k] > 0.0F)) continue;
    if (is_blocked(start, glm::vec3(ends.x[k], ends.y[k], ends.z[k]) - start, count)) value[k] = 0.0F;
  }
}

}  // namespace lichtmc
