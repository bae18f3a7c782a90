#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>
#include <set>
#include <span>

#include "engine/base/parallel.h"
#include "engine/cores/split_by_rank.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insert_in_parts.h"
#include "engine/io/plc_files.h"
#include "engine/mesher.h"
#include "engine/surface/remesh_surface.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

// The mesh is the same, byte for byte, on any number of threads.

namespace ccdt {
namespace {

using namespace mesh_test;

constexpr std::array<unsigned, 3> several_threads = {2, 3, 8};

// ---- Delaunay tetrahedralizations

constexpr std::size_t point_count = is_sanitized ? 12000 : 40000;

std::vector<Point3> random_points(std::mt19937_64& random) {
  std::vector<Point3> points(point_count);
  for (Point3& p : points) {
    const auto coordinate = [&] { return static_cast<double>(random() >> 24); };
    p = {coordinate(), coordinate(), coordinate()};
  }
  return points;
}

/// Groups of eight vertices on a sphere, in random order.
std::vector<Point3> lattice_points(std::mt19937_64& random) {
  std::vector<Point3> points;
  const auto side = static_cast<int>(std::cbrt(point_count));
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) points.push_back({256.0 * i, 256.0 * j, 256.0 * k});
  std::ranges::shuffle(points, random);
  return points;
}

/// All but a few on one line of clusters, so that planes cut right through them.
std::vector<Point3> clustered_points(std::mt19937_64& random) {
  std::vector<Point3> points = random_points(random);
  for (std::size_t i = 100; i < points.size(); ++i) points[i] = {0x1p-20 * points[i].x, points[i].y, points[i].y + 1};
  std::ranges::sort(points, {}, [](const Point3& p) { return as_array(p); });
  for (Point3& p : points) p = {std::round(p.x), p.y, p.z};
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::ranges::shuffle(points, random);
  return points;
}

/// The cells, each with its corners sorted, in order.
std::vector<std::array<std::uint32_t, 4>> sorted_cells(const delaunay::Delaunay& d) {
  std::vector<std::array<std::uint32_t, 4>> cells;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (d.is_dead(c)) continue;
    cells.push_back(d.cells[c].vertices);
    std::ranges::sort(cells.back());
  }
  std::ranges::sort(cells);
  return cells;
}

void expect_sound(const delaunay::Delaunay& d) {
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (d.is_dead(c)) continue;
    for (std::uint32_t f = 0; f < 4; ++f)
      ASSERT_EQ(d.across(d.cells[c].neighbors[f]), delaunay::face_code(c, f)) << "cell " << c;
  }
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v)
    ASSERT_TRUE(std::ranges::count(d.cells[d.cell_at[v]].vertices, v) == 1) << "vertex " << v;
}

TEST(Threads, MakeOneDelaunayTetrahedralization) {
  std::mt19937_64 random(3);
  for (const auto& points : {random_points(random), lattice_points(random), clustered_points(random)}) {
    const auto one = with_threads(1, [&] { return delaunay::build_delaunay(points); });
    for (const unsigned threads : several_threads) {
      const auto several = with_threads(threads, [&] { return delaunay::build_delaunay(points); });
      EXPECT_TRUE(sorted_cells(one) == sorted_cells(several)) << threads << " threads";
      expect_sound(several);
    }
  }
}

// ---- Splits of cubes

TEST(Threads, LeaveVerticesThatAreTooFewForParts) {
  std::mt19937_64 random(2);
  std::vector<Point3> points = random_points(random);
  points.resize(600);
  const std::size_t first = 400;
  with_threads(2, [&] {
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(points).first(first));
    delaunay::append_vertices(d, std::span(points).subspan(first));
    std::vector<std::uint32_t> added(points.size() - first);
    std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(first));
    delaunay::InsertionMarks marks;
    delaunay::PartedInsertion parted(d, marks);
    EXPECT_EQ(parted.insert(added, {}, 0, added.size(), {}), added);
    EXPECT_EQ(d.cell_at[first], none);
  });
}

TEST(Threads, ShareOneTableOfTheSplitsOfCubes) {
  std::vector<std::array<std::uint32_t, 8>> orders;
  std::array<std::uint32_t, 8> ranks{};
  std::iota(ranks.begin(), ranks.end(), 0u);
  do orders.push_back(ranks);
  while (std::ranges::next_permutation(ranks).found);
  if (is_sanitized) orders.resize(2000);
  std::vector<std::uint8_t> kinds(orders.size());
  with_threads(4, [&] {
    parallel_for(orders.size(), 16, [&](std::size_t i) { kinds[i] = cores::kind_of_cube(orders[i]); });
    return true;
  });
  for (std::size_t i = 0; i < orders.size(); ++i) ASSERT_EQ(cores::kind_of_cube(orders[i]), kinds[i]);
  const std::set<std::uint8_t> different(kinds.begin(), kinds.end());
  EXPECT_LE(different.size(), cores::most_kinds);
  if (!is_sanitized) {
    EXPECT_EQ(different.size(), cores::most_kinds);
  }
}

