#include "engine/improve/improve_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <random>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/portable_math.h"
#include "engine/base/sort_in_runs.h"
#include "engine/improve/find_freedom.h"
#include "engine/improve/find_step.h"
#include "engine/improve/keep_sides.h"
#include "engine/improve/split_large_cells.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/steiner/remove_steiner_vertices.h"
#include "engine/tets/shake_cells.h"

namespace ccdt::improve {

QualityGoal goal_of(const ImproveOptions& options) {
  return {options.objective, 1 / options.target_r, portable::sine(to_radians(options.target_dihedral))};
}

namespace {

using Clock = std::chrono::steady_clock;

/// A cell that is not good enough.
struct BadCell {
  double quality;
  CellId cell;
  std::uint16_t generation;    ///< version of the cell: a different one means a new cell
  std::uint64_t tried_at = 0;  ///< the number of the last change when no improvement was found
  int tries = 0;               ///< how often no improvement was found
  bool has_moved = false;      ///< its vertices have moved, but not far enough
};

/// After this many failed attempts, a cell is given up. More attempts would take 50% more time to fix one more percent
/// of the bad cells.
constexpr int most_tries = 3;

/// The mesh is changed at random around the remaining cells of lower quality, at most this many of them.
constexpr double very_bad = 0.01;
constexpr std::size_t most_shaken = 16;
/// How often this is done, and how many edges and faces are tried at each corner of a cell: more in each round, then
/// few again.
constexpr std::size_t shaking_rounds = 12;
constexpr std::array shaking_tries = {10, 20, 40};

/// How many cells are tried together: enough for many threads, few enough that most do not disturb each other.
constexpr std::size_t window_length = 128;
/// Fewer are not worth several threads.
constexpr std::size_t least_shared = 16;
/// How many cells may wait until those near them have had their turn.
constexpr std::size_t most_waiting = window_length;

/// What improvement is to do, and until when.
struct Task {
  StepRules rules;
  double time;  ///< seconds; 0: no limit
  Clock::time_point begin = Clock::now();
  const Progress& progress;

  bool time_is_up() const { return time > 0 && std::chrono::duration<double>(Clock::now() - begin).count() >= time; }
};

/// The cells that are not good enough.
struct BadCells {
  std::vector<BadCell> queue;    ///< of this pass, the worst first
  std::size_t next = 0;          ///< of the queue
  std::vector<BadCell> waiting;  ///< those that come first in the next window
  std::vector<BadCell> found;    ///< of the next pass
};

/// A cell of the window.
struct Trial {
  BadCell bad;
  std::array<std::uint32_t, 8> near;  ///< `vertices_near` it
};

/// What was found for a bad cell.
struct Attempt {
  Step step;
  Work work;
  std::uint32_t finder = 0;         ///< the thread that found it
  bool waits = false;               ///< something around it has changed since the window was filled
  std::uint64_t next_change = 0;    ///< the number of the change or move that follows the step
  std::vector<CellId> new_cells;    ///< of its change
  std::vector<CellId> worse_cells;  ///< that its moves made bad
};

/// The cells that are tried together, and what becomes of all bad cells.
struct Window {
  BadCells cells;
  ImproveCounts counts;

  std::vector<Trial> trials;
  std::uint32_t number = 0;
  std::vector<std::uint32_t> near;  ///< of each vertex: the last window with a cell close to it
  std::uint64_t begin = 0;          ///< the number of changes before
  std::vector<Box> changed_faces;   ///< around the faces that were changed since
  bool looks_for_faces = false;     ///< some steps depend on faces that are close to new ones

