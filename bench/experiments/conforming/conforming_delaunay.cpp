#include "bench/experiments/conforming/conforming_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/errors.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/planar/triangulation.h"
#include "engine/refine/facet_triangulation.h"

namespace ccdt::conforming {
namespace {

using Triangle = std::array<VertexId, 3>;
using protection::PieceEnds;
using refine::FacetTriangulation;

constexpr int most_rounds = 500;

struct Circumcircle {
  Point3 center;
  double radius = 0;
};

Circumcircle circumcircle_of(const std::array<Point3, 3>& t) {
  const Point3 u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  const Point3 offset = (0.5 / squared_length(n)) * (squared_length(u) * cross(v, n) + squared_length(v) * cross(n, u));
  return {t[0] + offset, length(offset)};
}

/// The circumcenter, or a place on the way to it if it is beyond all coordinates. The boundary blocks the way earlier.
Point3 reachable_center(const std::array<Point3, 3>& t, const Circumcircle& circle) {
  constexpr double farthest = 0x1p50;
  if (circle.radius < farthest) return circle.center;
  const Point3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
  return middle + (farthest / length(circle.center - middle)) * (circle.center - middle);
}

/// Sorted edges, each with its smaller end first.
using Edges = std::vector<planar::Edge>;

Edges sorted_edges(std::vector<planar::Edge> edges) {
  for (planar::Edge& edge : edges) std::ranges::sort(edge);
  std::ranges::sort(edges);
  return edges;
}

/// The given edges that are edges of these triangles.
std::vector<planar::Edge> edges_among(const Edges& edges, std::span<const Triangle> triangles) {
  std::vector<planar::Edge> found;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = t[i], b = t[(i + 1) % 3];
      if (std::ranges::binary_search(edges, planar::Edge{std::min(a, b), std::max(a, b)})) found.push_back({a, b});
    }
  return found;
}

/// A new vertex inside a facet.
struct FacetVertex {
  FacetId facet;
  Point3 place;
};

class Conformer {
 public:
  Conformer(plc::Plc plc, protection::Protection strategy) : plc_(std::move(plc)), strategy_(strategy) {
    // Which faces of a tetrahedralization the input's triangles are changes with the vertices.
    std::ranges::fill(plc_.faces, plc::no_face);
    for (plc::Segment& s : plc_.segments) s.face = plc::no_face;
    of_input_ = plc_.vertices.size();
    std::vector<planar::Edge> segments;
    for (const plc::Segment& s : plc_.segments) segments.push_back(s.ends);
    segments_ = sorted_edges(std::move(segments));
  }

  ConformingDelaunay run(std::size_t most_vertices) {
    result_.surface = start();
    note_missing();
    try {
      for (int round = 0; round < most_rounds; ++round) {
        protect({});
        std::vector<std::uint32_t> missing = find_missing_faces();
        result_.is_conforming = missing.empty();
        if (missing.empty() || result_.surface.delaunay.vertices.size() > most_vertices || !add_vertices(missing))
          break;
      }
    } catch (const LimitError&) {
      // A piece of a segment became too short.
    }
    return std::move(result_);
  }

 private:
  /// All vertices so far, in an unprotected tetrahedralization.
  protection::ProtectedDelaunay start() const {
    std::vector<Point3> points = plc_.vertices;
    points.insert(points.end(), on_segments_.begin(), on_segments_.end());
    protection::ProtectedDelaunay state = protection::unprotected(plc_, delaunay::build_delaunay(points), chains_);
    state.must_be_chain.assign(plc_.segments.size(), true);
    return state;
  }

  void note_missing() {
    for (const auto& [a, b] : result_.surface.chains.pieces())
      result_.missing_segments += delaunay::has_edge(result_.surface.delaunay, a, b) ? 0 : 1;
    result_.missing_faces = find_missing_faces().size();
  }

