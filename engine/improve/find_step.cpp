#include "engine/improve/find_step.h"

#include <algorithm>
#include <limits>

#include "engine/base/count_work.h"
#include "engine/tets/swaps.h"

namespace ccdt::improve {
namespace {

/// Reconnection takes long, so it is used only for cells whose quality is this many times below the target.
constexpr double reconnection_factor = 20;

bool choose(std::uint64_t ImproveCounts::*count, Step& step) {
  step.kind = Step::Kind::change;
  step.count = count;
  return true;
}

bool find_swap(const CellComplex& x, CellId cell, StepScratch& scratch, Step& step) {
  const tets::Swap swap = plan_best_swap(x, cell, scratch.swap, step.change);
  step.space_taken = step.change.space_taken;
  if (swap == tets::Swap::none) return false;
  return choose(swap == tets::Swap::edge_removal ? &ImproveCounts::removed_edges : &ImproveCounts::removed_faces, step);
}

const Move* find_move(const Step& step, std::uint32_t vertex) {
  for (std::size_t i = 0; i < step.move_count; ++i)
    if (step.moves[i].vertex == vertex) return &step.moves[i];
  return nullptr;
}

/// The place of a vertex after the moves of the step.
Point3 place_after(const CellComplex& x, const Step& step, std::uint32_t vertex) {
  const Move* const move = find_move(step, vertex);
  return move == nullptr ? x.point(vertex) : move->place;
}

double quality_after(const CellComplex& x, const Step& step, CellId cell) {
  const auto& v = x.cell(cell).vertices;
  if (std::ranges::none_of(v, [&](std::uint32_t corner) { return find_move(step, corner); })) return x.quality(cell);
  return cell_quality(x.goal(), place_after(x, step, v[0]), place_after(x, step, v[1]), place_after(x, step, v[2]),
                      place_after(x, step, v[3]));
}

/// Finds a better place for a vertex after the other moves of the step. Interior vertices come first: those on the
/// boundary slide only if that is not enough.
bool can_move(const CellComplex& x, const StepRules& rules, std::uint32_t vertex, Effort effort, PlanScratch& scratch,
              Step& step) {
  Freedom freedom;
  if (!x.is_interior(vertex)) {
    if (effort == Effort::usual || rules.freedom.empty() || rules.freedom[vertex].dimensions == 0) return false;
    freedom = rules.freedom[vertex];
  }
  ++work_done.moves_tried;
  scratch.cells.gather_star(x, vertex);
  scratch.faces.clear();
  double worst = std::numeric_limits<double>::infinity();
  for (const CellId c : scratch.cells.cells()) {
    worst = std::min(worst, quality_after(x, step, c));
    const auto [p, q, r] = tets::corners_of_face(x.cell(c).vertices, x.place(c, vertex));
    scratch.faces.push_back({place_after(x, step, p), place_after(x, step, q), place_after(x, step, r)});
  }
  Move& move = step.moves[step.move_count];
  move.vertex = vertex;
  move.place = x.point(vertex);
  if (!(move_apex(scratch.faces, x.goal(), freedom, worst, scratch.move, move.place) > worst)) return false;
  move.star = scratch.cells.cells();
  return true;
}

bool find_moves(const CellComplex& x, const StepRules& rules, CellId cell, Effort effort, PlanScratch& scratch,
                Step& step) {
  step.move_count = 0;
  for (const std::uint32_t vertex : x.cell(cell).vertices) {
    if (!can_move(x, rules, vertex, effort, scratch, step)) continue;
    ++step.move_count;
    if (quality_after(x, step, cell) >= x.goal().good()) break;
  }
  if (step.move_count == 0) return false;
  step.kind = Step::Kind::moves;
  return true;
}

void add_vertices(const CellComplex& x, const CellSet& cells, std::vector<std::uint32_t>& vertices) {
  for (const CellId c : cells.cells())
    vertices.insert(vertices.end(), x.cell(c).vertices.begin(), x.cell(c).vertices.end());
}

bool find_reconnection(const CellComplex& x, CellId cell, ReconnectionScratch& scratch, Step& step) {
  if (!(x.quality(cell) < x.goal().first() / reconnection_factor)) return false;
  const bool is_found = plan_reconnection(x, cell, x.quality(cell), scratch, step.change);
  add_vertices(x, scratch.cells, step.far_vertices);
  return is_found && x.all_positive(step.change) && choose(&ImproveCounts::reconnected_polyhedra, step);
}

bool find_collapse(const CellComplex& x, CellId cell, PlanScratch& scratch, Step& step) {
  return plan_collapse(x, cell, x.quality(cell), scratch, step.change) && x.all_positive(step.change) &&
         choose(&ImproveCounts::collapsed_edges, step);
}

bool find_insertion(const CellComplex& x, CellId cell, PlanScratch& scratch, Step& step) {
  const bool is_found = plan_insertion(x, cell, x.quality(cell), scratch, step.change);
  add_vertices(x, scratch.cells, step.far_vertices);
  return is_found && choose(&ImproveCounts::inserted_vertices, step);
}

}  // namespace

std::array<std::uint32_t, 8> vertices_near(const CellComplex& x, CellId cell) {
  const tets::Cell& here = x.cell(cell);
  std::array<std::uint32_t, 8> all;
  for (std::uint32_t f = 0; f < 4; ++f) {
    const std::uint32_t behind = here.neighbors[f];
    all[f] = here.vertices[f];
    all[f + 4] = behind == tets::no_neighbor ? all[f] : x.apex_of(behind);
  }
  return all;
}

void find_step(const CellComplex& x, const StepRules& rules, CellId cell, bool has_moved, Effort effort,
               StepScratch& scratch, Step& step) {
  step.kind = Step::Kind::none;
  step.far_vertices.clear();
  step.space_taken = empty_box;
  const bool swaps = !has_moved && rules.improvement != Improvement::smooth;
  const bool moves = !has_moved && rules.improvement != Improvement::swap;
  const bool rest = rules.improvement == Improvement::all && effort == Effort::greatest;
  if ((swaps && find_swap(x, cell, scratch, step)) ||
      (moves && find_moves(x, rules, cell, effort, scratch.plan, step)) ||
      (rest && (find_reconnection(x, cell, scratch.reconnection, step) || find_collapse(x, cell, scratch.plan, step) ||
                find_insertion(x, cell, scratch.plan, step)))) {
    if (step.kind == Step::Kind::change) x.find_cavity(step.change, step.cavity);
  }
}

}  // namespace ccdt::improve
