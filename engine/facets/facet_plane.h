#pragma once

#include <array>
#include <vector>

#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"
#include "engine/numbers/predicates.h"

namespace ccdt {

/// Exact planar predicates within a facet, agreeing with the tetrahedralization (a model of `PlanarPredicates`).
///
/// In an exactly flat facet they are those of space with an apex above the plane. A facet that is flat only within the
/// tolerance is *flattened*: its vertices are seen along the axis that its normal is nearest to, stretched to their
/// true distances and rounded to the grid, which gives points that are exactly in one plane.
class FacetPlane {
 public:
  FacetPlane(const std::vector<DelaunayVertex>& vertices, const Point3& apex) : vertices_(vertices), apex_(apex) {}
  /// \param flattened  by vertex; only those of the facet are read
  FacetPlane(const std::vector<DelaunayVertex>& vertices, const std::vector<Point3>& flattened)
      : vertices_(vertices), flattened_(&flattened), apex_{0, 0, 0x1p50} {}

  int orient(VertexId a, VertexId b, VertexId c) const { return orient3d(at(a), at(b), at(c), apex_); }

  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return incircle_perturbed(at(a), at(b), at(c), apex_, at(d),
                              {vertices_[a].rank, vertices_[b].rank, vertices_[c].rank, vertices_[d].rank});
  }

 private:
  const Point3& at(VertexId v) const { return flattened_ ? (*flattened_)[v] : vertices_[v].point; }

  const std::vector<DelaunayVertex>& vertices_;
  const std::vector<Point3>* flattened_ = nullptr;
  Point3 apex_;
};

/// The plane of a facet that is flat only within the tolerance, where the preferred diagonal is the one further from
/// the domain, and the Delaunay one only between exactly coplanar vertices. Seen from the domain the edges that
/// `planar_legalize` leaves are convex where they can be; and convex edges need no protection (Shewchuk 2002).
class BentPlane {
 public:
  /// \param domain_side  +1: the domain is above the facet, -1: below
  BentPlane(const FacetPlane& plane, const std::vector<DelaunayVertex>& vertices, int domain_side)
      : plane_(plane), vertices_(vertices), domain_side_(domain_side) {}

  int orient(VertexId a, VertexId b, VertexId c) const { return plane_.orient(a, b, c); }

  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    const int above =
        orient3d(vertices_[a].point, vertices_[b].point, vertices_[c].point, vertices_[d].point) * domain_side_;
    return above != 0 ? -above : plane_.incircle(a, b, c, d);
  }

 private:
  const FacetPlane& plane_;
  const std::vector<DelaunayVertex>& vertices_;
  int domain_side_;
};

}  // namespace ccdt
