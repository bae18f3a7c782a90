#include "engine/folds/divide_facets.h"

#include <algorithm>
#include <map>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/folds/find_folds.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::folds {
namespace {

/// Is the first triangle beyond an edge of the second one, seen along an axis, up to rounding?
bool is_beyond_an_edge(const std::array<Point3, 3>& one, const std::array<Point3, 3>& other, std::size_t axis) {
  constexpr double rounding = 1e-9;  // of the area
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto turn = [&](const Point3& a, const Point3& b, const Point3& c) {
    const auto p = as_array(b - a), q = as_array(c - a);
    return p[u] * q[v] - p[v] * q[u];
  };
  const double area = turn(other[0], other[1], other[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto is_beyond = [&](const Point3& p) {
      return turn(other[k], other[(k + 1) % 3], p) * area <= rounding * area * area;
    };
    if (std::ranges::all_of(one, is_beyond)) return true;
  }
  return false;
}

/// By 3 * triangle + edge: the triangle across the edge, if any.
std::vector<std::uint32_t> list_neighbors(std::span<const std::array<VertexId, 3>> triangles) {
  std::vector<AtEdge> sides;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      sides.push_back({edge_key(triangles[i][k], triangles[i][(k + 1) % 3]), 3 * i + k});
  std::ranges::sort(sides);
  std::vector<std::uint32_t> across(sides.size(), none);
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s - 1].edge != sides[s].edge) continue;
    across[sides[s - 1].value] = sides[s].value / 3;
    across[sides[s].value] = sides[s - 1].value / 3;
  }
  return across;
}

HashSet<std::uint64_t> ends_of(std::span<const plc::Segment> segments) {
  HashSet<std::uint64_t> ends;
  for (const plc::Segment& s : segments) ends.insert(edge_key(s.ends[0], s.ends[1]), {});
  return ends;
}

}  // namespace

FacetDivider::FacetDivider(const plc::Plc& plc, const delaunay::Delaunay& delaunay, double tolerance)
    : plc_(plc),
      least_height_(2 * tolerance),
      mesh_(facets::triangulate_facets(plc, protection::SegmentChains(plc.segments), delaunay)),
      first_(plc.facets.size() + 1, 0),
      across_(3 * mesh_.triangles.size(), none),
      is_separate_(mesh_.triangles.size(), 0),
      step_(plc.facets.size(), Step::whole) {
  for (const FacetId f : mesh_.facet) ++first_[f + 1];
  for (std::uint32_t f = 0; f < plc.facets.size(); ++f) {
    first_[f + 1] += first_[f];
    if (!is_nearly_flat(f)) continue;
    const std::vector<std::uint32_t> across = list_neighbors(triangles_of(f));
    for (std::size_t side = 0; side < across.size(); ++side)
      if (across[side] != none) across_[3 * first_[f] + side] = first_[f] + across[side];
  }
}

std::array<Point3, 3> FacetDivider::corners_of(const Triangle& t) const {
  return {plc_.vertices[t[0]], plc_.vertices[t[1]], plc_.vertices[t[2]]};
}

/// The triangles into which the facet is divided.
std::span<const std::array<VertexId, 3>> FacetDivider::triangles_of(std::uint32_t f) const {
  if (step_[f] == Step::input) return plc_.triangles_of(plc_.facets[f]);
  return std::span(mesh_.triangles).subspan(first_[f], first_[f + 1] - first_[f]);
}

/// The triangle that this one stays with. Two needles may share their longest edge.
std::uint32_t FacetDivider::leader(std::uint32_t i) const {
  constexpr int most_steps = 100;
  std::uint32_t before = none;
  for (int steps = 0; steps < most_steps; ++steps) {
    const std::array<Point3, 3> p = corners_of(mesh_.triangles[i]);
    std::array<double, 3> lengths{};
    for (std::size_t k = 0; k < 3; ++k) lengths[k] = length(p[(k + 1) % 3] - p[k]);
    const auto longest = static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin());
    const std::uint32_t next = across_[3 * i + longest];
    const bool is_needle = length(area_vector(p)) < least_height_ * lengths[longest];
    if (!is_needle || next == none) break;
    if (next == before) return std::min(i, next);
    before = std::exchange(i, next);
  }
  return i;
}

