#include "bench/experiments/small_plcs/trial.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "engine/mesher.h"

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

/// Is their total volume that of the domain, and do they have all segments as edges and all vertices as corners?
bool fill_domain(const SmallPlc& plc, const std::vector<Tetrahedron>& tetrahedra) {
  return total_volume(plc, tetrahedra) == small_plcs::six_volumes(plc) && has_all_segments(plc, tetrahedra) &&
         uses_all_vertices(plc, tetrahedra);
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
    if (open_.empty()) return take_down();
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
    if (!fill_domain(plc_, tetrahedra)) return;
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
  std::vector<signed char> disjoint_;  ///< by pair of candidates, computed when first asked for
  std::map<Triangle, OpenFace> open_;
  std::vector<std::size_t> chosen_;
  SearchResult result_;
};

/// Half of a plane at an edge: a facet, seen from the edge.
struct Wing {
  Point direction;            ///< from the first end of the edge to a point of the facet
  bool inside_after = false;  ///< is the domain next to it counterclockwise, looking against the edge's direction?
};

std::vector<Wing> wings_at(const SmallPlc& plc, const Edge& edge) {
  const Point& from = plc.vertices[edge[0]];
  std::vector<Wing> wings;
  const auto add = [&](const Polygon& facet, bool is_boundary) {
    for (const Triangle& t : triangles_of(plc, facet))
      for (unsigned i = 0; i < 3; ++i) {
        const Vertex a = t[i], b = t[(i + 1) % 3];
        if (edge_of(a, b) != edge) continue;
        // Counterclockwise of a triangle that runs along the edge is the side of its normal, the outside.
        const bool runs_along = a == edge[0];
        wings.push_back({plc.vertices[t[(i + 2) % 3]] - from, !is_boundary || !runs_along});
      }
  };
  for (const Polygon& facet : plc.boundary) add(facet, true);
  for (const Polygon& facet : plc.interior) add(facet, false);
  return wings;
}

/// The next of the other wings, counterclockwise.
const Wing& next_wing(const Point& axis, const std::vector<Wing>& wings, const Wing& wing) {
  // 0: less than 180 degrees; 1: exactly 180 degrees; 2: more.
  const auto half = [&](const Wing& w) {
    const std::int64_t turn = determinant(axis, wing.direction, w.direction);
    return turn > 0 ? 0 : turn == 0 ? 1 : 2;
  };
  const Wing* next = nullptr;
  for (const Wing& w : wings) {
    if (&w == &wing) continue;
    const bool is_nearer = next == nullptr || half(w) < half(*next) ||
                           (half(w) == half(*next) && determinant(axis, w.direction, next->direction) > 0);
    if (is_nearer) next = &w;
  }
  return *next;
}

bool is_grazeable(const SmallPlc& plc, const Edge& edge) {
  const std::vector<Wing> wings = wings_at(plc, edge);
  if (wings.size() < 2) return true;  // a segment in the domain, or the edge of a facet that ends there
  const Point axis = plc.vertices[edge[1]] - plc.vertices[edge[0]];
  return std::ranges::any_of(wings, [&](const Wing& w) {
    return w.inside_after && determinant(axis, w.direction, next_wing(axis, wings, w).direction) <= 0;
  });
}

std::vector<Tetrahedron> in_vertices_of(const SmallPlc& plc, const TetMesh& mesh) {
  std::map<std::array<double, 3>, Vertex> vertex_at;
  const InputPlc input = as_input(plc);
  for (Vertex v = 0; v < input.vertices.size(); ++v) vertex_at[as_array(input.vertices[v])] = v;
  std::vector<Tetrahedron> tetrahedra;
  for (const auto& corners : mesh.tetrahedra) {
    Tetrahedron t{};
    std::ranges::transform(corners, t.begin(), [&](auto v) { return vertex_at.at(as_array(mesh.vertices[v])); });
    std::ranges::sort(t);
    tetrahedra.push_back(t);
  }
  std::ranges::sort(tetrahedra);
  return tetrahedra;
}

