#include "engine/front/find_apex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/front/visibility.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/filters.h"
#include "engine/geometry/predicates.h"
#include "engine/locate/grid_locator.h"
#include "engine/locate/octree_locator.h"

namespace ccdt::front {
namespace {

/// The centroid in floating point, for boxes and cells.
Point3 approximate_centroid(const Point3& a, const Point3& b, const Point3& c) {
  return (1.0 / 3) * (a + b + c);
}

/// The circumsphere in floating point, a little too large; the cap stays unchanged if the four points are too flat.
void shrink(locate::Cap& cap, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = b - a, v = c - a, w = d - a;
  const double volume = dot(w, cross(u, v));
  if (volume * volume < 1e-18 * squared_length(u) * squared_length(v) * squared_length(w)) return;
  const Point3 to_center = to_circumcenter(u, v, w);
  cap.shrink_to(a + to_center, std::sqrt(squared_length(to_center)) * (1 + 1e-6));
}

/// The search for the apex of one face.
template <class Locator>
class ApexSearch {
 public:
  ApexSearch(const Locator& locator, const facets::FacetMesh& facets, const delaunay::Delaunay& d,
             const OrientedFace& face)
      : locator_(locator),
        facets_(facets),
        d_(d),
        face_(face.corners),
        a_(d.vertices[face_[0]]),
        b_(d.vertices[face_[1]]),
        c_(d.vertices[face_[2]]) {}

  std::optional<std::uint32_t> find(std::optional<std::uint32_t> seen_before) {
    if (seen_before)
      return best(located(*seen_before), [&](const locate::LocatedVertex& v) { return is_visible(v); }).id;
    const locate::LocatedVertex any = best(nobody, [](const locate::LocatedVertex&) { return true; });
    if (any.id == delaunay::ghost_vertex) return std::nullopt;
    if (is_visible(any)) return any.id;
    const locate::LocatedVertex seen =
        best(nobody, [&](const locate::LocatedVertex& v) { return v.id != any.id && is_visible(v); });
    if (seen.id == delaunay::ghost_vertex) return std::nullopt;
    return seen.id;
  }

  /// As in the paper (sections 4 and 5.1): the first visible vertex is replaced by a visible one in its sphere, until
  /// there is none. Where edges of facets meet edges of the three triangles exactly, facets can hide a vertex although
  /// they only touch these. So a vertex that passes the paper's tests is also tested along a line of sight from a
  /// generic point.
  std::optional<std::uint32_t> find_as_paper() {
    const auto is_seen = [&](const locate::LocatedVertex& v) { return is_visible_from_edges(v) && is_visible(v); };
    locate::LocatedVertex found = nobody;
    for (locate::LocatedVertex next = first(nobody, is_seen); next.id != delaunay::ghost_vertex;
         next = first(next, is_seen))
      found = next;
    if (found.id == delaunay::ghost_vertex) return std::nullopt;
    return found.id;
  }

  std::optional<std::uint32_t> find_near(NearVertices& near) {
    locate::LocatedVertex best = nobody;
    std::vector<Candidate> candidates;
    for (auto vertices = near.of_face(face_);; vertices = near.more(best.id)) {
      const std::uint32_t last = best.id;
      find_better(vertices, best, candidates);
      if (best.id == last) break;
    }
    if (best.id == delaunay::ghost_vertex) return std::nullopt;
    return best.id;
  }

 private:
  struct Candidate {
    double lift;  // grows with the part of the sphere that is above the face
    std::uint32_t id;
  };

  /// Replaces the best vertex by the best of the visible vertices that are better.
  void find_better(std::span<const std::uint32_t> vertices, locate::LocatedVertex& best,
                   std::vector<Candidate>& candidates) {
    const Point3 u = b_.point - a_.point, v = c_.point - a_.point, normal = cross(u, v);
    const Point3 twice_to_center = 2 * to_circumcenter(u, v);
    candidates.clear();
    for (const std::uint32_t id : vertices) {
      ++work_done.front_candidates;
      const locate::LocatedVertex vertex = located(id);
      if (!is_above(vertex.point) || (best.id != delaunay::ghost_vertex && !is_in_sphere(best, vertex))) continue;
      const Point3 e = vertex.point - a_.point;
      const double lift = dot(e, e - twice_to_center) / dot(normal, e);
      candidates.push_back({std::isnan(lift) ? 0 : lift, id});
    }
    // The first visible one is the best, up to rounding.
    std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::pair(c.lift, c.id); });
    for (const Candidate& candidate : candidates) {
      const locate::LocatedVertex vertex = located(candidate.id);
      if ((best.id == delaunay::ghost_vertex || is_in_sphere(best, vertex)) && is_visible(vertex)) best = vertex;
    }
  }

