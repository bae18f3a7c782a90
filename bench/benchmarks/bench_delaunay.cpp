// What is measured: the Delaunay tetrahedralization of points that are in memory, from the plain array of points to the
// finished structure, on one thread; releasing the structure is not included.
//
//   delaunay/insert/...  build_delaunay, vertex by vertex; including the sorting along a Hilbert curve
//   delaunay/wrap/...    wrap_delaunay, the paper's way: face by face in a uniform grid, which is included; it is
//                        given the ranks that decide ties, those of build_delaunay, so that both have one result
//   delaunay/cgal/...    CGAL's Delaunay_triangulation_3 with its kernel of exact predicates, given a range of the same
//                        points with the same coordinates
//   delaunay/tetgen/...  TetGen's library with the switch for silence alone; the time includes making the list of
//                        tetrahedra that it returns
//
//   .../random/N         N uniformly distributed points, snapped to the grid
//   .../lattice/N        N points of a perfect face-centered lattice in random order: almost all spheres have more than
//                        four points on them, which is the common case in the mesher
//   .../MODEL/N          the vertices of a mesh of the model, about N, those of its surface first
//   .../FILE             the same for a file given by --input
//
// "vertices" are the points, "cells" the finite tetrahedra. Before anything is timed, the results are compared: insert
// and wrap must have the same tetrahedra; the others the same volume as insert and, for random points, the same
// number of tetrahedra (the other points have many Delaunay tetrahedralizations). Compare by ratio within one run.

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/benchmarks/benchmark_main.h"
#include "bench/benchmarks/point_sets.h"
#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"

#ifdef CCDT_WITH_CGAL_MESHERS
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

#ifdef CCDT_WITH_TETGEN
#define TETLIBRARY
#include <tetgen.h>
#endif

namespace ccdt::benchmarks {
namespace {

/// Points of one kind, by size.
struct PointSet {
  std::string name;
  std::vector<std::int64_t> sizes;  ///< empty: there is only one
  std::function<std::vector<Point3>(std::int64_t size)> make;
};

/// The properties that two correct results share.
struct Outcome {
  std::size_t cells = 0;
  double volume = 0;

  void add_cell(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    ++cells;
    volume += dot(cross(b - a, c - a), d - a) / 6;
  }
};

struct Insert {
  static constexpr const char* name = "insert";
  static constexpr std::int64_t largest = 1000000;
  using Input = std::vector<Point3>;
  using Result = delaunay::Delaunay;

  static Input prepare(const std::vector<Point3>& points) { return points; }
  static Result build(const Input& input) { return delaunay::build_delaunay(input); }
  static Outcome outcome(const Result& d) {
    Outcome outcome;
    for (const auto& v : finite_cells(d)) outcome.add_cell(d.point(v[0]), d.point(v[1]), d.point(v[2]), d.point(v[3]));
    return outcome;
  }
};

struct Wrap {
  static constexpr const char* name = "wrap";
  static constexpr std::int64_t largest = 100000;  // beyond that, wrapping takes seconds
  using Input = delaunay::DelaunayVertices;
  using Result = delaunay::Delaunay;

  static Input prepare(const std::vector<Point3>& points) {
    const std::vector<std::uint32_t> ranks = delaunay::insertion_ranks(points);
    Input input;
    for (std::size_t i = 0; i < points.size(); ++i) input.push_back({points[i], ranks[i]});
    return input;
  }
  static Result build(const Input& input) { return delaunay::wrap_delaunay(input); }
  static Outcome outcome(const Result& d) { return Insert::outcome(d); }
};

#ifdef CCDT_WITH_CGAL_MESHERS
struct Cgal {
  static constexpr const char* name = "cgal";
  static constexpr std::int64_t largest = Insert::largest;
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

#endif

#ifdef CCDT_WITH_TETGEN
struct TetGen {
  static constexpr const char* name = "tetgen";
  static constexpr std::int64_t largest = Insert::largest;
  using Input = std::unique_ptr<tetgenio>;
  using Result = std::unique_ptr<tetgenio>;

