#include "engine/io/mesh_regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>

#include "engine/base/simplex_map.h"
#include "engine/base/union_find.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/ray.h"
#include "engine/io/formats.h"
#include "engine/mesh/boundary_faces.h"
#include "engine/mesh/sides.h"

namespace ccdt::io {
namespace {

using Corners = std::array<Point3, 3>;
using Face = std::array<std::uint32_t, 3>;

double volume_of(const mesh::TetMesh& mesh, std::uint32_t tetrahedron) {
  const auto& [a, b, c, d] = mesh.tetrahedra[tetrahedron];
  const Point3& p = mesh.vertices[a];
  return std::fabs(dot(cross(mesh.vertices[b] - p, mesh.vertices[c] - p), mesh.vertices[d] - p));
}

Point3 center_of(const mesh::TetMesh& mesh, std::uint32_t tetrahedron) {
  Point3 sum;
  for (const std::uint32_t v : mesh.tetrahedra[tetrahedron]) sum = sum + 0.25 * mesh.vertices[v];
  return sum;
}

/// The faces of each connected piece of a closed surface. Pieces that touch along an edge stay apart.
std::vector<std::vector<std::uint32_t>> connected_pieces(std::span<const Face> faces) {
  std::vector<AtEdge> edges;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({edge_key(faces[f][i], faces[f][(i + 1) % 3]), f});
  UnionFind pieces(faces.size());
  for_each_edge_group(edges, [&](std::span<const AtEdge> at_edge) {
    if (at_edge.size() == 2) pieces.join(at_edge[0].value, at_edge[1].value);
  });
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_first;
  for (std::uint32_t f = 0; f < faces.size(); ++f) by_first[pieces.find(f)].push_back(f);
  std::vector<std::vector<std::uint32_t>> all;
  for (auto& [first, piece] : by_first) all.push_back(std::move(piece));
  return all;
}

/// Six times the volume that a piece encloses; negative if its faces look inward.
double enclosed(std::span<const std::uint32_t> piece, std::span<const Corners> corners) {
  double sum = 0;
  const Point3 origin = corners[piece[0]][0];
  for (const std::uint32_t f : piece) {
    const auto& [a, b, c] = corners[f];
    sum += dot(cross(a - origin, b - origin), c - origin);
  }
  return sum;
}

/// A point in each cavity.
std::vector<Point3> cavity_seeds(const mesh::TetMesh& mesh, std::span<const Face> faces) {
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : faces) corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  const BoxTree tree(corners, [](const Corners& t) { return bounding_box(t); });
  const Box box = bounding_box(mesh.vertices);
  std::vector<Point3> seeds;
  for (const std::vector<std::uint32_t>& piece : connected_pieces(faces)) {
    if (!(enclosed(piece, corners) < 0)) continue;
    const std::uint32_t largest =
        *std::ranges::max_element(piece, {}, [&](std::uint32_t f) { return squared_length(area_vector(corners[f])); });
    const auto& [a, b, c] = corners[largest];
    const Point3 center = (1.0 / 3) * (a + b + c);
    const LineSegment way{center, length(box.high - box.low) * normalized(area_vector(corners[largest]))};
    double nearest = 1;
    tree.for_each_meeting(way, [&](std::uint32_t f) {
      if (f != largest) nearest = std::min(nearest, crossing_of(way, corners[f]));
    });
    if (nearest < 1) seeds.push_back(center + 0.5 * nearest * way.along);
  }
  return seeds;
}

}  // namespace

MeshSeeds bound_regions(mesh::TetMesh& mesh) {
  const FaceMap listed(mesh.faces, mesh.vertices.size());
  const std::vector<mesh::Side> sides = mesh::sorted_sides(mesh);
  UnionFind parts(mesh.tetrahedra.size());
  std::vector<Face> boundary;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    const auto region = [&](std::size_t side) { return attribute_of(mesh.regions, sides[side].tetrahedron); };
    const Face face = mesh::outward_faces_of(mesh, sides[i].tetrahedron)[sides[i].face];
    if (end - i == 1) boundary.push_back(face);
    const auto& [a, b, c] = sides[i].key;
    if (listed.find(VertexId(a), VertexId(b), VertexId(c)).index != none) continue;
    if (end - i > 1 && region(i) == region(i + 1))
      parts.join(sides[i].tetrahedron, sides[i + 1].tetrahedron);
    else
      mesh.faces.push_back(face);
  }
  mesh.face_markers.resize(mesh.faces.size(), 0);
  std::map<std::uint32_t, std::uint32_t> largest;  // tetrahedron of each part
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    std::uint32_t& found = largest.try_emplace(parts.find(t), t).first->second;
    if (volume_of(mesh, t) > volume_of(mesh, found)) found = t;
  }
  MeshSeeds seeds{{}, cavity_seeds(mesh, boundary)};
  for (const auto& [part, t] : largest) seeds.regions.push_back({center_of(mesh, t), attribute_of(mesh.regions, t)});
  return seeds;
}

}  // namespace ccdt::io
