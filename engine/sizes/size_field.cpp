#include "engine/sizes/size_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ccdt::sizes {

SizeField::SizeField(double largest, double grading, std::span<const SizedPlace> places,
                     const BackgroundSizes* background)
    : largest_(largest), grading_(grading) {
  std::vector<SizedPlace> with_vertices;
  if (background != nullptr && !background->tetrahedra.empty()) {
    largest_ = std::min(largest, std::ranges::max(background->sizes));
    interpolated_.emplace(*background);
  } else if (background != nullptr && !background->empty()) {
    with_vertices.assign(places.begin(), places.end());
    for (std::size_t v = 0; v < background->vertices.size(); ++v)
      with_vertices.push_back({box_of(background->vertices[v]), background->sizes[v]});
    places = with_vertices;
  }
  places_ = BoxTree(
      places, [](const SizedPlace& place) { return place.box; }, [](const SizedPlace& place) { return place.size; });
}

bool SizeField::is_below(const Box& box, double bound) const {
  if (largest_ < bound) return true;
  if (interpolated_ && interpolated_->is_below(box, bound)) return true;
  const auto lower = [&](const Box& place, double size) {
    return size + grading_ * std::sqrt(squared_distance(place, box));
  };
  return places_.any_below(bound, lower, [](const BoxTree::Item&) { return true; });
}

double SizeField::at(const Point3& p, double bound) const {
  double least = std::min(largest_, bound);
  if (interpolated_) least = std::min(least, interpolated_->at(p));
  const auto lower = [&](const Box& box, double size) { return size + grading_ * std::sqrt(squared_distance(box, p)); };
  places_.any_below(least, lower, [&](const BoxTree::Item& place) {
    least = lower(place.box, place.size);
    return false;
  });
  return least;
}

}  // namespace ccdt::sizes
