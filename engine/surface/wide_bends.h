#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/edge_table.h"

namespace ccdt::surface {

/// The triangles of a surface, and what is known of them before it is cut.
struct BentSurface {
  std::span<const Point3> points;
  std::span<const plc::VertexTriple> corners;  ///< of each triangle
  std::span<const Point3> normals;             ///< of length one
  std::span<const std::uint32_t> facet_of;
  const plc::EdgeTable& edges;
};

/// Do the two triangles at an edge run through it in opposite directions?
bool oriented_alike(const BentSurface& surface, std::uint32_t edge);

/// The part of an edge that remeshing must keep as a feature, although it is not sharp.
struct WideBend {
  std::array<VertexId, 2> ends;
  double from = 0, to = 1;  ///< shares of the edge, from its first end; none if from > to
  double longest = 0;       ///< edge across the rest of it that stays near the surface
};

/// The turns at wide bends, in radians; 0 at other edges. These are the edges between facets so wide that edges across
/// them would be farther from the surface than the deviation.
///
/// An edge of length L across the middle of a bend by the angle t is L t / 4 away from it. Where facets of width w
/// approximate a circle of radius w / t, edges of length sqrt(6 D w / t) stay within the deviation D. So narrow facets,
/// w t < D, need no feature.
///
/// \param is_feature  by edge: what is kept anyway
std::vector<double> turns_of_wide_bends(const BentSurface& surface, std::span<const char> is_feature, double deviation);

/// Wide bends, each without the part near a point where it meets another feature at a small angle and where the two are
/// nearer than a narrow facet is wide: there, both would make needles.
///
/// \param wedges      of the corners of triangles, between features
/// \param is_feature  by edge; wide bends are features
/// \param turns       `turns_of_wide_bends`
std::vector<WideBend> trim_in_narrow_wedges(const BentSurface& surface,
                                            std::span<const std::array<std::uint32_t, 3>> wedges,
                                            std::span<const char> is_feature, std::span<const double> turns,
                                            double deviation);

}  // namespace ccdt::surface
