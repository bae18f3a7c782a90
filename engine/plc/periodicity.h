#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::plc {

/// Along which axes a domain repeats: opposite sides of its box have the same vertices, edges and triangles. The bits
/// are those of the axes.
enum class Periodicity { none, x, y, xy, z, xz, yz, xyz };

constexpr auto names_of(Periodicity) {
  return std::to_array<NamedValue<Periodicity>>(
      {{Periodicity::none, "none", "opposite sides are independent"},
       {Periodicity::x, "x", "the sides of least and greatest x are equal"},
       {Periodicity::y, "y", "those of y"},
       {Periodicity::z, "z", "those of z"},
       {Periodicity::xy, "xy", "those of x and of y"},
       {Periodicity::xz, "xz", "those of x and of z"},
       {Periodicity::yz, "yz", "those of y and of z"},
       {Periodicity::xyz, "xyz", "all sides are equal to the opposite ones"}});
}

}  // namespace ccdt::plc
