#include "engine/sizes/repeat_places.h"

#include <cstddef>

#include "engine/plc/period.h"

namespace ccdt::sizes {

void repeat_places(const plc::Plc& plc, double largest, double grading, std::vector<SizedPlace>& places) {
  if (plc.periodicity == plc::Periodicity::none || grading == 0) return;
  const plc::Period period = plc::period_of(plc.vertices, plc.periodicity);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!period.repeats[axis]) continue;
    const Point3 extent = period.extent_along(axis);
    const double low = as_array(period.box.low)[axis], high = as_array(period.box.high)[axis];
    for (std::size_t i = 0, count = places.size(); i < count; ++i) {
      const SizedPlace place = places[i];
      const double reach = (largest - place.size) / grading;
      if (as_array(place.box.low)[axis] - low < reach)
        places.push_back({{place.box.low + extent, place.box.high + extent}, place.size});
      if (high - as_array(place.box.high)[axis] < reach)
        places.push_back({{place.box.low - extent, place.box.high - extent}, place.size});
    }
  }
}

}  // namespace ccdt::sizes
