#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/plc.h"
#include "engine/sizes/sample_cell.h"
#include "engine/sizes/size_field.h"
#include "engine/sizes/triangle.h"

namespace ccdt::sizes {

/// What follows from the distance between two facets. Lengths are in grid units.
struct WallRules {
  double largest;  ///< edge length where no place needs less
  /// By facet, above and below it: how long edges may be, as a multiple of the distance to the next facet there; 0: any
  /// length.
  std::vector<std::array<double, 2>> ratios;
  double least_size = 0;      ///< no place needs shorter edges
  double least_distance = 0;  ///< thinner places are ignored, because no reasonable number of edges would fit
  /// Cosine of the largest angle between a facet and the opposite one. Where the angle is larger, as in a wedge, the
  /// place is not thin.
  double least_cosine = 0;
};

/// Measures space over and under facets, piece by piece: a piece of a triangle is halved if it is longer than the edges
/// that fit there.
///
///     ------ x ------    the piece that is measured
///            | distance
///     ------ * ------    the nearest facet that shares no vertex with its facet, up to 60 degrees away from its normal
class Walls {
 public:
  /// \param plc  must outlive this
  Walls(const plc::Plc& plc, WallRules rules);

  /// Measures the pieces that are longer than a length, which decreases from call to call.
  void measure(double least, std::vector<SizedPlace>& places);

  /// The number of pieces that are not measured yet.
  std::size_t open() const { return open_.size(); }

 private:
  struct FacetTriangle {
    Triangle corners;
    Point3 normal;  ///< of length one
    FacetId facet;
  };
  /// Triangles that may be near, above and below.
  using Sides = std::array<std::uint32_t, 2>;
  struct Piece {
    Triangle corners;
    FacetId facet;
    Sides near;
  };
  struct Sample {
    double size;
    Sides near;
  };

  void take_pieces(const Triangle& t, FacetId facet);
  void mark_facets_around(FacetId facet);
  void measure(Piece piece, double least, std::vector<SizedPlace>& places);
  Sample sample_at(const Point3& p, const Piece& piece) const;
  void look(FacetId facet, const Point3& normal, int side, const Point3& p, Sample& sample) const;
  RegionId region_beside(FacetId facet, int side) const;

  const plc::Plc& plc_;
  const WallRules rules_;
  std::vector<std::vector<FacetId>> facets_of_vertex_;
  std::vector<FacetId> met_by_;  // by facet: the last facet that searched and shares a vertex with it
  std::vector<FacetTriangle> triangles_;
  BoxTree tree_;
  HashTable<SampleCell, Sample> known_;
  std::vector<Piece> open_;
};

}  // namespace ccdt::sizes
