#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::delaunay {

/// Three directions at right angles to each other.
using Basis = std::array<Point3, 3>;

/// Space cut by planes into convex parts (a k-d tree).
class SpaceCut {
 public:
  /// Cuts space so that about as many points are in each part.
  ///
  /// \param basis  the normals of the planes
  SpaceCut(std::span<const Point3> points, std::uint32_t parts, const Basis& basis);

  /// \return  below the number of parts
  std::uint32_t part_of(const Point3& p) const {
    const Node* node = nodes_.data();
    while (node->axis < 3) node = dot(basis_[node->axis], p) < node->at ? node + 1 : nodes_.data() + node->after;
    return node->after;
  }

 private:
  /// A plane; or a part, if `axis` is 3.
  struct Node {
    std::uint32_t axis, after;  ///< of the basis; the node of the far side, or the part
    double at;
  };
  void cut(std::span<std::array<double, 3>> places, std::uint32_t parts);

  Basis basis_;
  std::vector<Node> nodes_;  ///< the near side follows its plane
  std::uint32_t part_count_ = 0;
};

}  // namespace ccdt::delaunay