  static Input prepare(const std::vector<Point3>& points) {
    auto input = std::make_unique<tetgenio>();
    input->numberofpoints = static_cast<int>(points.size());
    input->pointlist = new REAL[3 * points.size()];
    REAL* coordinate = input->pointlist;
    for (const Point3& p : points)
      for (const double value : as_array(p)) *coordinate++ = value;
    return input;
  }
  static Result build(const Input& input) {
    auto result = std::make_unique<tetgenio>();
    std::string switches = "Q";
    try {
      tetrahedralize(switches.data(), input.get(), result.get());
    } catch (int code) {
      throw MeshError("TetGen stopped with code " + std::to_string(code), {}, "");
    }
    return result;
  }
  static Outcome outcome(const Result& result) {
    Outcome outcome;
    const auto corner = [&](int v) -> Point3 {
      const REAL* p = result->pointlist + 3 * static_cast<std::ptrdiff_t>(v);
      return {p[0], p[1], p[2]};
    };
    for (int t = 0; t < result->numberoftetrahedra; ++t) {
      const int* v = result->tetrahedronlist + 4 * static_cast<std::ptrdiff_t>(t);
      outcome.add_cell(corner(v[0]), corner(v[1]), corner(v[2]), corner(v[3]));
    }
    return outcome;
  }
};
#endif

/// Points, and the result of inserting them.
struct Reference {
  std::vector<Point3> points;
  Outcome inserted;
};

/// Computed once for each set and size.
const Reference& reference(const PointSet& set, std::int64_t size) {
  static std::map<std::pair<std::string, std::int64_t>, Reference> made;
  Reference& kept = made[{set.name, size}];
  if (kept.points.empty()) {  // also after a failure, so that it fails again
    kept.points = set.make(size);
    kept.inserted = Insert::outcome(Insert::build(kept.points));
  }
  return kept;
}

/// The error of a result; empty if it is right.
template <class Program>
std::string find_fault(const PointSet& set, std::int64_t size) {
  const auto& [points, ours] = reference(set, size);
  if constexpr (std::is_same_v<Program, Insert>) {
    // Checks insertion by the approximate volume of the hull of random points; all others are compared with insertion.
    const double cube = 0x1p156, volume = ours.volume;
    const bool fills_cube = volume > 0.9 * cube && volume <= cube;
    return set.name == "random" && !fills_cube ? "it does not fill the cube" : "";
  } else if constexpr (std::is_same_v<Program, Wrap>) {
    const Tetrahedra inserted = sorted(finite_cells(delaunay::build_delaunay(points)));
    return inserted == sorted(finite_cells(Wrap::build(Wrap::prepare(points))))
               ? ""
               : "insert and wrap have different cells";
  } else {
    const Outcome theirs = Program::outcome(Program::build(Program::prepare(points)));
    if (set.name == "random" && ours.cells != theirs.cells)
      return "it has " + std::to_string(theirs.cells) + " cells, insert " + std::to_string(ours.cells);
    if (std::fabs(ours.volume - theirs.volume) > 1e-9 * ours.volume) return "it and insert fill different volumes";
    return {};
  }
}

template <class Program>
void measure(benchmark::State& state, const std::vector<Point3>& points) {
  const typename Program::Input input = Program::prepare(points);
  std::size_t cells = 0;
  for (auto _ : state) {
    std::optional<typename Program::Result> result(Program::build(input));
    state.PauseTiming();
    cells = Program::outcome(*result).cells;
    result.reset();
    state.ResumeTiming();
  }
  set_counters(state, points.size(), cells);
}

template <class Program>
void add(const PointSet& set) {
  Family family{.name = std::string("delaunay/") + Program::name + "/" + set.name,
                .sizes = set.sizes,
                .complexity = benchmark::oN,
                .find_fault = [set](std::int64_t size) { return find_fault<Program>(set, size); },
                .measure = [set](benchmark::State& state,
                                 std::int64_t size) { measure<Program>(state, reference(set, size).points); }};
  std::erase_if(family.sizes, [](std::int64_t size) { return size > Program::largest; });
  add_family(family);
}

std::vector<PointSet> point_sets(const Files& files) {
  const std::vector<std::int64_t> sizes = {1000, 3000, 10000, 30000, 100000, 300000, 1000000};
  std::vector<PointSet> sets = {
      {"random", sizes, [](std::int64_t n) { return random_points(static_cast<std::size_t>(n), 2005); }},
      {"lattice", sizes, [](std::int64_t n) { return lattice_points(static_cast<std::size_t>(n), 2005); }}};
  for (const std::string model : model_names)
    sets.push_back({model, {model_sizes.begin(), model_sizes.end()}, [model](std::int64_t size) {
                      return points_of(stages_of_model(model, false, size).delaunay);
                    }});
  for (const auto& file : files)
    sets.push_back(
        {file.filename().string(), {}, [file](std::int64_t) { return points_of(stages_of_file(file).delaunay); }});
  return sets;
}

}  // namespace

void add_benchmarks(const Files& files) {
  for (const PointSet& set : point_sets(files)) {
    add<Insert>(set);
    add<Wrap>(set);
#ifdef CCDT_WITH_CGAL_MESHERS
    add<Cgal>(set);
#endif
#ifdef CCDT_WITH_TETGEN
    add<TetGen>(set);
#endif
  }
}

}  // namespace ccdt::benchmarks
