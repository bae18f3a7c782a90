#pragma once

#include <string>

#include "engine/plc/input.h"

namespace ccdt::plc {

/// The most vertices that a mesh can have: ids have 32 bits, and one of them means none.
inline constexpr double most_vertices = 4294967295.0;

/// \param count       the approximate number of vertices that the edge length needs; may be infinite
/// \param file        the name of the input, if it is known
/// \throw LimitError  always
[[noreturn]] void throw_too_many_vertices(double count, const std::string& file = {});

/// \param estimate    of the tetrahedra of a mesh
/// \throw LimitError  always: more than the user allows
[[noreturn]] void throw_too_many_tetrahedra(double estimate);

/// The diagonal of the bounding box: no edge is longer.
double longest_edge(const InputPlc& input);

/// \param most_triangles  0: any number
/// \throw LimitError      even triangles with edges of this length would have too many vertices, or be too many
void check_edges_of_surface(const InputPlc& input, double edge_length, double most_triangles = 0);

}  // namespace ccdt::plc
