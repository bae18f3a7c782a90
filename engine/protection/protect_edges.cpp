#include "engine/protection/protect_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"

namespace ccdt::protection {
namespace {

constexpr std::uint32_t whole = whole_segment;

/// A piece of a segment.
struct Subsegment {
  std::uint32_t segment;
  ChainVertex from, to;
};

Point3 point_on_segment(const plc::Plc& plc, std::uint32_t segment, std::uint32_t fraction) {
  const Point3& a = plc.vertices[plc.segments[segment].ends[0]];
  const Point3& b = plc.vertices[plc.segments[segment].ends[1]];
  // The ends are multiples of 2^20, so that this is exact.
  return a + fraction * ((1.0 / whole) * (b - a));
}

/// More than any sound part needs; without a bound two facets that almost touch would keep a computer busy for hours.
std::size_t most_steiner_vertices(const plc::Plc& plc) {
  return 10000 + 100 * plc.vertices.size();
}

[[noreturn]] void refuse_further_splits(const plc::Plc& plc, const Subsegment& piece, const char* why) {
  Place place;
  place.file = plc.name;
  for (const VertexId v : plc.segments[piece.segment].ends) place.points.push_back(as_array(plc.world[v]));
  throw LimitError(
      std::string("a segment cannot be protected: ") + why, place,
      "look for features at its ends that are smaller than 1e-6 of it, and remove them or split the segment");
}

/// The current vertices and segments, and the working memory of the stage.
class Protector {
 public:
  Protector(const plc::Plc& plc, Protection strategy, delaunay::Delaunay& delaunay, const SegmentChains& chains)
      : plc_(plc),
        strategy_(strategy),
        d_(delaunay),
        insertion_(delaunay),
        star_(delaunay),
        segment_of_steiner_(delaunay.vertices.size() - plc.vertices.size()) {
    for (std::uint32_t s = 0; s < chains.size(); ++s)
      for (std::size_t i = 1; i + 1 < chains[s].size(); ++i)
        segment_of_steiner_[chains[s][i].vertex - plc.vertices.size()] = s;
  }

  bool is_protected(const std::vector<ChainVertex>& chain) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      if (!star_.has_edge(chain[i].vertex, chain[i + 1].vertex)) return false;
    return true;
  }

  /// Splits the pieces of one segment until, as things stand, all are Delaunay edges.
  void protect(std::uint32_t segment, std::vector<ChainVertex>& chain) {
    std::vector<ChainVertex> ahead(chain.rbegin(), chain.rend() - 1);
    chain.resize(1);
    while (!ahead.empty()) {
      const Subsegment piece{segment, chain.back(), ahead.back()};
      if (star_.has_edge(piece.from.vertex, piece.to.vertex)) {
        chain.push_back(piece.to);
        ahead.pop_back();
      } else {
        ahead.push_back(split(piece));
      }
    }
  }

 private:
  ChainVertex split(const Subsegment& piece) {
    if (piece.to.fraction - piece.from.fraction < 2)
      refuse_further_splits(plc_, piece, "it would have to be split into more than 2^20 pieces");
    if (segment_of_steiner_.size() > most_steiner_vertices(plc_))
      refuse_further_splits(plc_, piece, "the edges have been split far more often than there are vertices");
    const std::uint32_t fraction = split_fraction(piece);
    const auto id = static_cast<std::uint32_t>(d_.vertices.size());
    d_.vertices.push_back({point_on_segment(plc_, piece.segment, fraction), id, 0});
    insertion_.find_cavity(id, d_.vertices[piece.from.vertex].cell);
    insertion_.fill_cavity();
    segment_of_steiner_.push_back(piece.segment);
    return {VertexId(id), fraction, std::max(piece.from.level, piece.to.level) + 1};
  }

  /// A fraction strictly between the ends of the piece.
  std::uint32_t split_fraction(const Subsegment& piece) {
    const std::uint32_t middle = piece.from.fraction + (piece.to.fraction - piece.from.fraction) / 2;
    if (strategy_ == Protection::midpoint) return middle;
    const auto encroaching = encroaching_vertex(piece, middle);
    if (!encroaching) return middle;
    const auto& ends = plc_.segments[piece.segment].ends;
    const double length = std::sqrt(squared_length(d_.point(ends[1]) - d_.point(ends[0])));
    const double fraction = std::nearbyint(split_length(piece, *encroaching) / length * whole);
    return static_cast<std::uint32_t>(std::clamp(fraction, piece.from.fraction + 1.0, piece.to.fraction - 1.0));
  }