  void protect(std::span<const PieceEnds> to_split) {
    result_.surface = protection::protect_edges(plc_, std::move(result_.surface), strategy_, {}, to_split);
    const delaunay::Delaunay& d = result_.surface.delaunay;
    on_segments_.clear();
    for (std::size_t v = plc_.vertices.size(); v < d.vertices.size(); ++v)
      on_segments_.push_back(d.point(static_cast<std::uint32_t>(v)));
    chains_ = result_.surface.chains;
    result_.on_segments = on_segments_.size();
    result_.in_facets = plc_.vertices.size() - of_input_;
  }

  /// Triangulates the facets. \return  the faces that are not Delaunay, those with the largest circumcircles first
  std::vector<std::uint32_t> find_missing_faces() {
    const delaunay::Delaunay& d = result_.surface.delaunay;
    result_.faces = facets::triangulate_facets(plc_, result_.surface.chains, d);
    const std::vector<std::uint32_t> codes = front::find_delaunay_faces(result_.faces.triangles, d);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::uint32_t f = 0; f < codes.size(); ++f)
      if (codes[f] == delaunay::no_neighbor) found.emplace_back(-circumcircle_of(corners_of(f)).radius, f);
    std::ranges::sort(found);
    std::vector<std::uint32_t> missing;
    for (const auto& [radius, f] : found) missing.push_back(f);
    return missing;
  }

  std::array<Point3, 3> corners_of(std::uint32_t face) const {
    const auto& [a, b, c] = result_.faces.triangles[face];
    const delaunay::Delaunay& d = result_.surface.delaunay;
    return {d.point(a), d.point(b), d.point(c)};
  }

  /// Adds vertices for these faces, except where they would be too close together. \return  false if it added none
  bool add_vertices(const std::vector<std::uint32_t>& missing) {
    points_ = plc_.vertices;
    points_.insert(points_.end(), on_segments_.begin(), on_segments_.end());
    pieces_ = sorted_edges(chains_.pieces());
    facets_.clear();
    std::vector<Circumcircle> used;
    std::vector<PieceEnds> to_split;
    std::vector<FacetVertex> added;
    for (const std::uint32_t face : missing) {
      const Circumcircle circle = circumcircle_of(corners_of(face));
      const auto is_near = [&](const Circumcircle& other) {
        return length(other.center - circle.center) < std::max(other.radius, circle.radius);
      };
      if (std::ranges::any_of(used, is_near)) continue;
      if (choose_vertex(face, circle, to_split, added)) used.push_back(circle);
    }
    const std::size_t before = on_segments_.size();
    protect(to_split);
    if (!added.empty()) {
      insert(added);
      move_chains(added.size());
      result_.surface = start();
    }
    return !added.empty() || on_segments_.size() > before;
  }

  /// The facet of a face, with the vertices on its segments.
  struct FacetOfFace {
    std::uint32_t first_face;
    FacetTriangulation triangulation;
  };

  FacetOfFace& facet_of(std::uint32_t face) {
    const FacetId id = result_.faces.facet[face];
    if (const auto found = facets_.find(id); found != facets_.end()) return found->second;
    const auto [begin, end] = std::ranges::equal_range(result_.faces.facet, id);
    const auto first = static_cast<std::uint32_t>(begin - result_.faces.facet.begin());
    const std::span<const Triangle> triangles =
        std::span(result_.faces.triangles).subspan(first, static_cast<std::size_t>(end - begin));
    return facets_
        .emplace(id, FacetOfFace{first, FacetTriangulation(triangles, plc_.facets[id].exactly_flat,
                                                           edges_among(pieces_, triangles), points_)})
        .first->second;
  }

