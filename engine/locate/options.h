#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::locate {

/// The search structure for the vertices near a face and the faces near an edge, for the front.
enum class LocatorKind {
  grid,    ///< the uniform grid of the paper (section 4)
  octree,  ///< adapts to graded density
  cavity   ///< the Delaunay cells that missing faces pierce: the fastest
};

constexpr auto names_of(LocatorKind) {
  return std::to_array<NamedValue<LocatorKind>>({{LocatorKind::cavity, "cavity", "the cells that missing faces pierce"},
                                                 {LocatorKind::octree, "octree", "adapts to graded density"},
                                                 {LocatorKind::grid, "grid", "the paper's uniform grid"}});
}

}  // namespace ccdt::locate
