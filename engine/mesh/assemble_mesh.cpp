#include "engine/mesh/assemble_mesh.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/index_lists.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/facets/facet_axis.h"
#include "engine/front/stuck.h"
#include "engine/geometry/predicates.h"

namespace ccdt::mesh {
namespace {

constexpr std::size_t chunk_length = 8192;  ///< of loops on several threads

double determinant(const Point3& a, const Point3& b, const Point3& c) {
  return dot(a, cross(b, c));
}

double size_of(const Point3& a) {
  return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z);
}

/// A sum of numbers, and an upper bound on its error.
struct RoundedSum {
  double sum, rounding;
};

/// Six times the volume that the facets enclose, by the divergence theorem.
RoundedSum volume_within(const plc::Plc& plc, const facets::FacetMesh& facets, std::span<const Point3> points) {
  double volume = 0, parts = 0;
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const plc::Facet& facet = plc.facets[facets.facet[i]];
    const int outward = (plc.regions[facet.below].inside ? 1 : 0) - (plc.regions[facet.above].inside ? 1 : 0);
    const auto& t = facets.triangles[i];
    if (outward == 0) continue;
    const Point3 &a = points[t[0]], b = points[t[1]] - a, c = points[t[2]] - a;
    // Not a determinant of the corners: its products are of the size of the box, however small the triangle is.
    volume += outward * determinant(a, b, c);
    parts += size_of(a) * size_of(b) * size_of(c);
  }
  return {volume, 1e-14 * parts};
}

FaceKey key_of(const std::array<VertexId, 3>& t) {
  return face_key(t[0], t[1], t[2]);
}

bool is_nearly_flat_boundary(const plc::Plc& plc, const plc::Facet& facet) {
  return !facet.exactly_flat && plc.regions[facet.above].inside != plc.regions[facet.below].inside;
}

/// Removes the tetrahedra of almost no volume that lie within a boundary facet, with all four vertices on it and two
/// faces on the boundary; their other two faces become faces of the facet. Only nearly flat facets have such
/// tetrahedra. A tetrahedron stays if its removal would remove a vertex or a segment from its facet, fold the facet
/// over, or put it onto another one.
class FlatTetrahedronPeeler {
 public:
  FlatTetrahedronPeeler(const plc::Plc& plc, const protection::SegmentChains& chains, std::span<const Point3> points,
                        facets::FacetMesh& facets, CollectedMesh& collected)
      : plc_(plc),
        chains_(chains),
        points_(points),
        facets_(facets),
        mesh_(collected.mesh),
        sources_(collected.sources) {}

  void peel() {
    find_nearly_flat_facets();
    if (vertices_ == 0) return;
    std::vector<std::uint32_t> flat = parallel_select(
        mesh_.tetrahedra.size(), chunk_length, [&](std::size_t i) { return lies_within_facet(mesh_.tetrahedra[i]); });
    if (flat.empty()) return;
    list_faces();
    // Sorted, so that the order does not depend on how the tetrahedra were found.
    const auto corners = [&](std::size_t i) {
      std::array<std::uint32_t, 4> t = mesh_.tetrahedra[i];
      std::sort(t.begin(), t.end());
      return t;
    };
    std::sort(flat.begin(), flat.end(), [&](std::size_t i, std::size_t j) { return corners(i) < corners(j); });
    std::vector<std::size_t> gone;
    for (bool changed = true; changed;) {
      const std::size_t before = gone.size();
      std::erase_if(flat, [&](std::size_t i) {
        const bool peels = try_to_peel(mesh_.tetrahedra[i]);
        if (peels) gone.push_back(i);
        return peels;
      });
      changed = gone.size() > before;
    }
    if (!gone.empty()) remove(std::move(gone));
  }

 private:
  void find_nearly_flat_facets() {
    std::vector<std::uint32_t> nearly_flat;
    std::uint32_t vertices = 0;
    for (std::size_t i = 0; i < facets_.triangles.size(); ++i) {
      if (!is_nearly_flat_boundary(plc_, plc_.facets[facets_.facet[i]])) continue;
      nearly_flat.push_back(static_cast<std::uint32_t>(i));
      for (const VertexId v : facets_.triangles[i]) vertices = std::max(vertices, v + 1);
    }
    vertices_ = vertices;
    facets_of_ = make_index_lists(vertices, [&](const auto& emit) {
      for (const std::uint32_t i : nearly_flat)
        for (const VertexId v : facets_.triangles[i]) emit(v, facets_.facet[i]);
    });
  }

