#include "engine/improve/find_step.h"

#include <utility>

#include "engine/base/count_work.h"

namespace ccdt::improve {

void StepFinder::find(std::uint32_t cell, Effort effort, Step& step) {
  step.kind = Step::Kind::none;
  if (improvement_ != Improvement::smooth && find_swap(cell, step)) return;
  if (improvement_ != Improvement::swap) find_move(cell, 0, effort, step);
}

bool StepFinder::find_swap(std::uint32_t cell, Step& step) {
  double least = x_.quality(cell);
  step.count = nullptr;
  const auto consider = [&](bool is_better, std::uint64_t ImproveCounts::*count) {
    if (!is_better) return;
    least = worst_of(plan_.new_cells);
    step.count = count;
    std::swap(plan_, step.change);
  };
  for (std::uint32_t edge = 0; edge < 6; ++edge)
    consider(plan_edge_removal(x_, cell, edge, least, plan_), &ImproveCounts::removed_edges);
  for (std::uint32_t face = 0; face < 4; ++face)
    consider(plan_face_removal(x_, cell, face, least, plan_), &ImproveCounts::removed_faces);
  if (step.count == nullptr || !x_.all_positive(step.change)) return false;
  step.kind = Step::Kind::swap;
  return true;
}

void StepFinder::find_move(std::uint32_t cell, std::uint32_t first_corner, Effort effort, Step& step) {
  step.kind = Step::Kind::none;
  for (step.corner = first_corner; step.corner < 4; ++step.corner) {
    if (!can_move(x_.cell(cell).vertices[step.corner], effort, step)) continue;
    step.kind = Step::Kind::move;
    return;
  }
}

/// Interior vertices first: those on the boundary slide only if that is not enough.
bool StepFinder::can_move(std::uint32_t vertex, Effort effort, Step& step) {
  Freedom freedom;
  if (!x_.is_interior(vertex)) {
    if (effort == Effort::usual || freedom_.empty() || freedom_[vertex].dimensions == 0) return false;
    freedom = freedom_[vertex];
  }
  ++work_done.moves_tried;
  gather_star(x_, vertex, marks_, star_);
  const double worst = x_.worst_of(star_.cells);
  step.place = x_.point(vertex);
  if (!(move_apex(star_.faces, x_.goal(), freedom, worst, move_, step.place) > worst)) return false;
  step.star.swap(star_.cells);
  return true;
}

bool StepFinder::is_unchanged_since(std::uint64_t change_count, std::uint32_t cell) const {
  for (std::uint32_t f = 0; f < 4; ++f) {
    if (x_.changed_at(x_.cell(cell).vertices[f]) > change_count) return false;
    const std::uint32_t behind = x_.across(face_code(cell, f));
    if (behind != no_neighbor && x_.changed_at(x_.apex_of(behind)) > change_count) return false;
  }
  return true;
}

}  // namespace ccdt::improve
