#include "engine/tets/fill_polyhedron.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"

namespace ccdt::tets {
namespace {

/// Nearly all searches that succeed need hardly more steps than there are tetrahedra.
constexpr int most_search_steps = 200;

/// Calls visit(v) for the vertices of a set.
template <class Visit>
void for_each(std::uint32_t set, const Visit& visit) {
  for (; set != 0; set &= set - 1) visit(static_cast<Corner>(std::countr_zero(set)));
}

std::uint32_t corner_set(const CornerTriangle& t) {
  return corner_bit(t[0]) | corner_bit(t[1]) | corner_bit(t[2]);
}

bool are_same(const CornerTriangle& s, const CornerTriangle& t) {
  for (int i = 0; i < 3; ++i)
    if (s[0] == t[i]) return s[1] == t[(i + 1) % 3] && s[2] == t[(i + 2) % 3];
  return false;
}

/// The vertices on the other side.
CornerSet opposite(const Sides& sides, Corner v) {
  if ((sides.above & corner_bit(v)) != 0) return sides.below;
  return (sides.below & corner_bit(v)) != 0 ? sides.above : 0;
}

/// The sides of a tetrahedron on a base, except the base, as seen from outside.
std::array<CornerTriangle, 3> sides_on(const CornerTriangle& base, Corner apex) {
  const auto& [a, b, c] = base;
  return {CornerTriangle{a, b, apex}, CornerTriangle{b, c, apex}, CornerTriangle{c, a, apex}};
}

}  // namespace

bool PolyhedronFiller::fill(const CellComplex& x, const std::vector<Triangle>& hull, int region, double least,
                            std::vector<NewCell>& cells) {
  goal_ = x.goal();
  least_ = least;
  if (!load(x, hull) || !(join_to_vertex() || search())) return false;
  for (const auto& [a, b, c, d] : tetrahedra_) {
    const std::array vertices = {vertices_[a], vertices_[b], vertices_[c], vertices_[d]};
    cells.push_back({vertices, region, x.quality_of(vertices)});
  }
  return true;
}

/// Numbers the vertices. \return false if there are too many
bool PolyhedronFiller::load(const CellComplex& x, const std::vector<Triangle>& hull) {
  vertices_.clear(), points_.clear(), hull_.clear();
  const auto corner_of = [&](std::uint32_t vertex) {
    const auto found = std::ranges::find(vertices_, vertex);
    const auto corner = static_cast<Corner>(found - vertices_.begin());
    if (found == vertices_.end()) vertices_.push_back(vertex), points_.push_back(x.point(vertex));
    return corner;
  };
  for (const auto& [a, b, c] : hull) {
    const Corner first = corner_of(a), second = corner_of(b);
    hull_.push_back({first, second, corner_of(c)});
  }
  return vertices_.size() <= most_vertices;
}

double PolyhedronFiller::quality_on(const CornerTriangle& t, Corner apex) const {
  return cell_quality(goal_, points_[t[0]], points_[t[1]], points_[t[2]], points_[apex]);
}

/// Joins all faces to the vertex for which the worst tetrahedron is best. That is far cheaper than a search.
/// \return is there a vertex that sees all faces, with tetrahedra that are good enough?
bool PolyhedronFiller::join_to_vertex() {
  double best_quality = least_;
  std::optional<Corner> best;
  const auto corners = static_cast<Corner>(vertices_.size());
  for (Corner v = 0; v < corners; ++v) {
    const double quality = quality_from(v, best_quality);
    if (quality > best_quality && keeps_all_faces(v)) best_quality = quality, best = v;
  }
  tetrahedra_.clear();
  if (!best) return false;
  for (const CornerTriangle& t : hull_)
    if (!has(t, *best)) tetrahedra_.push_back({t[0], t[1], t[2], *best});
  return true;
}

/// The quality of the worst tetrahedron between a vertex and the faces; any value up to `least` if it is not better
/// than that.
double PolyhedronFiller::quality_from(Corner v, double least) const {
  const auto sees = [&](const CornerTriangle& t) {
    return has(t, v) || orient3d(points_[t[0]], points_[t[1]], points_[t[2]], points_[v]) > 0;
  };
  if (!std::ranges::all_of(hull_, sees)) return least;
  double worst = std::numeric_limits<double>::infinity();
  for (const CornerTriangle& t : hull_) {
    if (has(t, v)) continue;
    worst = std::min(worst, quality_on(t, v));
    if (!(worst > least)) return least;
  }
  return worst;
}

/// Joining the vertex to the other faces makes tetrahedra. Are all faces at the vertex faces of these, and is each
/// further face in two of them? A facet that ends inside the polyhedron could be lost.
bool PolyhedronFiller::keeps_all_faces(Corner v) const {
  EdgeSets joined{}, at_vertex{};  // directed edges of the other faces, and those opposite the vertex
  const auto add = [](EdgeSets& edges, Corner a, Corner b) {
    const bool is_new = (edges[a] & corner_bit(b)) == 0;
    edges[a] |= corner_bit(b);
    return is_new;
  };
  for (const auto& [a, b, c] : hull_) {
    const bool is_new = a == v   ? add(at_vertex, b, c)
                        : b == v ? add(at_vertex, c, a)
                        : c == v ? add(at_vertex, a, b)
                                 : add(joined, a, b) && add(joined, b, c) && add(joined, c, a);
    if (!is_new) return false;
  }
  const auto n = static_cast<Corner>(vertices_.size());
  for (Corner a = 0; a < n; ++a) {
    CornerSet to_joined = 0, to_any = 0;
    for (Corner b = 0; b < n; ++b) {
      if ((joined[b] & corner_bit(a)) != 0) to_joined |= corner_bit(b);
      if (((joined[b] | at_vertex[b]) & corner_bit(a)) != 0) to_any |= corner_bit(b);
    }
    const bool is_once = (joined[a] & at_vertex[a]) == 0;
    if (!is_once || (at_vertex[a] & ~to_joined) != 0 || (joined[a] & ~to_any) != 0) return false;
  }
  return true;
}

/// Is there a vertex that makes a good tetrahedron with a face? Often, a face that must stay has no tetrahedron above
/// the least quality. Then no search succeeds.
bool PolyhedronFiller::has_apex(const CornerTriangle& t) const {
  const auto corners = static_cast<Corner>(vertices_.size());
  for (Corner v = 0; v < corners; ++v)
    if (!has(t, v) && quality_on(t, v) > least_) return true;
  return false;
}

/// Searches from the whole polyhedron.
bool PolyhedronFiller::search() {
  if (!std::ranges::all_of(hull_, [&](const CornerTriangle& t) { return has_apex(t); })) return false;
  sides_.find(points_);
  find_free_edges();
  front_.clear(), saved_front_.clear();
  edges_.fill(0);
  for (const CornerTriangle& t : hull_) add_front(t);
  steps_left_ = most_search_steps;
  const bool found = search_on();
  if (steps_left_ < 0) ++work_done.filling_steps;
  return found;
}

void PolyhedronFiller::find_free_edges() {
  const auto n = static_cast<Corner>(vertices_.size());
  const auto all = static_cast<CornerSet>((std::uint64_t{1} << n) - 1);
  for (Corner v = 0; v < n; ++v) free_edges_[v] = all & ~corner_bit(v);
  for (const CornerTriangle& t : hull_) {
    const Sides both = sides_.of(t[0], t[1], t[2]);
    for_each(both.above, [&](Corner p) {
      for_each(both.below & free_edges_[p], [&](Corner q) {
        if (!sides_.is_around(t, p, q)) return;
        free_edges_[p] &= ~corner_bit(q);
        free_edges_[q] &= ~corner_bit(p);
      });
    });
  }
}

void PolyhedronFiller::add_front(const CornerTriangle& t) {
  const auto& [a, b, c] = t;
  const Sides both = sides_.of(a, b, c);
  front_.push_back({t, both, both.above & free_edges_[a] & free_edges_[b] & free_edges_[c]});
  edges_[a] |= corner_bit(b) | corner_bit(c);
  edges_[b] |= corner_bit(a) | corner_bit(c);
  edges_[c] |= corner_bit(a) | corner_bit(b);
}

/// Searches from the front.
bool PolyhedronFiller::search_on() {
  if (front_.empty()) return true;
  if (--steps_left_ < 0) return false;
  CornerSet on_front = 0;
  for (const FrontFace& face : front_) on_front |= corner_set(face.corners);
  const auto count = [&](const FrontFace& face) { return std::popcount(face.apexes & on_front); };
  const FrontFace fewest = *std::ranges::min_element(front_, {}, count);
  const CornerTriangle& base = fewest.corners;
  std::array<std::pair<double, Corner>, most_vertices> trials;
  std::size_t trial_count = 0;
  for_each(fewest.apexes & on_front, [&](Corner apex) {
    const double quality = quality_on(base, apex);
    if (quality > least_) trials[trial_count++] = {-quality, apex};
  });
  std::sort(trials.begin(), trials.begin() + static_cast<std::ptrdiff_t>(trial_count));
  const auto saved = static_cast<std::ptrdiff_t>(saved_front_.size());
  saved_front_.insert(saved_front_.end(), front_.begin(), front_.end());
  const EdgeSets edges = edges_;
  const std::size_t size = tetrahedra_.size();
  for (std::size_t i = 0; i < trial_count; ++i) {
    const Corner apex = trials[i].second;
    if (is_blocked(base, apex)) continue;
    if (put(base, apex) && search_on()) return true;
    front_.assign(saved_front_.begin() + saved, saved_front_.end());
    edges_ = edges;
    tetrahedra_.resize(size);
  }
  saved_front_.resize(static_cast<std::size_t>(saved));
  return false;
}

/// Does the tetrahedron contain a vertex, or cross edges or the front?
bool PolyhedronFiller::is_blocked(const CornerTriangle& base, Corner apex) const {
  CornerSet within = sides_.of(base[0], base[1], base[2]).above;
  for (const CornerTriangle& side : sides_on(base, apex)) {
    within &= sides_.of(side[0], side[1], side[2]).below;
    if (is_pierced(side)) return true;
  }
  if (within != 0) return true;
  return std::ranges::any_of(front_, [&](const FrontFace& face) {
    const CornerSet other = opposite(face.sides, apex);
    return std::ranges::any_of(
        base, [&](Corner end) { return (other & corner_bit(end)) != 0 && sides_.is_around(face.corners, end, apex); });
  });
}

bool PolyhedronFiller::is_pierced(const CornerTriangle& t) const {
  const Sides both = sides_.of(t[0], t[1], t[2]);
  bool found = false;
  for_each(both.above, [&](Corner p) {
    for_each(found ? 0 : edges_[p] & both.below, [&](Corner q) { found = found || sides_.is_around(t, p, q); });
  });
  return found;
}

/// Puts a tetrahedron onto a face of the front. \return false if one of its sides cannot be there
bool PolyhedronFiller::put(const CornerTriangle& base, Corner apex) {
  const auto find = [&](const CornerTriangle& t) {
    return std::ranges::find_if(front_, [&](const FrontFace& face) { return are_same(face.corners, t); });
  };
  front_.erase(find(base));
  for (const CornerTriangle& side : sides_on(base, apex)) {
    const auto& [a, b, c] = side;
    const auto twin = find({b, a, c});
    if (twin != front_.end()) {
      front_.erase(twin);
      continue;
    }
    if (find(side) != front_.end()) return false;
    add_front(side);
  }
  tetrahedra_.push_back({base[0], base[1], base[2], apex});
  return true;
}

}  // namespace ccdt::tets
