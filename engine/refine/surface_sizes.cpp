#include "engine/refine/surface_sizes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/box.h"

namespace ccdt::refine {
namespace {

/// Thin places are found for up to this times the allowed tetrahedra, because their number is only an estimate then.
constexpr double excess_of_estimate = 4;

}  // namespace

SurfaceSizes::SurfaceSizes(const plc::Plc& plc, const RefineOptions& options)
    : largest_(options.edge_length),
      grading_(options.grading),
      found_(find_thin_places(plc, options.edge_length, excess_of_estimate * options.most_tetrahedra)) {
  limit_from_below(0);
}

void SurfaceSizes::limit_from_below(double least) {
  least_ = least;
  last_size_ = largest_;
  std::vector<SizedPoint> limited = found_;
  for (SizedPoint& place : limited) place.size = std::max(place.size, least);
  RawVector<Box> places;
  RawVector<double> sizes;
  for (const auto& [point, size] : thinned(limited)) places.push_back(box_of(point)), sizes.push_back(size);
  places_ = BoxTree(std::move(places), sizes);
}

double SurfaceSizes::least_for(double share) const {
  // In a plane, edges of length l instead of s leave (s / l)^2 of the vertices.
  const auto left = [&](double least) {
    double sum = 0;
    for (const SizedPoint& place : found_) sum += std::min(1.0, place.size * place.size / (least * least));
    return sum;
  };
  const double most = share * left(least_);
  double low = least_, least = largest_;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + least);
    (left(middle) > most ? low : least) = middle;
  }
  return least;
}

double SurfaceSizes::at(const Point3& p) {
  // The length grows only with the grading, so the last one limits this one, up to rounding. Places that are asked for
  // after each other are mostly near.
  double least = std::min(largest_, (1 + 1e-12) * (last_size_ + grading_ * length(p - last_)));
  const auto lower = [&](const Box& box, double size) { return size + grading_ * std::sqrt(squared_distance(box, p)); };
  places_.any_below(least, lower, [&](const BoxTree::Item& place) {
    least = lower(place.box, place.size);
    return false;
  });
  last_ = p, last_size_ = least;
  return least;
}

}  // namespace ccdt::refine