std::string disagreement_of(const Trial& trial, bool is_cospherical) {
  if (!trial.engine.failure.empty()) return "the engine failed: " + trial.engine.failure;
  if (is_cospherical) {  // the engine's symbolic perturbation takes another PLC
    if (trial.protection.premise() && !trial.engine.is_protected) return "the engine misses what is strongly Delaunay";
    return {};
  }
  if (trial.search.constrained_delaunay > 1) return "there are several constrained Delaunay tetrahedralizations";
  if (trial.search.some_is_delaunay != trial.has_dt)
    return "the search and the Delaunay tetrahedra disagree about a DT";
  if (trial.engine.is_protected != trial.protection.premise())
    return "the engine and the brute-force tests disagree about protection";
  if (!trial.engine.has_steiner_vertices && trial.engine.tetrahedra != trial.search.first)
    return "the engine's mesh is not the constrained Delaunay tetrahedralization";
  return {};
}

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
  return fill_domain(plc, tetrahedra);
}

SearchResult search_constrained_delaunay(const SmallPlc& plc) {
  return Search(plc).result();
}

std::vector<Edge> grazeable_segments(const SmallPlc& plc) {
  std::vector<Edge> grazeable;
  for (const Edge& edge : all_segments(plc))
    if (is_grazeable(plc, edge)) grazeable.push_back(edge);
  return grazeable;
}

bool is_strongly_delaunay(const std::vector<Point>& vertices, const Edge& edge) {
  // A sphere through the origin and b is |x|^2 = w x with w b = |b|^2; a vertex c is outside if |c|^2 > w c. By
  // Motzkin's theorem no w does it for c, d and e if and only if there are l, m, n >= 0, not all zero, and k with
  // l c + m d + n e + k b = 0 and l |c|^2 + m |d|^2 + n |e|^2 + k |b|^2 <= 0. Cramer's rule gives the four numbers. (If
  // c, d and b are in a plane with the origin, it gives n = 0, so pairs need no separate case.)
  const Point& origin = vertices[edge[0]];
  const Point b = vertices[edge[1]] - origin;
  std::vector<Point> others;
  for (Vertex v = 0; v < vertices.size(); ++v)
    if (v != edge[0] && v != edge[1]) others.push_back(vertices[v] - origin);
  const auto hinder = [&](const Point& c, const Point& d, const Point& e) {
    std::int64_t l = determinant(d, e, b), m = determinant(c, b, e), n = determinant(c, d, b);
    std::int64_t k = -determinant(c, d, e);
    if (l <= 0 && m <= 0 && n <= 0) {
      l = -l;
      m = -m;
      n = -n;
      k = -k;
    }
    if (l < 0 || m < 0 || n < 0 || l + m + n == 0) return false;
    return l * dot(c, c) + m * dot(d, d) + n * dot(e, e) + k * dot(b, b) <= 0;
  };
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (hinder(others[i], others[j], others[k])) return false;
  return true;
}

bool is_strongly_delaunay(const std::vector<Point>& vertices, const Triangle& triangle) {
  const Point &a = vertices[triangle[0]], &b = vertices[triangle[1]], &c = vertices[triangle[2]];
  const auto is_clear = [&](const Point& d) {
    const int side = orientation(a, b, c, d);
    return std::ranges::all_of(vertices, [&](const Point& e) {
      if (e == a || e == b || e == c || e == d) return true;
      const int other_side = orientation(a, b, c, e);
      // If both are on one side, a sphere may grow away from both. If both are coplanar, any third vertex decides.
      return other_side == side || side == 0 || side_of_sphere(a, b, c, d, e) < 0;
    });
  };
  return std::ranges::all_of(vertices, [&](const Point& d) { return d == a || d == b || d == c || is_clear(d); });
}

