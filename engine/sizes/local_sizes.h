#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/point.h"

namespace ccdt::sizes {

/// An edge length that is wanted at some places, in the units of the input. From there, lengths grow by the grading.
struct LocalSize {
  double edge_length = 0;  ///< > 0; with a volume, 0 means the edges of tetrahedra of that volume
  double volume = 0;       ///< no tetrahedron of the regions is larger; 0: any

  std::vector<int> markers = {};        ///< the facets with these markers
  std::vector<std::string> names = {};  ///< the same, by `InputPlc::marker_names`
  std::vector<int> segments = {};       ///< the segments with these markers
  std::vector<int> regions = {};        ///< the parts of the domain with these attributes
  std::vector<Box> boxes = {};
  std::vector<Ball> balls = {};  ///< radius 0: a point
  double within = 0;             ///< also everything within this distance of all these
};

/// Fills in the wanted edge length at each of some points; infinity where any length will do.
using SizeFunction = std::function<void(std::span<const Point3> points, std::span<double> lengths)>;

/// Bounds of the options below.
inline constexpr double most_curvature_angle = 180, most_elements_through = 1000;

/// Where edges should be shorter than `MeshOptions::edge_length`. The least of all lengths counts.
struct LocalSizes {
  std::string name = {};  ///< path of the file they come from; empty: none
  std::vector<LocalSize> sizes = {};
  /// Edges along curved surfaces turn by at most this angle, in degrees: they span it on the circle through the facets
  /// beside a segment. 0: any.
  double curvature_angle = 0;
  double elements_through = 0;  ///< about this many edges fit between facets with the domain in between; 0: any
  /// Is asked at the centers of cubes, in the units of the input, until these are no longer than the length. It begins
  /// with 4,096 cubes around the input, so it may miss what is smaller than a sixteenth of that.
  SizeFunction function = {};

  bool empty() const { return sizes.empty() && curvature_angle == 0 && elements_through == 0 && !function; }
};

}  // namespace ccdt::sizes
