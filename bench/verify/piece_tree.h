#pragma once

#include "bench/verify/surface.h"

namespace ccdt::verify {

/// The pieces by their bounding boxes.
class PieceTree {
 public:
  explicit PieceTree(const Surface& surface)
      : tolerance_(surface.tolerances.flat), tree_(surface.boxes_of_pieces(), surface.tolerances) {}

  /// Calls visit(piece) for all pieces whose box the box of a and b touches within the tolerance.
  template <class Visit>
  void for_each_near(const Point3& a, const Point3& b, const Visit& visit) const {
    tree_.for_each_meeting(expanded(hull(box_of(a), box_of(b)), tolerance_), visit);
  }

 private:
  double tolerance_;
  ScaledBoxTree tree_;
};

/// The position of a point relative to a piece: in its plane and near its border, or within it.
enum class PointOnPiece { off, border, within };

PointOnPiece locate_on_piece(const Surface& surface, std::uint32_t piece, const Point3& p);

}  // namespace ccdt::verify
