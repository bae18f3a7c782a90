#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/benchmarks/point_sets.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using DataStructure =
    CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, DataStructure>;
using Corners = std::array<std::uint32_t, 4>;

std::vector<Corners> in_order(std::vector<Corners> cells) {
  for (Corners& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<Corners> cells_of_ccdt(const std::vector<Point3>& points) {
  const delaunay::Delaunay d = delaunay::build_delaunay(points);
  std::vector<Corners> cells;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c)
    if (d.is_finite(c)) cells.push_back(d.cells[c].vertices);
  return in_order(std::move(cells));
}

Triangulation triangulate_with_cgal(const std::vector<Point3>& points) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
  for (const Point3& p : points)
    input.emplace_back(Kernel::Point_3(p.x, p.y, p.z), static_cast<std::uint32_t>(input.size()));
  return Triangulation(input.begin(), input.end());
}

std::vector<Corners> cells_of_cgal(const std::vector<Point3>& points) {
  const Triangulation triangulation = triangulate_with_cgal(points);
  std::vector<Corners> cells;
  for (const auto cell : triangulation.finite_cell_handles())
    cells.push_back(
        {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
  return in_order(std::move(cells));
}

TEST(DelaunayBesideCgal, RandomPointsHaveTheSameCells) {
  for (const std::size_t n : {5, 10, 100, 1000, 20000}) {
    const auto points = benchmarks::random_points(n, n);
    EXPECT_EQ(cells_of_ccdt(points), cells_of_cgal(points)) << n << " points";
  }
}

/// Octahedra of a face-centered lattice may be cut in several ways, but the spheres of its regular tetrahedra have no
/// fifth point on them: these are in every Delaunay tetrahedralization.
TEST(DelaunayBesideCgal, ALatticeHasTheSameRegularTetrahedra) {
  const auto points = benchmarks::lattice_points(4000, 1);
  const double step = [&] {
    double least = 0x1p60;
    for (const Point3& p : points)
      if (p.x > 0) least = std::min(least, p.x);
    return least;
  }();
  const auto regular = [&](std::vector<Corners> cells) {
    std::erase_if(cells, [&](const Corners& cell) {
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j)
          if (squared_length(points[cell[i]] - points[cell[j]]) != 2 * step * step) return true;
      return false;
    });
    return cells;
  };
  const auto ours = regular(cells_of_ccdt(points)), theirs = regular(cells_of_cgal(points));
  EXPECT_EQ(ours, theirs);
  EXPECT_GT(ours.size(), points.size());
}

}  // namespace
}  // namespace ccdt
