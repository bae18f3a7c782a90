#include "bench/experiments/small_plcs/trial.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ranges>

#include "engine/base/errors.h"
#include "engine/mesher.h"

namespace ccdt::small_plcs {
namespace {

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

/// Of the others the one that is next counterclockwise.
const Wing& next_wing(const Point& axis, const std::vector<Wing>& wings, const Wing& wing) {
  // Up to 180 degrees, exactly so, or above.
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

bool is_loose(const SmallPlc& plc, const Edge& edge) {
  return std::ranges::find(plc.segments, edge) != plc.segments.end();
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

std::vector<Edge> grazeable_segments(const SmallPlc& plc) {
  std::vector<Edge> grazeable;
  for (const Edge& edge : all_segments(plc))
    if (is_grazeable(plc, edge)) grazeable.push_back(edge);
  return grazeable;
}

bool is_strongly_delaunay(const std::vector<Point>& vertices, const Edge& edge) {
  // A sphere through the origin and b is |x|^2 = w x with w b = |b|^2; a vertex c is outside if |c|^2 > w c. By
  // Motzkin's theorem no w does it for c, d and e if and only if there are l, m, n >= 0, not all zero, and k with
  // l c + m d + n e + k b = 0 and l |c|^2 + m |d|^2 + n |e|^2 + k |b|^2 <= 0. Cramer's rule gives the four numbers. (Of
  // c, d and b in a plane with the origin it gives n = 0, so that pairs need no case of their own.)
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
      // On one side a sphere may grow away from both; of two coplanar vertices any third one tells.
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
          .all_segments = std::ranges::all_of(all_segments(plc), is_there),
          .faces = std::ranges::all_of(all_facets(plc), [&](const Polygon& f) { return is_protected(plc, f); }),
          .missing_is_loose =
              std::ranges::all_of(grazeable, [&](const Edge& e) { return is_there(e) || is_loose(plc, e); })};
}

EngineAnswer ask_engine(const SmallPlc& plc) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
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

}  // namespace ccdt::small_plcs
