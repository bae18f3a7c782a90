#pragma once

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "bench/verify/surface.h"

namespace ccdt::verify {

/// The pieces by their bounding boxes.
class PieceTree {
 public:
  explicit PieceTree(const Surface& surface);

  /// Calls visit(piece) for all pieces whose box the box of a and b touches within the tolerance.
  template <class Visit>
  void for_each_near(const Point3& a, const Point3& b, const Visit& visit) const {
    const BoostBox query = to_boost(expanded(hull(box_of(a), box_of(b)), tolerance_));
    for (auto i = tree_.qbegin(boost::geometry::index::intersects(query)); i != tree_.qend(); ++i) visit(i->second);
  }

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using BoostBox = boost::geometry::model::box<Corner>;
  using Item = std::pair<BoostBox, std::uint32_t>;
  using Tree = boost::geometry::index::rtree<Item, boost::geometry::index::quadratic<16>>;

  static BoostBox to_boost(const Box& box) {
    return {Corner(box.low.x, box.low.y, box.low.z), Corner(box.high.x, box.high.y, box.high.z)};
  }

  double tolerance_;
  Tree tree_;
};

/// Where a point lies against a piece: in its plane and near its border, or within it.
enum class PointOnPiece { off, border, within };
PointOnPiece locate_on_piece(const Surface& surface, std::uint32_t piece, const Point3& p);

/// Draws edges that lie within a facet of another plane, as the foot of a wall that stands on it, into that facet, and
/// splits edges where vertices of such lines lie on them. Then facets that touch share edges, and a facet is divided
/// where it borders on different regions.
///
/// The patch of pieces in one plane that has such a line becomes new pieces, without the edges that the input has
/// within it. Edges of the input that cross each other without a common vertex are left as they are.
void embed_lines(Surface& surface);

}  // namespace ccdt::verify