/// Does an inner edge of the Delaunay triangles run along a segment of another facet?
bool FacetDivider::touches_segment(std::uint32_t f) const {
  HashSet<std::uint64_t> own;
  for (const Triangle& t : plc_.triangles_of(plc_.facets[f]))
    for (std::size_t k = 0; k < 3; ++k) own.insert(edge_key(t[k], t[(k + 1) % 3]), {});
  const HashSet<std::uint64_t> segments = ends_of(plc_.segments);
  for (std::uint32_t side = 3 * first_[f]; side < 3 * first_[f + 1]; ++side) {
    const Triangle& t = mesh_.triangles[side / 3];
    const std::uint64_t edge = edge_key(t[side % 3], t[(side + 1) % 3]);
    if (segments.contains(edge) && !own.contains(edge)) return true;
  }
  return false;
}

/// Makes separate facets of the Delaunay triangles where a face is.
///
/// \return  false if they are separate already
bool FacetDivider::separate(std::uint32_t f, const std::array<Point3, 3>& face) {
  const Point3 normal = plc::sum_of_normals(plc_.triangles_of(plc_.facets[f]), plc_.vertices);
  const auto axis = static_cast<std::size_t>(dominant_axis(normal));
  bool changed = false;
  for (std::uint32_t i = first_[f]; i < first_[f + 1]; ++i) {
    const std::array<Point3, 3> corners = corners_of(mesh_.triangles[i]);
    if (is_beyond_an_edge(face, corners, axis) || is_beyond_an_edge(corners, face, axis)) continue;
    if (group_of(f, i - first_[f]) != none) continue;
    is_separate_[step_[f] == Step::needles ? i : leader(i)] = 1;
    changed = true;
  }
  return changed;
}

void FacetDivider::divide(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
                          const std::vector<FacetOrigin>& origins, const delaunay::Delaunay& delaunay) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> faces_of;  // by facet
  for (const std::uint32_t face : which) faces_of[origins[faces.facet[face]].facet].push_back(face);
  for (const auto& [f, its] : faces_of) {
    if (!is_nearly_flat(f)) continue;
    if (step_[f] == Step::input) throw MeshError("a flat facet bends", {}, "this is a bug: please report it");
    if (step_[f] == Step::whole) step_[f] = touches_segment(f) ? Step::input : Step::most_triangles;
    bool changed = false;
    for (const std::uint32_t face : its) {
      const auto& [a, b, c] = faces.triangles[face];
      changed |= separate(f, {delaunay.point(a), delaunay.point(b), delaunay.point(c)});
    }
    if (!changed) step_[f] = step_[f] == Step::most_triangles ? Step::needles : Step::input;
  }
}

void FacetDivider::follow_input(const facets::FacetMesh& faces, std::span<const std::uint32_t> which,
                                const std::vector<FacetOrigin>& origins) {
  for (const std::uint32_t face : which) step_[origins[faces.facet[face]].facet] = Step::input;
}

void FacetDivider::follow_input() {
  for (std::uint32_t f = 0; f < step_.size(); ++f)
    if (is_nearly_flat(f)) step_[f] = Step::input;
}

bool FacetDivider::give_way(const std::array<VertexId, 2>& segment) {
  std::vector<std::uint32_t> divided, beside;
  for (std::uint32_t f = 0; f < step_.size(); ++f) {
    if (step_[f] == Step::whole || step_[f] == Step::input) continue;
    divided.push_back(f);
    const bool has_end = std::ranges::any_of(triangles_of(f), [&](const Triangle& t) {
      return std::ranges::any_of(segment, [&](VertexId v) { return std::ranges::find(t, v) != t.end(); });
    });
    if (has_end) beside.push_back(f);
  }
  for (const std::uint32_t f : beside.empty() ? divided : beside) step_[f] = Step::input;
  return !divided.empty();
}