  /// Of the vertices around a point of the piece the one that sees the piece under the largest obtuse angle: it is why
  /// the piece is missing. Nothing if none is in the diametral sphere.
  std::optional<std::uint32_t> encroaching_vertex(const Subsegment& piece, std::uint32_t fraction) {
    const auto probe = static_cast<std::uint32_t>(d_.vertices.size());
    d_.vertices.push_back({point_on_segment(plc_, piece.segment, fraction), probe, 0});
    insertion_.find_cavity(probe, d_.vertices[piece.from.vertex].cell);
    const Point3 &a = d_.point(piece.from.vertex), &b = d_.point(piece.to.vertex);
    std::optional<std::uint32_t> worst;
    double least_cosine = 0;
    for (const delaunay::CavityFace& face : insertion_.cavity_faces()) {
      for (const std::uint32_t v : face.vertices) {
        if (v == delaunay::ghost_vertex || v == piece.from.vertex || v == piece.to.vertex) continue;
        const Point3 to_a = a - d_.point(v), to_b = b - d_.point(v);
        const double cosine = dot(to_a, to_b) / std::sqrt(squared_length(to_a) * squared_length(to_b));
        // Of equals the first, whatever the order of the cells.
        if (cosine > least_cosine || (cosine == least_cosine && v >= worst.value_or(0))) continue;
        least_cosine = cosine;
        worst = v;
      }
    }
    insertion_.discard_cavity();
    d_.vertices.pop_back();
    return worst;
  }

  /// Where the piece is split for the sake of an encroaching vertex, as a distance from the first end of its segment.
  double split_length(const Subsegment& piece, std::uint32_t encroaching) const {
    const auto& ends = plc_.segments[piece.segment].ends;
    const Point3 &first = d_.point(ends[0]), &p = d_.point(encroaching);
    const double length = std::sqrt(squared_length(d_.point(ends[1]) - first));
    if (encroaching >= plc_.vertices.size()) {
      // On a segment that meets this one: on its shell, so that the two do not split each other forever.
      const auto& others = plc_.segments[segment_of_steiner_[encroaching - plc_.vertices.size()]].ends;
      for (int i = 0; i < 2; ++i) {
        if (ends[i] != others[0] && ends[i] != others[1]) continue;
        const double radius = std::sqrt(squared_length(p - d_.point(ends[i])));
        const double along = i == 0 ? radius : length - radius;
        if (along * whole > length * (piece.from.fraction + 1) && along * whole < length * (piece.to.fraction - 1))
          return along;
      }
    }
    // Its foot: then it is in the diametral sphere of neither half.
    return dot(p - first, d_.point(ends[1]) - first) / length;
  }

  const plc::Plc& plc_;
  Protection strategy_;
  delaunay::Delaunay& d_;
  delaunay::Insertion insertion_;
  delaunay::CellStar star_;
  std::vector<std::uint32_t> segment_of_steiner_;  // by vertex less those of the PLC
};

/// The Delaunay edges that must stay.
std::vector<std::array<VertexId, 2>> edges_that_stay(const ProtectedDelaunay& p) {
  std::vector<std::array<VertexId, 2>> edges;
  for (std::size_t s = 0; s < p.chains.size(); ++s)
    for (std::size_t i = 0; p.must_be_chain[s] && i + 1 < p.chains[s].size(); ++i)
      edges.push_back({p.chains[s][i].vertex, p.chains[s][i + 1].vertex});
  return edges;
}

/// The edges that must stay, for fast queries.
struct ProtectedEdges {
  std::vector<std::uint8_t> on_edge;  ///< by vertex, those before the interior ones
  EdgeMap edges;

  explicit ProtectedEdges(const ProtectedDelaunay& p) : on_edge(p.delaunay.vertices.size(), 0) {
    const auto list = edges_that_stay(p);
    for (const auto& [a, b] : list) on_edge[a] = on_edge[b] = 1;
    edges = EdgeMap(list, on_edge.size());
  }
  bool may_have(std::uint32_t v) const { return v < on_edge.size() && on_edge[v] != 0; }
  bool has(std::uint32_t a, std::uint32_t b) const { return edges.find(a, b) != EdgeMap::none; }
};

/// Would filling this cavity destroy a protected edge, one that no face of the cavity has?
bool destroys_edge(const delaunay::Delaunay& d, const delaunay::Insertion& insertion, const ProtectedEdges& edges,
                   std::vector<std::uint64_t>& found) {
  found.clear();
  const auto interior = static_cast<std::uint32_t>(edges.on_edge.size());  // the first id, and all from there on
  for (const std::uint32_t c : insertion.cavity_cells()) {
    const auto& v = d.cells[c].vertices;
    const int others = int{v[0] < interior} + int{v[1] < interior} + int{v[2] < interior} + int{v[3] < interior};
    if (others < 2) continue;
    for (int i = 1; i < 4; ++i) {
      if (!edges.may_have(v[i])) continue;
      for (int j = 0; j < i; ++j) {
        if (edges.may_have(v[j]) && edges.has(v[i], v[j])) found.push_back(edge_key(v[i], v[j]));
      }
    }
  }
  if (found.empty()) return false;
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  // The faces are a closed surface, which passes each of its edges once in each direction.
  std::ptrdiff_t on_faces = 0;
  for (const delaunay::CavityFace& face : insertion.cavity_faces()) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = face.vertices[i], b = face.vertices[i < 2 ? i + 1 : 0];
      if (a < b && edges.may_have(a) && edges.may_have(b) && edges.has(a, b)) ++on_faces;
    }
  }
  return on_faces < repeated.begin() - found.begin();
}