  // Working memory.
  std::vector<StepScratch> finders;  ///< one for each thread
  std::vector<Attempt> attempts = std::vector<Attempt>(1);
  std::vector<std::uint32_t> announced;  ///< attempts whose steps are not yet made
  std::vector<BadCell> returning;
};

bool is_bad(const CellComplex& x, CellId cell) {
  return !(x.quality(cell) >= x.goal().good());
}

bool is_stale(const CellComplex& x, const BadCell& bad) {
  return x.generation(bad.cell) != bad.generation || x.is_dead(bad.cell) || !is_bad(x, bad.cell);
}

/// Has something around the cell changed since it was last tried?
bool could_be_tried(const CellComplex& x, const BadCell& bad) {
  const auto has_changed = [&](std::uint32_t v) { return x.changed_at(v) >= bad.tried_at; };
  return std::ranges::any_of(x.cell(bad.cell).vertices, has_changed);
}

bool have_changed(const CellComplex& x, std::span<const std::uint32_t> vertices, std::uint64_t since) {
  return std::ranges::any_of(vertices, [&](std::uint32_t v) { return x.changed_at(v) > since; });
}

void add_bad(const CellComplex& x, CellId cell, std::vector<BadCell>& bad) {
  if (is_bad(x, cell)) bad.push_back({x.quality(cell), cell, x.generation(cell)});
}

/// Keeps one entry for each cell that is still bad, the one with the fewest attempts, sorted with the worst first. A
/// cell that one moved vertex made good and another made bad again has two entries.
void tidy(const CellComplex& x, std::vector<BadCell>& bad) {
  std::erase_if(bad, [&](const BadCell& b) { return is_stale(x, b); });
  for (BadCell& b : bad) b.quality = x.quality(b.cell);
  sort_in_runs(bad, [](const BadCell& a, const BadCell& b) {
    return std::tie(a.quality, a.cell, a.tries, a.tried_at) < std::tie(b.quality, b.cell, b.tries, b.tried_at);
  });
  const auto rest = std::ranges::unique(bad, {}, &BadCell::cell);
  bad.erase(rest.begin(), rest.end());
}

/// Puts a cell into the window. One close to another of the window waits, since it would probably be disturbed.
void take(const CellComplex& x, const BadCell& bad, Window& window) {
  if (is_stale(x, bad)) return;
  if (bad.tries >= most_tries || !could_be_tried(x, bad)) {
    window.cells.found.push_back(bad);
    return;
  }
  const auto near = vertices_near(x, bad.cell);
  if (std::ranges::any_of(near, [&](std::uint32_t v) { return window.near[v] == window.number; })) {
    window.cells.waiting.push_back(bad);
    return;
  }
  for (const std::uint32_t v : near) window.near[v] = window.number;
  window.trials.push_back({bad, near});
}

/// Takes the next cells to try: first those that wait, then those of the queue.
void fill_window(const CellComplex& x, Window& window) {
  BadCells& cells = window.cells;
  window.trials.clear();
  window.changed_faces.clear();
  window.begin = x.change_count();
  ++window.number;
  window.near.resize(x.vertex_count(), 0);
  window.returning.clear();
  window.returning.swap(cells.waiting);
  const auto is_open = [&] { return window.trials.size() < window_length; };
  std::size_t i = 0;
  while (i < window.returning.size() && is_open()) take(x, window.returning[i++], window);
  cells.waiting.insert(cells.waiting.end(), window.returning.begin() + static_cast<std::ptrdiff_t>(i),
                       window.returning.end());
  while (cells.next < cells.queue.size() && is_open() && cells.waiting.size() < most_waiting)
    take(x, cells.queue[cells.next++], window);
}

/// Has something that the step depends on changed since the window was filled?
bool is_disturbed(const CellComplex& x, const Step& step, const Window& window) {
  return have_changed(x, step.far_vertices, window.begin) ||
         std::ranges::any_of(window.changed_faces, [&](const Box& box) { return box.meets(step.space_taken); });
}

void find_counted(const CellComplex& x, const Task& task, const BadCell& bad, Effort effort, StepScratch& scratch,
                  Attempt& attempt) {
  attempt.work = {};
  const WorkScope scope(attempt.work, true);
  find_step(x, task.rules, bad.cell, bad.has_moved, effort, scratch, attempt.step);
}

void find_steps(const CellComplex& x, const Task& task, Effort effort, Window& window) {
  window.attempts.resize(window_length);
  std::atomic<std::size_t> next = 0;
  parallel_for(window.finders.size(), 1, [&](std::size_t f) {
    for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < window.trials.size();
         i = next.fetch_add(1, std::memory_order_relaxed)) {
      find_counted(x, task, window.trials[i].bad, effort, window.finders[f], window.attempts[i]);
      window.attempts[i].finder = static_cast<std::uint32_t>(f);
    }
  });
}

/// Does the part of a step that must be done in order.
void announce(CellComplex& x, Attempt& attempt, Window& window) {
  Step& step = attempt.step;
  if (step.kind == Step::Kind::change) {
    x.announce(step.change, step.cavity, attempt.new_cells);
    for (const tets::FaceChange& face : step.change.faces)
      window.changed_faces.push_back(hull(x.box_of_face(x.faces()[face.face]), x.box_of_face(face.corners)));
  }
  for (std::size_t i = 0; step.kind == Step::Kind::moves && i < step.move_count; ++i)
    x.announce_move(step.moves[i].vertex, step.moves[i].place, step.moves[i].star);
  attempt.next_change = x.change_count() + 1;
}

/// \param worse  gets the cells that were good before and are now bad
void make_move(CellComplex& x, const Move& move, std::vector<CellId>& worse) {
  const auto first = static_cast<std::ptrdiff_t>(worse.size());
  std::ranges::copy_if(move.star, std::back_inserter(worse), [&](CellId c) { return !is_bad(x, c); });
  x.move_vertex(move.vertex, move.place, move.star);
  worse.erase(std::remove_if(worse.begin() + first, worse.end(), [&](CellId c) { return !is_bad(x, c); }), worse.end());
}

/// Does the rest of a step.
void make_step(CellComplex& x, Attempt& attempt) {
  Step& step = attempt.step;
  work_done += attempt.work;
  if (step.kind == Step::Kind::change) x.fill_cavity(step.change, attempt.new_cells, step.cavity);
  if (step.kind != Step::Kind::moves) return;
  attempt.worse_cells.clear();
  for (std::size_t i = 0; i < step.move_count; ++i) make_move(x, step.moves[i], attempt.worse_cells);
  work_done.vertices_moved += step.move_count;
}

/// Each thread makes the steps that it found, whose cells are in its cache.
void make_announced_steps(CellComplex& x, Window& window) {
  if (window.announced.size() < least_shared) {
    for (const std::uint32_t i : window.announced) make_step(x, window.attempts[i]);
  } else {
    parallel_for(window.finders.size(), 1, [&](std::size_t f) {
      for (const std::uint32_t i : window.announced)
        if (window.attempts[i].finder == f) make_step(x, window.attempts[i]);
    });
  }
  window.announced.clear();
}

/// Counts what was done, and decides when the cell and those that became bad are tried again.
void conclude(const CellComplex& x, const Task& task, Effort effort, BadCell& bad, const Attempt& attempt,
              Window& window) {
  const Step& step = attempt.step;
  BadCells& cells = window.cells;
  if (attempt.waits) {
    cells.waiting.push_back(bad);
    return;
  }
  if (!is_empty(step.space_taken)) window.looks_for_faces = true;
  if (step.kind == Step::Kind::change) {
    ++(window.counts.*step.count);
    window.counts.facet_flips += !step.change.faces.empty();
    // The qualities are read from the change, which is still in the cache.
    for (std::size_t i = 0; i < attempt.new_cells.size(); ++i)
      if (!(step.change.new_cells[i].quality >= x.goal().good())) add_bad(x, attempt.new_cells[i], cells.found);
    return;
  }
  if (step.kind == Step::Kind::moves) {
    window.counts.moved_vertices += step.move_count;
    for (const CellId c : attempt.worse_cells) add_bad(x, c, cells.found);
    if (!is_bad(x, bad.cell)) return;
    if (effort == Effort::greatest && task.rules.improvement == Improvement::all) {
      bad.has_moved = true;
      cells.waiting.push_back(bad);
      return;
    }
  }
  bad.tried_at = attempt.next_change;
  ++bad.tries;
  bad.has_moved = false;
  cells.found.push_back(bad);
}

/// Tries the cells of the window in order. A cell that was disturbed by a change in the same window waits. So each step
/// is found in the complex as it was before the window, and several threads can find them.
void try_window(CellComplex& x, const Task& task, Effort effort, Window& window) {
  const bool is_shared = window.finders.size() > 1 && window.trials.size() >= least_shared;
  if (is_shared) find_steps(x, task, effort, window);
  for (std::uint32_t i = 0; i < window.trials.size(); ++i) {
    auto& [bad, near] = window.trials[i];
    Attempt& attempt = window.attempts[is_shared ? i : 0];
    Step& step = attempt.step;
    attempt.waits = have_changed(x, near, window.begin);
    if (!attempt.waits) {
      if (!is_shared) find_counted(x, task, bad, effort, window.finders[0], attempt);
      attempt.waits = is_disturbed(x, step, window);
    }
    if (!attempt.waits) {
      const bool is_change = step.kind == Step::Kind::change;
      if (is_shared && is_change && x.has_changed_beyond(step.cavity, window.begin)) {
        make_announced_steps(x, window);
        x.find_cavity(step.change, step.cavity);
      }
      announce(x, attempt, window);
      if (is_shared && (!is_change || step.change.keeps_surface()))
        window.announced.push_back(i);
      else
        make_step(x, attempt);
    }
    if (!is_shared) conclude(x, task, effort, bad, attempt, window);
  }
  if (!is_shared) return;
  make_announced_steps(x, window);
  for (std::size_t i = 0; i < window.trials.size(); ++i)
    conclude(x, task, effort, window.trials[i].bad, window.attempts[i], window);
}

/// Tries each bad cell once, unless nothing around it has changed since its last failed attempt. \return was anything
/// improved?
bool pass(CellComplex& x, const Task& task, Effort effort, Window& window) {
  BadCells& cells = window.cells;
  cells.queue.swap(cells.found);
  cells.found.clear();
  tidy(x, cells.queue);
  const std::uint64_t changes = x.change_count();
  cells.next = 0;
  while (cells.next < cells.queue.size() || !cells.waiting.empty()) {
    report(task.progress, "improve", cells.next, cells.queue.size());
    if (task.time_is_up()) {
      cells.found.insert(cells.found.end(), cells.waiting.begin(), cells.waiting.end());
      cells.found.insert(cells.found.end(), cells.queue.begin() + static_cast<std::ptrdiff_t>(cells.next),
                         cells.queue.end());
      cells.waiting.clear();
      break;
    }
    fill_window(x, window);
    try_window(x, task, effort, window);
    if (window.looks_for_faces) x.index_faces();
  }
  return x.change_count() != changes;
}

/// Changes the mesh at random around the worst cells. All new cells are better than the bad cell near them.
/// \return was there a very bad one?
bool shake_worst_cells(CellComplex& x, int tries, std::mt19937& random, std::vector<BadCell>& found) {
  std::vector<CellId> new_cells;
  bool any = false;
  for (std::size_t i = 0; i < std::min(most_shaken, found.size()); ++i) {
    BadCell& bad = found[i];
    if (bad.quality >= very_bad) break;
    if (is_stale(x, bad)) continue;
    any = true;
    bad.tries = 0, bad.tried_at = 0, bad.has_moved = false;
    const auto corners = x.cell(bad.cell).vertices;
    for (const std::uint32_t v : corners) shake_cells(x, v, tries, bad.quality, random, new_cells);
  }
  for (const CellId c : new_cells)
    if (!x.is_dead(c)) add_bad(x, c, found);
  return any;
}

}  // namespace

