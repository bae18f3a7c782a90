#include "engine/facets/facet_mesh.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/shared_progress.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/geometry/predicates.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/facet_frame.h"

namespace ccdt::facets {
namespace {

using Triangle = std::array<VertexId, 3>;
using Vertices = std::span<const delaunay::DelaunayVertex>;

/// Exact planar predicates within a facet, agreeing with the tetrahedralization (a model of `planar::Predicates`).
class FacetPlane {
 public:
  FacetPlane(Vertices vertices, const Point3& apex) : vertices_(vertices), apex_(apex) {}
  /// \param flattened  by vertex; only those of the facet are read
  FacetPlane(Vertices vertices, const std::vector<Point3>& flattened)
      : vertices_(vertices), flattened_(&flattened), apex_(plc::FacetFrame::apex_of_flattened) {}

  int orient(VertexId a, VertexId b, VertexId c) const { return orient3d(at(a), at(b), at(c), apex_); }

  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return incircle_perturbed(at(a), at(b), at(c), apex_, at(d),
                              {vertices_[a].rank, vertices_[b].rank, vertices_[c].rank, vertices_[d].rank});
  }

 private:
  const Point3& at(VertexId v) const { return flattened_ ? (*flattened_)[v] : vertices_[v].point; }

  Vertices vertices_;
  const std::vector<Point3>* flattened_ = nullptr;
  Point3 apex_;
};

/// The plane of a nearly flat facet, where the preferred diagonal is the one farther from the domain, or the Delaunay
/// one if the four vertices are exactly coplanar. Seen from the domain, the edges that `planar::legalize` leaves are
/// convex where they can be; and convex edges need no protection (Shewchuk 2002).
class NearlyFlatPlane {
 public:
  /// \param domain_side  +1: the domain is above the facet, -1: below
  NearlyFlatPlane(const FacetPlane& plane, Vertices vertices, int domain_side)
      : plane_(plane), vertices_(vertices), domain_side_(domain_side) {}

  int orient(VertexId a, VertexId b, VertexId c) const { return plane_.orient(a, b, c); }

  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    const int above =
        orient3d(vertices_[a].point, vertices_[b].point, vertices_[c].point, vertices_[d].point) * domain_side_;
    return above != 0 ? -above : plane_.incircle(a, b, c, d);
  }

 private:
  const FacetPlane& plane_;
  Vertices vertices_;
  int domain_side_;
};

/// How many facets a thread takes at a time.
constexpr std::size_t facets_per_chunk = 1024;

/// Processes the facets of one PLC; holds their shared data. Copies may work at the same time.
class FacetMesher {
 public:
  FacetMesher(const plc::Plc& plc, const protection::SegmentChains& chains, const delaunay::Delaunay& delaunay)
      : plc_(plc),
        chains_(chains),
        d_(delaunay),
        star_(delaunay),
        is_split_(chains.have_inner_vertices()),
        in_facet_(delaunay.vertices.size(), 0) {
    const auto has_one_triangle = [](const plc::Facet& facet) { return facet.triangle_count == 1; };
    if (!is_split_ && std::ranges::all_of(plc.facets, has_one_triangle)) return;
    std::vector<std::array<VertexId, 2>> edges;
    edges.reserve(plc.segments.size());
    for (const plc::Segment& s : plc.segments) edges.push_back(s.ends);
    segment_of_edge_ = std::make_shared<const EdgeMap>(edges, plc.vertices.size());
  }

  void triangulate(FacetId id, FacetMesh& result) {
    const plc::Facet& facet = plc_.facets[id];
    const std::span<const Triangle> triangles = plc_.triangles_of(facet);
    if (triangles.size() == 1 && is_unsplit(triangles[0])) {
      result.triangles.push_back(triangles[0]);
      result.facet.push_back(id);
      return;
    }
    const std::vector<FacetSegment> segments = segments_of(triangles);
    const FacetPlane plane = facet.exactly_flat ? exact_plane(triangles) : flatten(triangles, segments);
    planar::Triangulation t = split_triangulation(triangles, plane, segments);
    if (!facet.exactly_flat) take_faces_on_domain_side(facet, plane, t);
    result.triangles.insert(result.triangles.end(), t.triangles.begin(), t.triangles.end());
    result.facet.resize(result.triangles.size(), id);
  }

