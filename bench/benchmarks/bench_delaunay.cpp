// What is measured: the Delaunay tetrahedralization of points that are in memory, from the plain array of points to the
// finished structure, on one thread; the sorting along a Hilbert curve is within, the release of the structure is not.
//
//   delaunay/ccdt/...   build_delaunay
//   delaunay/cgal/...   CGAL's Delaunay_triangulation_3 with its kernel of exact predicates, given the same points, of
//                       the very same coordinates, as a range
//
//   .../random/N        N uniformly distributed points, snapped to the grid
//   .../lattice/N       N points of a perfect face-centred lattice in random order: almost all spheres have more than
//                       four points on them, which is the common case in the mesher
//
// items_per_second counts points, "cells" the finite tetrahedra. Before anything is timed, the results of both are
// compared: the same volume and, for random points, the same number of tetrahedra (a lattice has many Delaunay
// tetrahedralizations). Repetitions are interleaved by default, so that both programs see the same machine; compare by
// ratio within one run.

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/benchmarks/point_sets.h"
#include "engine/delaunay/delaunay.h"

#ifdef CCDT_WITH_CGAL_MESHERS
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace ccdt::benchmarks {
namespace {

enum class Set { random, lattice };

const std::vector<Point3>& points_of(Set set, std::size_t n) {
  static std::map<std::pair<Set, std::size_t>, std::vector<Point3>> made;
  auto& points = made[{set, n}];
  if (points.empty()) points = set == Set::random ? random_points(n, 2005) : lattice_points(n, 2005);
  return points;
}

/// What two correct results have in common.
struct Outcome {
  std::size_t cells = 0;
  double volume = 0;

  void add_cell(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    ++cells;
    volume += dot(cross(b - a, c - a), d - a) / 6;
  }
};

struct Ccdt {
  static constexpr const char* name = "ccdt";
  using Input = std::vector<Point3>;
  using Result = Delaunay;

  static Input prepare(const std::vector<Point3>& points) { return points; }
  static Result build(const Input& input) { return build_delaunay(input); }
  static Outcome outcome(const Result& d) {
    Outcome outcome;
    for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
      const auto& v = d.cells[c].vertices;
      if (d.is_finite(c)) outcome.add_cell(d.point(v[0]), d.point(v[1]), d.point(v[2]), d.point(v[3]));
    }
    return outcome;
  }
};

#ifdef CCDT_WITH_CGAL_MESHERS
struct Cgal {
  static constexpr const char* name = "cgal";
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Input = std::vector<Kernel::Point_3>;
  using Result = CGAL::Delaunay_triangulation_3<Kernel>;

  static Input prepare(const std::vector<Point3>& points) {
    Input input;
    input.reserve(points.size());
    for (const Point3& p : points) input.emplace_back(p.x, p.y, p.z);
    return input;
  }
  static Result build(const Input& input) { return Result(input.begin(), input.end()); }
  static Outcome outcome(const Result& triangulation) {
    Outcome outcome;
    for (const auto cell : triangulation.finite_cell_handles()) {
      const auto corner = [&](int i) -> Point3 {
        const auto& p = cell->vertex(i)->point();
        return {p.x(), p.y(), p.z()};
      };
      outcome.add_cell(corner(0), corner(1), corner(2), corner(3));
    }
    return outcome;
  }
};

/// Why the results are not both right; empty if they are.
std::string find_difference(Set set, std::size_t n) {
  const auto& points = points_of(set, n);
  const Outcome ours = Ccdt::outcome(Ccdt::build(points));
  const Outcome theirs = Cgal::outcome(Cgal::build(Cgal::prepare(points)));
  if (set == Set::random && ours.cells != theirs.cells)
    return "ccdt has " + std::to_string(ours.cells) + " cells, CGAL " + std::to_string(theirs.cells);
  if (std::fabs(ours.volume - theirs.volume) > 1e-9 * theirs.volume) return "ccdt and CGAL fill different volumes";
  return {};
}
#else
/// Without CGAL: the cells must fill the convex hull, which for both sets is nearly or exactly known.
std::string find_difference(Set set, std::size_t n) {
  const Outcome ours = Ccdt::outcome(Ccdt::build(points_of(set, n)));
  const double cube = 0x1p156;
  if (ours.cells < 5 * n) return "ccdt has only " + std::to_string(ours.cells) + " cells";
  if (set == Set::random && !(ours.volume > 0.9 * cube && ours.volume <= cube)) return "ccdt does not fill the cube";
  return {};
}
#endif

/// Compared once for each set, whoever comes first.
const std::string& difference(Set set, std::size_t n) {
  static std::map<std::pair<Set, std::size_t>, std::string> found;
  const auto at = found.find({set, n});
  return at != found.end() ? at->second : found[{set, n}] = find_difference(set, n);
}

template <class Program>
void tetrahedralize(benchmark::State& state, Set set, std::size_t n) {
  if (const std::string& reason = difference(set, n); !reason.empty()) return state.SkipWithError(reason.c_str());
  const typename Program::Input input = Program::prepare(points_of(set, n));
  std::size_t cells = 0;
  for (auto _ : state) {
    std::optional<typename Program::Result> result(Program::build(input));
    state.PauseTiming();
    cells = Program::outcome(*result).cells;
    result.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(n) * static_cast<std::int64_t>(state.iterations()));
  state.counters["cells"] = static_cast<double>(cells);
}

template <class Program>
void add(Set set, std::size_t n) {
  const std::string name = std::string("delaunay/") + Program::name + (set == Set::random ? "/random/" : "/lattice/");
  benchmark::RegisterBenchmark((name + std::to_string(n)).c_str(), [set, n](benchmark::State& state) {
    tetrahedralize<Program>(state, set, n);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace ccdt::benchmarks

int main(int argc, char** argv) {
  using namespace ccdt::benchmarks;
  for (const std::size_t n : {100000, 1000000}) {
    for (const Set set : {Set::random, Set::lattice}) {
      add<Ccdt>(set, n);
#ifdef CCDT_WITH_CGAL_MESHERS
      add<Cgal>(set, n);
#endif
    }
  }
  // Before the arguments of the caller, which win.
  std::vector<std::string> defaults = {"--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=5",
                                       "--benchmark_display_aggregates_only=true"};
  std::vector<char*> arguments = {argv[0]};
  for (std::string& argument : defaults) arguments.push_back(argument.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