  void list_faces() {
    std::vector<Point3> normals(plc_.facets.size());
    for (std::size_t i = 0; i < facets_.triangles.size(); ++i) {
      const auto& t = facets_.triangles[i];
      Point3& normal = normals[facets_.facet[i]];
      normal = normal + area_vector({points_[t[0]], points_[t[1]], points_[t[2]]});
      if (is_nearly_flat_boundary(plc_, plc_.facets[facets_.facet[i]]))
        triangle_of_.set(key_of(t), i);
      else
        other_faces_.insert(key_of(t));
    }
    for (const Point3& normal : normals) axis_of_.push_back(facets::axis_along(normal));
    for (const auto& [a, b] : chains_.pieces()) segment_edges_.insert(edge_key(a, b));
  }

  /// Removes tetrahedra. The others keep their order.
  void remove(std::vector<std::size_t> those) {
    std::ranges::sort(those);
    auto next = those.begin();
    std::size_t kept = those.front();
    for (std::size_t i = kept; i < mesh_.tetrahedra.size(); ++i) {
      if (next != those.end() && *next == i) {
        ++next;
        continue;
      }
      mesh_.tetrahedra[kept] = mesh_.tetrahedra[i];
      if (!mesh_.regions.empty()) mesh_.regions[kept] = mesh_.regions[i];
      sources_[kept++] = sources_[i];
    }
    mesh_.tetrahedra.resize(kept);
    if (!mesh_.regions.empty()) mesh_.regions.resize(kept);
    sources_.resize(kept);
  }

  bool lies_within_facet(const std::array<std::uint32_t, 4>& t) const {
    if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= vertices_; })) return false;
    return std::ranges::any_of(facets_of_.of(t[0]), [&](std::uint32_t f) {
      return std::all_of(t.begin() + 1, t.end(), [&](std::uint32_t v) {
        const auto its = facets_of_.of(v);
        return std::ranges::find(its, f) != its.end();
      });
    });
  }

  /// The two of four corners that are not these.
  static std::array<std::uint32_t, 2> other_corners(const std::array<std::uint32_t, 2>& corners) {
    std::array<std::uint32_t, 2> others{};
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < 4; ++c)
      if (c != corners[0] && c != corners[1]) others[count++] = c;
    return others;
  }

  bool try_to_peel(const std::array<std::uint32_t, 4>& t) {
    std::array<std::uint32_t, 2> inner{};  // faces, by the corner opposite them
    std::array<std::size_t, 2> triangles{};
    int outers = 0, inners = 0;
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto [a, b, c] = delaunay::corners_of_face(t, f);
      const FaceKey key = face_key(a, b, c);
      const std::size_t* const found = triangle_of_.find(key);
      if (found != nullptr && outers < 2)
        triangles[outers++] = *found;
      else if (found == nullptr && inners < 2 && !other_faces_.contains(key))
        inner[inners++] = f;
    }
    if (outers != 2 || inners != 2 || facets_.facet[triangles[0]] != facets_.facet[triangles[1]]) return false;
    // The outer faces meet in the edge between the corners opposite the inner faces; the inner faces meet in the other
    // edge.
    const auto [p, q] = other_corners(inner);
    if (segment_edges_.contains(edge_key(t[inner[0]], t[inner[1]]))) return false;
    if (segment_edges_.contains(edge_key(t[p], t[q]))) return false;
    const FacetId facet = facets_.facet[triangles[0]];
    std::array<std::array<VertexId, 3>, 2> uncovered;
    for (std::size_t i = 0; i < 2; ++i) {
      // Face corners see the tetrahedron above them; the facet's triangles have the domain above or below.
      auto [a, b, c] = delaunay::corners_of_face(t, inner[i]);
      if (plc_.regions[plc_.facets[facet].above].inside) std::swap(a, b);
      if (!facets::is_upright(points_[a], points_[b], points_[c], axis_of_[facet])) return false;
      uncovered[i] = {VertexId(a), VertexId(b), VertexId(c)};
      // The order of a cell's vertices depends on the strategy.
      std::ranges::rotate(uncovered[i], std::ranges::min_element(uncovered[i]));
    }
    for (const std::size_t i : triangles) triangle_of_.erase(triangle_of_.find(key_of(facets_.triangles[i])));
    for (std::size_t i = 0; i < 2; ++i) {
      facets_.triangles[triangles[i]] = uncovered[i];
      triangle_of_.set(key_of(uncovered[i]), triangles[i]);
    }
    return true;
  }

  const plc::Plc& plc_;
  const protection::SegmentChains& chains_;
  std::span<const Point3> points_;
  facets::FacetMesh& facets_;
  TetMesh& mesh_;
  RawVector<std::uint32_t>& sources_;
  std::uint32_t vertices_ = 0;  // all vertices of nearly flat facets are below
  IndexLists facets_of_;        // by vertex: the nearly flat facets at it
  // If there are such tetrahedra:
  HashTable<FaceKey, std::size_t> triangle_of_;  // of nearly flat facets
  HashSet<FaceKey> other_faces_;                 // of all other facets
  HashSet<std::uint64_t> segment_edges_;
  std::vector<facets::FacetAxis> axis_of_;  // of each facet
};