/// The vertices with the points that are not among them, ranked as they would be inserted.
std::vector<delaunay::DelaunayVertex> with_points(std::vector<delaunay::DelaunayVertex> vertices,
                                                  std::span<const Point3> points) {
  const auto less = [](const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<Point3> taken;
  taken.reserve(vertices.size());
  for (const delaunay::DelaunayVertex& v : vertices) taken.push_back(v.point);
  std::ranges::sort(taken, less);
  for (const std::uint32_t i : delaunay::hilbert_order(points))
    if (!std::ranges::binary_search(taken, points[i], less))
      vertices.push_back({points[i], static_cast<std::uint32_t>(vertices.size()), 0});
  return vertices;
}

}  // namespace

ProtectedDelaunay unprotected(const plc::Plc& plc, delaunay::Delaunay delaunay) {
  ProtectedDelaunay result{std::move(delaunay), {}, {}};
  for (const plc::Segment& s : plc.segments) {
    result.chains.push_back({{s.ends[0], 0}, {s.ends[1], whole}});
    result.must_be_chain.push_back(s.grazeable);
  }
  return result;
}

ProtectedDelaunay protect_edges(const plc::Plc& plc, ProtectedDelaunay start, Protection strategy,
                                const Progress& progress) {
  SegmentChains& chains = start.chains;
  Protector protector(plc, strategy, start.delaunay, chains);
  // A new vertex may destroy a segment that was done: repeat until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t s = 0; s < plc.segments.size(); ++s) {
      if ((s & 0xFFF) == 0) report(progress, "protect", s, plc.segments.size());
      if (!start.must_be_chain[s] || protector.is_protected(chains[s])) continue;
      protector.protect(s, chains[s]);
      changed = true;
    }
  }
  note_bytes(bytes_of(start.delaunay.vertices, start.delaunay.cells, start.delaunay.free_cells));
  return start;
}

std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains) {
  std::vector<std::uint64_t> splits;
  for (const auto& chain : chains)
    for (const ChainVertex& v : chain) {
      if (v.level > splits.size()) splits.resize(v.level, 0);
      if (v.level > 0) ++splits[v.level - 1];
    }
  return splits;
}

delaunay::Delaunay insert_interior(std::span<const Point3> points, ProtectedDelaunay start, const Progress& progress) {
  const ProtectedEdges edges(start);
  delaunay::Delaunay& delaunay = start.delaunay;
  delaunay.vertices.reserve(delaunay.vertices.size() + points.size());
  delaunay.cells.reserve(delaunay.cells.size() + 7 * points.size());
  delaunay::Insertion insertion(delaunay);
  std::vector<std::uint64_t> found;
  std::uint32_t last = delaunay.vertices[0].cell;
  std::uint64_t done = 0;
  for (const std::uint32_t i : delaunay::hilbert_order(points)) {
    if ((++done & 0xFFFF) == 0) report(progress, "delaunay", done, points.size());
    const auto id = static_cast<std::uint32_t>(delaunay.vertices.size());
    delaunay.vertices.push_back({points[i], id, 0});
    if (insertion.find_cavity(id, last) && !destroys_edge(delaunay, insertion, edges, found)) {
      last = insertion.fill_cavity();
    } else {
      insertion.discard_cavity();
      delaunay.vertices.pop_back();
    }
  }
  note_bytes(bytes_of(delaunay.vertices, delaunay.cells, delaunay.free_cells, edges.on_edge, points) +
             insertion.bytes());
  return std::move(start.delaunay);
}

delaunay::Delaunay wrap_interior(std::span<const Point3> points, ProtectedDelaunay start, double grid_scale,
                                 const Progress& progress) {
  delaunay::Delaunay all = delaunay::wrap_delaunay(with_points(start.delaunay.vertices, points), grid_scale, progress);
  // Edges that are there with all points were there with any part of them: then insertion would drop none.
  delaunay::CellStar star(all);
  if (std::ranges::all_of(edges_that_stay(start), [&](const auto& edge) { return star.has_edge(edge[0], edge[1]); }))
    return all;
  return delaunay::wrap_delaunay(insert_interior(points, std::move(start), progress).vertices, grid_scale, progress);
}

}  // namespace ccdt::protection
