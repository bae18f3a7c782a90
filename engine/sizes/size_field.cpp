#include "engine/sizes/size_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/raw_vector.h"

namespace ccdt::sizes {

SizeField::SizeField(double largest, double grading, std::span<const SizedPlace> places)
    : largest_(largest), grading_(grading) {
  RawVector<Box> boxes(places.size());
  RawVector<double> sizes(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) boxes[i] = places[i].box, sizes[i] = places[i].size;
  places_ = BoxTree(std::move(boxes), sizes);
}

SizeField::SizeField(double largest, const BackgroundSizes& background)
    : largest_(std::min(largest, std::ranges::max(background.sizes))), interpolated_(background) {}

bool SizeField::is_below(const Box& box, double bound) const {
  if (largest_ < bound) return true;
  if (interpolated_) return interpolated_->is_below(box, bound);
  const auto lower = [&](const Box& place, double size) {
    return size + grading_ * std::sqrt(squared_distance(place, box));
  };
  return places_.any_below(bound, lower, [](const BoxTree::Item&) { return true; });
}

double SizeField::at(const Point3& p, double bound) const {
  double least = std::min(largest_, bound);
  const auto lower = [&](const Box& box, double size) { return size + grading_ * std::sqrt(squared_distance(box, p)); };
  places_.any_below(least, lower, [&](const BoxTree::Item& place) {
    least = lower(place.box, place.size);
    return false;
  });
  return least;
}

}  // namespace ccdt::sizes