/// \return the facet of each face
std::vector<std::uint32_t> add_faces_and_edges(const plc::Plc& plc, const protection::SegmentChains& chains,
                                               const facets::FacetMesh& facets, TetMesh& mesh) {
  const auto is_in_mesh = [&](std::size_t i) {
    const plc::Facet& facet = plc.facets[facets.facet[i]];
    return plc.regions[facet.above].inside || plc.regions[facet.below].inside;
  };
  std::vector<std::uint32_t> facet_of_face;
  parallel_pack(
      facets.triangles.size(), chunk_length,
      [&](std::size_t i, std::size_t end) {
        std::size_t count = 0;
        for (; i < end; ++i) count += is_in_mesh(i);
        return count;
      },
      [&](std::size_t size) {
        mesh.faces.resize(size);
        mesh.face_markers.resize(size);
        facet_of_face.resize(size);
      },
      [&](std::size_t i, std::size_t end, std::size_t face) {
        for (; i < end; ++i) {
          if (!is_in_mesh(i)) continue;
          const auto& t = facets.triangles[i];
          mesh.faces[face] = {t[0], t[1], t[2]};
          mesh.face_markers[face] = plc.facets[facets.facet[i]].marker;
          facet_of_face[face++] = facets.facet[i];
        }
      });
  list_edges(plc, chains, mesh);
  return facet_of_face;
}

}  // namespace

void list_edges(const plc::Plc& plc, const protection::SegmentChains& chains, TetMesh& mesh) {
  mesh.edges.clear();
  mesh.edge_markers.clear();
  mesh.edges.reserve(chains.size());
  mesh.edge_markers.reserve(chains.size());
  for (std::size_t s = 0; s < chains.size(); ++s) {
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i) {
      mesh.edges.push_back({chains[s][i].vertex, chains[s][i + 1].vertex});
      mesh.edge_markers.push_back(plc.segments[s].marker);
    }
  }
}

void drop_foreign_edges(const plc::Plc& plc, const protection::SegmentChains& chains, TetMesh& mesh) {
  std::size_t next = 0, kept = 0;
  for (std::size_t s = 0; s < chains.size(); ++s)
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i, ++next) {
      if (!plc.segments[s].listed) continue;
      mesh.edges[kept] = mesh.edges[next];
      mesh.edge_markers[kept++] = mesh.edge_markers[next];
    }
  mesh.edges.resize(kept);
  mesh.edge_markers.resize(kept);
}

void check_volume(const plc::Plc& plc, const facets::FacetMesh& facets, std::span<const Point3> points,
                  const TetMesh& mesh) {
  const auto parts = parallel_chunks(mesh.tetrahedra.size(), chunk_length, [&](std::size_t i, std::size_t end) {
    RoundedSum part{};
    for (; i < end; ++i) {
      const auto& t = mesh.tetrahedra[i];
      const Point3 a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]], c = points[t[3]] - points[t[0]];
      part.sum += determinant(a, b, c);
      part.rounding += size_of(a) * size_of(b) * size_of(c);  // much larger than the volume of a needle
    }
    return part;
  });
  RoundedSum filled{};
  for (const auto& [sum, rounding] : parts) filled = {filled.sum + sum, filled.rounding + 1e-15 * rounding};
  const auto [wanted, rounding] = volume_within(plc, facets, points);
  if (!(std::fabs(filled.sum - wanted) <= 1e-7 * std::fabs(wanted) + rounding + filled.rounding))
    throw front::stuck_near("the tetrahedra do not fill the domain", plc, {});
}

