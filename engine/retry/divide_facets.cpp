#include "engine/retry/divide_facets.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/facets/facet_mesh.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/integer_points.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::retry {
namespace {

using Triangle = std::array<VertexId, 3>;

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

RawVector<Box> boxes_of(std::span<const plc::FacetPart> parts) {
  RawVector<Box> boxes(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) boxes[i] = bounding_box(parts[i].corners);
  return boxes;
}

/// Divides the triangulation of the facets that are not exactly flat, the bent ones, into groups of triangles.
class FacetDivider {
 public:
  FacetDivider(const facets::FacetMesh& mesh, std::span<const plc::FacetPart> parts, double least_height, plc::Plc& plc)
      : mesh_(mesh), parts_(parts), tree_(boxes_of(parts)), least_height_(least_height), plc_(plc) {
    for (const plc::Facet& facet : plc.facets)
      normals_.push_back(plc::sum_of_normals(plc.triangles_of(facet), plc.vertices));
  }

  void divide() {
    list_neighbors();
    find_groups();
    add_segments();
    make_facets();
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  bool is_bent(std::uint32_t i) const { return !plc_.facets[mesh_.facet[i]].exactly_flat; }

  std::array<Point3, 3> corners_of(std::uint32_t i) const {
    const auto& [a, b, c] = mesh_.triangles[i];
    return {plc_.vertices[a], plc_.vertices[b], plc_.vertices[c]};
  }

  /// The triangles of the same facet across the edges. A facet may touch an inner edge of another one.
  void list_neighbors() {
    std::vector<std::tuple<FacetId, std::uint64_t, std::uint32_t>> sides;  // with 3 * triangle + edge
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (!is_bent(i)) continue;
      const Triangle& t = mesh_.triangles[i];
      for (std::uint32_t k = 0; k < 3; ++k)
        sides.emplace_back(mesh_.facet[i], edge_key(t[k], t[(k + 1) % 3]), 3 * i + k);
    }
    std::ranges::sort(sides);
    across_.assign(3 * mesh_.triangles.size(), none);
    for (std::size_t s = 1; s < sides.size(); ++s) {
      const auto& [facet, edge, side] = sides[s - 1];
      const auto& [next_facet, next_edge, next_side] = sides[s];
      if (facet != next_facet || edge != next_edge) continue;
      across_[side] = next_side / 3;
      across_[next_side] = side / 3;
    }
  }

  /// The triangle in whose group this one is. Two needles may have their longest edge in common.
  std::uint32_t leader(std::uint32_t i) const {
    constexpr int most_steps = 100;
    std::uint32_t before = none;
    for (int steps = 0; steps < most_steps; ++steps) {
      const std::array<Point3, 3> p = corners_of(i);
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

  bool overlaps_a_part(std::uint32_t i) const {
    const plc::FacetPart own{corners_of(i), normals_[mesh_.facet[i]]};
    bool found = false;
    tree_.for_each_meeting(bounding_box(own.corners),
                           [&](std::uint32_t part) { found = found || overlap(own, parts_[part]); });
    return found;
  }

  /// What is left of a facet is the group of its number; the other groups have the numbers of their leaders.
  void find_groups() {
    const auto facets = static_cast<std::uint32_t>(plc_.facets.size());
    group_of_.assign(mesh_.triangles.size(), none);
    for (std::uint32_t i = 0; i < group_of_.size(); ++i) {
      if (!is_bent(i)) continue;
      const std::uint32_t first = leader(i);
      group_of_[i] = overlaps_a_part(first) ? facets + first : std::uint32_t{mesh_.facet[i]};
    }
  }

  void add_segments() {
    HashSet<std::uint64_t> segments;
    for (const plc::Segment& s : plc_.segments) segments.insert(edge_key(s.ends[0], s.ends[1]), {});
    for (std::uint32_t i = 0; i < group_of_.size(); ++i) {
      if (!is_bent(i)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = across_[3 * i + k];
        if (next == none || group_of_[next] == group_of_[i]) continue;
        const VertexId a = mesh_.triangles[i][k], b = mesh_.triangles[i][(k + 1) % 3];
        if (segments.insert(edge_key(a, b), {}).second) plc_.segments.push_back({{a, b}, 0, true});
      }
    }
  }

  void make_facets() {
    struct Group {
      FacetId facet;  // that it is a part of
      std::vector<std::array<VertexId, 3>> triangles;
    };
    HashTable<std::uint32_t, std::uint32_t> place_of;  // in the list of groups
    std::vector<Group> groups;
    for (std::uint32_t i = 0; i < group_of_.size(); ++i) {
      if (!is_bent(i)) continue;
      const auto [place, is_new] = place_of.insert(group_of_[i], static_cast<std::uint32_t>(groups.size()));
      if (is_new) groups.push_back({mesh_.facet[i], {}});
      groups[*place].triangles.push_back(mesh_.triangles[i]);
    }
    const plc::Plc old = plc_;
    plc_.facets.clear(), plc_.triangles.clear(), plc_.faces.clear();
    for (const plc::Facet& facet : old.facets)
      if (facet.exactly_flat) plc_.add(facet, old.triangles_of(facet));
    for (const auto& [of, triangles] : groups) {
      plc::Facet facet = old.facets[of];
      facet.exactly_flat = triangles.size() == 1;
      plc_.add(facet, triangles);
    }
  }

  const facets::FacetMesh& mesh_;
  std::span<const plc::FacetPart> parts_;
  BoxTree tree_;  // of the parts
  double least_height_;
  plc::Plc& plc_;
  std::vector<Point3> normals_;          // of the facets
  std::vector<std::uint32_t> across_;    // of 3 * triangle + edge: a triangle of the same bent facet, if any
  std::vector<std::uint32_t> group_of_;  // of each triangle of a bent facet
};

}  // namespace

bool overlap(const plc::FacetPart& one, const plc::FacetPart& other) {
  const auto axis = static_cast<std::size_t>(dominant_axis(one.normal));
  return have_close_normals(one, other) && !is_beyond_an_edge(one.corners, other.corners, axis) &&
         !is_beyond_an_edge(other.corners, one.corners, axis);
}

void divide_facets(const delaunay::Delaunay& delaunay, std::span<const plc::FacetPart> parts, double tolerance,
                   plc::Plc& plc) {
  constexpr double needle = 2;  // tolerances
  const facets::FacetMesh mesh = facets::triangulate_facets(plc, protection::unprotected(plc, {}).chains, delaunay);
  FacetDivider(mesh, parts, needle * tolerance, plc).divide();
}

}  // namespace ccdt::retry
