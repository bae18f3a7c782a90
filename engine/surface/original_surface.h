#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"
#include "engine/surface/options.h"

namespace ccdt::surface {

/// An edge whose shape remeshing keeps.
struct FeatureEdge {
  std::array<std::uint32_t, 2> ends;     ///< points
  std::vector<std::uint32_t> triangles;  ///< around it; none if no facet has this segment
  bool is_segment = false;               ///< the input lists it
  int marker = 0;                        ///< of the segment
};

/// The surface before remeshing, cut along its features.
///
/// A *patch* is a set of triangles, all oriented alike, that are joined across edges that are not features. A *wedge*
/// (Hoppe 1998) is a part of a patch at a point: triangles around the point that are joined across non-feature edges at
/// the point.
///
///      \ w0 /        two features cross at the point in the middle:
///       \  /         four wedges
///    w1  ()  w3
///       /  \                                                                                                      .
///      / w2 \                                                                                                     .
struct OriginalSurface {
  std::vector<Point3> points;                           ///< in the units of the input; those of the PLC come first
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< points
  std::vector<std::array<std::uint32_t, 3>> wedges;     ///< of the same corners
  std::vector<Point3> triangle_normals;                 ///< of length one; the facet's normal where the facet is flat
  std::vector<std::uint32_t> facet_of;                  ///< of each triangle, in the PLC
  std::vector<std::uint32_t> patch_of;                  ///< of each triangle
  std::vector<int> patch_markers;
  std::vector<char> patch_is_flat;
  std::vector<std::uint32_t> wedge_points;
  std::vector<std::uint32_t> wedge_patches;
  std::vector<Point3> wedge_normals;  ///< of length one: mean over the wedge, weighted by angles; zero at a tip, such
                                      ///< as that of a cone, where the surface has no normal
  std::vector<FeatureEdge> features;
  std::vector<sizes::SizedPlace> rounded;  ///< parts of wide bends that are not features, and the longest edge there
  std::vector<char> is_listed_alone;       ///< by point: the input lists it, but no facet or segment uses it

  std::array<Point3, 3> corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {points[a], points[b], points[c]};
  }
};

/// \param plc  of this input, built with the same flatness
OriginalSurface cut_surface(const plc::InputPlc& input, const plc::Plc& plc, const RemeshOptions& options);

/// A point of the original surface.
struct Foot {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  ///< of the corners of the triangle; they sum to one
  Point3 point;                     ///< exactly in the triangle's plane where the plane is parallel to two axes
  double squared_distance = 0;
};

/// Finds the nearest point of a patch of the original surface.
class ClosestPoint {
 public:
  explicit ClosestPoint(const OriginalSurface& surface);

  /// \param near  a triangle of the patch; the nearer it is, the faster the search
  Foot on_patch(std::uint32_t patch, const Point3& p, std::uint32_t near) const { return search(patch, p, near, 0); }

  /// Is the patch within this distance of a point? Faster than finding the nearest point.
  bool is_within(double distance, std::uint32_t patch, const Point3& p, std::uint32_t near) const;

  /// The normal of the surface at a foot, interpolated from the normals of the wedges; of length one.
  Point3 normal_at(const Foot& foot) const;

 private:
  Foot search(std::uint32_t patch, const Point3& p, std::uint32_t near, double squared_enough) const;
  Foot foot_on(std::uint32_t triangle, const Point3& p) const;

  const OriginalSurface& surface_;
  IndexLists triangles_;        // of each patch
  std::vector<BoxTree> trees_;  // of these, by patch
};

}  // namespace ccdt::surface
