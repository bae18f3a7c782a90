#pragma once

#include <vector>

#include "engine/surface/triangle_fit.h"
#include "engine/surface/working_mesh.h"

namespace ccdt {

/// Where a vertex may go, with what the original surface is like there.
struct Spot {
  Point3 point;
  std::uint32_t near;
  Point3 normal;
};

/// The worst of the triangles around something, as they are and as a change would make them.
struct FitChange {
  WorstFit before, after;
};

/// The spot of a point that is on the surface or on a feature already.
Spot spot_at(const WorkingMesh& m, VertexHandle v, const Point3& p);

/// Adds the triangles around a vertex that would go to a spot.
void add_triangles_around(const WorkingMesh& m, VertexHandle v, const Spot& spot, Shape shape, FitChange& fit);

/// Would all edges of the vertex be near to the original surface, but for those that are not anyway?
bool edges_would_stay_near(const WorkingMesh& m, VertexHandle v, const Point3& p);

void move_vertex(WorkingMesh& m, VertexHandle v, const Spot& spot);

/// A knot that is not fixed, between its neighbours along its curve.
struct KnotOnCurve {
  std::array<std::uint32_t, 2> links;
  std::array<int, 2> sides;             ///< which end of each link it is
  std::array<std::uint32_t, 2> others;  ///< the knots at the other ends
  std::array<double, 2> arcs;           ///< of these
  std::uint32_t curve;
};

KnotOnCurve on_curve(const WorkingMesh& m, std::uint32_t knot);

/// The spots of its copies for an arc length on its curve.
std::vector<Spot> spots_at(const WorkingMesh& m, std::uint32_t knot, const Point3& p);

void move_knot(WorkingMesh& m, std::uint32_t knot, double arc, const Point3& p, const std::vector<Spot>& spots);

}  // namespace ccdt
