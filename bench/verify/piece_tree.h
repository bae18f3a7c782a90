#pragma once

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "bench/verify/surface.h"

namespace ccdt::verification {

/// The pieces by their bounding boxes.
class PieceTree {
 public:
  explicit PieceTree(const Surface& surface);

  /// Calls visit(piece) for all pieces whose box the box of a and b touches within the tolerance.
  template <class Visit>
  void for_each_near(const Point3& a, const Point3& b, const Visit& visit) const {
    const Box query(
        Corner(std::min(a.x, b.x) - tolerance_, std::min(a.y, b.y) - tolerance_, std::min(a.z, b.z) - tolerance_),
        Corner(std::max(a.x, b.x) + tolerance_, std::max(a.y, b.y) + tolerance_, std::max(a.z, b.z) + tolerance_));
    for (auto i = tree_.qbegin(boost::geometry::index::intersects(query)); i != tree_.qend(); ++i) visit(i->second);
  }

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;
  using Item = std::pair<Box, std::uint32_t>;

  double tolerance_;
  boost::geometry::index::rtree<Item, boost::geometry::index::quadratic<16>> tree_;
};

enum class Place { off, border, within };

/// Where a point lies against a piece: in its plane and near its border, or within it.
Place place_of(const Surface& surface, std::uint32_t piece, const Point3& p);

}  // namespace ccdt::verification
