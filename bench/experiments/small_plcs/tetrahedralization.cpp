#include "bench/experiments/small_plcs/tetrahedralization.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace ccdt::small_plcs {
namespace {

std::int64_t six_volumes(const SmallPlc& plc, const Tetrahedron& t) {
  const auto [a, b, c, d] = points_of(plc.vertices, t);
  return std::abs(small_plcs::six_volumes(a, b, c, d));
}

/// Inside or on its boundary.
bool contains(const SmallPlc& plc, const Tetrahedron& t, Vertex v) {
  for (unsigned i = 0; i < 4; ++i) {
    const auto [a, b, c] = face_opposite(t, i);
    const auto side = [&](Vertex w) {
      return orientation(plc.vertices[a], plc.vertices[b], plc.vertices[c], plc.vertices[w]);
    };
    if (side(v) == -side(t[i])) return false;
  }
  return true;
}

bool has_all_segments(const SmallPlc& plc, const std::vector<Tetrahedron>& tetrahedra) {
  return std::ranges::all_of(all_segments(plc), [&](const Edge& edge) {
    return std::ranges::any_of(tetrahedra, [&](const Tetrahedron& t) { return has(t, edge[0]) && has(t, edge[1]); });
  });
}

bool uses_all_vertices(const SmallPlc& plc, const std::vector<Tetrahedron>& tetrahedra) {
  std::set<Vertex> used;
  for (const Tetrahedron& t : tetrahedra) used.insert(t.begin(), t.end());
  return used.size() == plc.vertices.size();
}

std::int64_t total_volume(const SmallPlc& plc, const std::vector<Tetrahedron>& tetrahedra) {
  std::int64_t sum = 0;
  for (const Tetrahedron& t : tetrahedra) sum += six_volumes(plc, t);
  return sum;
}

/// The search: from the tetrahedron at one edge of the boundary on, over one open face after the other.
class Search {
 public:
  explicit Search(const SmallPlc& plc)
      : plc_(plc), candidates_(possible_tetrahedra(plc)), disjoint_(candidates_.size() * candidates_.size(), unknown) {
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      for (unsigned i = 0; i < 4; ++i) at_face_[face_opposite(candidates_[c], i)].push_back(c);
    start();
  }
  SearchResult result() const { return result_; }

 private:
  enum FaceKind { of_no_facet, of_boundary, of_interior };
  enum : signed char { unknown = -1 };
  /// A face with a tetrahedron on one side, and the other side still to be filled.
  struct OpenFace {
    int side;           ///< to be filled
    std::size_t owner;  ///< the candidate on the other side
  };

  int side(const Triangle& f, Vertex v) const {
    return orientation(plc_.vertices[f[0]], plc_.vertices[f[1]], plc_.vertices[f[2]], plc_.vertices[v]);
  }
  Vertex apex(std::size_t candidate, const Triangle& face) const {
    return *std::ranges::find_if(candidates_[candidate], [&](Vertex v) { return !has(face, v); });
  }
  bool is_on(const Polygon& facet, const Triangle& face) const {
    return std::ranges::all_of(face, [&](Vertex v) { return has(facet, v); }) && is_within(plc_, facet, face);
  }
  FaceKind kind_of(const Triangle& face) {
    const auto [entry, is_new] = kinds_.try_emplace(face, of_no_facet);
    if (is_new) {
      const auto holds = [&](const Polygon& facet) { return is_on(facet, face); };
      if (std::ranges::any_of(plc_.boundary, holds)) entry->second = of_boundary;
      if (std::ranges::any_of(plc_.interior, holds)) entry->second = of_interior;
    }
    return entry->second;
  }
  bool are_disjoint(std::size_t a, std::size_t b) {
    signed char& known = disjoint_[a * candidates_.size() + b];
    if (known == unknown)
      known = !insides_meet(points_of(plc_.vertices, candidates_[a]), points_of(plc_.vertices, candidates_[b]));
    return known == 1;
  }
  bool is_locally_delaunay(std::size_t a, std::size_t b, const Triangle& face) const {
    const auto [p, q, r, s] = points_of(plc_.vertices, candidates_[a]);
    return side_of_sphere(p, q, r, s, plc_.vertices[apex(b, face)]) <= 0;
  }

  /// All that can be at the first edge of the first facet, on its inner side.
  void start() {
    const Polygon& facet = plc_.boundary.front();
    for (std::size_t third = 2; third < facet.size(); ++third) {
      const Triangle face = triangle_of(facet[0], facet[1], facet[third]);
      if (!is_on(facet, face)) continue;
      for (const std::size_t candidate : at_face_[face])
        if (dot(area_vector(plc_, facet), plc_.vertices[apex(candidate, face)] - plc_.vertices[facet[0]]) < 0)
          choose(candidate);
    }
  }