// ---- Meshes

void expect_same_bytes(const TetMesh& a, const TetMesh& b) {
  EXPECT_TRUE(a.vertices == b.vertices);
  EXPECT_TRUE(a.tetrahedra == b.tetrahedra);
  EXPECT_TRUE(a.regions == b.regions);
  EXPECT_TRUE(a.faces == b.faces);
  EXPECT_TRUE(a.face_markers == b.face_markers);
  EXPECT_TRUE(a.edges == b.edges);
  EXPECT_TRUE(a.edge_markers == b.edge_markers);
  EXPECT_EQ(a.constrained_delaunay, b.constrained_delaunay);
}

/// \return  what one thread makes
MeshResult expect_one_mesh(const std::string& name, const InputPlc& input, MeshOptions options) {
  SCOPED_TRACE(name);
  options.threads = 1;
  MeshResult one = mesh_plc(input, options);
  EXPECT_FALSE(one.mesh.tetrahedra.empty());
  for (const unsigned threads : several_threads) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    options.threads = threads;
    const MeshResult several = mesh_plc(input, options);
    expect_same_bytes(one.mesh, several.mesh);
    // Vertices are inserted in another order, but otherwise several threads do what one does.
    EXPECT_TRUE(one.costs[Stage::plc].work == several.costs[Stage::plc].work);
    EXPECT_TRUE(one.costs[Stage::improve].work == several.costs[Stage::improve].work);
    EXPECT_EQ(one.counts.core_tetrahedra, several.counts.core_tetrahedra);
  }
  return one;
}

struct Case {
  std::string name;
  InputPlc input;
  double edge_length = 0;
};

std::vector<Case> cases() {
  std::mt19937 random(6);
  const double fine = is_sanitized ? 2.5 : 1.4;
  std::vector<Case> all = {{"piston", models::make_solid("piston", 2.5 * fine)},
                           {"uniform sphere", models::make_solid("sphere", 0.08 * fine), 0.08 * fine},
                           {"gridded cube", gridded_cube(is_sanitized ? 6 : 16)},
                           {"random voxels", random_voxels(3, 3, random), 0.15 * fine},
                           {"rough sphere", roughened(models::make_solid("sphere", 0.12 * fine), 0.3, random)},
                           {"cube with a turnstile", cube_with_turnstile(), 0.15 * fine}};
  if (is_sanitized) all.erase(all.begin() + 1);  // the cores of lattices have a test of their own
  if (is_sanitized || !there_are_parts()) return all;
  for (const char* part : {"turbine", "rotor", "elephant"})
    all.push_back({part, io::read_plc(folder_of_parts() / (std::string(part) + ".off"))});
  return all;
}

TEST(Threads, AreAsManyAsThereIsWorkFor) {
  const InputPlc cube = models::make_solid("cube", 1);
  const auto most_threads = [&](const MeshOptions& options) {
    unsigned most = 0;
    mesh_plc(cube, options, [&](auto...) { most = std::max(most, thread_count()); });
    return most;
  };
  EXPECT_EQ(most_threads({}), 1u);
  EXPECT_EQ(most_threads({.threads = 3}), 3u);
  EXPECT_EQ(most_threads({.edge_length = 0.1}), thread_backend::core_count());
}

TEST(Threads, MakeOneMesh) {
  for (const Case& c : cases()) {
    MeshOptions options;
    options.edge_length = c.edge_length;
    for (const DelaunayMethod method : {DelaunayMethod::core, DelaunayMethod::insert}) {
      options.delaunay = method, options.least_core = 0;
      expect_one_mesh(c.name + ", improved, " + std::string(name_of(method)), c.input, options);
    }
    options.lattice = Lattice::none;
    expect_one_mesh(c.name + ", surface alone", c.input, options);
    options.lattice = Lattice::refinement;
    options.improve.improvement = Improvement::none;
    expect_one_mesh(c.name + ", circumcenters", c.input, options);
  }
}

/// So many vertices are around the core that several threads insert these, too.
TEST(Threads, MakeOneCoreOfEachLattice) {
  const double edge_length = is_sanitized ? 0.085 : 0.06;
  const InputPlc sphere = models::make_solid("sphere", edge_length);
  for (const Lattice lattice : {Lattice::fcc, Lattice::bcc, Lattice::sc})
    for (const double grading : {0.0, 0.3}) {
      if (is_sanitized && grading == 0) continue;
      MeshOptions options;
      options.lattice = lattice, options.grading = grading;
      options.delaunay = DelaunayMethod::core, options.least_core = 0;
      const std::string name = "lattice " + std::string(name_of(lattice)) + ", grading " + std::to_string(grading);
      EXPECT_GT(expect_one_mesh(name, sphere, options).counts.core_tetrahedra, 0u) << name;
    }
}

