#include "engine/improver.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/check_arguments.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/predicates.h"
#include "engine/improve/improve_mesh.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesh/boundary_faces.h"
#include "engine/options/check_options.h"
#include "engine/plc/plc.h"
#include "engine/tets/cell_complex.h"

namespace ccdt {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr const char* mesh_remedy = "give a mesh in which all tetrahedra are positive and share whole faces";

/// \param corners  of what is wrong
template <std::size_t N>
[[noreturn]] void refuse(const mesh::TetMesh& mesh, const std::string& what,
                         const std::array<std::uint32_t, N>& corners) {
  Place place;
  for (const std::uint32_t v : corners) place.points.push_back(as_array(mesh.vertices[v]));
  throw InputError(what, place, mesh_remedy);
}

void check_tet_mesh(const mesh::TetMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  const bool is_complete = is_empty_or_complete(mesh.regions, mesh.tetrahedra) &&
                           is_empty_or_complete(mesh.face_markers, mesh.faces) &&
                           is_empty_or_complete(mesh.edge_markers, mesh.edges);
  if (!are_below(count, mesh.tetrahedra) || !are_below(count, mesh.faces) || !are_below(count, mesh.edges) ||
      !is_complete || !std::ranges::all_of(mesh.vertices, is_finite))
    throw InputError("the mesh has an index out of range, a list that is too short, or a coordinate that is not finite",
                     {}, mesh_remedy);
  if (mesh.tetrahedra.empty()) throw InputError("the mesh has no tetrahedra", {}, "give a mesh of tetrahedra");
}

/// Puts the vertices on a grid as fine as their doubles, and turns all tetrahedra upward.
std::vector<Point3> to_grid(mesh::TetMesh& mesh, const DyadicGrid& grid) {
  std::vector<Point3> points(mesh.vertices.size());
  parallel_for(points.size(), 4096, [&](std::size_t v) {
    const Point3 p = (1 / grid.unit) * (mesh.vertices[v] - grid.origin);
    points[v] = {round_to_unit(p.x), round_to_unit(p.y), round_to_unit(p.z)};
  });
  for (auto& t : mesh.tetrahedra) {
    const int sign = orient3d(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
    if (sign == 0) refuse(mesh, "a tetrahedron is flat", t);
    if (sign < 0) std::swap(t[2], t[3]);
  }
  return points;
}

/// A face of a tetrahedron.
struct Side {
  FaceKey key;
  std::uint32_t tetrahedron;
  std::uint32_t face;  ///< of its `mesh::outward_faces`

  bool operator<(const Side& other) const {
    return std::tie(key, tetrahedron, face) < std::tie(other.key, other.tetrahedron, other.face);
  }
};

std::vector<Side> sorted_sides(const mesh::TetMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto faces = mesh::outward_faces(mesh.tetrahedra[t]);
    for (std::uint32_t f = 0; f < 4; ++f) sides.push_back({face_key(faces[f][0], faces[f][1], faces[f][2]), t, f});
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Adds to the listed faces those on the boundary and between regions.
void list_walls(mesh::TetMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<FaceKey> listed;
  for (const auto& [a, b, c] : mesh.faces) {
    listed.push_back(face_key(a, b, c));
    if (!std::ranges::binary_search(sides, listed.back(), {}, &Side::key))
      refuse(mesh, "a listed face belongs to no tetrahedron", Face{a, b, c});
  }
  std::ranges::sort(listed);
  if (const auto twice = std::ranges::adjacent_find(listed); twice != listed.end())
    refuse(mesh, "a face is listed twice", *twice);
  const auto corners = [&](const Side& side) {
    return mesh::outward_faces(mesh.tetrahedra[side.tetrahedron])[side.face];
  };
  const auto is_turned = [&](const Side& side) {
    const auto [a, b, c] = corners(side);
    return is_odd(a, b, c);
  };
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end - i > 2) refuse(mesh, "more than two tetrahedra share a face", sides[i].key);
    const bool is_shared = end - i == 2;
    if (is_shared && is_turned(sides[i]) == is_turned(sides[i + 1]))
      refuse(mesh, "two tetrahedra lie on the same side of a face", sides[i].key);
    const bool is_within = is_shared && (mesh.regions.empty() ||
                                         mesh.regions[sides[i].tetrahedron] == mesh.regions[sides[i + 1].tetrahedron]);
    if (is_within || std::ranges::binary_search(listed, sides[i].key)) continue;
    mesh.faces.push_back(corners(sides[i]));
  }
  mesh.face_markers.resize(mesh.faces.size(), 0);
}

/// Numbers the vertices anew: first those that must stay, then the interior ones.
///
/// \param points  the vertices on the grid
/// \return        the number of those that must stay
std::uint32_t number_vertices(mesh::TetMesh& mesh, std::vector<Point3>& points) {
  std::vector<char> stays(mesh.vertices.size(), 1);
  for (const auto& t : mesh.tetrahedra)
    for (const std::uint32_t v : t) stays[v] = 0;
  const auto keep = [&](const auto& elements) {
    for (const auto& element : elements)
      for (const std::uint32_t v : element) stays[v] = 1;
  };
  keep(mesh.faces), keep(mesh.edges);
  std::vector<std::uint32_t> order(mesh.vertices.size()), number(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto interior = std::ranges::stable_partition(order, [&](std::uint32_t v) { return stays[v] != 0; });
  const std::vector<Point3> vertices = std::move(mesh.vertices), on_grid = points;
  mesh.vertices.resize(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    number[order[i]] = i;
    mesh.vertices[i] = vertices[order[i]];
    points[i] = on_grid[order[i]];
  }
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements)
      for (std::uint32_t& v : element) v = number[v];
  };
  renumber(mesh.tetrahedra), renumber(mesh.faces), renumber(mesh.edges);
  return static_cast<std::uint32_t>(order.size() - interior.size());
}

