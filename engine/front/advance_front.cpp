#include "engine/front/advance_front.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "engine/delaunay/cell_star.h"
#include "engine/front/find_apex.h"

namespace ccdt {
namespace {

/// The front: sides of PLC faces in arrays by triangle, because most of them are Delaunay and never looked at again,
/// and the faces that the front makes in a table.
class Front {
 public:
  Front(const Plc& plc, const FacetMesh& facets, const std::vector<std::uint32_t>& codes, bool face_protection,
        const Delaunay& delaunay);

  void advance(const Progress& progress);
  FrontResult finish();

 private:
  enum Side : std::size_t { above = 0, below = 1 };

  [[noreturn]] void fail(const OrientedFace& face, const char* what) const;
  std::optional<std::size_t> plc_side(const OrientedFace& face) const;
  FrontFace state_of(std::size_t side) const;
  std::optional<FrontFace> close(const OrientedFace& face);
  void add_tetrahedron(const OrientedFace& base, std::uint32_t apex, ChamberId chamber);
  void pass(const OrientedFace& inner, ChamberId chamber);

  const Plc& plc_;
  const FacetMesh& facets_;
  const std::vector<std::uint32_t>& codes_;
  bool face_protection_;
  const Delaunay& d_;
  CellStar star_;
  std::vector<bool> plc_open_;  // by 2 * triangle + side
  std::unordered_map<OrientedFace, std::size_t, OrientedFaceHash> plc_sides_;
  std::unordered_map<OrientedFace, FrontFace, OrientedFaceHash> faces_;
  std::vector<OrientedFace> undelaunay_;  // some may be closed meanwhile
  FrontResult result_;
};

Front::Front(const Plc& plc, const FacetMesh& facets, const std::vector<std::uint32_t>& codes, bool face_protection,
             const Delaunay& delaunay)
    : plc_(plc),
      facets_(facets),
      codes_(codes),
      face_protection_(face_protection),
      d_(delaunay),
      star_(delaunay),
      plc_open_(2 * facets.triangles.size(), false) {
  const bool any_undelaunay = std::find(codes.begin(), codes.end(), no_neighbor) != codes.end();
  if (any_undelaunay) plc_sides_.reserve(2 * facets.triangles.size());
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const auto& t = facets.triangles[i];
    const Facet& facet = plc.facets[facets.facet[i]];
    for (const Side side : {above, below}) {
      plc_open_[2 * i + side] = plc.chambers[side == above ? facet.above : facet.below].inside;
      if (!any_undelaunay) continue;
      const OrientedFace face(t[0], t[side == above ? 1 : 2], t[side == above ? 2 : 1]);
      plc_sides_.emplace(face, 2 * i + side);
      if (plc_open_[2 * i + side] && codes[i] == no_neighbor) undelaunay_.push_back(face);
    }
  }
}

void Front::fail(const OrientedFace& face, const char* what) const {
  Place place;
  place.file = plc_.name;
  for (const std::uint32_t v : face.corners) place.points.push_back(as_array(plc_.grid.to_world(d_.point(v))));
  throw FrontStuck(what, place, "the facets near these points are almost but not quite flat: try another --flatness");
}

std::optional<std::size_t> Front::plc_side(const OrientedFace& face) const {
  const auto found = plc_sides_.find(face);
  if (found == plc_sides_.end()) return std::nullopt;
  return found->second;
}

FrontFace Front::state_of(std::size_t side) const {
  const std::size_t triangle = side / 2;
  const Facet& facet = plc_.facets[facets_.facet[triangle]];
  const std::uint32_t code = codes_[triangle];
  if (side % 2 == above) return {facet.above, code};
  return {facet.below, code == no_neighbor ? no_neighbor : d_.cells[cell_of(code)].neighbors[face_of(code)]};
}

/// Takes a face from the front; nothing if it is not there.
std::optional<FrontFace> Front::close(const OrientedFace& face) {
  if (const auto side = plc_side(face)) {
    if (!plc_open_[*side]) return std::nullopt;
    plc_open_[*side] = false;
    return state_of(*side);
  }
  const auto found = faces_.find(face);
  if (found == faces_.end()) return std::nullopt;
  const FrontFace state = found->second;
  faces_.erase(found);
  return state;
}

void Front::advance(const Progress& progress) {
  if (undelaunay_.empty()) return;
  ApexFinder finder(facets_, d_);
  std::uint64_t done = 0;
  while (!undelaunay_.empty()) {
    const OrientedFace face = undelaunay_.back();
    undelaunay_.pop_back();
    const auto state = close(face);
    if (!state) continue;
    const auto apex = finder.find(face);
    if (!apex) fail(face, "the front found no vertex that is visible from a face");
    add_tetrahedron(face, *apex, state->chamber);
    if ((++done & 0xFFF) == 0) report(progress, "front", done, done + undelaunay_.size());
  }
}

void Front::add_tetrahedron(const OrientedFace& base, std::uint32_t apex, ChamberId chamber) {
  const auto& [a, b, c] = base.corners;
  result_.tetrahedra.push_back({a, b, c, apex});
  result_.chambers.push_back(chamber);
  // The other faces, with the tetrahedron above them.
  pass({a, c, apex}, chamber);
  pass({c, b, apex}, chamber);
  pass({b, a, apex}, chamber);
}

/// Closes a face that waited for this tetrahedron, or opens its other side (paper, section 5.3).
void Front::pass(const OrientedFace& inner, ChamberId chamber) {
  if (close(inner)) return;
  if (plc_side(inner)) fail(inner, "the front passed a facet");
  const OrientedFace outer = inner.reversed();
  const std::uint32_t code =
      face_protection_ ? star_.find_face(outer.corners[0], outer.corners[1], outer.corners[2]) : no_neighbor;
  if (!faces_.emplace(outer, FrontFace{chamber, code}).second) fail(outer, "two tetrahedra of the front overlap");
  if (code == no_neighbor) undelaunay_.push_back(outer);
}

FrontResult Front::finish() {
  for (std::size_t side = 0; side < plc_open_.size(); ++side)
    if (plc_open_[side]) result_.open.push_back(state_of(side));
  for (const auto& entry : faces_) result_.open.push_back(entry.second);
  return std::move(result_);
}

}  // namespace

FrontResult advance_front(const Plc& plc, const FacetMesh& facets, const std::vector<std::uint32_t>& codes,
                          bool face_protection, const Delaunay& delaunay, const Progress& progress) {
  Front front(plc, facets, codes, face_protection, delaunay);
  front.advance(progress);
  return front.finish();
}

}  // namespace ccdt
