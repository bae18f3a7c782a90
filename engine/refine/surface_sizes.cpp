#include "engine/refine/surface_sizes.h"

#include <algorithm>
#include <cmath>

#include "engine/refine/thin_places.h"

namespace ccdt::refine {
namespace {

lattice::SizeTree tree_of(const std::vector<SizedPoint>& places) {
  std::vector<lattice::SizeTree::Item> items;
  items.reserve(places.size());
  for (const SizedPoint& place : places) items.push_back({box_of(place.point), place.size, 0});
  return lattice::SizeTree(items);
}

}  // namespace

SurfaceSizes::SurfaceSizes(const plc::Plc& plc, const RefineOptions& options)
    : largest_(options.edge_length),
      grading_(options.grading),
      places_(tree_of(find_thin_places(plc, options.edge_length, options.most_tetrahedra))) {}

double SurfaceSizes::at(const Point3& p) const {
  double least = largest_;
  const auto size_in = [&](const Box& box, double size) {
    return size + grading_ * std::sqrt(squared_distance(box, p));
  };
  places_.any(least, size_in, [&](const lattice::SizeTree::Item& item) {
    least = std::min(least, size_in(item.box, item.size));
    return false;
  });
  return least;
}

}  // namespace ccdt::refine
