#include "engine/improve/improve_mesh.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/improve/find_freedom.h"
#include "engine/improve/find_step.h"
#include "engine/improve/topological_changes.h"

namespace ccdt::improve {
namespace {

using Clock = std::chrono::steady_clock;

/// A cell that is not good enough.
struct BadCell {
  double quality;
  std::uint32_t cell;
  std::uint32_t generation;    ///< version of the cell: a different one means a new cell
  std::uint64_t tried_at = 0;  ///< the number of the last change when no improvement was found
  int tries = 0;               ///< how often no improvement was found
};

/// After this many failed attempts, a cell is given up. More attempts would cost 50% more time to fix one more percent
/// of the bad cells.
constexpr int most_tries = 3;

/// A step that was found ahead of its turn.
struct EarlyStep {
  Step step;
  std::uint32_t generation = 0;    ///< of the cell
  std::uint64_t change_count = 0;  ///< when it was found
  bool is_known = false;
  Work work;
};

/// How many steps are found ahead at a time: enough for several threads, few enough that most are still valid at their
/// turn.
constexpr std::size_t most_early = 512;
/// Fewer are not worth the trouble of several threads.
constexpr std::size_t least_early = 32;

class Improver {
 public:
  Improver(CellComplex& x, const std::vector<Freedom>& freedom, const ImproveOptions& options)
      : x_(x),
        options_(options),
        improvement_(options.improvement.value_or(Improvement::all)),
        begin_(Clock::now()),
        finders_(thread_count(), StepFinder(x, freedom, improvement_)) {}

  ImproveCounts run(const Progress& progress) {
    for (std::uint32_t c = 0; c < x_.cell_count(); ++c) add_bad(c);
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

 private:
  bool is_bad(std::uint32_t cell) const { return !(x_.quality(cell) >= goal_quality(x_.goal())); }
  bool is_stale(const BadCell& bad) const {
    return x_.generation(bad.cell) != bad.generation || x_.is_dead(bad.cell) || !is_bad(bad.cell);
  }
  bool should_be_tried(const BadCell& bad) const {
    const auto has_changed = [&](std::uint32_t v) { return x_.changed_at(v) >= bad.tried_at; };
    return bad.tries < most_tries && std::ranges::any_of(x_.cell(bad.cell).vertices, has_changed);
  }
  bool time_is_up() const {
    return options_.time > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() >= options_.time;
  }

  void add_bad(std::uint32_t cell) {
    if (is_bad(cell)) found_.push_back({x_.quality(cell), cell, x_.generation(cell)});
  }

  /// Keeps one entry for each cell that is still bad, the one with the fewest attempts, sorted with the worst first. A
  /// cell that one moved vertex made good and another made bad again has two entries.
  void tidy(std::vector<BadCell>& bad) const {
    std::erase_if(bad, [&](const BadCell& b) { return is_stale(b); });
    for (BadCell& b : bad) b.quality = x_.quality(b.cell);
    std::ranges::sort(bad, [](const BadCell& a, const BadCell& b) {
      return std::tie(a.quality, a.cell, a.tries, a.tried_at) < std::tie(b.quality, b.cell, b.tries, b.tried_at);
    });
    const auto rest = std::ranges::unique(bad, {}, &BadCell::cell);
    bad.erase(rest.begin(), rest.end());
  }

  /// Tries each bad cell once, unless nothing around it has changed since its last failed attempt. \return was anything
  /// improved?
  bool pass(Effort effort, const Progress& progress) {
    queue_.swap(found_);
    found_.clear();
    tidy(queue_);
    const std::uint64_t changes = x_.change_count();
    std::uint64_t done = 0;
    for (BadCell& bad : queue_) {
      if (done % most_early == 0) find_early(done, effort);
      const EarlyStep* const early = early_.empty() ? nullptr : &early_[done % most_early];
      if (done++ % 256 == 0) {
        report(progress, "improve", done, queue_.size());
        if (time_is_up()) {
          found_.insert(found_.end(), queue_.begin() + static_cast<std::ptrdiff_t>(done) - 1, queue_.end());
          break;
        }
      }
      if (is_stale(bad)) continue;
      if (should_be_tried(bad)) {
        if (improve(bad.cell, effort, early) && is_stale(bad)) continue;
        bad.tried_at = x_.change_count() + 1;
        ++bad.tries;
      }
      found_.push_back(bad);
    }
    return x_.change_count() != changes;
  }

  /// Finds the next steps of the queue on several threads. Each is used at its turn if it is still valid then. So the
  /// steps are those that one thread finds.
  void find_early(std::size_t begin, Effort effort) {
    const std::size_t count = std::min(most_early, queue_.size() - begin);
    if (finders_.size() == 1) return;
    early_.resize(most_early);
    for (EarlyStep& early : early_) early.is_known = false;
    if (count < least_early) return;
    std::atomic<std::size_t> next = 0;
    parallel_for(finders_.size(), 1, [&](std::size_t f) {
      for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < count;
           i = next.fetch_add(1, std::memory_order_relaxed)) {
        const BadCell& bad = queue_[begin + i];
        EarlyStep& early = early_[i];
        if (is_stale(bad) || !should_be_tried(bad)) continue;
        early.work = {};
        const WorkElsewhere scope(early.work);
        early.generation = bad.generation;
        early.change_count = x_.change_count();
        early.is_known = true;
        finders_[f].find(bad.cell, effort, early.step);
      }
    });
  }

