#include "engine/improve/insert_vertex.h"

#include <algorithm>
#include <cmath>

#include "engine/improve/move_apex.h"

namespace ccdt {
namespace {

constexpr std::size_t most_cells = 40;  ///< in a cavity
constexpr int most_rounds = 3;          ///< of growing the cavity and moving the vertex

/// A face of the cavity's hull, as its cell inside calls it.
struct HullFace {
  std::uint32_t code;
  std::array<std::uint32_t, 3> corners;  ///< the inside is above
};

/// Cells of the complex that are marked with its last question.
struct Cavity {
  std::vector<std::uint32_t> cells;
  std::vector<HullFace> hull;
  std::vector<StarFace> faces;  ///< of the hull
};

bool is_in(const CellComplex& x, std::uint32_t cell) {
  return x.marks[cell] == x.questions;
}

void add_cell(CellComplex& x, std::uint32_t cell, Cavity& cavity) {
  x.marks[cell] = x.questions;
  cavity.cells.push_back(cell);
}

bool is_on_hull(const CellComplex& x, const Cell& cell, std::uint32_t code) {
  const std::uint32_t beyond = cell.neighbors[face_of(code)];
  return x.is_wall(code) || !is_in(x, cell_of(beyond));
}

/// The hull of the cavity as it is.
void find_hull(const CellComplex& x, Cavity& cavity) {
  cavity.hull.clear();
  for (const std::uint32_t c : cavity.cells) {
    const Cell& cell = x.cells[c];
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (!is_on_hull(x, cell, face_code(c, f))) continue;
      const auto& corner = face_corners[f];
      cavity.hull.push_back(
          {face_code(c, f), {cell.vertices[corner[0]], cell.vertices[corner[1]], cell.vertices[corner[2]]}});
    }
  }
}

/// Takes in what is behind faces that make a cell with the apex that is worth less than `wanted`.
/// \return false: the cavity is as large as it may be
bool grow(CellComplex& x, const QualityGoal& goal, double wanted, const Point3& apex, Cavity& cavity) {
  // Cells that join the cavity are met later in the same loop.
  for (std::size_t i = 0; i < cavity.cells.size(); ++i) {
    const std::uint32_t c = cavity.cells[i];
    const Cell& cell = x.cells[c];
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (x.is_wall(face_code(c, f)) || is_in(x, cell_of(cell.neighbors[f]))) continue;
      const auto& corner = face_corners[f];
      const double made = worth(goal, x.points[cell.vertices[corner[0]]], x.points[cell.vertices[corner[1]]],
                                x.points[cell.vertices[corner[2]]], apex);
      if (made >= wanted) continue;
      if (cavity.cells.size() >= most_cells) return false;
      add_cell(x, cell_of(cell.neighbors[f]), cavity);
    }
  }
  find_hull(x, cavity);
  return true;
}

Point3 rounded(const Point3& p) {
  return {std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)};
}

/// Are all vertices and edges that must stay on the cavity's hull?
bool keeps_constraints(const CellComplex& x, const Cavity& cavity) {
  const auto on_hull = [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::any_of(cavity.hull, [&](const HullFace& face) {
      const auto has = [&](std::uint32_t v) { return std::ranges::find(face.corners, v) != face.corners.end(); };
      return has(a) && has(b);
    });
  };
  for (const std::uint32_t c : cavity.cells) {
    const auto& v = x.cells[c].vertices;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (!x.is_interior(v[i]) && !on_hull(v[i], v[i])) return false;
      for (std::uint32_t j = i + 1; j < 4; ++j)
        if (x.is_segment(v[i], v[j]) && !on_hull(v[i], v[j])) return false;
    }
  }
  return true;
}

void fill_faces(const CellComplex& x, Cavity& cavity) {
  cavity.faces.clear();
  for (const HullFace& face : cavity.hull)
    cavity.faces.push_back({x.points[face.corners[0]], x.points[face.corners[1]], x.points[face.corners[2]]});
}

void plan(CellComplex& x, const QualityGoal& goal, const Cavity& cavity, const Point3& apex, Change& change) {
  const auto vertex = static_cast<std::uint32_t>(x.points.size());
  x.points.push_back(apex);
  x.cell_of_vertex.push_back(no_neighbor);
  x.changed_at.push_back(0);
  change.old_cells = cavity.cells;
  const int region = x.regions[cavity.cells[0]];
  for (const HullFace& face : cavity.hull) {
    const std::array<std::uint32_t, 4> vertices = {face.corners[0], face.corners[1], face.corners[2], vertex};
    change.new_cells.push_back({vertices, region, x.worth_of(goal, vertices)});
  }
}

/// What a cavity around the cell is wanted to be worth, between what it is and what is good enough.
double wanted_worth(const QualityGoal& goal, double least) {
  return goal.objective == Objective::r ? std::max(least, 0.5 * (std::min(least, goal.inverse_r) + goal.inverse_r))
                                        : 0.5 * (least + goal.sine);
}

}  // namespace

bool plan_insertion(CellComplex& x, const QualityGoal& goal, std::uint32_t cell, double least, Change& change) {
  thread_local Cavity cavity;
  change.clear();
  cavity.cells.clear();
  ++x.questions;
  add_cell(x, cell, cavity);
  const auto& v = x.cells[cell].vertices;
  const Point3 origin = x.points[v[0]];
  const Point3 sum = (x.points[v[1]] - origin) + (x.points[v[2]] - origin) + (x.points[v[3]] - origin);
  Point3 apex = rounded(origin + 0.25 * sum);
  double worst = 0;
  for (int round = 0; round < most_rounds; ++round) {
    if (!grow(x, goal, wanted_worth(goal, least), apex, cavity)) return false;
    fill_faces(x, cavity);
    worst = worst_of_star(cavity.faces, goal, apex);
    const double before = worst;
    worst = move_apex(cavity.faces, goal, {}, worst, apex);
    if (worst == before) break;
  }
  if (!(worst > least) || !keeps_constraints(x, cavity)) return false;
  plan(x, goal, cavity, apex, change);
  return all_positive(x, change);
}

}  // namespace ccdt
