#include "engine/improve/find_step.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/count_work.h"

namespace ccdt::improve {

using tets::no_neighbor;

std::array<std::uint32_t, 8> vertices_near(const CellComplex& x, std::uint32_t cell) {
  const Cell& here = x.cell(cell);
  std::array<std::uint32_t, 8> all;
  for (std::uint32_t f = 0; f < 4; ++f) {
    const std::uint32_t behind = here.neighbors[f];
    all[f] = here.vertices[f];
    all[f + 4] = behind == no_neighbor ? all[f] : x.apex_of(behind);
  }
  return all;
}

namespace {

/// Reconnection takes long, so it is for cells whose quality is this many times below the target.
constexpr double reconnection_factor = 20;

const Move* find_move(const Step& step, std::uint32_t vertex) {
  for (std::size_t i = 0; i < step.move_count; ++i)
    if (step.moves[i].vertex == vertex) return &step.moves[i];
  return nullptr;
}

}  // namespace

Point3 StepFinder::point_after(const Step& step, std::uint32_t vertex) const {
  const Move* const move = find_move(step, vertex);
  return move == nullptr ? x_.point(vertex) : move->place;
}

double StepFinder::quality_after(const Step& step, const std::array<std::uint32_t, 4>& v) const {
  return cell_quality(x_.goal(), point_after(step, v[0]), point_after(step, v[1]), point_after(step, v[2]),
                      point_after(step, v[3]));
}

void StepFinder::find(std::uint32_t cell, bool has_moved, Effort effort, Step& step) {
  step.kind = Step::Kind::none;
  step.far_vertices.clear();
  step.space_taken = empty_box;
  find_any(cell, has_moved, effort, step);
  if (step.kind == Step::Kind::change) x_.find_cavity(step.change, step.cavity);
}

void StepFinder::find_any(std::uint32_t cell, bool has_moved, Effort effort, Step& step) {
  if (!has_moved && improvement_ != Improvement::smooth && find_swap(cell, step)) return;
  if (!has_moved && improvement_ != Improvement::swap && find_moves(cell, effort, step)) return;
  if (improvement_ != Improvement::all || effort != Effort::greatest) return;
  if (find_reconnection(cell, step)) return;
  if (!find_collapse(cell, step)) find_insertion(cell, step);
}

bool StepFinder::find_swap(std::uint32_t cell, Step& step) {
  const tets::Swap swap = tets::plan_best_swap(x_, cell, plan_, step.change, step.space_taken);
  if (swap == tets::Swap::none) return false;
  step.kind = Step::Kind::change;
  step.count = swap == tets::Swap::edge_removal ? &ImproveCounts::removed_edges : &ImproveCounts::removed_faces;
  return true;
}

bool StepFinder::find_moves(std::uint32_t cell, Effort effort, Step& step) {
  step.move_count = 0;
  const auto& v = x_.cell(cell).vertices;
  for (const std::uint32_t vertex : v) {
    if (!can_move(vertex, effort, step)) continue;
    ++step.move_count;
    if (quality_after(step, v) >= goal_quality(x_.goal())) break;
  }
  if (step.move_count == 0) return false;
  step.kind = Step::Kind::moves;
  return true;
}

bool StepFinder::find_collapse(std::uint32_t cell, Step& step) {
  if (!plan_collapse(x_, cell, x_.quality(cell), scratch_, step.change) || !x_.all_positive(step.change)) return false;
  step.kind = Step::Kind::change;
  step.count = &ImproveCounts::collapsed_edges;
  return true;
}

bool StepFinder::find_insertion(std::uint32_t cell, Step& step) {
  const bool is_found = plan_insertion(x_, cell, x_.quality(cell), scratch_, step.change);
  for (const std::uint32_t c : scratch_.cavity.tried)
    step.far_vertices.insert(step.far_vertices.end(), x_.cell(c).vertices.begin(), x_.cell(c).vertices.end());
  if (!is_found) return false;
  step.kind = Step::Kind::change;
  step.count = &ImproveCounts::inserted_vertices;
  return true;
}

bool StepFinder::find_reconnection(std::uint32_t cell, Step& step) {
  const QualityGoal& goal = x_.goal();
  const double first_goal = goal.objective == Objective::r ? goal.inverse_r : goal.sine;
  if (!(x_.quality(cell) < first_goal / reconnection_factor)) return false;
  const bool is_found = reconnection_.plan(cell, x_.quality(cell), step.change);
  for (const std::uint32_t c : reconnection_.cells())
    step.far_vertices.insert(step.far_vertices.end(), x_.cell(c).vertices.begin(), x_.cell(c).vertices.end());
  if (!is_found || !x_.all_positive(step.change)) return false;
  step.kind = Step::Kind::change;
  step.count = &ImproveCounts::reconnected_polyhedra;
  return true;
}

/// Interior vertices first: those on the boundary slide only if that is not enough.
bool StepFinder::can_move(std::uint32_t vertex, Effort effort, Step& step) {
  Freedom freedom;
  if (!x_.is_interior(vertex)) {
    if (effort == Effort::usual || freedom_.empty() || freedom_[vertex].dimensions == 0) return false;
    freedom = freedom_[vertex];
  }
  ++work_done.moves_tried;
  const double worst = gather_moved_star(vertex, step);
  Move& move = step.moves[step.move_count];
  move.vertex = vertex;
  move.place = x_.point(vertex);
  if (!(move_apex(star_.faces, x_.goal(), freedom, worst, scratch_.move, move.place) > worst)) return false;
  move.star.swap(star_.cells);
  move.corners.clear();
  for (const std::uint32_t c : move.star)
    move.corners.insert(move.corners.end(), x_.cell(c).vertices.begin(), x_.cell(c).vertices.end());
  return true;
}

/// Gathers the star of a vertex after the moves of the step. \return the quality of its worst cell
double StepFinder::gather_moved_star(std::uint32_t vertex, const Step& step) {
  gather_star(x_, vertex, scratch_.marks, star_);
  if (step.move_count == 0) return x_.worst_of(star_.cells);
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < star_.cells.size(); ++i) {
    const std::uint32_t c = star_.cells[i];
    const auto& v = x_.cell(c).vertices;
    const bool has_moved = std::ranges::any_of(v, [&](std::uint32_t corner) { return find_move(step, corner); });
    worst = std::min(worst, has_moved ? quality_after(step, v) : x_.quality(c));
    if (!has_moved) continue;
    const auto [a, b, d] = corners_of_face(v, x_.place(c, vertex));
    star_.faces[i] = {point_after(step, a), point_after(step, b), point_after(step, d)};
  }
  return worst;
}

}  // namespace ccdt::improve
