#pragma once

#include <optional>
#include <span>

#include "engine/base/point.h"
#include "engine/delaunay/delaunay.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// The Delaunay tetrahedralization of the vertices of a surface; none if they are flat. Protection works on a
/// tetrahedralization that grows by one vertex at a time, so this one is made by insertion, whatever the method. With
/// another method, it is used only for protection.
///
/// Opposite sides of a periodic surface get the same triangles, even where vertices are on a common circle: the ranks
/// of their vertices have the same order.
///
/// \param points  grid units
std::optional<delaunay::Delaunay> tetrahedralize_vertices(std::span<const Point3> points, Run& run);

}  // namespace ccdt::steps