  bool improve(std::uint32_t cell, Effort effort, const EarlyStep* early) {
    const Step* step = &step_;
    if (early != nullptr && early->is_known && early->generation == x_.generation(cell) &&
        finders_[0].is_unchanged_since(early->change_count, cell)) {
      work_done += early->work;
      step = &early->step;
    } else {
      finders_[0].find(cell, effort, step_);
    }
    if (step->kind == Step::Kind::swap) {
      ++(counts_.*step->count);
      counts_.facet_flips += step->change.flips.size();
      apply(step->change);
      return true;
    }
    bool improved = false;
    while (step->kind == Step::Kind::move) {
      improved = true;
      move(cell, *step);
      if (!is_bad(cell)) return true;
      finders_[0].find_move(cell, step->corner + 1, effort, step_);
      step = &step_;
    }
    const bool everything = effort == Effort::greatest && improvement_ == Improvement::all;
    return (everything && insert_or_collapse(cell)) || improved;
  }

  void apply(const Change& change) {
    x_.apply(change, scratch_.marks, new_cells_);
    for (const std::uint32_t c : new_cells_) add_bad(c);
  }

  void move(std::uint32_t cell, const Step& step) {
    good_cells_.clear();
    std::ranges::copy_if(step.star, std::back_inserter(good_cells_), [&](std::uint32_t c) { return !is_bad(c); });
    x_.move_vertex(x_.cell(cell).vertices[step.corner], step.place, step.star);
    ++counts_.moved_vertices;
    ++work_done.vertices_moved;
    for (const std::uint32_t c : good_cells_) add_bad(c);
  }

  bool insert_or_collapse(std::uint32_t cell) {
    const double least = x_.quality(cell);
    if (plan_collapse(x_, cell, least, scratch_, plan_) && x_.all_positive(plan_)) {
      ++counts_.collapsed_edges;
      apply(plan_);
      return true;
    }
    if (!plan_insertion(x_, cell, least, scratch_, plan_)) return false;
    ++counts_.inserted_vertices;
    apply(plan_);
    return true;
  }

  CellComplex& x_;
  const ImproveOptions& options_;
  const Improvement improvement_;
  const Clock::time_point begin_;
  ImproveCounts counts_;
  std::vector<BadCell> queue_, found_;  ///< of this pass, the worst first; of the next pass

  // Working memory.
  std::vector<StepFinder> finders_;  ///< one for each thread
  std::vector<EarlyStep> early_;
  Step step_;
  Change plan_;
  PlanScratch scratch_;
  std::vector<std::uint32_t> new_cells_, good_cells_;
};

}  // namespace

ImproveCounts improve_cells(CellComplex& complex, const std::vector<Freedom>& freedom, const ImproveOptions& options,
                            const Progress& progress) {
  if (options.improvement == Improvement::none) return {};
  return Improver(complex, freedom, options).run(progress);
}

ImproveCounts improve_mesh(ImproveInput input, const ImproveOptions& options, std::vector<Point3>& points,
                           mesh::TetMesh& mesh, const Progress& progress) {
  std::vector<Freedom> freedom;
  const bool all_slide = options.boundary == BoundaryRule::slide;
  if (all_slide || input.first_sliding < input.first_interior) {
    freedom = find_freedom(input.plc, input.chains, points.size());
    for (std::size_t v = 0; !all_slide && v < input.first_sliding; ++v) freedom[v].dimensions = 0;
  }
  CellComplex complex(mesh, std::move(points), std::move(input.facet_of_face),
                      static_cast<std::uint32_t>(input.first_interior), goal_of(options));
  const ImproveCounts counts = improve_cells(complex, freedom, options, progress);
  note_bytes(complex.bytes());
  if (complex.change_count() > 0) mesh.constrained_delaunay = false;
  points = std::move(complex).take_mesh(mesh);
  return counts;
}

}  // namespace ccdt::improve
