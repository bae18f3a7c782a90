#include "engine/improve/insert_and_collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/base/count_work.h"
#include "engine/tets/swaps.h"

namespace ccdt::improve {
namespace {

constexpr std::size_t most_cavity_cells = 40;
constexpr int most_insertion_rounds = 3;  ///< of growing the cavity and moving the vertex

/// Finds the hull of the current cavity.
void find_hull(const CellComplex& x, const CellMarks& in_cavity, VertexCavity& cavity) {
  cavity.hull.clear();
  cavity.faces.clear();
  for (const std::uint32_t c : cavity.cells) {
    const Cell& cell = x.cell(c);
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (!x.is_wall(face_code(c, f)) && in_cavity.is_marked(cell_of(cell.neighbors[f]))) continue;
      const auto face = corners_of_face(cell.vertices, f);
      cavity.hull.push_back(face);
      cavity.faces.push_back({x.point(face[0]), x.point(face[1]), x.point(face[2])});
    }
  }
}

/// Adds the cells behind faces that would make a cell worse than `wanted` with the apex. \return false: the cavity has
/// its largest size
bool grow(const CellComplex& x, double wanted, const Point3& apex, CellMarks& in_cavity, VertexCavity& cavity) {
  // Cells that join the cavity are met later in the same loop.
  for (std::size_t i = 0; i < cavity.cells.size(); ++i) {
    const std::uint32_t c = cavity.cells[i];
    const Cell& cell = x.cell(c);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t next = cell_of(cell.neighbors[f]);
      if (x.is_wall(face_code(c, f)) || in_cavity.is_marked(next)) continue;
      const auto [p, q, r] = corners_of_face(cell.vertices, f);
      if (cell_quality(x.goal(), x.point(p), x.point(q), x.point(r), apex) >= wanted) continue;
      if (cavity.cells.size() >= most_cavity_cells) return false;
      in_cavity.mark(next);
      cavity.cells.push_back(next);
      cavity.tried.push_back(next);
    }
  }
  find_hull(x, in_cavity, cavity);
  return true;
}

Point3 rounded(const Point3& p) {
  return {std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)};
}

/// Are all vertices and edges that must stay on the hull of the cavity?
bool keeps_constraints(const CellComplex& x, const VertexCavity& cavity) {
  const auto on_hull = [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::any_of(cavity.hull, [&](const auto& face) {
      const auto has = [&](std::uint32_t v) { return std::ranges::find(face, v) != face.end(); };
      return has(a) && has(b);
    });
  };
  for (const std::uint32_t c : cavity.cells) {
    const auto& v = x.cell(c).vertices;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (!x.is_interior(v[i]) && !on_hull(v[i], v[i])) return false;
      for (std::uint32_t j = i + 1; j < 4; ++j)
        if (x.is_segment(v[i], v[j]) && !on_hull(v[i], v[j])) return false;
    }
  }
  return true;
}

/// The wanted quality of the cells around a new vertex, between that of the cell and the goal.
double wanted_quality(const QualityGoal& goal, double least) {
  return goal.objective == Objective::r ? std::max(least, 0.5 * (std::min(least, goal.inverse_r) + goal.inverse_r))
                                        : 0.5 * (least + goal.sine);
}

/// Makes the cells that remain after `gone` moves onto `end`. \return is each better than `least`?
bool join_star(const CellComplex& x, const std::vector<std::uint32_t>& star, std::uint32_t gone, std::uint32_t end,
               double least, std::vector<NewCell>& made) {
  made.clear();
  for (const std::uint32_t c : star) {
    auto vertices = x.cell(c).vertices;
    if (std::ranges::find(vertices, end) != vertices.end()) continue;
    std::ranges::replace(vertices, gone, end);
    const double quality = x.quality_of(vertices);
    if (!(quality > least)) return false;
    made.push_back({vertices, x.region(c), quality});
  }
  return true;
}

}  // namespace

bool plan_insertion(const CellComplex& x, std::uint32_t cell, double least, PlanScratch& scratch, Change& change) {
  ++work_done.changes_tried;
  auto& [marks, star, joined, cavity, move] = scratch;
  const QualityGoal& goal = x.goal();
  change.clear();
  marks.clear(x.cell_count());
  marks.mark(cell);
  cavity.cells.assign(1, cell);
  cavity.tried.assign(1, cell);
  const auto& v = x.cell(cell).vertices;
  const Point3 origin = x.point(v[0]);
  const Point3 sum = (x.point(v[1]) - origin) + (x.point(v[2]) - origin) + (x.point(v[3]) - origin);
  Point3 apex = rounded(origin + 0.25 * sum);
  double worst = 0;
  for (int round = 0; round < most_insertion_rounds; ++round) {
    const std::size_t size = cavity.cells.size();
    if (!grow(x, wanted_quality(goal, least), apex, marks, cavity)) {
      if (round == 0) return false;
      cavity.cells.resize(size);  // the hull is still theirs
      break;
    }
    worst = worst_of_star(cavity.faces, goal, apex);
    const double before = worst;
    worst = move_apex(cavity.faces, goal, {}, worst, move, apex);
    if (worst == before) break;
  }
  if (!(worst > least) || !keeps_constraints(x, cavity)) return false;
  const auto vertex = static_cast<std::uint32_t>(x.vertex_count());
  const int region = x.region(cell);
  change.new_vertex = apex;
  change.old_cells = cavity.cells;
  for (std::size_t i = 0; i < cavity.hull.size(); ++i) {
    const StarFace& face = cavity.faces[i];
    const auto [a, b, c] = cavity.hull[i];
    change.new_cells.push_back({{a, b, c, vertex}, region, cell_quality(goal, face.a, face.b, face.c, apex)});
  }
  return x.all_positive(change);
}

bool plan_collapse(const CellComplex& x, std::uint32_t cell, double least, PlanScratch& scratch, Change& change) {
  ++work_done.changes_tried;
  bool is_planned = false;
  change.clear();
  const auto corners = x.cell(cell).vertices;
  for (const std::uint32_t gone : corners) {
    if (!x.is_interior(gone)) continue;
    gather_cells(x, gone, scratch.marks, scratch.star);
    for (const std::uint32_t end : corners) {
      if (end == gone || !join_star(x, scratch.star, gone, end, least, scratch.joined)) continue;
      is_planned = true;
      change.old_cells = scratch.star;
      change.new_cells.swap(scratch.joined);
      least = tets::worst_of(change.new_cells);
    }
  }
  return is_planned;
}

}  // namespace ccdt::improve
