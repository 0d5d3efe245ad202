// Figures with their standard errors, for Python: single ones, and arrays of them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lichtmc/figure.hpp"

namespace lichtmc::python {

// "349 ± 2", as in the texts of the library; for very small and very large values "(3.49 ± 0.02)e-08".
std::string text_of(const Figure& figure);

// Figures at a fixed distance from each other, in `owner`'s memory: an array of one to three dimensions.
struct Figures {
  std::shared_ptr<const void> owner;
  const Figure* first = nullptr;  // null: there are none
  std::size_t step = 1;           // distance of two figures, in units of a double
  std::vector<std::size_t> shape;
};

// The same member of all rows, whose number is the product of the shape.
template <class Row>
Figures figures_of(std::shared_ptr<const void> owner, const std::vector<Row>& rows, Figure Row::*member,
                   std::vector<std::size_t> shape) {
  static_assert(sizeof(Row) % sizeof(double) == 0);
  return {std::move(owner), rows.empty() ? nullptr : &(rows.front().*member), sizeof(Row) / sizeof(double),
          std::move(shape)};
}

}  // namespace lichtmc::python
