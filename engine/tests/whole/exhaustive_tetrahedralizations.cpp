#include "engine/tests/whole/exhaustive_tetrahedralizations.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/geometry/predicates.h"

namespace ccdt::test {

namespace {

using Vertex = std::uint32_t;
using Edge = std::array<Vertex, 2>;
using Face = std::array<Vertex, 3>;  ///< in increasing order
using Tetrahedron = std::array<Vertex, 4>;

template <std::size_t Count>
bool has(const std::array<Vertex, Count>& corners, Vertex v) {
  return std::ranges::find(corners, v) != corners.end();
}

Face face_opposite(const Tetrahedron& t, unsigned i) {
  Face face = {t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
  std::ranges::sort(face);
  return face;
}

std::vector<Edge> edges_of(const std::vector<Face>& faces) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : faces) edges.insert({{a, b}, {b, c}, {a, c}});
  return {edges.begin(), edges.end()};
}

class Enumeration {
 public:
  explicit Enumeration(const Polyhedron& polyhedron) : polyhedron_(polyhedron) {
    for (const auto& [a, b, c] : polyhedron.triangles) {
      Face face = {a, b, c};
      std::ranges::sort(face);
      surface_.push_back(face);
      const bool turned = orient3d(at(face[0]), at(face[1]), at(face[2]), at(a) + normal(a, b, c)) < 0;
      open_[face] = turned ? 1 : -1;  // the inside is below the triangle
    }
    list_candidates();
    fill();
  }

  Tetrahedralizations result() const { return result_; }

 private:
  const Point3& at(Vertex v) const { return polyhedron_.vertices[v]; }
  Point3 normal(Vertex a, Vertex b, Vertex c) const { return cross(at(b) - at(a), at(c) - at(a)); }
  int side(const Face& f, Vertex v) const { return orient3d(at(f[0]), at(f[1]), at(f[2]), at(v)); }

  bool contains(const Tetrahedron& t, Vertex v) const {
    for (unsigned i = 0; i < 4; ++i)
      if (side(face_opposite(t, i), v) != side(face_opposite(t, i), t[i])) return false;
    return true;
  }
  bool pierces(const Edge& e, const Face& f) const {
    if (has(f, e[0]) || has(f, e[1]) || side(f, e[0]) == side(f, e[1])) return false;
    const int turn = orient3d(at(e[0]), at(e[1]), at(f[0]), at(f[1]));
    return turn == orient3d(at(e[0]), at(e[1]), at(f[1]), at(f[2])) &&
           turn == orient3d(at(e[0]), at(e[1]), at(f[2]), at(f[0]));
  }
  bool crosses_surface(const Tetrahedron& t) const {
    std::vector<Face> faces;
    for (unsigned i = 0; i < 4; ++i) faces.push_back(face_opposite(t, i));
    const auto any_pierces = [&](const std::vector<Edge>& edges, const std::vector<Face>& through) {
      return std::ranges::any_of(edges, [&](const Edge& e) {
        return std::ranges::any_of(through, [&](const Face& f) { return pierces(e, f); });
      });
    };
    return any_pierces(edges_of(faces), surface_) || any_pierces(edges_of(surface_), faces);
  }
  /// The tetrahedra that are possible on their own. Some may be outside; these are never used.
  void list_candidates() {
    const auto n = static_cast<Vertex>(polyhedron_.vertices.size());
    for (Vertex a = 0; a < n; ++a)
      for (Vertex b = a + 1; b < n; ++b)
        for (Vertex c = b + 1; c < n; ++c)
          for (Vertex d = c + 1; d < n; ++d) {
            const Tetrahedron t = {a, b, c, d};
            bool is_empty = true;
            for (Vertex v = 0; v < n; ++v) is_empty = is_empty && (has(t, v) || !contains(t, v));
            if (is_empty && !crosses_surface(t)) candidates_.push_back(t);
          }
  }