  /// Are these triangles of a facet Delaunay faces that have no flat cell on the domain's side?
  bool face_domain(const plc::Facet& facet, std::span<const Triangle> triangles, std::span<const std::uint32_t> codes) {
    if (std::ranges::find(codes, delaunay::no_neighbor) != codes.end()) return false;
    enter(facet, triangles);
    std::optional<FacetPlane> plane;  // rarely needed
    return std::ranges::none_of(codes, [&](std::uint32_t code) {
      const std::uint32_t cell = cell_on_domain_side(code);
      if (!has_all_vertices_here(cell)) return false;
      if (!plane) plane.emplace(flatten(plc_.triangles_of(facet), segments_of(plc_.triangles_of(facet))));
      return is_flat_cell(cell, *plane);
    });
  }

 private:
  struct FacetSegment {
    VertexId a, b;  ///< in the order of its triangle
    std::uint32_t segment;
    std::size_t number;  ///< in the order of the triangles
  };

  bool is_unsplit(const Triangle& t) const {
    if (!is_split_) return true;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t segment = segment_of_edge_->find(t[i], t[(i + 1) % 3]);
      if (segment != none && chains_[segment].size() != 2) return false;
    }
    return true;
  }

  std::vector<FacetSegment> segments_of(std::span<const Triangle> triangles) const {
    std::vector<FacetSegment> segments;
    segments.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        const VertexId a = t[i], b = t[(i + 1) % 3];
        if (const std::uint32_t found = segment_of_edge_->find(a, b); found != none)
          segments.push_back({a, b, found, segments.size()});
      }
    }
    // A segment within the facet is found from both sides.
    std::ranges::sort(segments, {}, [](const auto& s) { return std::pair(s.segment, s.number); });
    const auto same = [](const auto& l, const auto& r) { return l.segment == r.segment; };
    segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
    return segments;
  }

  FacetPlane exact_plane(std::span<const Triangle> triangles) const {
    return {d_.vertices, plc::FacetFrame(triangles, plc_.vertices).apex(triangles, plc_.vertices)};
  }

  FacetPlane flatten(std::span<const Triangle> triangles, const std::vector<FacetSegment>& segments) {
    const plc::FacetFrame frame(triangles, plc_.vertices);
    flattened_.resize(d_.vertices.size());
    const Point3 base = d_.point(triangles[0][0]);
    const auto flatten_vertex = [&](VertexId v) { flattened_[v] = frame.flattened(d_.point(v) - base); };
    for (const Triangle& t : triangles) std::for_each(t.begin(), t.end(), flatten_vertex);
    for (const FacetSegment& s : segments)
      for (const protection::ChainVertex& v : chains_[s.segment]) flatten_vertex(v.vertex);
    return FacetPlane(d_.vertices, flattened_);
  }

  planar::Triangulation split_triangulation(std::span<const Triangle> triangles, const FacetPlane& plane,
                                            const std::vector<FacetSegment>& segments) const {
    std::vector<planar::Edge> constrained;
    constrained.reserve(segments.size());
    std::size_t inner_vertices = 0;
    for (const FacetSegment& s : segments) {
      constrained.push_back({s.a, s.b});
      inner_vertices += chains_[s.segment].size() - 2;
    }
    planar::Triangulation t = planar::from_triangles(triangles, constrained, 2 * inner_vertices);
    planar::legalize(t, plane);
    for (const FacetSegment& s : segments) {
      const auto chain = chains_[s.segment];
      for (std::size_t i = 1; i + 1 < chain.size(); ++i)
        planar::split_edge(t, chain[i - 1].vertex, chain.back().vertex, chain[i].vertex, plane);
    }
    return t;
  }

  /// Are the three vertices on one line, up to the tolerance? Vertices along an edge of a rotated part are.
  bool is_chain(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point3 u = d_.point(b) - d_.point(a), v = d_.point(c) - d_.point(a), w = d_.point(c) - d_.point(b);
    const double longest = std::max({squared_length(u), squared_length(v), squared_length(w)});
    return squared_length(cross(u, v)) < 1e-12 * longest * longest;
  }

  /// Are all vertices of the cell in the current facet?
  bool has_all_vertices_here(std::uint32_t cell) const {
    return std::ranges::all_of(d_.cells[cell].vertices,
                               [&](std::uint32_t u) { return u != delaunay::ghost_vertex && in_facet_[u] == here_; });
  }

  /// Are all vertices of the cell in the current facet, and may it be left out? It may not if it alone joins a slightly
  /// protruding vertex on the border of the facet to the domain.
  bool is_flat_cell(std::uint32_t cell, const FacetPlane& plane) const {
    if (!has_all_vertices_here(cell)) return false;
    const auto& v = d_.cells[cell].vertices;
    for (const auto& corner : delaunay::face_corners) {
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t middle = v[corner[i]], a = v[corner[(i + 1) % 3]], b = v[corner[(i + 2) % 3]];
        if (!is_chain(a, middle, b) || dot(d_.point(a) - d_.point(middle), d_.point(b) - d_.point(middle)) > 0)
          continue;
        const std::uint32_t apex = v[0] ^ v[1] ^ v[2] ^ v[3] ^ a ^ b ^ middle;
        const int turn = plane.orient(VertexId(a), VertexId(middle), VertexId(apex));
        if (turn * domain_side_ * orient3d(d_.point(a), d_.point(middle), d_.point(apex), d_.point(b)) > 0)
          return false;
      }
    }
    return true;
  }

  /// Are all vertices of the cell in the current facet, although it may not be left out?
  bool is_kept_cell(std::uint32_t cell, const FacetPlane& plane) const {
    return has_all_vertices_here(cell) && !is_flat_cell(cell, plane);
  }

  /// The cell on the domain's side of a face of the facet, which is given by its code.
  std::uint32_t cell_on_domain_side(std::uint32_t code) const {
    const std::uint32_t cell = delaunay::cell_of(code);
    return domain_side_ > 0 ? cell : delaunay::cell_of(d_.cells[cell].neighbors[delaunay::face_of(code)]);
  }

  /// The edges of the facet's Delaunay faces that have no flat cell on the domain's side.
  std::vector<planar::Edge> edges_toward_domain(const FacetPlane& plane, const std::vector<VertexId>& vertices) {
    std::vector<planar::Edge> edges;
    for (const VertexId v : vertices) {
      for (const std::uint32_t c : star_.around(v)) {
        if (d_.is_ghost(c) || is_flat_cell(c, plane)) continue;
        for (std::uint32_t f = 0; f < 4; ++f) {
          const auto& corner = delaunay::face_corners[f];
          Triangle face;
          for (int i = 0; i < 3; ++i) face[i] = VertexId(d_.cells[c].vertices[corner[i]]);
          if (std::any_of(face.begin(), face.end(), [&](VertexId u) { return in_facet_[u] != here_; })) continue;
          if (face[0] > v || face[1] > v || face[2] > v) continue;  // once per face
          if (plane.orient(face[0], face[1], face[2]) != domain_side_ || is_chain(face[0], face[1], face[2])) continue;
          if (is_kept_cell(delaunay::cell_of(d_.cells[c].neighbors[f]), plane)) continue;
          for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(face[i], face[(i + 1) % 3]);
            edges.push_back({low, high});
          }
        }
      }
    }
    // The numbers of cells depend on how the tetrahedralization was made, but the triangles must not.
    std::ranges::sort(edges);
    const auto rest = std::ranges::unique(edges);
    edges.erase(rest.begin(), rest.end());
    return edges;
  }

  /// Makes this the current facet. \return its vertices
  std::vector<VertexId> enter(const plc::Facet& facet, std::span<const Triangle> triangles) {
    ++here_;
    domain_side_ = plc_.regions[facet.above].inside ? 1 : -1;
    std::vector<VertexId> vertices;
    for (const Triangle& triangle : triangles) {
      for (const VertexId v : triangle) {
        if (in_facet_[v] != here_) vertices.push_back(v);
        in_facet_[v] = here_;
      }
    }
    return vertices;
  }

  /// Gives a facet that is not exactly flat the Delaunay faces that have no flat cell on the domain's side.
  void take_faces_on_domain_side(const plc::Facet& facet, const FacetPlane& plane, planar::Triangulation& t) {
    const std::vector<VertexId> vertices = enter(facet, t.triangles);
    const auto is_right = [&](const Triangle& triangle) {
      const std::uint32_t code = delaunay::find_face(d_, triangle[0], triangle[1], triangle[2]);
      return code != delaunay::no_neighbor && !is_flat_cell(cell_on_domain_side(code), plane);
    };
    if (std::all_of(t.triangles.begin(), t.triangles.end(), is_right)) return;
    for (const planar::Edge& edge : edges_toward_domain(plane, vertices)) {
      const auto side = planar::find_edge(t, edge[0], edge[1]);
      if (!side || !t.constrained[side->triangle][side->corner]) planar::insert_constraint(t, edge[0], edge[1], plane);
    }
    // The rest are not Delaunay faces. Their edges must not be reflex, or else the front might find no way around them.
    const bool on_both_sides = plc_.regions[facet.above].inside && plc_.regions[facet.below].inside;
    if (!on_both_sides) planar::legalize(t, NearlyFlatPlane(plane, d_.vertices, domain_side_));
  }

  const plc::Plc& plc_;
  const protection::SegmentChains& chains_;
  const delaunay::Delaunay& d_;
  delaunay::CellStar star_;
  bool is_split_;                                   // has any segment vertices between its ends?
  std::shared_ptr<const EdgeMap> segment_of_edge_;  // shared with copies; none if no facet asks for its segments
  std::vector<Point3> flattened_;                   // by vertex, of the current facet
  std::vector<std::uint32_t> in_facet_;             // by vertex: the last facet in which it was seen, plus 1
  std::uint32_t here_ = 0;
  int domain_side_ = 1;  // of the current facet; +1: above
};