std::vector<std::uint32_t> finish_mesh(const plc::Plc& plc, const protection::SegmentChains& chains,
                                       std::span<const Point3> points, facets::FacetMesh facets,
                                       CollectedMesh& collected) {
  FlatTetrahedronPeeler(plc, chains, points, facets, collected).peel();
  collected.mesh.constrained_delaunay = true;
  return add_faces_and_edges(plc, chains, facets, collected.mesh);
}

// ---- Coordinates

namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;
using Rational = boost::multiprecision::cpp_rational;

bool is_positive_exactly(const std::array<const Point3*, 4>& p) {
  ++work_done.orient3d_filter_failures;
  ++work_done.wide_evaluations;
  ++work_done.exact_evaluations;
  std::array<std::array<Rational, 3>, 3> m;
  for (int i = 0; i < 3; ++i) {
    m[i] = {Rational(p[i + 1]->x) - Rational(p[0]->x), Rational(p[i + 1]->y) - Rational(p[0]->y),
            Rational(p[i + 1]->z) - Rational(p[0]->z)};
  }
  const Rational det = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                       m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
                       m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
  return det > 0;
}

/// In the units of the input the differences are rounded, which the bound of the filter allows for (Shewchuk 1997,
/// o3derrboundA).
bool is_positive(const std::vector<Point3>& world, const Tetrahedron& t) {
  const Point3 &a = world[t[0]], u = world[t[1]] - a, v = world[t[2]] - a, w = world[t[3]] - a;
  const double det = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) + w.z * (u.x * v.y - u.y * v.x);
  const double permanent = std::fabs(w.x) * (std::fabs(u.y * v.z) + std::fabs(u.z * v.y)) +
                           std::fabs(w.y) * (std::fabs(u.z * v.x) + std::fabs(u.x * v.z)) +
                           std::fabs(w.z) * (std::fabs(u.x * v.y) + std::fabs(u.y * v.x));
  constexpr double factor = 8 * 0x1p-53 * (1 + 1e-6);
  if (std::fabs(det) > factor * permanent) return det > 0;
  return is_positive_exactly({&world[t[0]], &world[t[1]], &world[t[2]], &world[t[3]]});
}

[[noreturn]] void refuse_rounding(const plc::Plc& plc, const std::vector<Point3>& world, const Tetrahedron& t) {
  Place place;
  place.file = plc.name;
  for (const std::uint32_t v : t) place.points.push_back(as_array(world[v]));
  throw MeshError("a tetrahedron is so thin that the rounding of its coordinates inverts it", place,
                  "move the part closer to the origin, where coordinates are finer");
}

}  // namespace

std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const Tetrahedron> tetrahedra) {
  std::vector<Point3> world(points.size());
  parallel_for(world.size(), chunk_length, [&](std::size_t v) {
    world[v] = v < plc.world.size() && points[v] == plc.vertices[v] ? plc.world[v] : plc.grid.to_world(points[v]);
  });
  // A vertex that goes back to the grid may invert a tetrahedron of another vertex, so this repeats until all are
  // right. All inverted tetrahedra are found before any vertex moves, so that their order does not matter.
  std::vector<bool> on_grid(plc.world.size(), false);
  while (true) {
    work_done.cells_visited += tetrahedra.size();
    const auto inverted = parallel_collect<Tetrahedron>(
        tetrahedra.size(), chunk_length, [&](std::size_t i, std::size_t end, std::vector<Tetrahedron>& found) {
          for (; i < end; ++i)
            if (!is_positive(world, tetrahedra[i])) found.push_back(tetrahedra[i]);
        });
    note_bytes(bytes_of(points, tetrahedra, world, inverted));
    if (inverted.empty()) return world;
    bool moved = false;
    for (const Tetrahedron& t : inverted) {
      for (const std::uint32_t v : t) {
        if (v >= on_grid.size() || on_grid[v]) continue;
        on_grid[v] = moved = true;
        world[v] = plc.grid.to_world(points[v]);
      }
    }
    if (!moved) refuse_rounding(plc, world, inverted.front());
  }
}

}  // namespace ccdt::mesh
