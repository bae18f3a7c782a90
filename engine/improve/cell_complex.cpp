#include "engine/improve/cell_complex.h"

#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

/// A face of a cell, or a face of the mesh on a facet, among those with the same least corner.
struct FaceEntry {
  std::uint64_t rest;  ///< the other two corners, in growing order
  std::uint32_t code;  ///< of the cell; `no_neighbor`: it is a face on a facet
};

/// All faces, ordered by their least corners: those of vertex v are from `begin[v]` to `begin[v + 1]`.
struct FaceBuckets {
  std::vector<std::uint32_t> begin;
  std::vector<FaceEntry> entries;
};

template <class Visit>
void visit_faces(const CellComplex& x, const Visit& visit) {
  for (std::uint32_t c = 0; c < x.cells.size(); ++c) {
    const auto& v = x.cells[c].vertices;
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto& corner = face_corners[f];
      visit(face_key(v[corner[0]], v[corner[1]], v[corner[2]]), face_code(c, f));
    }
  }
  for (const auto& face : x.faces) visit(face_key(face[0], face[1], face[2]), no_neighbor);
}

FaceBuckets sort_faces(const CellComplex& x) {
  FaceBuckets buckets;
  buckets.begin.assign(x.points.size() + 2, 0);
  visit_faces(x, [&](const FaceKey& key, std::uint32_t) { ++buckets.begin[key[0] + 2]; });
  for (std::size_t v = 2; v < buckets.begin.size(); ++v) buckets.begin[v] += buckets.begin[v - 1];
  buckets.entries.resize(buckets.begin.back());
  visit_faces(x, [&](const FaceKey& key, std::uint32_t code) {
    buckets.entries[buckets.begin[key[0] + 1]++] = {std::uint64_t{key[1]} << 32 | key[2], code};
  });
  return buckets;
}

void set_wall(CellComplex& x, std::uint32_t code) {
  x.walls[cell_of(code)] = static_cast<std::uint8_t>(x.walls[cell_of(code)] | 1u << face_of(code));
}

/// Joins the entries of one bucket that are the same face: two cells at most, and a face on a facet.
void join(CellComplex& x, std::span<FaceEntry> entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      if (entries[i].rest != entries[j].rest) continue;
      const std::uint32_t a = entries[i].code, b = entries[j].code;
      if (a != no_neighbor && b != no_neighbor) {
        x.cells[cell_of(a)].neighbors[face_of(a)] = b;
        x.cells[cell_of(b)].neighbors[face_of(b)] = a;
      } else if (a != no_neighbor || b != no_neighbor) {
        set_wall(x, a != no_neighbor ? a : b);
      }
    }
  }
}

void find_neighbors(CellComplex& x) {
  FaceBuckets buckets = sort_faces(x);
  for (std::size_t v = 0; v < x.points.size(); ++v)
    join(x, std::span(buckets.entries).subspan(buckets.begin[v], buckets.begin[v + 1] - buckets.begin[v]));
  for (std::uint32_t c = 0; c < x.cells.size(); ++c)
    for (std::uint32_t f = 0; f < 4; ++f)
      if (x.cells[c].neighbors[f] == no_neighbor) set_wall(x, face_code(c, f));
}

}  // namespace

bool is_positive(const CellComplex& x, const std::array<std::uint32_t, 4>& v) {
  return orient3d(x.points[v[0]], x.points[v[1]], x.points[v[2]], x.points[v[3]]) > 0;
}

CellComplex make_complex(const TetMesh& mesh, std::vector<Point3> points, std::vector<std::uint32_t> facet_of_face,
                         std::uint32_t first_interior, const QualityGoal& goal) {
  CellComplex x;
  x.points = std::move(points);
  x.first_interior = first_interior;
  x.cell_of_vertex.assign(x.points.size(), no_neighbor);
  x.changed_at.assign(x.points.size(), 0);
  const std::size_t size = mesh.tetrahedra.size();
  x.cells.resize(size);
  x.worths.resize(size);
  for (std::uint32_t c = 0; c < size; ++c) {
    x.cells[c] = {mesh.tetrahedra[c], {no_neighbor, no_neighbor, no_neighbor, no_neighbor}};
    x.worths[c] = x.worth_of(goal, mesh.tetrahedra[c]);
    for (const std::uint32_t v : mesh.tetrahedra[c]) x.cell_of_vertex[v] = c;
  }
  x.walls.assign(size, 0);
  x.regions = mesh.regions;
  x.generations.assign(size, 0);
  x.marks.assign(size, 0);
  x.faces = mesh.faces;
  x.facet_of_face = std::move(facet_of_face);
  x.segments.reserve(mesh.edges.size());
  for (const auto& edge : mesh.edges) x.segments.insert(edge_key(edge[0], edge[1]));
  x.wall_faces.reserve(x.faces.size());
  for (std::uint32_t f = 0; f < x.faces.size(); ++f)
    x.wall_faces.insert(face_key(x.faces[f][0], x.faces[f][1], x.faces[f][2]), f);
  find_neighbors(x);
  return x;
}

std::vector<Point3> take_mesh(CellComplex&& x, TetMesh& mesh) {
  std::vector<std::uint32_t> number(x.points.size());
  std::vector<Point3> points;
  points.reserve(x.points.size());
  for (std::uint32_t v = 0; v < x.points.size(); ++v) {
    number[v] = static_cast<std::uint32_t>(points.size());
    if (!x.is_interior(v) || x.cell_of_vertex[v] != no_neighbor) points.push_back(x.points[v]);
  }
  mesh.tetrahedra.clear();
  mesh.regions.clear();
  for (std::uint32_t c = 0; c < x.cells.size(); ++c) {
    if (x.is_dead(c)) continue;
    const auto& v = x.cells[c].vertices;
    mesh.tetrahedra.push_back({number[v[0]], number[v[1]], number[v[2]], number[v[3]]});
    mesh.regions.push_back(x.regions[c]);
  }
  mesh.faces = std::move(x.faces);
  return points;
}

}  // namespace ccdt