/// Calls `work(mesher, begin, end)` for chunks of 0 .. count, on several threads, in any order. A thread ends when its
/// call returns false.
template <class Work>
void in_chunks(const FacetMesher& first, std::size_t count, const Work& work) {
  std::vector<FacetMesher> meshers(std::min<std::size_t>(thread_count(), count / facets_per_chunk + 1), first);
  std::atomic<std::size_t> next = 0;
  parallel_for(meshers.size(), 1, [&](std::size_t m) {
    for (std::size_t begin = next.fetch_add(facets_per_chunk); begin < count; begin = next.fetch_add(facets_per_chunk))
      if (!work(meshers[m], begin, std::min(count, begin + facets_per_chunk))) return;
  });
}

/// The faces of each facet are consecutive.
struct FacetFaces {
  FacetId facet;
  std::size_t begin, end;
};

std::vector<FacetFaces> faces_by_facet(const FacetMesh& facets) {
  std::vector<FacetFaces> result;
  for (std::size_t i = 0; i < facets.facet.size(); ++i) {
    if (result.empty() || result.back().facet != facets.facet[i]) result.push_back({facets.facet[i], i, i});
    ++result.back().end;
  }
  return result;
}

}  // namespace

FacetMesh triangulate_facets(const plc::Plc& plc, const protection::SegmentChains& chains,
                             const delaunay::Delaunay& delaunay, const Progress& progress) {
  const std::size_t count = plc.facets.size();
  std::vector<FacetMesh> parts((count + facets_per_chunk - 1) / facets_per_chunk);
  SharedProgress shared(progress, "facets", 0, count);
  in_chunks(FacetMesher(plc, chains, delaunay), count, [&](FacetMesher& mesher, std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) mesher.triangulate(FacetId(f), parts[begin / facets_per_chunk]);
    return shared.add(end - begin);
  });
  FacetMesh result;
  for (const FacetMesh& part : parts) {
    result.triangles.insert(result.triangles.end(), part.triangles.begin(), part.triangles.end());
    result.facet.insert(result.facet.end(), part.facet.begin(), part.facet.end());
  }
  note_bytes(bytes_of(result.triangles, result.facet));
  return result;
}

