#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/point.h"
#include "engine/plc/plc.h"
#include "engine/refine/refine_plc.h"
#include "engine/refine/thin_places.h"

namespace ccdt::refine {

/// The wanted edge length of the surface at a point: at most that of the options, less at thin places
/// (`find_thin_places`). From there it grows by the distance times the grading.
///
/// Each leaf of an octree lists the places that may decide there. The octree grows where points are asked for.
class SurfaceSizes {
 public:
  SurfaceSizes(const plc::Plc& plc, const RefineOptions& options);

  double at(const Point3& p);

  /// Raises the wanted lengths of thin places to at least this.
  void limit_from_below(double least);

  /// The limit that leaves about this share of the vertices at thin places; `largest` if none does.
  double least_for(double share) const;

 private:
  struct Node {
    Point3 low;
    double side;
    std::uint32_t first = 0, count = 0;  ///< of its part of `listed_`
    std::uint32_t first_child = 0;       ///< eight in a row; 0: not split
    bool is_listed = false;
    double least = 0;  ///< the least size of its places
  };

  /// Splits the node first if it has many places.
  bool has_children(std::uint32_t node);
  /// Lists those places of the parent that may decide in the child.
  void list(std::uint32_t parent, std::uint32_t child);

  double largest_, grading_, least_ = 0;
  Box box_;                         ///< of the surface
  std::vector<SizedPoint> found_;   ///< all thin places
  std::vector<SizedPoint> places_;  ///< those that are left at the limit, in Morton order
  std::vector<Node> nodes_;         ///< the root first
  std::vector<std::uint32_t> listed_;
  std::vector<double> at_center_;  ///< working memory of `list`
};

}  // namespace ccdt::refine
