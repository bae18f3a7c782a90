#include "engine/improve/split_large_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/base/errors.h"
#include "engine/improve/insert_and_collapse.h"

namespace ccdt::improve {
namespace {

/// New cells are smaller than the divided one by this factor at least; a quarter is what its center alone achieves.
constexpr double least_gain = 0.75;

/// When the mesh gets its coordinates, each one of a vertex may return to that of the input, which is half a quantum
/// away.
const double largest_move = std::sqrt(3.0) * 0.5 * DyadicGrid::quantum;

/// The largest volume that a cell can have in the units of the input.
double largest_volume(const std::array<Point3, 4>& p) {
  const Point3 ab = p[1] - p[0], ac = p[2] - p[0], ad = p[3] - p[0];
  const double twice_area =
      length(cross(ab, ac)) + length(cross(ac, ad)) + length(cross(ad, ab)) + length(cross(ac - ab, ad - ab));
  return std::fabs(dot(cross(ab, ac), ad)) / 6 + largest_move * twice_area / 6;
}

double volume_of(const CellComplex& x, const std::array<std::uint32_t, 4>& v, const Change& change) {
  std::array<Point3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = v[i] < x.vertex_count() ? x.point(v[i]) : *change.new_vertex;
  return largest_volume(p);
}

class Splitter {
 public:
  Splitter(CellComplex& x, const std::vector<VolumeLimit>& limits) : x_(x), limits_(limits) {}

  bool is_large(CellId cell) const {
    if (x_.is_dead(cell)) return false;
    const auto limit = std::ranges::find(limits_, x_.region(cell), &VolumeLimit::attribute);
    return limit != limits_.end() && volume_of(x_, x_.cell(cell).vertices, {}) > limit->volume;
  }

  /// \param made  gets the new cells
  void split(CellId cell, std::vector<CellId>& made) {
    const double most = least_gain * volume_of(x_, x_.cell(cell).vertices, {});
    const auto are_smaller = [&] {
      return std::ranges::all_of(change_.new_cells,
                                 [&](const tets::NewCell& c) { return volume_of(x_, c.vertices, change_) <= most; });
    };
    const bool is_planned = plan_split(x_, cell, false, scratch_, change_) && are_smaller();
    if (!is_planned && !plan_split(x_, cell, true, scratch_, change_))
      throw LimitError("a tetrahedron is too flat to be divided until no volume exceeds the limit of its region", {},
                       "give the region a larger volume, or mesh without limits");
    x_.apply(change_, made);
  }

 private:
  CellComplex& x_;
  const std::vector<VolumeLimit>& limits_;
  PlanScratch scratch_;
  Change change_;
};

}  // namespace

std::vector<VolumeLimit> volume_limits(const plc::Plc& plc, bool has_attributes) {
  std::vector<VolumeLimit> limits;
  for (const plc::Region& region : plc.regions) {
    const int attribute = has_attributes ? region.attribute : 0;
    const bool is_new = std::ranges::find(limits, attribute, &VolumeLimit::attribute) == limits.end();
    if (region.inside && region.largest_volume > 0 && is_new)
      limits.push_back({attribute, region.largest_volume / std::pow(plc.grid.unit, 3)});
  }
  return limits;
}

std::uint64_t split_large_cells(CellComplex& complex, const std::vector<VolumeLimit>& limits, double most_share,
                                const Progress& progress) {
  if (limits.empty()) return 0;
  Splitter splitter(complex, limits);
  std::vector<CellId> large, made;
  for (std::size_t c = 0; c < complex.cell_count(); ++c)
    if (splitter.is_large(CellId(c))) large.push_back(CellId(c));
  const auto cells = static_cast<double>(complex.cell_count() - complex.dead_count());
  if (static_cast<double>(large.size()) > most_share * cells) return 0;
  std::uint64_t count = 0;
  while (!large.empty()) {
    const CellId cell = large.back();
    large.pop_back();
    if (!splitter.is_large(cell)) continue;
    if ((++count & 0xFFF) == 0) report(progress, "improve", count, 0);
    splitter.split(cell, made);
    std::ranges::copy_if(made, std::back_inserter(large), [&](CellId c) { return splitter.is_large(c); });
  }
  return count;
}

}  // namespace ccdt::improve
