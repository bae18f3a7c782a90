#include "models/patch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "engine/planar/triangulation.h"
#include "models/patch_points.h"

namespace ccdt {
namespace {

constexpr int smoothing_rounds = 8;

struct Outline {
  PatchOutline plane;
  std::vector<std::uint32_t> vertices;  // of the surface, for each vertex of the outline
};

Outline lay_out(const Surface& surface, const Patch& patch) {
  Outline outline;
  std::unordered_map<std::uint32_t, std::uint32_t> known;
  const auto local = [&](std::uint32_t id) {
    const auto [at, is_new] = known.emplace(id, static_cast<std::uint32_t>(outline.vertices.size()));
    if (is_new) {
      outline.vertices.push_back(id);
      outline.plane.vertices.push_back(patch.chart.flatten(surface.vertices[id]));
    }
    return at->second;
  };
  for (const Chain& loop : patch.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = local(loop[i]);
      outline.plane.border.push_back({from, local(loop[(i + 1) % loop.size()])});
    }
  }
  for (const Chain& cut : patch.cuts) {
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const std::uint32_t from = local(cut[i]);
      outline.plane.cuts.push_back({from, local(cut[i + 1])});
    }
  }
  return outline;
}

PlanarTriangulation triangulate(const std::vector<Point2>& points, const PatchOutline& outline) {
  std::vector<VertexId> vertices(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) vertices[i] = VertexId(i);
  std::vector<PlanarEdge> edges;
  for (const auto* part : {&outline.border, &outline.cuts}) {
    for (const auto& [a, b] : *part) edges.push_back({VertexId(a), VertexId(b)});
  }
  PlanarCarving carving;
  carving.outside = PlanarCarving::Outside::nesting;
  PlanarTriangulationResult result = planar_triangulate(vertices, edges, PlanarPoints(points), carving);
  const auto is_kept = [&](const PlanarEdge& e) {
    return planar_find_edge(result.triangulation, e[0], e[1]).has_value();
  };
  if (!result || !result.unused.empty() || !std::all_of(edges.begin(), edges.end(), is_kept)) {
    throw std::logic_error("the curves of a patch cross, or meet otherwise than in shared vertices");
  }
  return std::move(result.triangulation);
}

double doubled_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Point2 circumcentre(const Point2& a, const Point2& b, const Point2& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  return {a.x + (cy * b2 - by * c2) / d, a.y + (bx * c2 - cx * b2) / d};
}

/// The triangles around each vertex, one list after the other.
struct Stars {
  std::vector<std::uint32_t> first, triangles;
};

Stars stars_of(const PlanarTriangulation& mesh, std::size_t vertices) {
  Stars stars{std::vector<std::uint32_t>(vertices + 1, 0), std::vector<std::uint32_t>(3 * mesh.triangles.size())};
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) ++stars.first[v + 1];
  }
  std::partial_sum(stars.first.begin(), stars.first.end(), stars.first.begin());
  std::vector<std::uint32_t> next(stars.first.begin(), stars.first.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t]) stars.triangles[next[v]++] = t;
  }
  return stars;
}

/// Moves a vertex to the mean of the circumcentres around it, weighted by area and density, unless a triangle would
/// turn over or become much flatter than it is.
void smooth_vertex(std::uint32_t v, std::vector<Point2>& points, const PlanarTriangulation& mesh, const Stars& stars,
                   const PatchSpacing& spacing) {
  const auto corners_of = [&](std::uint32_t i) { return mesh.triangles[stars.triangles[i]]; };
  double weights = 0, x = 0, y = 0, flattest = 1e300;
  for (std::uint32_t i = stars.first[v]; i < stars.first[v + 1]; ++i) {
    const auto [a, b, c] = corners_of(i);
    const Point2 centroid{(points[a].x + points[b].x + points[c].x) / 3, (points[a].y + points[b].y + points[c].y) / 3};
    const Point2 centre = circumcentre(points[a], points[b], points[c]);
    const double wanted = spacing(centroid);
    const double area = doubled_area(points[a], points[b], points[c]);
    const double weight = area / (wanted * wanted * wanted * wanted);
    flattest = std::min(flattest, area);
    weights += weight;
    x += weight * centre.x;
    y += weight * centre.y;
  }
  const Point2 before = points[v];
  points[v] = {x / weights, y / weights};
  const double wanted = spacing(points[v]);
  const double least = std::min(flattest, 0.2 * wanted * wanted);
  for (std::uint32_t i = stars.first[v]; i < stars.first[v + 1]; ++i) {
    const auto [a, b, c] = corners_of(i);
    if (doubled_area(points[a], points[b], points[c]) < least) {
      points[v] = before;
      return;
    }
  }
}

}  // namespace

void add_patch(Surface& surface, const Patch& patch) {
  const Outline outline = lay_out(surface, patch);
  const PatchSpacing spacing(outline.plane, patch.edge_length);
  std::vector<Point2> points = outline.plane.vertices;
  const std::vector<Point2> inner = place_patch_points(outline.plane, spacing);
  points.insert(points.end(), inner.begin(), inner.end());

  PlanarTriangulation mesh = triangulate(points, outline.plane);
  const auto border = static_cast<std::uint32_t>(outline.vertices.size());
  for (int round = 0; round < smoothing_rounds && !inner.empty(); ++round) {
    const Stars stars = stars_of(mesh, points.size());
    for (std::uint32_t v = border; v < points.size(); ++v) smooth_vertex(v, points, mesh, stars, spacing);
    planar_legalize(mesh, PlanarPoints(points));
  }

  std::vector<std::uint32_t> ids = outline.vertices;
  for (std::size_t i = border; i < points.size(); ++i) ids.push_back(add_vertex(surface, patch.chart.lift(points[i])));
  for (const auto& [a, b, c] : mesh.triangles) add_triangle(surface, ids[a], ids[b], ids[c], patch.marker);
}

}  // namespace ccdt
