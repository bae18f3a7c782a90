#include "engine/improve/improve_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/portable_math.h"
#include "engine/base/sort_in_runs.h"
#include "engine/improve/find_freedom.h"
#include "engine/improve/find_step.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/steiner/remove_steiner_vertices.h"
#include "engine/tets/shake_cells.h"

namespace ccdt::improve {

using tets::FaceChange;

QualityGoal goal_of(const ImproveOptions& options) {
  return {options.objective, 1 / options.target_r, portable::sine(to_radians(options.target_dihedral))};
}

namespace {

using Clock = std::chrono::steady_clock;

/// A cell that is not good enough.
struct BadCell {
  double quality;
  std::uint32_t cell;
  std::uint16_t generation;    ///< version of the cell: a different one means a new cell
  std::uint64_t tried_at = 0;  ///< the number of the last change when no improvement was found
  int tries = 0;               ///< how often no improvement was found
  bool has_moved = false;      ///< its vertices have moved, but not far enough
};

/// After this many failed attempts, a cell is given up. More attempts would cost 50% more time to fix one more percent
/// of the bad cells.
constexpr int most_tries = 3;

/// The mesh is changed at random around cells of lower quality that are left, and only around this many of them.
constexpr double very_bad = 0.01;
constexpr std::size_t most_shaken = 16;
/// How often, and how many edges and faces are tried at each corner of a cell: more in each round, then few again.
constexpr std::size_t shaking_rounds = 12;
constexpr std::array shaking_tries = {10, 20, 40};

/// A cell of the window.
struct Trial {
  BadCell bad;
  std::array<std::uint32_t, 8> near;  ///< `vertices_near` it
};

/// What was found for a bad cell.
struct Attempt {
  Step step;
  Work work;
  bool waits = false;                      ///< something around it has changed since the window was filled
  std::uint64_t next_change = 0;           ///< the number of the change or move that follows the step
  std::vector<std::uint32_t> new_cells;    ///< of its change
  std::vector<std::uint32_t> worse_cells;  ///< that its moves made bad
};

/// How many cells are tried together: enough for many threads, few enough that most do not disturb each other.
constexpr std::size_t window_length = 128;
/// Fewer are not worth the trouble of several threads.
constexpr std::size_t least_shared = 16;
/// How many cells may wait until those near them have had their turn.
constexpr std::size_t most_waiting = window_length;

class Improver {
 public:
  Improver(CellComplex& x, const std::vector<Freedom>& freedom, const ImproveOptions& options)
      : x_(x),
        options_(options),
        improvement_(options.improvement.value_or(Improvement::all)),
        begin_(Clock::now()),
        shaker_(x),
        finders_(thread_count(), StepFinder(x, freedom, improvement_)),
        attempts_(1) {}

  ImproveCounts run(const Progress& progress) {
    found_ = parallel_collect<BadCell>(x_.cell_count(), 16384, [&](std::size_t c, std::size_t end, auto& bad) {
      for (; c < end; ++c) add_bad(static_cast<std::uint32_t>(c), bad);
    });
    counts_.bad_cells = found_.size();
    Effort effort = Effort::usual;
    while (!found_.empty() && !time_is_up()) {
      const bool changed = pass(effort, progress);
      if (changed) continue;
      if (effort == Effort::greatest || improvement_ == Improvement::swap) break;
      effort = Effort::greatest;
      for (BadCell& bad : found_) bad.tried_at = 0, bad.tries = 0;
    }
    if (improvement_ == Improvement::all) shake_worst_cells(progress);
    tidy(found_);
    counts_.bad_cells_left = found_.size();
    counts_.stop = found_.empty() ? ImproveStop::target : time_is_up() ? ImproveStop::time : ImproveStop::stuck;
    return counts_;
  }

 private:
  bool is_good(double quality) const { return quality >= goal_quality(x_.goal()); }
  bool is_bad(std::uint32_t cell) const { return !is_good(x_.quality(cell)); }
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

  void add_bad(std::uint32_t cell, std::vector<BadCell>& bad) const {
    if (is_bad(cell)) bad.push_back({x_.quality(cell), cell, x_.generation(cell)});
  }

