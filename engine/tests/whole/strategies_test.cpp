#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <optional>
#include <utility>

#include "engine/geometry/predicates.h"
#include "engine/io/plc_files.h"
#include "engine/tests/front/front_stages.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

// All strategies give the same constrained Delaunay tetrahedralization: two Delaunay methods, three locators, the check
// on and off. A test that prints a line for each input.

namespace ccdt {
namespace {

using namespace mesh_test;

struct Case {
  std::string name;
  InputPlc plc;
  Lattice lattice = Lattice::none;
  double edge_length = 0;
};

/// A cube whose surface and inside are the points of a cubic lattice: all cells have eight cospherical vertices.
InputPlc cube_of_lattice_points(std::uint32_t n) {
  InputPlc plc = gridded_cube(n);
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 1; j < n; ++j)
      for (std::uint32_t k = 1; k < n; ++k)
        plc.vertices.push_back((1.0 / n) *
                               Point3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return plc;
}

std::vector<Case> small_cases() {
  std::vector<Case> cases;
  const auto add = [&](const char* name, const InputPlc& plc) {
    cases.push_back({name, plc});
    cases.push_back({std::string(name) + ", rotated", rotated(oblique, plc), Lattice::fcc});
  };
  add("Schoenhardt's polyhedron", plc_test::schoenhardt());
  add("cube with a cubic hole", cube_with_cubic_hole());
  add("cube within a cube", cube_within_cube());
  add("two cubes", two_cubes());
  add("slit", cube_with_slit());
  add("dangling facet", cube_with_dangling_facet());
  add("dangling segment", cube_with_dangling_segment());
  add("floating segment", cube_with_floating_segment());
  add("turnstile", cube_with_turnstile());
  add("two bars", two_bars());
  add("gridded plate", gridded_plate(5, 0.01));
  cases.push_back({"cubic lattice in a cube", cube_of_lattice_points(6)});
  cases.push_back({"gridded cube filled with fcc", gridded_cube(8), Lattice::fcc});
  cases.push_back({"gridded cube filled with sc", gridded_cube(8), Lattice::sc});
  cases.push_back({"gridded cube, refined", gridded_cube(8), Lattice::refinement});
  cases.push_back({"rotated gridded cube, refined", rotated(oblique, gridded_cube(6)), Lattice::refinement, 0.1});
  cases.push_back({"antiprism on a sphere", twisted_prism(12, -0.5)});
  return cases;
}

std::vector<Case> random_cases() {
  std::vector<Case> cases;
  std::mt19937 random(5);
  for (int i = 0; i < 3; ++i) {
    const std::string number = " " + std::to_string(i);
    const InputPlc voxels = random_voxels(3, 2 + i % 2, random);
    cases.push_back({"random voxels" + number, voxels, Lattice::bcc, 0.5});
    cases.push_back({"random voxels in perspective" + number, in_perspective(voxels, 3)});
    cases.push_back({"random convex" + number, random_convex(24, random)});
    cases.push_back(
        {"rough sphere" + number, roughened(models::make_solid("sphere", 0.35), 0.3, random), Lattice::fcc});
    cases.push_back({"rough sphere" + number + ", refined", cases.back().plc, Lattice::refinement});
  }
  return cases;
}

/// The models of the paper, and real surfaces where there are any.
std::vector<Case> part_cases() {
  std::vector<Case> cases;
  for (const char* name : {"piston", "bracket", "stepping-pole"}) {
    cases.push_back({name, models::make_solid(name, 6), Lattice::fcc});
    cases.push_back({std::string(name) + ", refined", models::make_solid(name, 6), Lattice::refinement});
    cases.push_back({std::string(name) + ", surface alone", models::make_solid(name, 8)});
  }
  if (!there_are_parts()) return cases;
  for (const char* name : {"anchor", "cube-meshed", "fandisk", "handle", "joint", "pinion", "rotor"})
    cases.push_back({name, io::read_plc(folder_of_parts() / (std::string(name) + ".off")), Lattice::none});
  for (const char* name : {"anchor", "joint", "elephant"})
    cases.push_back(
        {std::string(name) + ", filled", io::read_plc(folder_of_parts() / (std::string(name) + ".off")), Lattice::fcc});
  return cases;
}

/// Brute force over all vertices: the cell above a face (below it, if `side` is -1) is made with the vertex whose
/// sphere holds no other vertex of that side.
std::optional<std::uint32_t> apex_of(const std::array<VertexId, 3>& face, int side, const delaunay::Delaunay& d) {
  const auto& [a, b, c] = face;
  std::optional<std::uint32_t> best;
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
    if (v == a || v == b || v == c || orient3d(d.point(a), d.point(b), d.point(c), d.point(v)) != side) continue;
    if (best && insphere_perturbed(d.point(a), d.point(b), d.point(c), d.point(*best), d.point(v),
                                   {d.vertices[a].rank, d.vertices[b].rank, d.vertices[c].rank, d.vertices[*best].rank,
                                    d.vertices[v].rank}) != side)
      continue;
    best = v;
  }
  return best;
}

/// Is the face Delaunay? It is if the sphere of the cell on one side of it holds no vertex of the other side, nor one
/// in its plane. Asks no tetrahedralization.
bool is_delaunay_by_brute_force(const std::array<VertexId, 3>& face, const delaunay::Delaunay& d) {
  const auto& [a, b, c] = face;
  const int side = apex_of(face, 1, d) ? 1 : -1;
  const std::uint32_t apex = *apex_of(face, side, d);
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
    if (v == a || v == b || v == c || v == apex) continue;
    if (insphere_perturbed(d.point(a), d.point(b), d.point(c), d.point(apex), d.point(v),
                           {d.vertices[a].rank, d.vertices[b].rank, d.vertices[c].rank, d.vertices[apex].rank,
                            d.vertices[v].rank}) == side)
      return false;
  }
  return true;
}

