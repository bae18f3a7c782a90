#include "engine/sizes/budget.h"

#include <algorithm>

#include "engine/sizes/triangle.h"

namespace ccdt::sizes {
namespace {

class TriangleCounter {
 public:
  TriangleCounter(const SizeField& field, double most) : walk_(field), most_(most) {}

  /// Halves the triangle until its edges have about the length wanted in its middle.
  void add(const Triangle& t) {
    if (count_ > most_) return;
    const auto [a, b, c] = longest_edge_first(t);
    const double size = walk_.at((1.0 / 3) * (a + b + c));
    if (length(b - a) <= most_edges * size) {
      // Counts equilateral triangles, but along a needle one for each edge.
      count_ += std::max(0.5, 2 / std::sqrt(3.0) * length(area_vector(t)) / (size * size));
      return;
    }
    const Point3 middle = 0.5 * (a + b);
    add({a, middle, c});
    add({middle, b, c});
  }

  double count() const { return count_; }

 private:
  static constexpr double most_edges = 2;  ///< along the longest edge of a triangle that is not halved

  SizeWalk walk_;
  double most_, count_ = 0;
};

}  // namespace

double count_triangles(const plc::Plc& plc, const SizeField& field, double most) {
  TriangleCounter counter(field, most);
  for (const auto& [a, b, c] : plc.triangles) counter.add({plc.vertices[a], plc.vertices[b], plc.vertices[c]});
  return counter.count();
}

}  // namespace ccdt::sizes
