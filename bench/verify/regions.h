#pragma once

#include <algorithm>
#include <functional>
#include <optional>

#include "bench/verify/surface.h"

namespace ccdt::verify {

/// Where a ray meets a piece of the surface.
struct Hit {
  std::uint32_t piece;
  double along;     ///< 0 at the start of the ray, 1 at its end
  bool from_above;  ///< the ray comes from the side that the piece's normal points to

  /// The side that the ray meets, and the one from which it goes on; numbered as in `Regions::of_side`.
  std::uint32_t side_met() const { return 2 * piece + (from_above ? 0 : 1); }
  std::uint32_t side_left() const { return 2 * piece + (from_above ? 1 : 0); }
};

/// Shoots rays at the surface. Exact signs decide which pieces a ray meets.
class RayShooter {
 public:
  explicit RayShooter(const Surface& surface);

  /// All pieces that the ray from `start` out of the box meets, in their order along it. Nothing if the ray grazes an
  /// edge, or if two pieces are too close to be ordered. Each `attempt` is another ray; there is no limit.
  std::optional<std::vector<Hit>> shoot(const Point3& start, int attempt) const;

  /// How far a ray that starts at this height rises.
  double length(double z) const { return std::max(high_z_ - z, 0.0) + surface_.tolerances.box; }
  /// Direction of a ray; its z is 1.
  static Point3 direction(int attempt);

  /// The pieces whose plane and whose box are within the tolerance of flatness of a point.
  std::vector<std::uint32_t> pieces_near(const Point3& point) const;
  /// Is a point exactly on a piece that is perpendicular to an axis, and if near its border, on an edge along an axis?
  /// Then it stays on the piece when coordinates are rounded.
  /// \param counts  pieces of which this is not true are left out
  bool is_on_piece_across_axis(const Point3& point, const std::function<bool(std::uint32_t)>& counts) const;

 private:
  const Surface& surface_;
  double high_z_;
  ScaledBoxTree tree_;  // of the pieces
};

enum class Inside : std::uint8_t { no, yes, unknown };

/// The parts of space that the facets of the input do not divide further, computed only from the input.
struct Regions {
  /// Region of each side of each piece: 2 * piece for above, 2 * piece + 1 for below. Region 0 reaches infinity.
  std::vector<std::uint32_t> of_side;
  std::vector<Inside> inside;                ///< of each region
  std::vector<std::vector<int>> attributes;  ///< for each region: the attributes of the region seeds in it
  std::vector<std::uint32_t> hole_seeds;     ///< for each region: how many are in it

  std::uint32_t count() const { return static_cast<std::uint32_t>(inside.size()); }
  bool touches_inside(std::uint32_t piece) const {
    return inside[of_side[2 * piece]] == Inside::yes || inside[of_side[2 * piece + 1]] == Inside::yes;
  }
};

/// Finds the regions: sides of pieces are glued around edges, and rays determine the nesting of shells.
///
/// Which regions of a surface (`Inside::even_odd`) are inside depends on its shells, which are connected pieces. A
/// region is inside if an odd number of shells is around it, or if an odd number of pieces is on the shortest way to
/// infinity. The two rules can differ only if regions share pieces and others enclose one of them. Then either answer
/// is right: `Inside::unknown`.
Regions find_regions(const plc::InputPlc& input, const Surface& surface);

/// The regions that a point is in, or borders on if it lies on the surface. Empty if the surface there is too irregular
/// to decide.
std::vector<std::uint32_t> regions_at(const Surface& surface, const Regions& regions, const RayShooter& rays,
                                      const Point3& point);

}  // namespace ccdt::verify