bool follow_interior_vertices(const plc::Plc& plc, const protection::SegmentChains& chains,
                              const delaunay::Delaunay& delaunay, const std::vector<std::uint32_t>& codes,
                              FacetMesh& facets) {
  if (std::ranges::all_of(plc.facets, &plc::Facet::exactly_flat)) return false;
  FacetMesher first(plc, chains, delaunay);
  const std::vector<FacetFaces> by_facet = faces_by_facet(facets);
  std::vector<std::uint8_t> stays(by_facet.size());
  in_chunks(first, by_facet.size(), [&](FacetMesher& mesher, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [id, from, to] = by_facet[i];
      const plc::Facet& facet = plc.facets[id];
      stays[i] = facet.exactly_flat || mesher.face_domain(facet, std::span(facets.triangles).subspan(from, to - from),
                                                          std::span(codes).subspan(from, to - from));
    }
    return true;
  });
  if (std::ranges::all_of(stays, std::identity{})) return false;
  const FacetMesh old = std::move(facets);
  facets = {};
  for (std::size_t i = 0; i < by_facet.size(); ++i) {
    const auto& [id, from, to] = by_facet[i];
    if (stays[i] == 0) {
      first.triangulate(id, facets);
      continue;
    }
    facets.triangles.insert(facets.triangles.end(), old.triangles.begin() + from, old.triangles.begin() + to);
    facets.facet.resize(facets.triangles.size(), id);
  }
  return true;
}

}  // namespace ccdt::facets