  /// Chooses a vertex in the facet of a face, or pieces of segments to be split. \return  false if there is no place
  bool choose_vertex(std::uint32_t face, const Circumcircle& circle, std::vector<PieceEnds>& to_split,
                     std::vector<FacetVertex>& added) {
    FacetOfFace& facet = facet_of(face);
    const std::optional<Point3> place =
        facet.triangulation.snap(reachable_center(corners_of(face), circle), circle.radius);
    if (!place) return false;
    const VertexId v(points_.size());
    points_.push_back(*place);
    const refine::WalkEnd end = facet.triangulation.walk(face - facet.first_face, v);
    points_.pop_back();
    const planar::Triangulation& t = facet.triangulation.triangulation();
    const auto split = [&](const planar::Side& side) {
      to_split.push_back({planar::edge_start(t, side), planar::edge_end(t, side)});
    };
    if (end.wall) {
      split(*end.wall);
      return true;
    }
    if (end.triangle == none) return false;
    const std::vector<planar::Side> encroached = encroached_sides(t, *place);
    std::ranges::for_each(encroached, split);
    if (encroached.empty()) added.push_back({result_.faces.facet[face], *place});
    return true;
  }

  std::vector<planar::Side> encroached_sides(const planar::Triangulation& t, const Point3& p) const {
    std::vector<planar::Side> sides;
    for (std::uint32_t triangle = 0; triangle < t.triangles.size(); ++triangle)
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const planar::Side side{triangle, corner};
        const bool is_wall = planar::is_constrained(t, side) || planar::neighbor(t, side) == none;
        const Point3 &a = points_[planar::edge_start(t, side)], &b = points_[planar::edge_end(t, side)];
        if (is_wall && dot(a - p, b - p) < 0) sides.push_back(side);
      }
    return sides;
  }

  /// Adds vertices inside the facets of the PLC.
  void insert(const std::vector<FacetVertex>& added) {
    std::multimap<FacetId, VertexId> vertices;
    for (const FacetVertex& v : added) {
      vertices.emplace(v.facet, VertexId(plc_.vertices.size()));
      plc_.vertices.push_back(v.place);
      plc_.world.push_back(plc_.grid.to_world(v.place));
    }
    const plc::Plc old = plc_;
    plc_.facets.clear(), plc_.triangles.clear(), plc_.faces.clear();
    for (std::uint32_t f = 0; f < old.facets.size(); ++f) {
      const plc::Facet& facet = old.facets[f];
      const std::span<const Triangle> triangles = old.triangles_of(facet);
      const auto [begin, end] = vertices.equal_range(FacetId(f));
      if (begin == end) {
        plc_.add(facet, triangles);
        continue;
      }
      FacetTriangulation t(triangles, facet.exactly_flat, edges_among(segments_, triangles), plc_.vertices);
      for (auto v = begin; v != end; ++v) t.insert(v->second, t.find(v->second));
      plc_.add(facet, t.triangulation().triangles);
    }
  }

  /// The ids of vertices on segments follow those of the PLC.
  void move_chains(std::size_t by) {
    std::vector<protection::InnerVertex> inner;
    for (std::uint32_t s = 0; s < chains_.size(); ++s)
      for (protection::ChainVertex v : chains_[s].subspan(1, chains_[s].size() - 2))
        inner.push_back({s, {VertexId(v.vertex + by), v.fraction, v.level}});
    chains_ = protection::SegmentChains(plc_.segments);
    chains_.insert(std::move(inner));
  }

  plc::Plc plc_;  // gains the vertices inside facets
  protection::Protection strategy_;
  std::size_t of_input_;             // number of vertices
  std::vector<Point3> on_segments_;  // by id, after those of the PLC
  protection::SegmentChains chains_;
  ConformingDelaunay result_;
  std::vector<Point3> points_;  // of all vertices, for the triangulations of facets
  std::map<FacetId, FacetOfFace> facets_;
  Edges segments_, pieces_;  // the segments of the PLC, and their current pieces
};

}  // namespace

ConformingDelaunay make_conforming(plc::Plc plc, protection::Protection strategy, std::size_t most_vertices) {
  return Conformer(std::move(plc), strategy).run(most_vertices);
}

}  // namespace ccdt::conforming
