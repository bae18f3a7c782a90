#include "engine/improve/improve_cells.h"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "engine/improve/insert_vertex.h"
#include "engine/improve/remove_edge.h"
#include "engine/improve/remove_faces.h"
#include "engine/improve/remove_vertex.h"
#include "engine/improve/vertex_star.h"

namespace ccdt {
namespace {

using Clock = std::chrono::steady_clock;

/// A cell that is not good enough.
struct BadCell {
  double worth;
  std::uint32_t cell;
  std::uint32_t generation;    ///< of the cell: another one there is a new cell
  std::uint64_t tried_at = 0;  ///< the number of the last change when it was tried in vain
  int tries = 0;               ///< how often that was
};

/// So often a cell is tried in vain before it is given up. More would cost half as much time again for the last one in
/// a hundred of the bad cells.
constexpr int most_tries = 3;

/// How much is tried for a cell.
enum class Effort { usual, greatest };

class Improving {
 public:
  Improving(CellComplex& x, const std::vector<Freedom>& freedom, const ImproveOptions& options)
      : x_(x),
        freedom_(freedom),
        options_(options),
        improvement_(options.improvement.value_or(Improvement::all)),
        goal_(goal_of(options)),
        begin_(Clock::now()) {}

  ImproveCounts run(const Progress& progress);

 private:
  bool is_bad(std::uint32_t cell) const { return !(x_.worths[cell] >= worth_of_goal(goal_)); }
  bool is_stale(const BadCell& bad) const {
    return x_.generations[bad.cell] != bad.generation || x_.is_dead(bad.cell) || !is_bad(bad.cell);
  }
  bool is_worth_a_try(const BadCell& bad) const {
    const auto has_changed = [&](std::uint32_t v) { return x_.changed_at[v] >= bad.tried_at; };
    return bad.tries < most_tries && std::ranges::any_of(x_.cells[bad.cell].vertices, has_changed);
  }
  bool time_is_up() const {
    return options_.time > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() >= options_.time;
  }

  void tidy(std::vector<BadCell>& bad) const;
  bool pass(Effort effort, const Progress& progress);
  bool improve(std::uint32_t cell, Effort effort);
  bool swap(std::uint32_t cell);
  bool smooth(std::uint32_t cell, Effort effort);
  bool move(std::uint32_t vertex, Effort effort);
  bool insert_or_collapse(std::uint32_t cell);
  void apply(const Change& change);
  void add_bad(std::uint32_t cell) {
    if (is_bad(cell)) found_.push_back({x_.worths[cell], cell, x_.generations[cell]});
  }

  CellComplex& x_;
  const std::vector<Freedom>& freedom_;
  const ImproveOptions& options_;
  const Improvement improvement_;
  const QualityGoal goal_;
  const Clock::time_point begin_;
  ImproveCounts counts_;
  std::vector<BadCell> queue_, found_;  ///< of this pass, worst first; for the next one

