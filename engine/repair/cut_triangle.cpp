#include "engine/repair/cut_triangle.h"

#include <algorithm>
#include <optional>

#include "engine/geometry/integer_points.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/projected_plane.h"

namespace ccdt::repair {
namespace {

using planar::Edge;
using plc::VertexTriple;

void sort_each_once(auto& items) {
  std::ranges::sort(items);
  const auto again = std::ranges::unique(items);
  items.erase(again.begin(), again.end());
}

/// Of equal items, keeps one if their number is odd, and none if it is even.
void sort_and_cancel(std::vector<Edge>& edges) {
  std::ranges::sort(edges);
  std::vector<Edge> kept;
  for (const Edge& e : edges) {
    if (!kept.empty() && kept.back() == e)
      kept.pop_back();
    else
      kept.push_back(e);
  }
  edges = std::move(kept);
}

Edge sorted(VertexId a, VertexId b) {
  return {std::min(a, b), std::max(a, b)};
}

class TriangleCutter {
 public:
  TriangleCutter(std::span<const Point3> vertices, const DividedTriangle& triangle)
      : vertices_(vertices),
        triangle_(triangle),
        plane_{vertices, {}, dominant_axis(plc::points_of(vertices, triangle.corners))},
        sense_(plane_.orient(triangle.corners[0], triangle.corners[1], triangle.corners[2])) {
    for (std::size_t k = 0; k < 3; ++k) {
      around_.push_back(triangle.corners[k]);
      around_.insert(around_.end(), triangle.on_edges[k].begin(), triangle.on_edges[k].end());
    }
    // Where the outline runs out and back, there is no inside, and its neighbors meet.
    for (std::size_t i = 0; i < around_.size(); ++i)
      outline_.push_back(sorted(around_[i], around_[(i + 1) % around_.size()]));
    sort_and_cancel(outline_);
    for (const auto& [a, b] : triangle.pieces) {
      if (a != b && !std::ranges::binary_search(outline_, sorted(a, b))) pieces_.push_back(sorted(a, b));
      for (const VertexId v : {a, b}) all_.push_back(v);
    }
    sort_each_once(pieces_);
    for (const Edge& e : outline_)
      for (const VertexId v : e) rim_.push_back(v);
    sort_each_once(rim_);
    all_.insert(all_.end(), rim_.begin(), rim_.end());
    sort_each_once(all_);
  }

  TriangleParts run() {
    TriangleParts parts;
    if (outline_.empty()) return parts;
    if (with_pieces(parts.triangles)) return parts;
    find_beyond_edges(parts.beyond_edges);
    if (!with_some_pieces(parts.triangles) && !without_pieces(parts.triangles)) as_fan(parts.triangles);
    return parts;
  }

 private:
  /// Takes the triangles of the triangulation if it has the given outline. \return does it?
  bool take(const planar::Triangulation& t, std::vector<VertexTriple>& parts) const {
    if (planar::border_edges(t) != outline_) return false;
    for (const auto& [a, b, c] : t.triangles)
      parts.push_back(sense_ > 0 ? VertexTriple{a, b, c} : VertexTriple{a, c, b});
    return true;
  }

  bool with_pieces(std::vector<VertexTriple>& parts) const {
    std::vector<Edge> edges = outline_;
    edges.insert(edges.end(), pieces_.begin(), pieces_.end());
    const auto result = planar::triangulate(std::span(all_), std::span<const Edge>(edges), plane_);
    return result && result.unused.empty() && take(result.triangulation, parts);
  }

  /// Leaves out the pieces that cross others.
  bool with_some_pieces(std::vector<VertexTriple>& parts) const {
    auto result = planar::triangulate(std::span(all_), std::span<const Edge>(outline_), plane_);
    if (!result || planar::border_edges(result.triangulation) != outline_) return false;
    for (const auto& [a, b] : pieces_)
      if (planar::has_vertex(result.triangulation, a) && planar::has_vertex(result.triangulation, b))
        planar::insert_constraint(result.triangulation, a, b, plane_);
    return take(result.triangulation, parts);
  }

  bool without_pieces(std::vector<VertexTriple>& parts) const {
    const auto result = planar::triangulate(std::span(rim_), std::span<const Edge>(outline_), plane_);
    return result && take(result.triangulation, parts);
  }

  /// The outline crosses itself. Its fan is folded, but closes the surface.
  void as_fan(std::vector<VertexTriple>& parts) const {
    for (std::size_t i = 2; i < around_.size(); ++i)
      if (around_[0] != around_[i - 1] && around_[i - 1] != around_[i] && around_[i] != around_[0])
        parts.push_back({around_[0], around_[i - 1], around_[i]});
  }

  void find_beyond_edges(std::vector<std::pair<std::size_t, VertexId>>& found) const {
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<VertexId> chain = {triangle_.corners[k]};
      chain.insert(chain.end(), triangle_.on_edges[k].begin(), triangle_.on_edges[k].end());
      chain.push_back(triangle_.corners[plc::next_corner(k)]);
      for (const VertexId v : all_)
        if (std::ranges::find(chain, v) == chain.end() && is_beyond(chain, v)) found.emplace_back(k, v);
    }
  }

  /// Is a vertex beside one of the edges of the chain, and not on the inner side?
  bool is_beyond(const std::vector<VertexId>& chain, VertexId v) const {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Point3 &a = vertices_[chain[i]], &b = vertices_[chain[i + 1]];
      if (plane_.orient(chain[i], chain[i + 1], v) * sense_ > 0) continue;
      const auto axis = static_cast<std::size_t>(dominant_axis(b - a));
      const auto [low, high] = std::minmax({as_array(a)[axis], as_array(b)[axis]});
      const double x = as_array(vertices_[v])[axis];
      if (low <= x && x <= high) return true;
    }
    return false;
  }

  std::span<const Point3> vertices_;
  const DividedTriangle& triangle_;
  plc::ProjectedPlane plane_;
  int sense_;
  std::vector<VertexId> around_;     // corners and vertices on the edges, in order
  std::vector<Edge> outline_;        // sorted
  std::vector<Edge> pieces_;         // sorted
  std::vector<VertexId> rim_, all_;  // the vertices of the outline, and with those of the pieces; sorted
};

}  // namespace

TriangleParts cut_triangle(std::span<const Point3> vertices, const DividedTriangle& triangle) {
  return TriangleCutter(vertices, triangle).run();
}

}  // namespace ccdt::repair
