#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/plc/find_repeats.h"
#include "engine/plc/plc.h"
#include "engine/refine/close_segments.h"

namespace ccdt::refine {

/// The segments and facets of a periodic PLC that repeat each other, and so get the same vertices. In any other PLC,
/// each is alone.
class Copies {
 public:
  explicit Copies(const plc::Plc& plc);

  bool has_copies(std::uint32_t segment) const { return !lists_.empty() && lists_[segment] != none; }

  /// Is this segment the first one of those that repeat it?
  bool is_first(std::uint32_t segment) const {
    return !has_copies(segment) || repeats_.segments[lists_[segment]][0].segment == segment;
  }

  /// Calls visit(copy, turned) for a segment and those that repeat it.
  template <class Visit>
  void visit(std::uint32_t segment, const Visit& visit) const {
    if (!has_copies(segment)) return visit(segment, false);
    const bool turned = is_turned(segment);
    for (const plc::RepeatedSegment& copy : repeats_.segments[lists_[segment]])
      visit(copy.segment, copy.turned != turned);
  }

  /// Gives segments that repeat each other the greatest distance of all.
  void make_equal(std::vector<LeastDistances>& distances) const;

  /// The facet that gets the same vertices as this one, moved by `shift`; `none` if there is no other, or if this one
  /// is such a copy.
  struct FacetCopy {
    std::uint32_t facet = none;
    Point3 shift = {};
  };
  FacetCopy of_facet(std::uint32_t facet) const { return facets_.empty() ? FacetCopy{} : facets_[facet]; }
  bool is_copy(std::uint32_t facet) const { return !is_copy_.empty() && is_copy_[facet]; }

 private:
  bool is_turned(std::uint32_t segment) const;

  plc::Repeats repeats_;
  std::vector<std::uint32_t> lists_;  // by segment: in `repeats_.segments`
  std::vector<FacetCopy> facets_;
  std::vector<bool> is_copy_;  // by facet
};

}  // namespace ccdt::refine
