#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/surface.h"

namespace ccdt {

/// The target edge length in space: `min(largest, min over the surface of (edge length there + grading * distance))`.
///
/// The surface is sampled at its vertices (mean length of the edges there) and the centroids of its triangles (mean of
/// their edges). The samples are the leaves of a complete binary tree of boxes, in an array.
class SizeField {
 public:
  /// Graded, or uniform when the grading is 0. In grid units.
  SizeField(const Surface& surface, double edge_length, double grading);

  /// The edge length that most of the mesh should have: as the user gave it, or the mean of the surface.
  double reference() const { return reference_; }

  /// Is the target edge length below `bound` anywhere in the box?
  bool is_below(const Box& box, double bound) const;

 private:
  struct Sample {
    Point3 place;
    double edge_length;
  };
  struct Group {
    Box box;
    double shortest;
  };

  void sort_samples(std::size_t begin, std::size_t end, std::size_t group);
  double reach(std::size_t group, const Box& box) const;

  double reference_ = 0, largest_ = 0, grading_ = 0;
  std::vector<Sample> samples_;
  std::vector<Group> groups_;  ///< the children of group g are 2g+1 and 2g+2
  std::size_t first_leaf_ = 0;
};

}  // namespace ccdt
