#include "engine/improve/remove_vertex.h"

#include <algorithm>

#include "engine/improve/vertex_star.h"

namespace ccdt {
namespace {

/// \return what the worst cell is worth when `gone` has moved onto `end`; as soon as it is not more than `least`, that
double worth_of_collapse(const CellComplex& x, const QualityGoal& goal, const std::vector<std::uint32_t>& star,
                         std::uint32_t gone, std::uint32_t end, double least) {
  double worst = 2;
  for (const std::uint32_t c : star) {
    auto vertices = x.cells[c].vertices;
    if (std::ranges::find(vertices, end) != vertices.end()) continue;
    std::ranges::replace(vertices, gone, end);
    const double made = x.worth_of(goal, vertices);
    if (!(made > least)) return made;
    worst = std::min(worst, made);
  }
  return worst;
}

void collapse(const CellComplex& x, const QualityGoal& goal, const std::vector<std::uint32_t>& star, std::uint32_t gone,
              std::uint32_t end, Change& change) {
  change.clear();
  change.old_cells = star;
  for (const std::uint32_t c : star) {
    auto vertices = x.cells[c].vertices;
    if (std::ranges::find(vertices, end) != vertices.end()) continue;
    std::ranges::replace(vertices, gone, end);
    change.new_cells.push_back({vertices, x.regions[c], x.worth_of(goal, vertices)});
  }
}

}  // namespace

bool plan_collapse(CellComplex& x, const QualityGoal& goal, std::uint32_t cell, double least, Change& change) {
  thread_local std::vector<std::uint32_t> star;
  bool is_planned = false;
  const auto corners = x.cells[cell].vertices;
  for (const std::uint32_t gone : corners) {
    if (!x.is_interior(gone)) continue;
    gather_cells(x, gone, star);
    for (const std::uint32_t end : corners) {
      if (end == gone) continue;
      const double worst = worth_of_collapse(x, goal, star, gone, end, least);
      if (!(worst > least)) continue;
      least = worst;
      is_planned = true;
      collapse(x, goal, star, gone, end, change);
    }
  }
  return is_planned;
}

}  // namespace ccdt
