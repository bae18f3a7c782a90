#include "bench/verify/periodic_sides.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bench/verify/findings.h"
#include "engine/base/box.h"

namespace ccdt::verify {
namespace {

/// The faces of one side, and their vertices by one of the two coordinates in its plane.
struct Side {
  std::vector<Face> faces;
  std::vector<std::uint32_t> vertices;
};

class SideMatcher {
 public:
  SideMatcher(const Topology& topology, std::size_t axis, double tolerance, Check& check)
      : topology_(topology), axis_(axis), tolerance_(tolerance), check_(check) {
    const Box box = bounding_box(topology.mesh.vertices);
    low_ = side_at(as_array(box.low)[axis]);
    high_ = side_at(as_array(box.high)[axis]);
  }

  void run() {
    check_.checked += low_.faces.size() + high_.faces.size();
    std::vector<Face> moved;
    for (const Face& face : low_.faces) {
      const Face opposite = ascending(Face{opposite_of(face[0]), opposite_of(face[1]), opposite_of(face[2])});
      if (std::ranges::binary_search(high_.faces, opposite))
        moved.push_back(opposite);
      else
        add_failure(face, "greatest");
    }
    std::ranges::sort(moved);
    for (const Face& face : high_.faces)
      if (!std::ranges::binary_search(moved, face)) add_failure(face, "least");
  }

 private:
  double coordinate(std::uint32_t vertex, std::size_t step) const {
    return as_array(topology_.mesh.vertices[vertex])[(axis_ + step) % 3];
  }

  Side side_at(double plane) const {
    Side side;
    for (const std::uint32_t f : topology_.boundary_faces) {
      const Face face = vertices_of_face(topology_, f);
      const auto is_on_it = [&](std::uint32_t v) { return std::fabs(coordinate(v, 0) - plane) <= tolerance_; };
      if (!std::ranges::all_of(face, is_on_it)) continue;
      side.faces.push_back(face);
      side.vertices.insert(side.vertices.end(), face.begin(), face.end());
    }
    std::ranges::sort(side.faces);
    sort_and_unique(side.vertices);
    std::ranges::sort(side.vertices, {}, [&](std::uint32_t v) { return coordinate(v, 1); });
    return side;
  }

  /// The vertex opposite one on the low side; `none` if there is not exactly one.
  std::uint32_t opposite_of(std::uint32_t vertex) const {
    const double wanted = coordinate(vertex, 1);
    std::uint32_t found = none;
    auto next = std::ranges::lower_bound(high_.vertices, wanted - tolerance_, {},
                                         [&](std::uint32_t v) { return coordinate(v, 1); });
    for (; next != high_.vertices.end() && coordinate(*next, 1) <= wanted + tolerance_; ++next) {
      if (std::fabs(coordinate(*next, 2) - coordinate(vertex, 2)) > tolerance_) continue;
      if (found != none) return none;
      found = *next;
    }
    return found;
  }

  void add_failure(const Face& face, const char* other_side) {
    fail(check_, [&] {
      return "face" + text(topology_.mesh.vertices, face) + " is not on the side of " + other_side + " " + "xyz"[axis_];
    });
  }

  const Topology& topology_;
  const std::size_t axis_;
  const double tolerance_;
  Check& check_;
  Side low_, high_;
};

}  // namespace

Check check_periodic_sides(const Topology& topology, plc::Periodicity periodic, double tolerance) {
  Check check{.name = "equal opposite sides"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((static_cast<unsigned>(periodic) >> axis & 1) != 0) SideMatcher(topology, axis, tolerance, check).run();
  return check;
}

}  // namespace ccdt::verify