  /// Are two tetrahedra on the two sides of a plane through three of their corners?
  bool are_disjoint(const Tetrahedron& s, const Tetrahedron& t) const {
    std::set<Vertex> corners(s.begin(), s.end());
    corners.insert(t.begin(), t.end());
    const auto side_of = [&](const Face& plane, const Tetrahedron& of) {
      int result = 0;
      for (const Vertex v : of) {
        if (has(plane, v)) continue;
        if (result == -side(plane, v)) return 0;
        result = side(plane, v);
      }
      return result;
    };
    for (const Vertex a : corners)
      for (const Vertex b : corners)
        for (const Vertex c : corners) {
          if (a >= b || b >= c) continue;
          const int side_of_s = side_of({a, b, c}, s);
          if (side_of_s != 0 && side_of_s == -side_of({a, b, c}, t)) return true;
        }
    return false;
  }

  void fill() {
    if (open_.empty()) {
      count();
      return;
    }
    const auto [face, inside] = *open_.begin();
    for (const Tetrahedron& t : candidates_) {
      if (!std::ranges::includes(t, face) || side(face, apex(t, face)) != inside) continue;
      if (!std::ranges::all_of(chosen_, [&](const Tetrahedron& other) { return are_disjoint(t, other); })) continue;
      const auto before = open_;
      if (advance_over(t)) {
        chosen_.push_back(t);
        fill();
        chosen_.pop_back();
      }
      open_ = before;
    }
  }
  static Vertex apex(const Tetrahedron& t, const Face& face) {
    return *std::ranges::find_if(t, [&](Vertex v) { return !has(face, v); });
  }
  /// False if the tetrahedron is on the wrong side of one of its faces.
  bool advance_over(const Tetrahedron& t) {
    for (unsigned i = 0; i < 4; ++i) {
      const Face face = face_opposite(t, i);
      const auto found = open_.find(face);
      if (found == open_.end()) {
        if (std::ranges::find(surface_, face) != surface_.end()) return false;
        open_[face] = -side(face, t[i]);
      } else {
        if (found->second != side(face, t[i])) return false;
        open_.erase(found);
      }
    }
    return true;
  }

  void count() {
    std::vector<Face> faces;
    std::set<Vertex> used;
    for (const Tetrahedron& t : chosen_) {
      for (unsigned i = 0; i < 4; ++i) faces.push_back(face_opposite(t, i));
      used.insert(t.begin(), t.end());
    }
    const std::vector<Edge> edges = edges_of(faces);
    for (Edge segment : polyhedron_.segments) {
      std::ranges::sort(segment);
      if (!std::ranges::binary_search(edges, segment)) return;
    }
    if (used.size() < polyhedron_.vertices.size()) return;
    ++result_.all;
    if (is_locally_delaunay()) ++result_.constrained_delaunay;
  }
  bool is_locally_delaunay() const {
    for (const Tetrahedron& s : chosen_)
      for (const Tetrahedron& t : chosen_) {
        for (unsigned i = 0; i < 4; ++i) {
          const Face face = face_opposite(s, i);
          if (s == t || !std::ranges::includes(t, face)) continue;
          const Point3 &a = at(s[0]), &b = at(s[1]), &c = at(s[2]), &d = at(s[3]);
          if (insphere(a, b, c, d, at(apex(t, face))) * orient3d(a, b, c, d) > 0) return false;
        }
      }
    return true;
  }

  const Polyhedron& polyhedron_;
  std::vector<Face> surface_;
  std::map<Face, int> open_;  ///< faces beside which space is still to be filled, and on which side
  std::vector<Tetrahedron> candidates_, chosen_;
  Tetrahedralizations result_;
};

}  // namespace

bool is_generic(const Polyhedron& polyhedron) {
  const auto& v = polyhedron.vertices;
  for (std::size_t a = 0; a < v.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c)
        for (std::size_t d = 0; d < c; ++d) {
          if (orient3d(v[a], v[b], v[c], v[d]) == 0) return false;
          for (std::size_t e = 0; e < d; ++e)
            if (insphere(v[a], v[b], v[c], v[d], v[e]) == 0) return false;
        }
  return true;
}

Tetrahedralizations count_tetrahedralizations(const Polyhedron& polyhedron) {
  return Enumeration(polyhedron).result();
}

}  // namespace ccdt::test
