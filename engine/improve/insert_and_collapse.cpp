#include "engine/improve/insert_and_collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"
#include "engine/tets/swaps.h"

namespace ccdt::improve {
namespace {

constexpr std::size_t most_cavity_cells = 40;
constexpr int most_insertion_rounds = 3;  ///< of growing the cavity and moving the vertex

/// Lists the faces of the hull, and their points.
void list_hull(const CellComplex& x, PlanScratch& cavity) {
  cavity.hull.clear();
  cavity.faces.clear();
  cavity.cells.visit_hull(x, [&](std::uint32_t code) {
    const auto& [a, b, c] = cavity.hull.emplace_back(x.corners_of(code));
    cavity.faces.push_back({x.point(a), x.point(b), x.point(c)});
  });
}

/// The center of a cell, on the grid.
Point3 center_of(const CellComplex& x, CellId cell) {
  const auto& v = x.cell(cell).vertices;
  const Point3 origin = x.point(v[0]);
  const Point3 sum = (x.point(v[1]) - origin) + (x.point(v[2]) - origin) + (x.point(v[3]) - origin);
  const Point3 p = origin + 0.25 * sum;
  return {std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)};
}

/// Are all vertices and edges that must stay on the hull of the cavity?
bool keeps_constraints(const CellComplex& x, std::span<const CellId> cells, const std::vector<Triangle>& hull) {
  const auto is_there = [&](std::uint32_t a, std::uint32_t b) { return tets::is_on_hull(hull, a, b); };
  const auto keeps_corners = [&](CellId c) {
    return std::ranges::all_of(x.cell(c).vertices, [&](std::uint32_t v) { return x.is_interior(v) || is_there(v, v); });
  };
  return std::ranges::all_of(cells, keeps_corners) && keeps_segments(x, cells, is_there);
}

/// Plans to replace the cells of a cavity by those between its hull and a new vertex.
void plan_star(const CellComplex& x, CellId cell, const Point3& apex, std::span<const CellId> cells,
               const PlanScratch& cavity, Change& change) {
  const auto vertex = static_cast<std::uint32_t>(x.vertex_count());
  change.new_vertex = apex;
  change.old_cells.assign(cells.begin(), cells.end());
  for (std::size_t i = 0; i < cavity.hull.size(); ++i) {
    const StarFace& face = cavity.faces[i];
    const auto [a, b, c] = cavity.hull[i];
    const double quality = cell_quality(x.goal(), face.a, face.b, face.c, apex);
    change.new_cells.push_back({{a, b, c, vertex}, x.region(cell), quality});
  }
}

/// The wanted quality of the cells around a new vertex: between the bad cell's quality and the goal.
double wanted_quality(const tets::QualityGoal& goal, double least) {
  return std::max(least, 0.5 * (std::min(least, goal.first()) + goal.first()));
}

}  // namespace

bool plan_insertion(const CellComplex& x, CellId cell, double least, PlanScratch& cavity, Change& change) {
  ++work_done.changes_tried;
  const tets::QualityGoal& goal = x.goal();
  const double wanted = wanted_quality(goal, least);
  change.clear();
  cavity.cells.start(x, cell);
  Point3 apex = center_of(x, cell);
  const auto makes_a_bad_cell = [&](std::uint32_t code) {
    if (x.is_wall(code)) return false;
    const auto [p, q, r] = x.corners_of(code);
    return cell_quality(goal, x.point(p), x.point(q), x.point(r), apex) < wanted;
  };
  double worst = 0;
  std::size_t size = 1;  // of the cavity that the hull belongs to
  for (int round = 0; round < most_insertion_rounds; ++round) {
    if (!cavity.cells.grow(x, makes_a_bad_cell, 0, most_cavity_cells)) {
      if (round == 0) return false;
      break;
    }
    size = cavity.cells.cells().size();
    list_hull(x, cavity);
    const double before = worst_of_star(cavity.faces, goal, apex);
    worst = move_apex(cavity.faces, goal, {}, before, cavity.move, apex);
    if (worst == before) break;
  }
  const std::span cells = std::span(cavity.cells.cells()).first(size);
  if (!(worst > least) || !keeps_constraints(x, cells, cavity.hull)) return false;
  plan_star(x, cell, apex, cells, cavity, change);
  return x.all_positive(change);
}

bool plan_split(const CellComplex& x, CellId cell, bool is_alone, PlanScratch& cavity, Change& change) {
  change.clear();
  const Point3 apex = center_of(x, cell);
  cavity.cells.start(x, cell);
  const auto is_in_sphere = [&](std::uint32_t code) {
    if (x.is_wall(code)) return false;
    const auto& [a, b, c, d] = x.cell(tets::cell_of(x.across(code))).vertices;
    return insphere(x.point(a), x.point(b), x.point(c), x.point(d), apex) > 0;
  };
  if (!is_alone && !cavity.cells.grow(x, is_in_sphere, 0, most_cavity_cells)) return false;
  list_hull(x, cavity);
  if (!keeps_constraints(x, cavity.cells.cells(), cavity.hull)) return false;
  plan_star(x, cell, apex, cavity.cells.cells(), cavity, change);
  return x.all_positive(change);
}

bool plan_collapse(const CellComplex& x, CellId cell, double least, PlanScratch& scratch, Change& change) {
  ++work_done.changes_tried;
  bool is_planned = false;
  change.clear();
  const auto is_better = [&](tets::NewCell& made) {
    made.quality = x.quality_of(made.vertices);
    return made.quality > least;
  };
  const auto corners = x.cell(cell).vertices;
  for (const std::uint32_t gone : corners) {
    if (!x.is_interior(gone)) continue;
    scratch.cells.gather_star(x, gone);
    for (const std::uint32_t end : corners) {
      if (end == gone || !collapse_star(x, scratch.cells.cells(), gone, end, is_better, scratch.joined)) continue;
      is_planned = true;
      change.old_cells = scratch.cells.cells();
      change.new_cells.swap(scratch.joined);
      least = tets::worst_of(change.new_cells);
    }
  }
  return is_planned;
}

}  // namespace ccdt::improve
