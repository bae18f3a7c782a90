#include "tests/fuzz/scene.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/plc/build_plc.h"

namespace ccdt::fuzz {

namespace {

bool is_valid(const plc::InputPlc& plc) {
  try {
    plc::build_plc(plc);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Point3 across(int axis, double at, double u, double v) {
  std::array<double, 3> p{};
  p[axis] = at;
  p[(axis + 1) % 3] = u;
  p[(axis + 2) % 3] = v;
  return {p[0], p[1], p[2]};
}

}  // namespace

Scene::Scene(Random& random) : random_(random) {
  plc_.name = "scene";
  plc_.inside = plc::InputPlc::Inside::seeds;
  for (auto& levels : levels_) {
    levels = {0, 16};
    const auto more = random.between(1, 4);
    for (std::int64_t i = 0; i < more; ++i) levels.push_back(static_cast<double>(random.between(1, 15)));
    if (chance(4)) levels.push_back(levels.back() - tiny(2, 12));
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  }
}

bool Scene::add(Thing thing) {
  const plc::InputPlc plc = plc_;
  const auto index = index_;
  const auto edges = edges_;
  const auto rectangles = rectangles_;
  thing(*this);
  if (is_valid(plc_)) return true;
  plc_ = plc;
  index_ = index;
  edges_ = edges;
  rectangles_ = rectangles;
  return false;
}

double Scene::tiny(int least, int most) {
  return std::ldexp(1, -static_cast<int>(random_.between(least, most)));
}

std::uint32_t Scene::index_of(const Point3& p) {
  const auto [entry, is_new] = index_.try_emplace(as_array(p), static_cast<std::uint32_t>(plc_.vertices.size()));
  if (is_new) plc_.vertices.push_back(p);
  return entry->second;
}

void Scene::draw(const Edge& edge, const Rectangle& rectangle) {
  const auto low = as_array(plc_.vertices[rectangle.low]), high = as_array(plc_.vertices[rectangle.high]);
  bool is_border = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = as_array(plc_.vertices[edge[0]])[axis], q = as_array(plc_.vertices[edge[1]])[axis];
    if (std::min(p, q) < low[axis] || std::max(p, q) > high[axis]) return;
    is_border = is_border || (axis != rectangle.axis && p == q && (p == low[axis] || p == high[axis]));
  }
  if (!is_border) plc_.polygon_facets[rectangle.facet].polygons.push_back({edge[0], edge[1]});
}

void Scene::note_edge(std::uint32_t a, std::uint32_t b) {
  edges_.push_back({a, b});
  for (const Rectangle& rectangle : rectangles_) draw({a, b}, rectangle);
}

void Scene::facet(const std::vector<Point3>& corners, int marker) {
  std::vector<std::uint32_t> loop;
  for (const Point3& p : corners) loop.push_back(index_of(p));
  for (std::size_t i = 0; i < loop.size(); ++i) note_edge(loop[i], loop[(i + 1) % loop.size()]);
  plc::PolygonFacet facet;
  facet.polygons = {loop};
  facet.marker = marker;
  facet.number = static_cast<std::uint32_t>(plc_.polygon_facets.size());
  plc_.polygon_facets.push_back(facet);
}

void Scene::rectangle(int axis, double at, const std::array<double, 4>& low_and_high, int marker) {
  const auto& [u, v, x, y] = low_and_high;
  const std::vector<Point3> corners = {across(axis, at, u, v), across(axis, at, x, v), across(axis, at, x, y),
                                       across(axis, at, u, y)};
  facet(corners, marker);
  rectangles_.push_back({axis, index_of(corners[0]), index_of(corners[2]), plc_.polygon_facets.size() - 1});
  const std::vector<Edge> edges = edges_;
  for (const Edge& edge : edges) draw(edge, rectangles_.back());
}

void Scene::box(const Point3& low, const Point3& high) {
  const auto a = as_array(low), b = as_array(high);
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {a[axis], b[axis]})
      rectangle(axis, at, {a[(axis + 1) % 3], a[(axis + 2) % 3], b[(axis + 1) % 3], b[(axis + 2) % 3]});
}

void Scene::segment(const Point3& a, const Point3& b) {
  if (a == b) return vertex(a);
  const std::uint32_t i = index_of(a), j = index_of(b);
  plc_.segments.push_back({i, j});
  note_edge(i, j);
}

}  // namespace ccdt::fuzz
