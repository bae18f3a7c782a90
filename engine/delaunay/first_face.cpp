#include "engine/delaunay/first_face.h"

#include <algorithm>
#include <cmath>

#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = VertexId::none_value;
// Straight up, about as far as points can be apart, so that the filters of the predicates work as for any points.
constexpr Point3 upwards = {0, 0, 0x1p51};

/// Wraps the hull; every function passes over all vertices once and is exact.
class Wrapping {
 public:
  explicit Wrapping(std::span<const GridVertex> vertices) : v_(vertices) {}

  std::optional<std::array<std::uint32_t, 3>> face() const {
    if (v_.size() < 4) return {};
    const std::uint32_t a = lowest();
    const std::uint32_t b = beside(a);
    if (b == none) return {};
    std::uint32_t c = on_upright_plane(a, b);
    if (c == none) c = around(a, b);
    if (c == none) return {};
    const std::uint32_t inner = off_plane(a, b, c);
    if (inner == none) return {};
    std::vector<std::uint32_t> plane;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), at(b), at(c), at(e)) == 0) plane.push_back(e);
    const std::uint32_t q = along_boundary(plane, a, inner);
    return std::array{a, q, above_edge(plane, a, q, inner)};
  }

 private:
  const Point3& at(std::uint32_t v) const { return v_[v].point; }

  /// Of the smallest x, of these the smallest y, of these the smallest z: a vertex of the hull.
  std::uint32_t lowest() const {
    const auto lower = [](const GridVertex& p, const GridVertex& q) { return as_array(p.point) < as_array(q.point); };
    return static_cast<std::uint32_t>(std::min_element(v_.begin(), v_.end(), lower) - v_.begin());
  }

  /// The upright plane through a and the result, which is not straight above a, has no vertices on its outer side.
  std::uint32_t beside(std::uint32_t a) const {
    const Point3 up = at(a) + upwards;
    std::uint32_t b = none;
    for (std::uint32_t e = 0; e < v_.size(); ++e) {
      if (at(e).x == at(a).x && at(e).y == at(a).y) continue;
      if (b == none || orient3d(at(a), up, at(b), at(e)) > 0) b = e;
    }
    return b;
  }

  /// A vertex of the upright plane through a and b that is not on the line of a and b.
  std::uint32_t on_upright_plane(std::uint32_t a, std::uint32_t b) const {
    const Point3 up = at(a) + upwards;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), up, at(b), at(e)) == 0 && !collinear(at(a), at(b), at(e))) return e;
    return none;
  }

  /// The plane that turns around the line of a and b meets this vertex first.
  std::uint32_t around(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t c = none;
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (c == none ? !collinear(at(a), at(b), at(e)) : orient3d(at(a), at(b), at(c), at(e)) > 0) c = e;
    return c;
  }

  std::uint32_t off_plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (std::uint32_t e = 0; e < v_.size(); ++e)
      if (orient3d(at(a), at(b), at(c), at(e)) != 0) return e;
    return none;
  }

  /// Next to a on the boundary of the vertices of a hull plane, counterclockwise as seen from outside.
  std::uint32_t along_boundary(std::span<const std::uint32_t> plane, std::uint32_t a, std::uint32_t inner) const {
    std::uint32_t q = none;
    for (const std::uint32_t e : plane) {
      if (e == a) continue;
      if (q == none || orient3d(at(a), at(q), at(e), at(inner)) > 0 ||
          (collinear(at(a), at(q), at(e)) && is_nearer(at(e) - at(a), at(q) - at(a))))
        q = e;
    }
    return q;
  }

  /// Of two multiples of one vector.
  static bool is_nearer(const Point3& p, const Point3& q) {
    return std::array{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)} <
           std::array{std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)};
  }

  /// The vertex that makes a Delaunay triangle of the edge from a to q, in their plane.
  std::uint32_t above_edge(std::span<const std::uint32_t> plane, std::uint32_t a, std::uint32_t q,
                           std::uint32_t inner) const {
    std::uint32_t r = none;
    for (const std::uint32_t e : plane) {
      if (orient3d(at(q), at(a), at(e), at(inner)) <= 0) continue;
      if (r == none || incircle_perturbed(at(q), at(a), at(r), at(inner), at(e),
                                          {v_[q].rank, v_[a].rank, v_[r].rank, v_[e].rank}) > 0)
        r = e;
    }
    return r;
  }

  std::span<const GridVertex> v_;
};

}  // namespace

std::optional<std::array<std::uint32_t, 3>> find_first_face(std::span<const GridVertex> vertices) {
  return Wrapping(vertices).face();
}

}  // namespace ccdt
