// Values of cells of a grid as arrays (rows, columns): a view if every cell has a value, else a copy with NaN where
// there is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "views.hpp"

namespace lichtmc::python {

struct GridShape {
  std::size_t rows = 0;
  std::size_t columns = 0;

  std::size_t size() const { return rows * columns; }
};

// A member of elements, which are in the order of the cells that have one. cell(k): of the k-th element, row by row.
template <class Row, class Member, class Kept, class Cell>
View<double> grid_of(const std::shared_ptr<Kept>& kept, std::span<const Row> elements, Member Row::*member,
                     const GridShape& shape, const Cell& cell) {
  constexpr std::size_t numbers = std::is_same_v<Member, glm::dvec3> ? 3 : 1;
  static_assert(sizeof(Member) == numbers * sizeof(double) && sizeof(Row) % sizeof(double) == 0);
  const auto first_number = [member](const Row& row) { return reinterpret_cast<const double*>(&(row.*member)); };
  const auto with_numbers = [&](const auto& make) {
    if constexpr (numbers == 1)
      return make(std::array<std::size_t, 2>{shape.rows, shape.columns});
    else
      return make(std::array<std::size_t, 3>{shape.rows, shape.columns, numbers});
  };
  if (elements.size() == shape.size() && !elements.empty()) {
    constexpr std::int64_t step = sizeof(Row) / sizeof(double);
    return with_numbers([&](const auto& sizes) {
      std::array<std::int64_t, std::tuple_size_v<std::remove_cvref_t<decltype(sizes)>>> strides{};
      strides[0] = static_cast<std::int64_t>(shape.columns) * step;
      strides[1] = step;
      if constexpr (numbers > 1) strides[2] = 1;
      return strided(kept, first_number(elements.front()), sizes, strides);
    });
  }
  std::vector<double> values(shape.size() * numbers, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const double* from = first_number(elements[k]);
    std::copy(from, from + numbers, values.begin() + static_cast<std::ptrdiff_t>(numbers * cell(k)));
  }
  return with_numbers([&](const auto& sizes) { return owned(std::move(values), sizes); });
}

}  // namespace lichtmc::python
