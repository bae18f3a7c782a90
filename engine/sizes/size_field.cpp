#include "engine/sizes/size_field.h"

#include <algorithm>
#include <cmath>

namespace ccdt::sizes {

SizeField::SizeField(double largest, double grading, std::span<const SizedPlace> places)
    : largest_(largest), grading_(grading) {
  places_ = BoxTree(
      places, [](const SizedPlace& place) { return place.box; }, [](const SizedPlace& place) { return place.size; });
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