void FacetDivider::make_grazeable(const plc::Plc& plc, std::span<const std::uint32_t> segments) {
  for (const std::uint32_t s : segments)
    grazeable_.push_back(edge_key(plc.segments[s].ends[0], plc.segments[s].ends[1]));
}

/// The number of a triangle's group. Triangles of a facet with the same number form one facet.
///
/// \param i  of `triangles_of(f)`
std::uint32_t FacetDivider::group_of(std::uint32_t f, std::uint32_t i) const {
  if (step_[f] == Step::input) return i;
  const std::uint32_t own = first_[f] + i, whole = leader(own);
  if (is_separate_[own] == 0 && is_separate_[whole] == 0) return none;
  return (step_[f] == Step::needles ? own : whole) - first_[f];
}

std::vector<std::vector<std::array<VertexId, 3>>> FacetDivider::parts_of(std::uint32_t f) const {
  const std::span<const Triangle> triangles = triangles_of(f);
  std::map<std::uint32_t, std::vector<Triangle>> groups;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) groups[group_of(f, i)].push_back(triangles[i]);
  std::vector<std::vector<Triangle>> parts;
  for (auto& [group, its] : groups) parts.push_back(std::move(its));
  return parts;
}

/// Adds the edges between the parts.
void FacetDivider::add_segments(std::uint32_t f, plc::Plc& result) const {
  const std::span<const Triangle> triangles = triangles_of(f);
  const std::vector<std::uint32_t> across = list_neighbors(triangles);
  for (std::uint32_t side = 0; side < across.size(); ++side) {
    const std::uint32_t i = side / 3, j = across[side];
    if (j == none || j < i || group_of(f, i) == group_of(f, j)) continue;
    const VertexId a = triangles[i][side % 3], b = triangles[i][(side + 1) % 3];
    const VertexId apex = *std::ranges::find_if(triangles[j], [&](VertexId v) { return v != a && v != b; });
    const auto [p, q, r] = corners_of(triangles[i]);
    const int turn = orient3d(p, q, r, plc_.vertices[apex]);
    result.segments.push_back(
        {.ends = {a, b}, .grazeable = is_grazeable_fold(plc_, plc_.facets[f], turn), .listed = false});
  }
}

plc::Plc FacetDivider::divided() const {
  plc::Plc result = plc_;
  result.facets.clear(), result.triangles.clear(), result.faces.clear();
  for (std::uint32_t f = 0; f < step_.size(); ++f) {
    plc::Facet part = plc_.facets[f];
    if (step_[f] == Step::whole) {
      result.add(part, plc_.triangles_of(part));
      continue;
    }
    for (const std::vector<Triangle>& triangles : parts_of(f)) {
      part.exactly_flat = triangles.size() == 1;
      result.add(part, triangles);
    }
    add_segments(f, result);
  }
  HashSet<std::uint64_t> grazeable, known = ends_of(plc_.segments);
  for (const std::uint64_t ends : grazeable_) grazeable.insert(ends, {});
  const auto end_key = [](const plc::Segment& s) { return edge_key(s.ends[0], s.ends[1]); };
  const auto first_new = result.segments.begin() + static_cast<std::ptrdiff_t>(plc_.segments.size());
  const auto is_known = [&](const plc::Segment& s) { return !known.insert(end_key(s), {}).second; };
  result.segments.erase(std::remove_if(first_new, result.segments.end(), is_known), result.segments.end());
  for (plc::Segment& s : result.segments) s.grazeable = s.grazeable || grazeable.contains(end_key(s));
  return result;
}

std::vector<FacetOrigin> FacetDivider::origins() const {
  std::vector<FacetOrigin> origins;
  for (std::uint32_t f = 0; f < step_.size(); ++f) {
    const std::size_t parts = step_[f] == Step::whole ? 1 : parts_of(f).size();
    origins.insert(origins.end(), parts, {FacetId(f), is_nearly_flat(f) && step_[f] != Step::input});
  }
  return origins;
}

}  // namespace ccdt::folds
