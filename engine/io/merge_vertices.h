#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::io {

/// Gives equal points one index: a hash table with open addressing over a list of points. Formats that repeat a vertex
/// for every triangle would need six times the memory otherwise. 0 and -0 are equal.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Point3>& vertices);

  /// The index of the point in the list, which it joins if it is new.
  std::uint32_t index_of(Point3 point);

 private:
  void grow();
  std::size_t slot_of(const Point3& point) const;

  std::vector<Point3>& vertices_;
  std::vector<std::uint32_t> slots_;  ///< a power of two in number, at most half of them used
};

}  // namespace ccdt::io