/// \throw InputError  a listed edge belongs to no tetrahedron
void check_edges(const mesh::TetMesh& mesh) {
  std::vector<std::uint64_t> keys;
  for (const auto& t : mesh.tetrahedra)
    for (const auto& corner : delaunay::edge_corners) keys.push_back(edge_key(t[corner[0]], t[corner[1]]));
  std::ranges::sort(keys);
  for (const auto& edge : mesh.edges)
    if (!std::ranges::binary_search(keys, edge_key(edge[0], edge[1])))
      refuse(mesh, "a listed edge belongs to no tetrahedron", edge);
}

LargeVector<tets::Cell> cells_of(const mesh::TetMesh& mesh) {
  LargeVector<tets::Cell> cells(mesh.tetrahedra.size());
  parallel_for(cells.size(), 4096, [&](std::size_t c) {
    cells[c].vertices = mesh.tetrahedra[c];
    cells[c].neighbors.fill(tets::no_neighbor);
  });
  return cells;
}

ImprovedMesh improve_on_threads(mesh::TetMesh mesh, const improve::ImproveOptions& options, const Progress& progress) {
  check_tet_mesh(mesh);
  if (!mesh.edges.empty()) check_edges(mesh);
  plc::Plc original;  // has what `mesh::to_world` needs
  original.grid = make_grid(mesh.vertices);
  original.vertices = to_grid(mesh, original.grid);
  const bool has_markers = !mesh.face_markers.empty() || mesh.faces.empty();
  list_walls(mesh);
  const std::uint32_t first_interior = number_vertices(mesh, original.vertices);
  original.world = std::move(mesh.vertices);
  std::vector<std::uint32_t> facets(mesh.faces.size());  // each its own, so none is flipped
  std::iota(facets.begin(), facets.end(), 0u);
  LargeVector<tets::Cell> cells = cells_of(mesh);
  tets::CellComplex complex(std::move(mesh.faces), mesh.edges, std::move(cells), std::move(mesh.regions),
                            original.vertices, std::move(facets), first_interior, improve::goal_of(options));
  ImprovedMesh result{{}, improve::improve_cells(complex, {}, options, progress)};
  if (complex.change_count() > 0) mesh.constrained_delaunay = false;
  const std::vector<Point3> points = std::move(complex).take_mesh(mesh);
  mesh.vertices = mesh::to_world(original, points, mesh.tetrahedra);
  if (!has_markers) mesh.face_markers.clear();
  mesh.partitions.clear();  // they were of other tetrahedra
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace

ImprovedMesh improve_tet_mesh(mesh::TetMesh mesh, const improve::ImproveOptions& options, unsigned threads,
                              const Progress& progress) {
  MeshOptions all;
  all.improve = options;
  all.threads = threads;
  options::check_options(all);
  return with_threads(threads, [&] { return improve_on_threads(std::move(mesh), options, progress); });
}

}  // namespace ccdt
