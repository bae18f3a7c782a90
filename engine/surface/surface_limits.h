#pragma once

#include "engine/surface/triangle_fit.h"
#include "engine/surface/working_mesh.h"

namespace ccdt {

/// How far an edge may be from the original surface or feature in its middle, as a fraction of its length: a circle
/// keeps eighteen edges at least.
inline constexpr double most_deviation = 0.044;

/// The same for the edges that improve bad triangles: a circle keeps fifteen edges.
inline constexpr double most_deviation_of_improved = 0.055;

/// Edges are split above and collapsed below these multiples of the wanted length (Botsch and Kobbelt 2004).
inline constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;

/// Could an edge between two vertices of a patch lie within the bound, to judge by the normals at its ends? An arc of
/// half the angle a has a sagitta of tan(a/2)/2 of its chord, and its ends turn by a away from the chord.
bool runs_along_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b);

/// Is the middle of an edge between two vertices of a patch, or one and a place for another, within the bound?
bool is_near_surface(const WorkingMesh& m, VertexHandle a, const Point3& q, double most = most_deviation);
inline bool is_near_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b) {
  return is_near_surface(m, a, m.point(b));
}

/// The triangle over a halfedge: its corners, from the start of the halfedge.
inline std::array<VertexHandle, 3> corners_of(const WorkingMesh& m, HalfedgeHandle h) {
  return {m.mesh.from_vertex_handle(h), m.mesh.to_vertex_handle(h),
          m.mesh.to_vertex_handle(m.mesh.next_halfedge_handle(h))};
}

inline TriangleFit fit_of(const WorkingMesh& m, const std::array<VertexHandle, 3>& v, Shape shape = Shape::area) {
  return fit_of({m.point(v[0]), m.point(v[1]), m.point(v[2])},
                {m.at(v[0]).normal, m.at(v[1]).normal, m.at(v[2]).normal}, shape);
}

}  // namespace ccdt
