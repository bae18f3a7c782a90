#include "bench/verify/spread_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace ccdt::verify {

namespace {

/// A face of the mesh to the left of a directed edge, with the tetrahedron above it.
struct FaceAtEdge {
  std::uint32_t half_face;  ///< of the tetrahedron
  std::uint32_t third;      ///< the third corner of the face
  std::uint32_t apex;       ///< of the tetrahedron
};

/// The inner faces of the mesh around the plane of a patch.
class PlaneFaces {
 public:
  PlaneFaces(const Topology& topology, const Surface& surface, const Patches& patches, std::uint32_t patch)
      : flat(surface.tolerances.flat), topology_(topology), patches_(patches), patch_(patch) {}

  const double flat;

  const Point3& at(std::uint32_t v) const { return topology_.mesh.vertices[v]; }
  bool in_plane(std::uint32_t v) const { return std::fabs(patches_.height(patch_, at(v))) <= flat; }
  double area_above(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return 0.5 * dot(patches_.normal[patch_], cross(at(b) - at(a), at(c) - at(a)));
  }
  /// The least area, as seen from above, of a face at an edge. A face with less would be turned over.
  double least_area(std::uint32_t a, std::uint32_t b) const { return -flat * length(at(b) - at(a)); }

  /// Calls visit(FaceAtEdge) for the inner faces in the plane to the left of a directed edge.
  template <class Visit>
  void for_each_at(std::uint32_t a, std::uint32_t b, const Visit& visit) const {
    for (const std::uint32_t t : topology_.stars.of(a)) {
      const auto& tet = topology_.mesh.tetrahedra[t];
      if (std::find(tet.begin(), tet.end(), b) == tet.end()) continue;
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t apex = tet[corner];
        if (apex == a || apex == b) continue;
        const auto [u, v, w] = outward(topology_.mesh, 4 * t + corner);
        const std::uint32_t third = u != a && u != b ? u : v != a && v != b ? v : w;
        // Seen from within the tetrahedron, which must be above, the face has the opposite orientation of `outward`.
        const bool runs = (u == b && v == a) || (v == b && w == a) || (w == b && u == a);
        if (!runs || !in_plane(third)) continue;
        if (!topology_.on_boundary(face_of(topology_, 4 * t + corner))) visit(FaceAtEdge{4 * t + corner, third, apex});
      }
    }
  }

 private:
  const Topology& topology_;
  const Patches& patches_;
  std::uint32_t patch_;
};

/// The faces in the plane that are reached from the links, each from the side that may be its upper one. Faces with an
/// edge where no other face continues are left out.
class FacesWithoutDeadEnds {
 public:
  FacesWithoutDeadEnds(const Topology& topology, const PlaneFaces& plane, const std::vector<Edge>& links)
      : topology_(topology), plane_(plane), links_(links.begin(), links.end()), open_(links) {
    while (!open_.empty()) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      gather(a, b);
    }
    remove_dead_ends();
  }

  bool has(std::uint32_t half_face) const { return half_faces_.contains(half_face); }

 private:
  /// The directed edges of a face, with its upper side to their left.
  std::array<Edge, 3> edges_of(std::uint32_t half_face) const {
    const auto [u, v, w] = outward(topology_.mesh, half_face);
    return {{{v, u}, {u, w}, {w, v}}};
  }

  void gather(std::uint32_t a, std::uint32_t b) {
    plane_.for_each_at(a, b, [&](const FaceAtEdge& f) {
      if (plane_.area_above(a, b, f.third) < plane_.least_area(a, b) || !half_faces_.insert(f.half_face).second) return;
      for (const Edge& e : edges_of(f.half_face)) {
        ++at_edge_[e];
        if (links_.contains(e) || !reached_.insert(e).second) continue;
        open_.push_back({e[1], e[0]});
      }
    });
  }

  bool goes_on(std::uint32_t half_face, const Edge& edge) const {
    if (links_.contains(edge)) return true;
    const Edge reverse = {edge[1], edge[0]};
    const auto found = at_edge_.find(reverse);
    if (found == at_edge_.end() || links_.contains(reverse)) return false;
    const auto [one, other] = topology_.half_faces[face_of(topology_, half_face)];
    return found->second > int{has(half_face == one ? other : one)};  // the same face from below does not count
  }

  void remove_dead_ends() {
    std::vector<std::uint32_t> left(half_faces_.begin(), half_faces_.end());
    for (std::size_t dropped = 1; dropped > 0;)
      dropped = std::erase_if(left, [&](std::uint32_t half_face) {
        const auto edges = edges_of(half_face);
        if (std::ranges::all_of(edges, [&](const Edge& e) { return goes_on(half_face, e); })) return false;
        for (const Edge& e : edges) --at_edge_[e];
        half_faces_.erase(half_face);
        return true;
      });
  }

  const Topology& topology_;
  const PlaneFaces& plane_;
  std::set<Edge> links_;
  std::vector<Edge> open_;
  std::set<Edge> reached_;
  std::set<std::uint32_t> half_faces_;
  std::map<Edge, int> at_edge_;  // how many of the faces are to the left of an edge
};

