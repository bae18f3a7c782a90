#pragma once

#include <optional>
#include <span>

#include "engine/base/point.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/refusals.h"

namespace ccdt {

/// The angle, exactly classified, by which one must turn about the axis a->b, counterclockwise seen from b, to come
/// from c to d.
enum class Turn { zero, below_180, exactly_180, above_180 };
Turn turn_about(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Sorts the triangles around each edge of three or more by angle, counterclockwise about the axis from its smaller end
/// to its greater.
///
/// \param is_inner_edge  edges within one facet: they have two triangles and are not looked at
/// \param tolerance      in grid units; two facets on the same side of an edge and this near to each other cover each
/// other \return               two triangles that cover each other, if there are any
std::optional<Overlap> sort_around_edges(std::span<const Point3> vertices, const TriangleSet& triangles,
                                         const std::vector<char>& is_inner_edge, double tolerance, EdgeTable& edges);

}  // namespace ccdt
