// numpy arrays that show the memory of a result, without copies: read-only, and each keeps the result alive.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace lichtmc::python {

namespace nb = nanobind;

// A Python object that keeps something alive, as the owner of an array.
template <class Kept>
nb::capsule keep(std::shared_ptr<Kept> kept) {
  auto held = std::make_unique<std::shared_ptr<Kept>>(std::move(kept));
  nb::capsule capsule(held.get(), [](void* pointer) noexcept { delete static_cast<std::shared_ptr<Kept>*>(pointer); });
  held.release();
  return capsule;
}

template <class Scalar>
using View = nb::ndarray<nb::numpy, const Scalar>;

// For properties that give an array: it has its owner, and needs no other.
inline constexpr auto has_owner = nb::rv_policy::reference;

// Of one member of every element of a vector: shape (n,), or (n, 3) for points. `kept` owns the vector.
template <class Row, class Member, class Kept>
auto column(const std::shared_ptr<Kept>& kept, const std::vector<Row>& rows, Member Row::*member) {
  constexpr bool is_point = std::is_same_v<Member, glm::dvec3>;
  using Scalar = std::conditional_t<is_point, double, Member>;
  static_assert(std::is_arithmetic_v<Scalar> && sizeof(Row) % sizeof(Scalar) == 0);
  static constexpr Scalar nothing{};
  const void* first = rows.empty() ? static_cast<const void*>(&nothing) : &(rows.front().*member);
  const std::size_t shape[2] = {rows.size(), 3};
  const std::int64_t strides[2] = {sizeof(Row) / sizeof(Scalar), 1};
  return View<Scalar>(first, is_point ? 2 : 1, shape, keep(kept), strides);
}

// Of a vector of numbers, in C order with this shape, whose product is its size.
template <class Scalar, std::size_t dimensions, class Kept>
View<Scalar> shaped(const std::shared_ptr<Kept>& kept, const std::vector<Scalar>& values,
                    const std::array<std::size_t, dimensions>& shape) {
  static constexpr Scalar nothing{};
  const void* first = values.empty() ? static_cast<const void*>(&nothing) : values.data();
  return View<Scalar>(first, dimensions, shape.data(), keep(kept));
}

// Of numbers at fixed distances, in units of a number, from `first`, which `kept` owns.
template <class Scalar, std::size_t dimensions, class Kept>
View<Scalar> strided(const std::shared_ptr<Kept>& kept, const Scalar* first,
                     const std::array<std::size_t, dimensions>& shape,
                     const std::array<std::int64_t, dimensions>& strides) {
  static constexpr Scalar nothing{};
  return View<Scalar>(first == nullptr ? &nothing : first, dimensions, shape.data(), keep(kept), strides.data());
}

// What a class's __array__(dtype, copy) returns, by numpy's protocol.
inline nb::object as_array(const nb::object& array, const nb::object& dtype, const nb::object& copy) {
  const nb::object numpy = nb::module_::import_("numpy");
  const bool must_copy = !copy.is_none() && nb::cast<bool>(copy);
  return must_copy ? numpy.attr("array")(array, dtype) : numpy.attr("asarray")(array, dtype);
}

// A new array that owns these values. Elsewhere only views are given: use it for what the library does not store so.
template <class Scalar, std::size_t dimensions>
View<Scalar> owned(std::vector<Scalar> values, const std::array<std::size_t, dimensions>& shape) {
  const auto kept = std::make_shared<const std::vector<Scalar>>(std::move(values));
  return shaped(kept, *kept, shape);
}

}  // namespace lichtmc::python