  void choose(std::size_t candidate) {
    const std::map<Triangle, OpenFace> before = open_;
    if (advance_over(candidate)) {
      chosen_.push_back(candidate);
      fill();
      chosen_.pop_back();
    }
    open_ = before;
  }

  void fill() {
    if (open_.empty()) {
      take_down();
      return;
    }
    const auto [face, open] = *open_.begin();
    for (const std::size_t candidate : at_face_[face]) {
      if (side(face, apex(candidate, face)) != open.side) continue;
      if (std::ranges::all_of(chosen_, [&](std::size_t other) { return are_disjoint(candidate, other); }))
        choose(candidate);
    }
  }

  /// False if the tetrahedron does not fit one of its neighbors.
  bool advance_over(std::size_t candidate) {
    for (unsigned i = 0; i < 4; ++i) {
      const Tetrahedron& t = candidates_[candidate];
      const Triangle face = face_opposite(t, i);
      const FaceKind kind = kind_of(face);
      if (kind == of_boundary) continue;
      const auto found = open_.find(face);
      if (found == open_.end()) {
        open_[face] = {-side(face, t[i]), candidate};
        continue;
      }
      if (found->second.side != side(face, t[i])) return false;
      if (kind == of_no_facet && !is_locally_delaunay(candidate, found->second.owner, face)) return false;
      open_.erase(found);
    }
    return true;
  }

  void take_down() {
    std::vector<Tetrahedron> tetrahedra;
    for (const std::size_t c : chosen_) tetrahedra.push_back(candidates_[c]);
    if (total_volume(plc_, tetrahedra) != small_plcs::six_volumes(plc_) || !has_all_segments(plc_, tetrahedra) ||
        !uses_all_vertices(plc_, tetrahedra))
      return;
    std::ranges::sort(tetrahedra);
    ++result_.constrained_delaunay;
    if (std::ranges::all_of(tetrahedra, [&](const Tetrahedron& t) { return is_delaunay(plc_.vertices, t); }))
      result_.some_is_delaunay = true;
    if (result_.first.empty()) result_.first = std::move(tetrahedra);
  }

  const SmallPlc& plc_;
  std::vector<Tetrahedron> candidates_;
  std::map<Triangle, std::vector<std::size_t>> at_face_;  ///< the candidates on both of its sides
  std::map<Triangle, FaceKind> kinds_;
  std::vector<signed char> disjoint_;  ///< by pair of candidates, as far as it has been asked for
  std::map<Triangle, OpenFace> open_;
  std::vector<std::size_t> chosen_;
  SearchResult result_;
};

}  // namespace

bool is_delaunay(const std::vector<Point>& vertices, const Tetrahedron& t) {
  return std::ranges::none_of(vertices, [&](const Point& p) {
    return side_of_sphere(vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]], p) > 0;
  });
}

std::vector<Tetrahedron> possible_tetrahedra(const SmallPlc& plc) {
  std::vector<std::vector<Point>> constraints;
  for (const Polygon& facet : all_facets(plc))
    for (const auto& [a, b, c] : triangles_of(plc, facet))
      constraints.push_back({plc.vertices[a], plc.vertices[b], plc.vertices[c]});
  for (const auto& [a, b] : plc.segments) constraints.push_back({plc.vertices[a], plc.vertices[b]});

  std::vector<Tetrahedron> possible;
  const auto n = static_cast<Vertex>(plc.vertices.size());
  for (Vertex a = 0; a < n; ++a)
    for (Vertex b = a + 1; b < n; ++b)
      for (Vertex c = b + 1; c < n; ++c)
        for (Vertex d = c + 1; d < n; ++d) {
          const Tetrahedron t = {a, b, c, d};
          bool is_possible = six_volumes(plc, t) != 0;
          for (Vertex v = 0; v < n && is_possible; ++v) is_possible = has(t, v) || !contains(plc, t, v);
          is_possible = is_possible && std::ranges::none_of(constraints, [&](const auto& constraint) {
                          return insides_meet(points_of(plc.vertices, t), constraint);
                        });
          if (is_possible && is_inside(plc, {a, b, c, d})) possible.push_back(t);
        }
  return possible;
}

bool has_delaunay_tetrahedralization(const SmallPlc& plc) {
  std::vector<Tetrahedron> tetrahedra = possible_tetrahedra(plc);
  std::erase_if(tetrahedra, [&](const Tetrahedron& t) { return !is_delaunay(plc.vertices, t); });
  return total_volume(plc, tetrahedra) == six_volumes(plc) && has_all_segments(plc, tetrahedra) &&
         uses_all_vertices(plc, tetrahedra);
}

SearchResult search_constrained_delaunay(const SmallPlc& plc) {
  return Search(plc).result();
}

}  // namespace ccdt::small_plcs