/// Compares the reported numbers of faces with an independent count.
void expect_right_face_counts(const Case& c, const MeshCounts& counts) {
  if (c.lattice != Lattice::none) return;  // without interior vertices the stages are made again in three lines
  const Stages stages(c.plc);
  std::uint64_t undelaunay = 0;
  for (std::size_t i = 0; i < stages.facets.triangles.size(); ++i) {
    const bool is_delaunay = is_delaunay_by_brute_force(stages.facets.triangles[i], stages.delaunay);
    EXPECT_EQ(stages.codes[i] != delaunay::no_neighbor, is_delaunay) << "face " << i;
    undelaunay += !is_delaunay;
  }
  EXPECT_EQ(counts.faces, stages.facets.triangles.size());
  EXPECT_EQ(counts.undelaunay_faces, undelaunay);
}

/// FNV-1a over the sorted tetrahedra and the bits of the coordinates: equal on every machine and by every compiler.
std::uint64_t hash_of(const TetMesh& mesh) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&hash](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (word >> (8 * byte) & 0xFFu)) * 0x100000001B3u;
  };
  std::vector<std::array<std::uint32_t, 4>> cells = mesh.tetrahedra;
  for (auto& cell : cells) std::ranges::sort(cell);
  std::ranges::sort(cells);
  for (const auto& cell : cells)
    for (const std::uint32_t v : cell) add(v);
  for (const Point3& p : mesh.vertices)
    for (const double x : {p.x, p.y, p.z}) add(std::bit_cast<std::uint64_t>(x));
  return hash;
}

MeshResult expect_one_set_of_tetrahedra(const Case& c) {
  std::optional<MeshResult> first;
  for (const DelaunayMethod method : {DelaunayMethod::insert, DelaunayMethod::core, DelaunayMethod::wrap}) {
    for (const LocatorKind locator : {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity}) {
      for (const bool check : {true, false}) {
        SCOPED_TRACE("delaunay " + std::to_string(static_cast<int>(method)) + ", locator " +
                     std::to_string(static_cast<int>(locator)) + ", check " + std::to_string(check));
        MeshOptions options;
        options.delaunay = method, options.least_core = 0;
        options.visibility = method == DelaunayMethod::wrap ? Visibility::faces : Visibility::centroid;
        options.locator = locator;
        options.face_protection = check;
        options.lattice = c.lattice;
        options.edge_length = c.edge_length;
        options.improve.improvement = Improvement::none;
        options.improve.steiner = SteinerRule::keep;
        MeshResult result = mesh_plc(c.plc, options);
        if (!first) {
          first = std::move(result);
          continue;
        }
        expect_same_cells(first->mesh, result.mesh);
        EXPECT_EQ(first->counts.faces, result.counts.faces);
        EXPECT_EQ(first->counts.undelaunay_faces, result.counts.undelaunay_faces);
      }
    }
  }
  return std::move(*first);
}

TEST(Strategies, FindOneSetOfTetrahedraAndTheRightNumbersOfFaces) {
  std::vector<Case> cases = small_cases();
  const auto add = [&](const std::vector<Case>& more) { cases.insert(cases.end(), more.begin(), more.end()); };
  add(random_cases());
  if (!is_sanitized) add(part_cases());  // the small ones pass the same code, in a tenth of the time
  ASSERT_GE(cases.size(), 25u);
  std::printf("%-38s %9s %11s %7s %11s %16s\n", "input", "vertices", "tetrahedra", "faces", "undelaunay", "hash");
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const MeshResult result = expect_one_set_of_tetrahedra(c);
    expect_verified(c.plc, result.mesh);
    expect_right_face_counts(c, result.counts);
    std::printf("%-38s %9zu %11zu %7zu %11zu %016llx\n", c.name.c_str(), result.mesh.vertices.size(),
                result.mesh.tetrahedra.size(), static_cast<std::size_t>(result.counts.faces),
                static_cast<std::size_t>(result.counts.undelaunay_faces),
                static_cast<unsigned long long>(hash_of(result.mesh)));
  }
}

}  // namespace
}  // namespace ccdt
