#pragma once

#include "bench/run/json.h"

namespace ccdt::results {

/// A kept mesh (JSON of schema `ccdt.mesh/1`) as JSON of schema `ccdt.pagemesh/1`: a quarter as large, for pages with
/// many meshes.
///
/// Coordinates are rounded to a millionth of the box. Vertices and tetrahedra come in the order of a breadth-first walk
/// over the mesh, in which most tetrahedra need no more than a few bits; the numbers of the vertices are kept. The walk
/// and what it writes down are described in `compact_mesh.cpp`.
///
/// \throw nlohmann::json::exception, std::runtime_error  it is not a kept mesh
bench::Json compact_mesh(const bench::Json& kept);

}  // namespace ccdt::results