  /// Keeps one entry for each cell that is still bad, the one with the fewest attempts, sorted with the worst first. A
  /// cell that one moved vertex made good and another made bad again has two entries.
  void tidy(std::vector<BadCell>& bad) const {
    std::erase_if(bad, [&](const BadCell& b) { return is_stale(b); });
    for (BadCell& b : bad) b.quality = x_.quality(b.cell);
    sort_in_runs(bad, [](const BadCell& a, const BadCell& b) {
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
    next_ = 0;
    while (next_ < queue_.size() || !waiting_.empty()) {
      report(progress, "improve", next_, queue_.size());
      if (time_is_up()) {
        found_.insert(found_.end(), waiting_.begin(), waiting_.end());
        found_.insert(found_.end(), queue_.begin() + static_cast<std::ptrdiff_t>(next_), queue_.end());
        waiting_.clear();
        break;
      }
      fill_window();
      try_window(effort);
    }
    return x_.change_count() != changes;
  }

  /// Changes the mesh around the worst cells at random and improves it again.
  void shake_worst_cells(const Progress& progress) {
    for (std::size_t round = 0; round < shaking_rounds && !time_is_up(); ++round) {
      tidy(found_);
      if (!shake_once(shaking_tries[round % shaking_tries.size()])) return;
      while (pass(Effort::usual, progress) && !time_is_up()) {
      }
      pass(Effort::greatest, progress);
    }
  }

  /// All new cells are better than the bad cell near them. \return was there a very bad one?
  bool shake_once(int tries) {
    new_cells_.clear();
    bool any = false;
    for (std::size_t i = 0; i < std::min(most_shaken, found_.size()); ++i) {
      BadCell& bad = found_[i];
      if (bad.quality >= very_bad) break;
      if (is_stale(bad)) continue;
      any = true;
      bad.tries = 0, bad.tried_at = 0, bad.has_moved = false;
      const auto corners = x_.cell(bad.cell).vertices;
      for (const std::uint32_t v : corners) shaker_.shake(v, tries, bad.quality, new_cells_);
    }
    for (const std::uint32_t c : new_cells_)
      if (!x_.is_dead(c)) add_bad(c, found_);
    return any;
  }

  /// Takes the next cells to try: first those that wait, then those of the queue. A cell close to one that was taken
  /// before waits, since it would probably be disturbed.
  void fill_window() {
    window_.clear();
    returning_.clear();
    returning_.swap(waiting_);
    ++window_number_;
    window_near_.resize(x_.vertex_count(), 0);
    std::size_t i = 0;
    while (i < returning_.size() && window_.size() < window_length) take(returning_[i++]);
    waiting_.insert(waiting_.end(), returning_.begin() + static_cast<std::ptrdiff_t>(i), returning_.end());
    while (next_ < queue_.size() && window_.size() < window_length && waiting_.size() < most_waiting)
      take(queue_[next_++]);
  }

  void take(const BadCell& bad) {
    if (is_stale(bad)) return;
    if (!should_be_tried(bad)) {
      found_.push_back(bad);
      return;
    }
    const auto near = vertices_near(x_, bad.cell);
    if (std::ranges::any_of(near, [&](std::uint32_t v) { return window_near_[v] == window_number_; })) {
      waiting_.push_back(bad);
      return;
    }
    for (const std::uint32_t v : near) window_near_[v] = window_number_;
    window_.push_back({bad, near});
  }

  /// Tries the cells of the window in their order. One that was disturbed by a change in the same window waits. So each
  /// step is found in the complex as it was before the window, and several threads can find them.
  void try_window(Effort effort) {
    const std::uint64_t before = x_.change_count();
    changed_faces_.clear();
    if (finders_.size() > 1 && window_.size() >= least_shared) {
      try_together(effort, before);
    } else {
      try_in_turn(effort, before);
    }
    if (looks_for_faces_) x_.index_faces();
  }

  void try_in_turn(Effort effort, std::uint64_t before) {
    Attempt& attempt = attempts_[0];
    for (auto& [bad, near] : window_) {
      attempt.waits = have_changed(near, before);
      if (!attempt.waits) {
        find_step(finders_[0], bad, effort, attempt);
        attempt.waits = is_disturbed(attempt.step, before);
      }
      if (!attempt.waits) {
        announce(attempt);
        make_step(attempt);
      }
      conclude(bad, attempt, effort);
    }
  }

  /// The same on all threads.
  void try_together(Effort effort, std::uint64_t before) {
    find_steps(effort);
    for (std::uint32_t i = 0; i < window_.size(); ++i) {
      Attempt& attempt = attempts_[i];
      Step& step = attempt.step;
      attempt.waits = have_changed(window_[i].near, before) || is_disturbed(step, before);
      if (attempt.waits) continue;
      const bool is_change = step.kind == Step::Kind::change;
      if (is_change && x_.has_changed_beyond(step.cavity, before)) {
        make_announced_steps();
        x_.find_cavity(step.change, step.cavity);
      }
      announce(attempt);
      if (is_change && !step.change.keeps_surface())
        make_step(attempt);
      else
        announced_.push_back(i);
    }
    make_announced_steps();
    for (std::size_t i = 0; i < window_.size(); ++i) conclude(window_[i].bad, attempts_[i], effort);
  }

  bool have_changed(std::span<const std::uint32_t> vertices, std::uint64_t since) const {
    return std::ranges::any_of(vertices, [&](std::uint32_t v) { return x_.changed_at(v) > since; });
  }

  /// Has something farther away changed that the step was made for?
  bool is_disturbed(const Step& step, std::uint64_t since) const {
    return have_changed(step.far_vertices, since) ||
           std::ranges::any_of(changed_faces_, [&](const Box& box) { return box.meets(step.space_taken); });
  }

  void find_steps(Effort effort) {
    attempts_.resize(window_length);
    finder_of_.resize(window_length);
    std::atomic<std::size_t> next = 0;
    parallel_for(finders_.size(), 1, [&](std::size_t f) {
      for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < window_.size();
           i = next.fetch_add(1, std::memory_order_relaxed)) {
        find_step(finders_[f], window_[i].bad, effort, attempts_[i]);
        finder_of_[i] = static_cast<std::uint32_t>(f);
      }
    });
  }

  static void find_step(StepFinder& finder, const BadCell& bad, Effort effort, Attempt& attempt) {
    attempt.work = {};
    const WorkElsewhere scope(attempt.work);
    finder.find(bad.cell, bad.has_moved, effort, attempt.step);
  }

  /// Each thread makes those that it found: it has their cells at hand.
  void make_announced_steps() {
    if (announced_.size() < least_shared) {
      for (const std::uint32_t i : announced_) make_step(attempts_[i]);
    } else {
      parallel_for(finders_.size(), 1, [&](std::size_t f) {
        for (const std::uint32_t i : announced_)
          if (finder_of_[i] == f) make_step(attempts_[i]);
      });
    }
    announced_.clear();
  }

  /// Does what must be done in the order of the steps.
  void announce(Attempt& attempt) {
    Step& step = attempt.step;
    if (step.kind == Step::Kind::change) {
      x_.announce(step.change, step.cavity, attempt.new_cells);
      for (const FaceChange& face : step.change.faces)
        changed_faces_.push_back(hull(x_.box_of_face(x_.faces()[face.face]), x_.box_of_face(face.corners)));
    }
    for (std::size_t i = 0; step.kind == Step::Kind::moves && i < step.move_count; ++i) announce(step.moves[i]);
    attempt.next_change = x_.change_count() + 1;
  }

  void announce(const Move& move) {
    x_.announce_move(move.corners);
    if (!x_.is_interior(move.vertex)) x_.announce_faces(move.vertex, move.place, move.star);
  }

  /// Does the rest.
  void make_step(Attempt& attempt) {
    Step& step = attempt.step;
    work_done += attempt.work;
    if (step.kind == Step::Kind::change) x_.fill_cavity(step.change, attempt.new_cells, step.cavity);
    if (step.kind != Step::Kind::moves) return;
    attempt.worse_cells.clear();
    for (std::size_t i = 0; i < step.move_count; ++i) move(step.moves[i], attempt.worse_cells);
    work_done.vertices_moved += step.move_count;
  }

  /// \param worse  gets the cells that were good before
  void move(const Move& move, std::vector<std::uint32_t>& worse) {
    const auto first = static_cast<std::ptrdiff_t>(worse.size());
    std::ranges::copy_if(move.star, std::back_inserter(worse), [&](std::uint32_t c) { return !is_bad(c); });
    x_.move_vertex(move.vertex, move.place, move.star);
    worse.erase(std::remove_if(worse.begin() + first, worse.end(), [&](std::uint32_t c) { return !is_bad(c); }),
                worse.end());
  }

  /// Counts what was done, and decides when the cell and those that became bad are tried again.
  void conclude(BadCell& bad, const Attempt& attempt, Effort effort) {
    const Step& step = attempt.step;
    if (attempt.waits) {
      waiting_.push_back(bad);
      return;
    }
    if (!is_empty(step.space_taken)) looks_for_faces_ = true;
    if (step.kind == Step::Kind::change) {
      ++(counts_.*step.count);
      counts_.facet_flips += !step.change.faces.empty();
      // The qualities are asked of the change, whose memory is at hand.
      for (std::size_t i = 0; i < attempt.new_cells.size(); ++i)
        if (!is_good(step.change.new_cells[i].quality)) add_bad(attempt.new_cells[i], found_);
      return;
    }
    if (step.kind == Step::Kind::moves) {
      counts_.moved_vertices += step.move_count;
      for (const std::uint32_t c : attempt.worse_cells) add_bad(c, found_);
      if (!is_bad(bad.cell)) return;
      if (effort == Effort::greatest && improvement_ == Improvement::all) {
        bad.has_moved = true;
        waiting_.push_back(bad);
        return;
      }
    }
    bad.tried_at = attempt.next_change;
    ++bad.tries;
    bad.has_moved = false;
    found_.push_back(bad);
  }

  CellComplex& x_;
  const ImproveOptions& options_;
  const Improvement improvement_;
  const Clock::time_point begin_;
  tets::CellShaker shaker_;
  ImproveCounts counts_;
  std::vector<BadCell> queue_, found_;  ///< of this pass, the worst first; of the next pass
  std::size_t next_ = 0;                ///< of the queue
  std::vector<Trial> window_;           ///< those that are tried together
  std::vector<BadCell> waiting_;        ///< those that come first in the next window
  std::uint32_t window_number_ = 0;
  std::vector<std::uint32_t> window_near_;  ///< of each vertex: the last window with a cell close to it

  // Working memory.
  std::vector<StepFinder> finders_;  ///< one for each thread
  std::vector<Attempt> attempts_;
  std::vector<std::uint32_t> finder_of_;  ///< by attempt
  std::vector<Box> changed_faces_;        ///< around the faces that were changed in this window
  bool looks_for_faces_ = false;          ///< some steps depend on faces that are close to new ones
  std::vector<std::uint32_t> announced_;  ///< attempts whose steps are not yet made
  std::vector<BadCell> returning_;
  std::vector<std::uint32_t> new_cells_;
};

}  // namespace

ImproveCounts improve_cells(CellComplex& complex, const std::vector<Freedom>& freedom, const ImproveOptions& options,
                            const Progress& progress) {
  if (options.improvement == Improvement::none) return {};
  return Improver(complex, freedom, options).run(progress);
}

ImproveCounts improve_mesh(ImproveInput input, const ImproveOptions& options, std::vector<Point3>& points,
                           mesh::TetMesh& mesh, const Progress& progress) {
  // The cells are the tetrahedra. In large meshes there is no memory for both.
  release(mesh.tetrahedra);
  CellComplex complex(std::move(mesh.faces), mesh.edges, std::move(input.cells), std::move(mesh.regions),
                      std::move(points), std::move(input.facet_of_face),
                      static_cast<std::uint32_t>(input.first_interior), goal_of(options));
  std::uint64_t removed = 0;
  if (options.steiner == SteinerRule::remove) {
    const auto first_steiner = static_cast<std::uint32_t>(input.first_steiner);
    removed = steiner::remove_steiner_vertices(input.plc, first_steiner, complex, input.chains, progress);
    if (removed > 0) mesh::list_edges(input.plc, input.chains, mesh);
  }
  std::vector<Freedom> freedom;
  const bool all_slide = options.boundary == BoundaryRule::slide;
  if (options.improvement != Improvement::none && (all_slide || input.first_sliding < input.first_interior)) {
    freedom = find_freedom(input.plc, input.chains, complex.vertex_count());
    for (std::size_t v = 0; !all_slide && v < input.first_sliding; ++v) freedom[v].dimensions = 0;
  }
  ImproveCounts counts = improve_cells(complex, freedom, options, progress);
  counts.removed_steiner_vertices = removed;
  note_bytes(complex.bytes());
  if (complex.change_count() > 0) mesh.constrained_delaunay = false;
  points = std::move(complex).take_mesh(mesh);
  return counts;
}

}  // namespace ccdt::improve