/// Its remeshed facets are flat only within the tolerance, and follow the faces of the tetrahedralization.
TEST(Threads, MakeOneListOfFaces) {
  const auto part = folder_of_hard_parts() / "TR12J_OCC.stl";
  if (is_sanitized || !std::filesystem::exists(part)) GTEST_SKIP() << "takes " << part << ", and too long";
  MeshOptions options;
  options.lattice = Lattice::none;
  expect_one_mesh("TR12J", surface::remesh_surface(io::read_plc(part), {.edge_length = 19.51372113411484}), options);
}

/// Options with so much to improve that many changes are next to each other.
MeshOptions hard_to_improve() {
  MeshOptions options;
  options.improve.target_dihedral = 35;
  options.improve.boundary = BoundaryRule::slide;
  return options;
}

TEST(Threads, MakeOneMeshOfARefinedSurface) {
  MeshOptions options;
  options.surface = SurfaceRule::refine;
  if (!is_sanitized) expect_one_mesh("bracket", models::make_solid("bracket", 10), options);
  options.lattice = Lattice::bcc;
  expect_one_mesh("cube", cube_with_slit(), options);
  options = hard_to_improve();
  options.surface = SurfaceRule::refine;
  expect_one_mesh("much improved", models::make_solid("bracket", 10), options);
}

TEST(Threads, MakeOneMeshThatIsMuchImproved) {
  std::mt19937 random(7);
  expect_one_mesh("random voxels", random_voxels(is_sanitized ? 2 : 3, 3, random), hard_to_improve());
  expect_one_mesh("rough sphere", roughened(models::make_solid("sphere", 0.25), 0.3, random), hard_to_improve());
}

TEST(Threads, MakeOneMeshOfARemeshedSurface) {
  const double edge_length = is_sanitized ? 8 : 4;
  for (const char* solid : {"bracket", "piston"}) {
    SCOPED_TRACE(solid);
    const InputPlc input = models::make_solid(solid, 2 * edge_length);
    const auto remesh = [&] { return surface::remesh_surface(input, {.edge_length = edge_length}); };
    const InputPlc one = with_threads(1, remesh);
    for (const unsigned threads : several_threads) {
      const InputPlc several = with_threads(threads, remesh);
      EXPECT_TRUE(one.vertices == several.vertices) << threads << " threads";
      EXPECT_TRUE(one.triangles == several.triangles) << threads << " threads";
    }
    MeshOptions options;
    options.edge_length = edge_length;
    expect_one_mesh("remeshed", one, options);
  }
}

/// Under the thread sanitizer, threads pause at random, so that each repetition runs in another order.
TEST(Threads, MakeOneMeshTimeAndAgain) {
  std::mt19937 random(8);
  const std::vector<InputPlc> inputs = {random_voxels(2, 3, random), cube_with_turnstile(),
                                        models::make_solid("sphere", 0.12)};
  for (const InputPlc& input : inputs) {
    MeshOptions options;
    options.edge_length = 0.12;
    options.threads = 1;
    const MeshResult one = mesh_plc(input, options);
    options.threads = 4;
    for (int repetition = 0; repetition < 10; ++repetition) expect_same_bytes(one.mesh, mesh_plc(input, options).mesh);
  }
}

TEST(Threads, DoBothAndThrowWhatTheFirstThrows) {
  with_threads(2, [] {
    int first = 0, second = 0;
    parallel_both([&] { first = 1; }, [&] { second = 2; });
    EXPECT_EQ(first + second, 3);
    for (int repetition = 0; repetition < 100; ++repetition) {
      EXPECT_THROW(parallel_both([] { throw 1; }, [] { throw 2.5; }), int);
      EXPECT_THROW(parallel_both([] {}, [] { throw 2.5; }), double);
    }
    return true;
  });
}

TEST(Threads, StopWhenProgressThrows) {
  struct Canceled {};
  MeshOptions options;
  options.threads = 4;
  const InputPlc input = models::make_solid("piston", is_sanitized ? 5 : 2.5);
  for (const std::string_view stage : {"plc", "delaunay", "lattice", "improve"}) {
    const auto cancel = [&](std::string_view now, std::uint64_t, std::uint64_t) {
      if (now == stage) throw Canceled();
    };
    EXPECT_THROW(mesh_plc(input, options, cancel), Canceled) << stage;
  }
}

}  // namespace
}  // namespace ccdt
