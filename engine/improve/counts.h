#pragma once

#include <array>
#include <cstdint>

#include "engine/base/enum_names.h"

namespace ccdt::improve {

/// Why improvement stopped.
enum class ImproveStop {
  none,    ///< it was not requested
  target,  ///< every tetrahedron reached the target
  time,    ///< the time was up
  stuck    ///< no change improves any of the remaining tetrahedra
};

constexpr auto names_of(ImproveStop) {
  return std::to_array<NamedValue<ImproveStop>>({{ImproveStop::none, "none"},
                                                 {ImproveStop::target, "target"},
                                                 {ImproveStop::time, "time"},
                                                 {ImproveStop::stuck, "stuck"}});
}

/// How often each change was made, and why improvement stopped.
struct ImproveCounts {
  std::uint64_t bad_cells = 0;  ///< cells that were not good enough before
  std::uint64_t bad_cells_left = 0;
  std::uint64_t removed_edges = 0;  ///< 3-2 and 4-4 swaps, and larger ones
  std::uint64_t facet_flips = 0;    ///< of these, on facets
  std::uint64_t removed_faces = 0;  ///< 2-3 swaps and larger ones
  std::uint64_t moved_vertices = 0;
  std::uint64_t inserted_vertices = 0;
  std::uint64_t collapsed_edges = 0;
  std::uint64_t reconnected_polyhedra = 0;
  std::uint64_t removed_steiner_vertices = 0;  ///< from segments
  ImproveStop stop = ImproveStop::none;
};

}  // namespace ccdt::improve
