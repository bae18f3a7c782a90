#include "engine/delaunay/delaunay.h"

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/delaunay/insertion.h"
#include "engine/numbers/predicates.h"

namespace ccdt::delaunay {
namespace {

/// Puts four points that are not in one plane first in `order`, positively oriented.
void put_simplex_first(std::span<const Point3> points, std::vector<std::uint32_t>& order) {
  const auto bring = [&](std::size_t to, auto&& good) {
    for (std::size_t i = to; i < order.size(); ++i) {
      if (good(points[order[i]])) {
        std::rotate(order.begin() + static_cast<std::ptrdiff_t>(to), order.begin() + static_cast<std::ptrdiff_t>(i),
                    order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        return;
      }
    }
    refuse_flat_points();
  };
  const auto at = [&](std::size_t i) -> const Point3& { return points[order[i]]; };
  bring(0, [](const Point3&) { return true; });
  bring(1, [&](const Point3& p) { return !(p == at(0)); });
  bring(2, [&](const Point3& p) { return !numbers::collinear(at(0), at(1), p); });
  bring(3, [&](const Point3& p) { return numbers::orient3d(at(0), at(1), at(2), p) != 0; });
  if (numbers::orient3d(at(0), at(1), at(2), at(3)) < 0) std::swap(order[0], order[1]);
}

/// The indices of the points in the order of insertion.
std::vector<std::uint32_t> insertion_order(std::span<const Point3> points) {
  std::vector<std::uint32_t> order = hilbert_order(points);
  put_simplex_first(points, order);
  return order;
}

/// The tetrahedron of vertices 0 to 3 with its four ghosts.
void make_first_cells(Delaunay& d) {
  d.cells.assign(5, {});
  d.cells[0].vertices = {0, 1, 2, 3};
  for (std::uint32_t f = 0; f < 4; ++f) {
    // From outside the face is seen the other way round.
    const auto& corner = face_corners[f];
    d.cells[f + 1].vertices = {corner[0], corner[2], corner[1], ghost_vertex};
    d.cells[f + 1].neighbors[3] = face_code(0, f);
    d.cells[0].neighbors[f] = face_code(f + 1, 3);
  }
  // Two ghosts meet where both lack each other's opposite vertex.
  for (std::uint32_t i = 1; i < 5; ++i) {
    for (std::uint32_t f = 0; f < 3; ++f) {
      const std::uint32_t other = 1 + d.cells[i].vertices[f];  // the ghost over the face opposite to this vertex
      const auto& v = d.cells[other].vertices;
      const auto g = static_cast<std::uint32_t>(std::find(v.begin(), v.end(), i - 1) - v.begin());
      d.cells[i].neighbors[f] = face_code(other, g);
    }
  }
}

/// From places in the insertion order back to ids.
void renumber(Delaunay& d, const std::vector<std::uint32_t>& order) {
  std::vector<DelaunayVertex> by_id(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) by_id[order[i]] = d.vertices[i];
  d.vertices = std::move(by_id);
  for (Cell& cell : d.cells)
    for (std::uint32_t& v : cell.vertices)
      if (v != ghost_vertex) v = order[v];
}

}  // namespace

void refuse_flat_points() {
  throw MeshError("the vertices are all in one plane, or fewer than four", {},
                  "a tetrahedral mesh needs a body: check that the input is not flat");
}

std::vector<std::uint32_t> insertion_ranks(std::span<const Point3> points) {
  const std::vector<std::uint32_t> order = insertion_order(points);
  std::vector<std::uint32_t> ranks(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<std::uint32_t>(i);
  return ranks;
}

Delaunay build_delaunay(std::span<const Point3> points, const Progress& progress) {
  const std::vector<std::uint32_t> order = insertion_order(points);
  Delaunay d;
  d.vertices.resize(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) d.vertices[i] = {points[order[i]], static_cast<std::uint32_t>(i), 0};
  d.cells.reserve(7 * points.size() + 64);
  make_first_cells(d);
  Insertion insertion(d);
  std::uint32_t last = 0;
  for (std::uint32_t v = 4; v < d.vertices.size(); ++v) {
    insertion.find_cavity(v, last);
    last = insertion.fill_cavity();
    if ((v & 0xFFFF) == 0) report(progress, "delaunay", v, d.vertices.size());
  }
  renumber(d, order);
  return d;
}

}  // namespace ccdt::delaunay