class SheetSpreader {
 public:
  SheetSpreader(const Topology& topology, const Surface& surface, const Patches& patches, std::uint32_t patch,
                SheetFaces which)
      : topology_(topology),
        plane_(topology, surface, patches, patch),
        which_(which),
        open_(patches.links_of(patch).begin(), patches.links_of(patch).end()),
        greatest_area_(1.001 * patches.area[patch] + plane_.flat * patches.perimeter[patch]) {
    walls_.insert(open_.begin(), open_.end());
    if (which == SheetFaces::without_dead_ends) without_dead_ends_.emplace(topology, plane_, open_);
  }

  std::optional<Sheet> spread() {
    while (!open_.empty()) {
      const Edge edge = open_.back();
      open_.pop_back();
      if (!done_.contains(edge) && !add_face(edge[0], edge[1])) return {};
    }
    return std::move(sheet_);
  }

 private:
  /// Adds the topmost face to the left of a directed edge.
  bool add_face(std::uint32_t a, std::uint32_t b) {
    const double least_area = plane_.least_area(a, b);
    FaceAtEdge best = {none, none, none};
    std::pair<bool, double> best_rank = {false, least_area};  // is it topmost? its area
    plane_.for_each_at(a, b, [&](const FaceAtEdge& f) {
      const std::pair<bool, double> rank = {!plane_.in_plane(f.apex), plane_.area_above(a, b, f.third)};
      if (rank <= best_rank || rank.second < least_area || !may_have(f.half_face)) return;
      best = f;
      best_rank = rank;
    });
    if (best.half_face == none) return false;
    sheet_.faces.push_back({a, b, best.third});
    sheet_.above.push_back(best.half_face / 4);
    area_ += best_rank.second;
    return area_ <= greatest_area_ && close({a, b}) && close({b, best.third}) && close({best.third, a});
  }

  bool may_have(std::uint32_t half_face) const {
    if (which_ == SheetFaces::listed) return topology_.listed[face_of(topology_, half_face)];
    return !without_dead_ends_ || without_dead_ends_->has(half_face);
  }

  /// An edge of a new face: a link, or to be shared with the next face.
  bool close(const Edge& e) {
    const Edge reverse = {e[1], e[0]};
    if (!done_.insert(e).second) return false;
    if (!walls_.contains(e) && !done_.contains(reverse)) open_.push_back(reverse);
    return true;
  }

  const Topology& topology_;
  PlaneFaces plane_;
  SheetFaces which_;
  Sheet sheet_;
  std::vector<Edge> open_;
  double greatest_area_, area_ = 0;
  std::set<Edge> walls_, done_;
  std::optional<FacesWithoutDeadEnds> without_dead_ends_;  // if only those may be in the sheet
};

}  // namespace

std::optional<Sheet> spread_sheet(const Topology& topology, const Surface& surface, const Patches& patches,
                                  std::uint32_t patch, SheetFaces which) {
  return SheetSpreader(topology, surface, patches, patch, which).spread();
}

}  // namespace ccdt::verify