  locate::LocatedVertex located(std::uint32_t id) const { return {d_.point(id), d_.vertices[id].rank, id}; }

  /// The vertex above the face with the emptiest sphere among the best so far and those that satisfy a condition;
  /// `ghost_vertex` if there is none.
  template <class Satisfies>
  locate::LocatedVertex best(locate::LocatedVertex best, const Satisfies& satisfies) {
    const Point3 &a = a_.point, &b = b_.point, &c = c_.point;
    locate::Cap cap(a, b, c);
    if (best.id != delaunay::ghost_vertex) shrink(cap, a, b, c, best.point);
    // Any vertex above the face in a later, smaller sphere is also in the earlier one, so one search suffices.
    locator_.visit_nearest_first(approximate_centroid(a, b, c), cap, [&](const locate::LocatedVertex& v) {
      ++work_done.front_candidates;
      if (!cap.may_hold(v.point) || v.id == face_[0] || v.id == face_[1] || v.id == face_[2] || v.id == best.id) return;
      if (!is_above(v.point) || (best.id != delaunay::ghost_vertex && !is_in_sphere(best, v)) || !satisfies(v)) return;
      best = v;
      shrink(cap, a, b, c, v.point);
    });
    return best;
  }

  /// The first vertex above the face, searched one ring of cells after another, that satisfies a condition and is in
  /// the sphere of the face and another vertex, if one is given; `ghost_vertex` if there is none.
  template <class Satisfies>
  locate::LocatedVertex first(const locate::LocatedVertex& before, const Satisfies& satisfies) {
    const Point3 &a = a_.point, &b = b_.point, &c = c_.point, start = approximate_centroid(a, b, c);
    locate::Cap cap(a, b, c);
    if (before.id != delaunay::ghost_vertex) shrink(cap, a, b, c, before.point);
    locate::LocatedVertex found = nobody;
    locator_.visit_nearest_first(start, cap, [&](const locate::LocatedVertex& v) {
      if (found.id != delaunay::ghost_vertex) return;
      ++work_done.front_candidates;
      if (v.id == face_[0] || v.id == face_[1] || v.id == face_[2] || v.id == before.id) return;
      if (!is_above(v.point) || (before.id != delaunay::ghost_vertex && !is_in_sphere(before, v)) || !satisfies(v))
        return;
      found = v;
      cap.shrink_to(start, 0);  // ends the search
    });
    return found;
  }

  bool is_above(const Point3& p) const {
    const Sign sign = orient3d_filter(a_.point, b_.point, c_.point, p);
    return sign == Sign::unknown ? orient3d_exactly(a_.point, b_.point, c_.point, p) > 0 : sign == Sign::plus;
  }

  /// Is v in the sphere of the face and the best vertex so far?
  bool is_in_sphere(const locate::LocatedVertex& best, const locate::LocatedVertex& v) const {
    const Sign sign = insphere_filter(a_.point, b_.point, c_.point, best.point, v.point);
    if (sign == Sign::plus || sign == Sign::minus) return sign == Sign::plus;
    return insphere_perturbed(a_.point, b_.point, c_.point, best.point, v.point,
                              {a_.rank, b_.rank, c_.rank, best.rank, v.rank}) > 0;
  }