ImproveCounts improve_cells(CellComplex& x, const std::vector<Freedom>& freedom, const ImproveOptions& options,
                            const Progress& progress) {
  if (options.improvement == Improvement::none) return {};
  const Task task{{options.improvement.value_or(Improvement::all), freedom}, options.time, Clock::now(), progress};
  const Improvement improvement = task.rules.improvement;
  Window window;
  window.finders.resize(thread_count());
  ImproveCounts& counts = window.counts;
  std::vector<BadCell>& found = window.cells.found;
  found = parallel_collect<BadCell>(x.cell_count(), 16384, [&](std::size_t c, std::size_t end, auto& bad) {
    for (; c < end; ++c) add_bad(x, CellId(c), bad);
  });
  counts.bad_cells = found.size();
  const auto improve = [&](Effort effort) { return pass(x, task, effort, window); };

  for (Effort effort = Effort::usual; !found.empty() && !task.time_is_up();) {
    if (improve(effort)) continue;
    if (effort == Effort::greatest || improvement == Improvement::swap) break;
    effort = Effort::greatest;
    for (BadCell& bad : found) bad.tried_at = 0, bad.tries = 0;
  }
  std::mt19937 random{2};
  for (std::size_t round = 0; improvement == Improvement::all && round < shaking_rounds && !task.time_is_up();
       ++round) {
    tidy(x, found);
    if (!shake_worst_cells(x, shaking_tries[round % shaking_tries.size()], random, found)) break;
    while (improve(Effort::usual) && !task.time_is_up()) {
    }
    improve(Effort::greatest);
  }
  tidy(x, found);
  counts.bad_cells_left = found.size();
  if (!task.time_is_up()) {
    const auto is_given_up = [&](const BadCell& bad) { return bad.tries >= most_tries && could_be_tried(x, bad); };
    work_done.cell_tries += static_cast<std::uint64_t>(std::ranges::count_if(found, is_given_up));
    if (improvement == Improvement::all && !found.empty() && found.front().quality < very_bad)
      ++work_done.shaking_rounds;
  }
  counts.stop = found.empty() ? ImproveStop::target : task.time_is_up() ? ImproveStop::time : ImproveStop::stuck;
  return counts;
}

ImproveCounts improve_mesh(ImproveInput input, const ImproveOptions& options, std::vector<Point3>& points,
                           mesh::TetMesh& mesh, const Progress& progress) {
  // The cells are the tetrahedra. In large meshes there is no memory for both.
  release(mesh.tetrahedra);
  const std::vector<VolumeLimit> limits = volume_limits(input.plc, !mesh.regions.empty());
  keep_faces_on_sides(input.plc, points, mesh.faces, input.facet_of_face);
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
    keep_vertices_on_sides(input.plc, complex, freedom);
  }
  // First, so that improvement mends the shapes; but if large triangles were kept, most attempts would fail.
  // And last, since improvement looks at shapes alone.
  constexpr double most_mended = 0.1;  // of all cells
  const std::uint64_t split = split_large_cells(complex, limits, most_mended, progress);
  ImproveCounts counts = improve_cells(complex, freedom, options, progress);
  counts.inserted_vertices += split + split_large_cells(complex, limits, 1, progress);
  counts.removed_steiner_vertices = removed;
  note_bytes(complex.bytes());
  if (complex.change_count() > 0) mesh.constrained_delaunay = false;
  points = std::move(complex).take_mesh(mesh);
  return counts;
}

}  // namespace ccdt::improve
