#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/point.h"

/// From numpy's arrays to the engine's vectors and back. Python code has made the arrays contiguous and of these types.
namespace ccdt::python {

namespace py = pybind11;

static_assert(sizeof(Point3) == 3 * sizeof(double), "an array of points is an array of coordinates");

/// An array of numbers, row after row.
template <class Number>
using Array = py::array_t<Number, py::array::c_style>;

template <class Number>
requires std::is_arithmetic_v<Number> Number number_of(const Number&);
template <class Number, std::size_t Size>
Number number_of(const std::array<Number, Size>&);
double number_of(const Point3&);

/// What the elements of a vector consist of for numpy: rows of numbers; of 0 columns: single numbers.
template <class Element>
using NumberOf = decltype(number_of(std::declval<Element>()));
template <class Element>
constexpr py::ssize_t columns_of = std::is_arithmetic_v<Element> ? 0 : sizeof(Element) / sizeof(NumberOf<Element>);

/// An array that shares the memory of a vector.
///
/// \param owner  lives as long as the array, and the vector as long as the owner
template <class Element>
Array<NumberOf<Element>> view_of(std::vector<Element>& elements, const py::object& owner) {
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(elements.size())};
  if (columns_of<Element> != 0) shape.push_back(columns_of<Element>);
  return Array<NumberOf<Element>>(shape, reinterpret_cast<NumberOf<Element>*>(elements.data()), owner);
}

/// \throw std::invalid_argument  the array does not have such rows
template <class Element>
std::vector<Element> vector_of(const Array<NumberOf<Element>>& array) {
  const bool fits =
      columns_of<Element> == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns_of<Element>;
  if (!fits) throw std::invalid_argument("an array has the wrong shape");
  std::vector<Element> elements(static_cast<std::size_t>(array.shape(0)));
  if (!elements.empty())
    std::memcpy(static_cast<void*>(elements.data()), array.data(), elements.size() * sizeof(Element));
  return elements;
}

/// Adds a property for a list of a class: an array that shares its memory. Setting it ends the life of older arrays, so
/// Python code sets it only before it gives any away.
template <class Owner, class Element>
void add_list(py::class_<Owner>& type, const char* name, std::vector<Element> Owner::*list) {
  type.def_property(
      name, [list](const py::object& self) { return view_of(self.cast<Owner&>().*list, self); },
      [list](Owner& owner, const Array<NumberOf<Element>>& array) { owner.*list = vector_of<Element>(array); });
}

}  // namespace ccdt::python
