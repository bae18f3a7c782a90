#pragma once

#include <cstdint>
#include <span>

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::delaunay {

/// Inserts vertices that are in the list of `d` but have no cells yet.
///
/// \param vertices  in order of rank; all ranks are greater than those of the vertices that have cells. Several rounds
///                  along a Hilbert curve are best, as `append_vertices` arranges them. No two vertices are at the same
///                  place.
void insert_vertices(Delaunay& d, std::span<const std::uint32_t> vertices, const Progress& progress = {});

/// Makes room for more cells. Several threads move the existing ones.
void reserve_cells(Delaunay& d, std::size_t capacity);

/// The largest number of cells, dead ones included, that `insert_vertices` normally adds for this many vertices.
std::size_t most_new_cells(std::size_t vertices);

}  // namespace ccdt::delaunay
