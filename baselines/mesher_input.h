#pragma once

#include "baselines/mesher.h"

namespace ccdt::baselines {

/// The input with vertices of equal coordinates merged: surface formats repeat a vertex in every triangle, but the
/// other meshers expect shared vertices. Triangles, polygons and segments keep their order.
InputPlc merge_equal_vertices(const InputPlc& input);

/// The input with polygons replaced by triangles, which programs that read surfaces expect.
InputPlc triangulate_facets(const InputPlc& input, const MeshOptions& options);

/// Median length of the edges of the input's triangles and polygons; 0 without any.
double median_edge_length(const InputPlc& input);

/// The target edge length of a mesh: that of the options, or that of the surface if this is 0.
double target_edge_length(const InputPlc& input, const MeshOptions& options);

/// Volume of the regular tetrahedron of this edge length.
double regular_tetrahedron_volume(double edge_length);

/// Volume of the largest tetrahedron of a mesh of this edge length: twice the regular one's, which is about the
/// average.
double largest_tetrahedron_volume(double edge_length);

}  // namespace ccdt::baselines