  bool is_visible(const locate::LocatedVertex& v) {
    // The triangles that hid the last vertices are likely to hide this one.
    for (std::size_t i = 0; i < occluders_.size(); ++i)
      if (is_hidden_by(occluders_[i], v)) {
        std::rotate(occluders_.begin(), occluders_.begin() + i, occluders_.begin() + i + 1);
        return false;
      }
    return !locator_.any_near_edge(approximate_centroid(a_.point, b_.point, c_.point), v.point, [&](std::uint32_t f) {
      if (!is_hidden_by(f, v)) return false;
      if (occluders_.size() == most_occluders) occluders_.pop_back();
      occluders_.insert(occluders_.begin(), f);
      return true;
    });
  }

  /// The paper's test: no facet crosses the triangles that the vertex forms with the edges of the face.
  bool is_visible_from_edges(const locate::LocatedVertex& v) const {
    for (const auto& [from, to] : {std::pair(&a_, &b_), std::pair(&b_, &c_), std::pair(&c_, &a_)}) {
      const Corners triangle = {&from->point, &to->point, &v.point};
      const Box box = bounding_box(std::array{from->point, to->point, v.point});
      if (locator_.any_near_box(box, [&](std::uint32_t f) {
            const auto& t = facets_.triangles[f];
            ++work_done.visibility_tests;
            return cross_each_other(triangle, {&d_.point(t[0]), &d_.point(t[1]), &d_.point(t[2])});
          }))
        return false;
    }
    return true;
  }

  bool is_hidden_by(std::uint32_t f, const locate::LocatedVertex& v) const {
    const auto& t = facets_.triangles[f];
    if (t[0] == v.id || t[1] == v.id || t[2] == v.id) return false;
    ++work_done.visibility_tests;
    return hides({&d_.point(t[0]), &d_.point(t[1]), &d_.point(t[2])}, v.point, a_.point, b_.point, c_.point);
  }

  static constexpr locate::LocatedVertex nobody{{}, 0, delaunay::ghost_vertex};
  static constexpr std::size_t most_occluders = 16;

  const Locator& locator_;
  const facets::FacetMesh& facets_;
  const delaunay::Delaunay& d_;
  const std::array<std::uint32_t, 3>& face_;
  const delaunay::DelaunayVertex &a_, &b_, &c_;
  std::vector<std::uint32_t> occluders_;  // the last first
};

}  // namespace

template <class Locator>
std::optional<std::uint32_t> find_apex(const Locator& locator, const facets::FacetMesh& facets,
                                       const delaunay::Delaunay& delaunay, const OrientedFace& face,
                                       std::optional<std::uint32_t> seen_before) {
  return ApexSearch<Locator>(locator, facets, delaunay, face).find(seen_before);
}

template <class Locator>
std::optional<std::uint32_t> find_apex_as_in_paper(const Locator& locator, const facets::FacetMesh& facets,
                                                   const delaunay::Delaunay& delaunay, const OrientedFace& face) {
  return ApexSearch<Locator>(locator, facets, delaunay, face).find_as_paper();
}

template <class Locator>
std::optional<std::uint32_t> find_near_apex(const Locator& locator, const facets::FacetMesh& facets,
                                            const delaunay::Delaunay& delaunay, const OrientedFace& face,
                                            NearVertices& near) {
  return ApexSearch<Locator>(locator, facets, delaunay, face).find_near(near);
}

template std::optional<std::uint32_t> find_apex(const locate::GridLocator&, const facets::FacetMesh&,
                                                const delaunay::Delaunay&, const OrientedFace&,
                                                std::optional<std::uint32_t>);
template std::optional<std::uint32_t> find_apex(const locate::OctreeLocator&, const facets::FacetMesh&,
                                                const delaunay::Delaunay&, const OrientedFace&,
                                                std::optional<std::uint32_t>);
template std::optional<std::uint32_t> find_apex_as_in_paper(const locate::GridLocator&, const facets::FacetMesh&,
                                                            const delaunay::Delaunay&, const OrientedFace&);
template std::optional<std::uint32_t> find_apex_as_in_paper(const locate::OctreeLocator&, const facets::FacetMesh&,
                                                            const delaunay::Delaunay&, const OrientedFace&);
template std::optional<std::uint32_t> find_near_apex(const locate::OctreeLocator&, const facets::FacetMesh&,
                                                     const delaunay::Delaunay&, const OrientedFace&, NearVertices&);

}  // namespace ccdt::front
