#include "engine/front/advance_front.h"

#include <unordered_set>

#include "engine/delaunay/cell_star.h"
#include "engine/front/find_apex.h"

namespace ccdt {
namespace {

class Front {
 public:
  Front(const Plc& plc, const FacetMesh& facets, bool face_protection, const Delaunay& delaunay)
      : plc_(plc), face_protection_(face_protection), d_(delaunay), star_(delaunay), finder_(facets, delaunay) {}

  /// Opens both sides of the faces of the PLC, where the domain is.
  void start(const FacetMesh& facets, const std::vector<std::uint32_t>& codes);
  void advance(const Progress& progress);
  FrontResult finish();

 private:
  [[noreturn]] void fail(const OrientedFace& face, const char* what) const;
  void open(const OrientedFace& face, const FrontFace& state);
  void add_tetrahedron(const OrientedFace& base, std::uint32_t apex, ChamberId chamber);
  void pass(const OrientedFace& inner, ChamberId chamber);

  const Plc& plc_;
  bool face_protection_;
  const Delaunay& d_;
  CellStar star_;
  ApexFinder finder_;
  std::unordered_set<OrientedFace, OrientedFaceHash> plc_faces_;  // in both orientations
  FrontFaces faces_;
  std::vector<OrientedFace> undelaunay_;  // some may be closed meanwhile
  FrontResult result_;
};

void Front::fail(const OrientedFace& face, const char* what) const {
  Place place;
  place.file = plc_.name;
  for (const std::uint32_t v : face.corners) place.points.push_back(as_array(d_.point(v)));
  throw FrontStuck(what, place, "the facets near these points are almost but not quite flat: try another --flatness");
}

void Front::open(const OrientedFace& face, const FrontFace& state) {
  if (!faces_.emplace(face, state).second) fail(face, "two tetrahedra of the front overlap");
  if (state.code == no_neighbor) undelaunay_.push_back(face);
}

void Front::start(const FacetMesh& facets, const std::vector<std::uint32_t>& codes) {
  plc_faces_.reserve(2 * facets.triangles.size());
  faces_.reserve(2 * facets.triangles.size());
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const auto& t = facets.triangles[i];
    const OrientedFace face(t[0], t[1], t[2]);
    plc_faces_.insert(face);
    plc_faces_.insert(face.reversed());
    const Facet& facet = plc_.facets[facets.facet[i]];
    const std::uint32_t below =
        codes[i] == no_neighbor ? no_neighbor : d_.cells[cell_of(codes[i])].neighbors[face_of(codes[i])];
    if (plc_.chambers[facet.above].inside) open(face, {facet.above, codes[i]});
    if (plc_.chambers[facet.below].inside) open(face.reversed(), {facet.below, below});
  }
}

void Front::advance(const Progress& progress) {
  std::uint64_t done = 0;
  while (!undelaunay_.empty()) {
    const OrientedFace face = undelaunay_.back();
    undelaunay_.pop_back();
    const auto found = faces_.find(face);
    if (found == faces_.end()) continue;
    const ChamberId chamber = found->second.chamber;
    faces_.erase(found);
    const auto apex = finder_.find(face);
    if (!apex) fail(face, "the front found no vertex that is visible from a face");
    add_tetrahedron(face, *apex, chamber);
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
  if (const auto found = faces_.find(inner); found != faces_.end()) {
    faces_.erase(found);
    return;
  }
  if (plc_faces_.contains(inner)) fail(inner, "the front passed a facet");
  const OrientedFace outer = inner.reversed();
  const std::uint32_t code =
      face_protection_ ? star_.find_face(outer.corners[0], outer.corners[1], outer.corners[2]) : no_neighbor;
  open(outer, {chamber, code});
}

FrontResult Front::finish() {
  result_.open.reserve(faces_.size());
  for (const auto& entry : faces_) result_.open.push_back(entry.second);
  return std::move(result_);
}

}  // namespace

FrontResult advance_front(const Plc& plc, const FacetMesh& facets, const std::vector<std::uint32_t>& codes,
                          bool face_protection, const Delaunay& delaunay, const Progress& progress) {
  Front front(plc, facets, face_protection, delaunay);
  front.start(facets, codes);
  front.advance(progress);
  return front.finish();
}

}  // namespace ccdt
