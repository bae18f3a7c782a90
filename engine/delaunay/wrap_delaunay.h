#pragma once

#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt::delaunay {

/// Tetrahedralizes points face by face, as the paper does (sections 4 and 5: the uniform grid construction of Fang and
/// Piegl 1993, in space): starting with a face of the hull, the tetrahedron on the open side of each face is found by a
/// search in the uniform grid around it. The cells are the very ones that insertion in the order of the ranks gives.
///
/// The time is about linear for points of a uniform density in a body. It is not where the points are graded or lie on
/// surfaces alone, as the number of vertices in a cell is then no longer bounded: a region that is k times denser than
/// the mean costs about k times as much per vertex; n points on a sphere cost about n^2. On slanted flat sides, where
/// vertices are a rounding off the plane, the spheres of slivers are half-spaces, whose border is searched: about n^1.2
/// in all.
///
/// \param vertices    by id, with point and rank; points pairwise different, in grid units, and ranks too
/// \param grid_scale  factor of the paper's size of the grid's cells
/// \return  without dead cells
/// \throw MeshError  as build_delaunay
Delaunay wrap_delaunay(std::vector<DelaunayVertex> vertices, double grid_scale = 1, const Progress& progress = {});

}  // namespace ccdt::delaunay
