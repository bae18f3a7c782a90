#include <gtest/gtest.h>

#include <array>
#include <random>

#include "engine/base/errors.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"

// Tetrahedra of almost no volume, with all vertices on a facet that is flat only within the tolerance.

namespace ccdt {
namespace {

using namespace mesh_test;

/// A tetrahedron over the narrow triangle 0 1 2. The surface there has one more vertex, 4, beside the middle of the
/// short edge 0 1. It is so little above the plane that its two triangles with vertex 2 are one facet. A third
/// triangle, which is a facet of its own, closes the gap to the edge.
InputPlc tetrahedron_with_a_closed_gap() {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1e-4, 0, 0}, {5e-5, 4, 0}, {5e-5, 1, -4}, {5e-5, 0, 1e-8}};
  plc.triangles = {{2, 0, 4}, {2, 4, 1}, {0, 1, 4}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  plc.triangle_markers = {1, 1, 2, 3, 4, 5};
  return plc;
}

TEST(FlatTetrahedra, WithAFaceOnAnotherFacetAreNotRemoved) {
  const InputPlc input = tetrahedron_with_a_closed_gap();
  MeshOptions options;
  options.lattice = Lattice::none;
  const MeshResult result = mesh_plc(input, options);
  EXPECT_EQ(result.mesh.tetrahedra.size(), 2u);
  expect_verified(input, result.mesh);
}

// Both sides of the plate may get the same triangle. Then it is twice in the front.
TEST(FlatTetrahedra, OfAPlateThinnerThanTheToleranceDoNotConfuseTheFront) {
  std::mt19937 random(1);
  MeshOptions options;
  options.lattice = Lattice::none;
  options.flatness = 2e-6;
  int meshed = 0;
  for (int i = 0; i < 20; ++i) {
    try {
      meshed += !mesh_plc(rough_plate(3e-8, random), options).mesh.tetrahedra.empty();
    } catch (const ccdt::Error& error) {
      EXPECT_FALSE(error.place().points.empty());
    }
  }
  EXPECT_GT(meshed, 0);
}

/// A facet of the triangles 0 1 3 and 0 3 2, with a flat tetrahedron below it, and another tetrahedron below that one.
///
/// \param fourth  vertex 3, a little above the plane of the others
/// \return  how many of the two tetrahedra remain
std::size_t count_after_finish(const Point3& fourth) {
  plc::Plc plc;
  plc.regions = {{.inside = false}, {.inside = true}};
  const std::vector<std::array<VertexId, 3>> triangles = {{VertexId(0), VertexId(1), VertexId(3)},
                                                          {VertexId(0), VertexId(3), VertexId(2)}};
  plc.add({.exactly_flat = false, .above = RegionId(0), .below = RegionId(1)}, triangles);
  std::vector<Point3> points;
  for (const Point3& p : {Point3{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, fourth, {2, 2, -10}}) points.push_back(0x1p20 * p);
  const facets::FacetMesh facets{triangles, {FacetId(0), FacetId(0)}};
  mesh::CollectedMesh collected;
  for (const auto& t : {std::array<std::uint32_t, 4>{0, 1, 2, 3}, {0, 2, 1, 4}}) {
    collected.mesh.tetrahedra.push_back(t);
    collected.mesh.regions.push_back(0);
    collected.sources.push_back(0);
  }
  mesh::finish_mesh(plc, {}, points, facets, collected);
  return collected.mesh.tetrahedra.size();
}

TEST(FlatTetrahedra, StayWhereTheFacetWouldFoldOver) {
  EXPECT_EQ(count_after_finish({6, 6, 0x1p-20}), 1u);  // a convex quadrilateral gets the other diagonal
  EXPECT_EQ(count_after_finish({4, 4, 0x1p-20}), 2u);
}

/// The last two triangles form one facet. Its other diagonal, 3 5, is an edge of the adjacent facets.
InputPlc solid_with_a_facet_that_touches_an_edge() {
  InputPlc plc;
  plc.vertices = {{120.71760559082031, 206.234130859375, -979.236572265625},
                  {121.83713531494141, 205.99606323242188, -980.1571044921875},
                  {126.81591033935547, 205.40037536621094, -981.5},
                  {123.79683685302734, 205.22947692871094, -980.38055419921875},
                  {124.13599395751953, 205.11933898925781, -980.50640869140625},
                  {133.81341552734375, 208.79605102539062, -982.5096435546875}};
  plc.triangles = {{5, 0, 1}, {0, 3, 1}, {4, 5, 2}, {2, 5, 3}, {3, 5, 1}, {3, 4, 2}, {5, 4, 0}, {4, 3, 0}};
  return plc;
}

TEST(FlatTetrahedra, StayBetweenAFacetAndAnEdgeBesideIt) {
  const InputPlc input = solid_with_a_facet_that_touches_an_edge();
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine}) {
    MeshOptions options;
    options.lattice = Lattice::none;
    options.surface = rule;
    expect_right(input, mesh_plc(input, options).mesh);
  }
}

/// Vertex 0 is nearer to the edge 1 3 than the tolerance, and protection splits that edge.
InputPlc solid_with_a_vertex_beside_an_edge() {
  InputPlc plc;
  plc.vertices = {{-1000.2096557617188, 0.24792923033237457, 100.27812194824219},
                  {-1000.2894287109375, 0.29233172535896301, 100.11640167236328},
                  {-1000.61279296875, 0.20309451222419739, 100.0135498046875},
                  {-999.964599609375, 0.11061803996562958, 100.77671813964844},
                  {-999.75469970703125, -0.28292417526245117, 100.58245086669922},
                  {-1000.5874633789062, 0.050308629870414734, 100.30351257324219},
                  {-1000.7623291015625, 0.15389204025268555, 99.938270568847656},
                  {-1000.6395874023438, -0.26488837599754333, 100.79003143310547}};
  plc.triangles = {{6, 1, 4}, {3, 4, 1}, {3, 1, 0}, {1, 2, 0}, {2, 3, 0}, {2, 1, 6},
                   {3, 5, 7}, {7, 5, 2}, {2, 6, 7}, {4, 3, 7}, {2, 5, 3}, {7, 6, 4}};
  return plc;
}

// The facets on the other side of the vertex do not contain the edge.
TEST(FlatTetrahedra, OfOneFacetDoNotBelongToAnEdgeBesideIt) {
  const InputPlc input = solid_with_a_vertex_beside_an_edge();
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.steiner = SteinerRule::keep;
  expect_verified(input, mesh_plc(input, options).mesh);
}

}  // namespace
}  // namespace ccdt