  Change plan_, best_;
  VertexStar star_;
};

ImproveCounts Improving::run(const Progress& progress) {
  for (std::uint32_t c = 0; c < x_.cells.size(); ++c) add_bad(c);
  counts_.bad_cells = found_.size();
  Effort effort = Effort::usual;
  while (!found_.empty() && !time_is_up()) {
    const bool changed = pass(effort, progress);
    if (changed) continue;
    if (effort == Effort::greatest || improvement_ == Improvement::swap) break;
    effort = Effort::greatest;
    for (BadCell& bad : found_) bad.tried_at = 0, bad.tries = 0;
  }
  tidy(found_);
  counts_.bad_cells_left = found_.size();
  counts_.stop = found_.empty() ? ImproveStop::target : time_is_up() ? ImproveStop::time : ImproveStop::stuck;
  return counts_;
}

/// Leaves one entry for each cell that is still bad, the least tried, and the worst first. A cell that a moved vertex
/// has made good and another one bad again has two.
void Improving::tidy(std::vector<BadCell>& bad) const {
  std::erase_if(bad, [&](const BadCell& b) { return is_stale(b); });
  for (BadCell& b : bad) b.worth = x_.worths[b.cell];
  std::ranges::sort(bad, [](const BadCell& a, const BadCell& b) {
    return std::tie(a.worth, a.cell, a.tries, a.tried_at) < std::tie(b.worth, b.cell, b.tries, b.tried_at);
  });
  const auto rest = std::ranges::unique(bad, {}, &BadCell::cell);
  bad.erase(rest.begin(), rest.end());
}

/// Tries each bad cell once, unless nothing around it has changed since it was tried in vain.
/// \return has anything been improved?
bool Improving::pass(Effort effort, const Progress& progress) {
  queue_.swap(found_);
  found_.clear();
  tidy(queue_);
  const std::uint64_t changes = x_.changes;
  std::uint64_t done = 0;
  for (BadCell& bad : queue_) {
    if (done++ % 256 == 0) {
      report(progress, "improve", done, queue_.size());
      if (time_is_up()) {
        found_.insert(found_.end(), queue_.begin() + static_cast<std::ptrdiff_t>(done) - 1, queue_.end());
        break;
      }
    }
    if (is_stale(bad)) continue;
    if (is_worth_a_try(bad)) {
      if (improve(bad.cell, effort) && is_stale(bad)) continue;
      bad.tried_at = x_.changes + 1;
      ++bad.tries;
    }
    found_.push_back(bad);
  }
  return x_.changes != changes;
}

bool Improving::improve(std::uint32_t cell, Effort effort) {
  const bool swaps = improvement_ != Improvement::smooth;
  const bool smooths = improvement_ != Improvement::swap;
  if (swaps && swap(cell)) return true;
  bool improved = false;
  if (smooths && smooth(cell, effort)) {
    improved = true;
    if (!is_bad(cell)) return true;
  }
  const bool everything = effort == Effort::greatest && improvement_ == Improvement::all;
  return (everything && insert_or_collapse(cell)) || improved;
}

/// The best of all swaps that a cell has part in.
bool Improving::swap(std::uint32_t cell) {
  double least = x_.worths[cell];
  std::uint64_t* count = nullptr;  // of what the best plan removes
  const auto consider = [&](bool is_better, std::uint64_t& removed) {
    if (!is_better) return;
    least = worst_of(plan_.new_cells);
    count = &removed;
    std::swap(plan_, best_);
  };
  for (std::uint32_t edge = 0; edge < 6; ++edge)
    consider(plan_edge_removal(x_, goal_, cell, edge, least, plan_), counts_.removed_edges);
  for (std::uint32_t face = 0; face < 4; ++face)
    consider(plan_face_removal(x_, goal_, cell, face, least, plan_), counts_.removed_faces);
  if (count == nullptr || !all_positive(x_, best_)) return false;
  ++*count;
  counts_.facet_flips += best_.flips.size();
  apply(best_);
  return true;
}

void Improving::apply(const Change& change) {
  for (const std::uint32_t c : apply_change(x_, change)) add_bad(c);
}

bool Improving::smooth(std::uint32_t cell, Effort effort) {
  bool moved = false;
  const auto corners = x_.cells[cell].vertices;
  for (const std::uint32_t v : corners) {
    if (!move(v, effort)) continue;
    moved = true;
    if (!is_bad(cell)) break;
  }
  return moved;
}

/// Interior vertices first: those on the boundary slide only where that was not enough.
bool Improving::move(std::uint32_t vertex, Effort effort) {
  Freedom freedom;
  if (!x_.is_interior(vertex)) {
    if (effort == Effort::usual || freedom_.empty() || freedom_[vertex].dimensions == 0) return false;
    freedom = freedom_[vertex];
  }
  gather_star(x_, vertex, star_);
  const double worst = worst_of(x_, star_.cells);
  Point3 apex = x_.points[vertex];
  if (!(move_apex(star_.faces, goal_, freedom, worst, apex) > worst)) return false;
  x_.points[vertex] = apex;
  ++x_.changes;
  ++counts_.moved_vertices;
  for (const std::uint32_t c : star_.cells) {
    const bool was_bad = is_bad(c);
    x_.worths[c] = x_.worth_of(goal_, x_.cells[c].vertices);
    note_change(x_, x_.cells[c].vertices);
    if (!was_bad) add_bad(c);
  }
  return true;
}

bool Improving::insert_or_collapse(std::uint32_t cell) {
  const double least = x_.worths[cell];
  if (plan_collapse(x_, goal_, cell, least, plan_) && all_positive(x_, plan_)) {
    ++counts_.collapsed_edges;
    apply(plan_);
    return true;
  }
  if (!plan_insertion(x_, goal_, cell, least, plan_)) return false;
  ++counts_.inserted_vertices;
  apply(plan_);
  return true;
}

}  // namespace

ImproveCounts improve_cells(CellComplex& complex, const std::vector<Freedom>& freedom, const ImproveOptions& options,
                            const Progress& progress) {
  if (options.improvement == Improvement::none) return {};
  return Improving(complex, freedom, options).run(progress);
}

}  // namespace ccdt