bool is_protected(const SmallPlc& plc, const Polygon& facet) {
  const Point whole = area_vector(plc, facet);
  std::int64_t filled = 0;
  for (std::size_t skipped = 0; skipped < facet.size(); ++skipped) {
    Polygon corners = facet;
    if (facet.size() > 3) corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(skipped));
    const Triangle triangle = triangle_of(corners[0], corners[1], corners[2]);
    if (is_within(plc, facet, triangle) && is_strongly_delaunay(plc.vertices, triangle))
      filled += dot(area_vector(plc, corners), whole);
    if (facet.size() == 3) break;
  }
  return filled == dot(whole, whole);
}

ProtectionState protection_of(const SmallPlc& plc) {
  const auto is_there = [&](const Edge& edge) { return is_strongly_delaunay(plc.vertices, edge); };
  const std::vector<Edge> grazeable = grazeable_segments(plc);
  return {.edges = std::ranges::all_of(grazeable, is_there),
          .faces = std::ranges::all_of(all_facets(plc), [&](const Polygon& f) { return is_protected(plc, f); }),
          .missing_is_loose =
              std::ranges::all_of(grazeable, [&](const Edge& e) { return is_there(e) || has(plc.segments, e); })};
}

EngineAnswer ask_engine(const SmallPlc& plc) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.threads = 1;  // for ten vertices
  options.improve.improvement = Improvement::none;
  options.improve.steiner = SteinerRule::keep;
  try {
    const MeshResult result = mesh_plc(as_input(plc), options);
    EngineAnswer answer{.has_steiner_vertices = result.counts.steiner_vertices > 0};
    answer.is_protected = !answer.has_steiner_vertices && result.counts.undelaunay_faces == 0;
    if (!answer.has_steiner_vertices) answer.tetrahedra = in_vertices_of(plc, result.mesh);
    return answer;
  } catch (const Error& error) {
    return {.failure = error.what()};
  }
}

Trial try_plc(SmallPlc plc, bool is_cospherical) {
  Trial trial{.plc = std::move(plc)};
  trial.protection = protection_of(trial.plc);
  trial.search = search_constrained_delaunay(trial.plc);
  trial.has_dt = is_cospherical ? trial.search.some_is_delaunay : has_delaunay_tetrahedralization(trial.plc);
  trial.engine = ask_engine(trial.plc);
  trial.disagreement = disagreement_of(trial, is_cospherical);
  return trial;
}

SmallPlc with_interior_point(const SmallPlc& plc, std::uint64_t seed) {
  constexpr int most_draws = 50;
  Random random(seed);
  Point low = plc.vertices.front(), high = low;
  for (const Point& p : plc.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto last = static_cast<Vertex>(plc.vertices.size());
  SmallPlc more = plc;
  more.vertices.emplace_back();
  for (int draw = 0; draw < most_draws; ++draw) {
    more.vertices.back() = {random.between(low.x, high.x), random.between(low.y, high.y),
                            random.between(low.z, high.z)};
    if (is_inside(more, {last}) && is_generic(more)) return more;
  }
  return {};
}

std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_per_family) {
  const auto has_one = [](const SmallPlc& plc) { return search_constrained_delaunay(plc).constrained_delaunay > 0; };
  std::vector<ExistenceTrials> all;
  std::uint64_t seed = 1;
  for (const Family& family : families()) {
    if (family.is_cospherical) continue;
    ExistenceTrials& trials = all.emplace_back();
    trials.family = family.name;
    Random random(++seed);
    for (std::uint64_t i = 0; i < cases_per_family; ++i) {
      const SmallPlc plc = next_plc(family, random), more = with_interior_point(plc, ++seed);
      if (more.vertices.empty() || !has_one(plc)) continue;
      ++trials.cases;
      if (has_one(more)) continue;
      const bool is_smallest = trials.lost++ == 0 || more.vertices.size() < trials.counterexample.vertices.size();
      if (is_smallest) trials.counterexample = more;
    }
  }
  return all;
}

}  // namespace ccdt::small_plcs
