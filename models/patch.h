#pragma once

#include <functional>
#include <vector>

#include "engine/planar/points.h"
#include "models/curves.h"

namespace ccdt::models {

/// A developable patch laid out in the plane without distortion. Counterclockwise in the plane is counterclockwise seen
/// from outside.
struct Chart {
  std::function<planar::Point2(const Point3&)> flatten;
  std::function<Point3(const planar::Point2&)> lift;  ///< the inverse, onto the true surface
};

/// Where the outer side of a cylinder is.
enum class OuterSide { away_from_axis, towards_axis };

/// The plane through `origin` with that unit normal toward the outer side. Where the normal is along an axis, the
/// points of the plane have exactly the origin's coordinate there.
Chart plane_chart(const Point3& origin, const Point3& normal);

/// The cylinder unrolled. The patch must lie within 180 degrees on both sides of the angle `middle`.
Chart cylinder_chart(Axis axis, const Point3& center, double radius, double middle, OuterSide outer_side);

/// A piece of a surface that can be laid out in the plane, between curves that have been cut into edges.
struct SurfacePatch {
  Chart chart;
  std::vector<Chain> loops;  ///< closed, in any direction: the outer one and those of the holes
  std::vector<Chain> cuts;   ///< open curves inside that must be edges as well
  double edge_length = 1;
  int marker = 0;
};

/// Triangulates a patch with nearly equilateral triangles whose outer vertices are those of its curves: points in
/// layers, their constrained Delaunay triangulation, then smoothing toward the optimal Delaunay triangulation (Chen &
/// Xu 2004) in turn with flips.
///
/// \throw std::logic_error  the curves cross, or meet at points that are not shared vertices
void add_patch(ModelSurface& surface, const SurfacePatch& patch);

}  // namespace ccdt::models
