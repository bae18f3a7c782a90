#include "engine/front/advance_front.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/index_lists.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/find_apex.h"
#include "engine/locate/cavity_locator.h"
#include "engine/locate/grid_locator.h"
#include "engine/locate/octree_locator.h"

namespace ccdt::front {
namespace {

constexpr std::uint32_t no_cavity = locate::CavityLocator::no_cavity;

/// For tables.
struct OrientedFaceTraits {
  static OrientedFace none() { return {ghost_vertex, ghost_vertex, ghost_vertex}; }
  static std::size_t hash(const OrientedFace& f) {
    std::uint64_t h =
        f.corners[0] * 0x9E3779B97F4A7C15u ^ f.corners[1] * 0xC2B2AE3D27D4EB4Fu ^ f.corners[2] * 0x165667B19E3779F9u;
    h ^= h >> 32;
    h *= 0xD6E8FEB86659FD93u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

/// Finds the vertex that makes the tetrahedron above a face. Here with a locator of the whole model, so that there is
/// only one cavity.
template <class Locator>
class WholeModelFinder {
 public:
  WholeModelFinder(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay, const Locator& locator)
      : facets_(facets), d_(delaunay), locator_(locator) {}

  /// \param cavity  of the tetrahedron below the face; becomes that of the one above it
  std::optional<std::uint32_t> find(const OrientedFace& face, std::uint32_t& /*cavity*/) const {
    return find_apex(locator_, facets_, d_, face);
  }

  std::uint32_t cavity_of_triangle(std::uint32_t /*triangle*/) const { return no_cavity; }
  std::size_t bytes() const { return locator_.bytes(); }

  /// The triangles that the front can meet.
  std::vector<std::uint32_t> triangles() const { return all_indices(facets_.triangles.size()); }

 private:
  const facets::FacetMesh& facets_;
  const delaunay::Delaunay& d_;
  Locator locator_;
};

/// The same, cavity by cavity.
class CavityFinder {
 public:
  /// \param all_faces  may the front hold Delaunay faces, outside of the cavities too?
  CavityFinder(const facets::FacetMesh& facets, const std::vector<std::uint32_t>& codes, bool all_faces,
               const delaunay::Delaunay& delaunay, delaunay::CellStar& star)
      : facets_(facets), d_(delaunay), star_(star), all_faces_(all_faces), locator_(facets, codes, delaunay, star) {}

  std::optional<std::uint32_t> find(const OrientedFace& face, std::uint32_t& cavity) {
    if (all_faces_) {
      const auto& [a, b, c] = face.corners;
      if (const std::uint32_t code = star_.find_face(a, b, c); code != no_neighbor) {
        cavity = locator_.cavity_of_cell(cell_of(code));
        if (cavity == no_cavity && d_.is_ghost(cell_of(code))) return std::nullopt;
        if (cavity == no_cavity) return d_.cells[cell_of(code)].vertices[face_of(code)];
      }
    }
    if (cavity == no_cavity) return std::nullopt;
    return find_apex(locator_.cavity(cavity), facets_, d_, face);
  }

  std::uint32_t cavity_of_triangle(std::uint32_t triangle) const { return locator_.cavity_of_triangle(triangle); }
  std::size_t bytes() const { return locator_.bytes(); }

  std::vector<std::uint32_t> triangles() const {
    return all_faces_ ? all_indices(facets_.triangles.size()) : locator_.triangles();
  }

 private:
  const facets::FacetMesh& facets_;
  const delaunay::Delaunay& d_;
  delaunay::CellStar& star_;
  bool all_faces_;
  locate::CavityLocator locator_;
};

enum Side : std::size_t { above = 0, below = 1 };

/// What is above a side (2 * triangle + Side) of a face of the PLC.
FrontFace state_of(const FrontInput& in, std::size_t side) {
  const plc::Facet& facet = in.plc.facets[in.facets.facet[side / 2]];
  const std::uint32_t code = in.codes[side / 2];
  if (side % 2 == above) return {facet.above, code};
  return {facet.below, code == no_neighbor ? code : in.delaunay.across(code)};
}

/// The sides of the PLC's faces that the domain is on.
std::vector<std::uint8_t> sides_within(const FrontInput& in) {
  std::vector<std::uint8_t> is_within(2 * in.facets.triangles.size());
  for (std::size_t i = 0; i < in.facets.triangles.size(); ++i) {
    const plc::Facet& facet = in.plc.facets[in.facets.facet[i]];
    is_within[2 * i + above] = in.plc.regions[facet.above].inside;
    is_within[2 * i + below] = in.plc.regions[facet.below].inside;
  }
  return is_within;
}

/// The front: sides of PLC faces as bits, because most of them are Delaunay and never looked at again; a table for
/// those that the front may meet and for the faces that it makes.
class Front {
 public:
  Front(const FrontInput& input, bool face_protection, delaunay::CellStar& star)
      : in_(input), face_protection_(face_protection), star_(star), plc_open_(sides_within(input)) {}

  template <class Finder>
  void advance(Finder&& finder, const Progress& progress) {
    add_plc_faces(finder);
    finder_bytes_ = finder.bytes();
    std::uint64_t done = 0;
    while (!undelaunay_.empty() && !result_.stuck) {
      const OrientedFace face = undelaunay_.back();
      undelaunay_.pop_back();
      State state;
      if (!close(faces_.find(face), state)) continue;
      const auto apex = finder.find(face, state.cavity);
      if (!apex) return fail(face, "the front found no vertex that is visible from a face");
      add_tetrahedron(face, *apex, state);
      if ((++done & 0xFFF) == 0) report(progress, "front", done, done + undelaunay_.size());
    }
  }

  /// What is left of the front: faces of the PLC and of its own.
  FrontResult finish() {
    result_.open.reserve(static_cast<std::size_t>(std::ranges::count(plc_open_, 1)) + faces_.size());
    for (std::size_t side = 0; side < plc_open_.size(); ++side)
      if (plc_open_[side]) result_.open.push_back(state_of(in_, side));
    note_bytes(bytes_of(plc_open_, undelaunay_, result_.tetrahedra, result_.regions, result_.open) + faces_.bytes() +
               finder_bytes_);
    faces_.for_each([&](const OrientedFace&, const State& state) {
      if (state.side == no_side) result_.open.push_back(state.face);
    });
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t no_side = 0xFFFFFFFFu;

  struct State {
    FrontFace face;
    std::uint32_t cavity = no_cavity;  // of the tetrahedron below, or of the missing face
    std::uint32_t side = no_side;      // of the PLC, if any: such entries stay when they are closed
  };

  /// Notes that the front is stuck at a face; the first time counts.
  void fail(const OrientedFace& face, const char* what) {
    if (result_.stuck) return;
    Place place;
    place.file = in_.plc.name;
    for (const std::uint32_t v : face.corners)
      place.points.push_back(as_array(in_.plc.grid.to_world(in_.delaunay.point(v))));
    result_.stuck.emplace(what, place,
                          "the facets near these points are almost but not quite flat: try another --flatness");
  }

  template <class Finder>
  void add_plc_faces(const Finder& finder) {
    const std::vector<std::uint32_t> triangles = finder.triangles();
    faces_.reserve(2 * triangles.size());
    for (const std::uint32_t i : triangles) {
      const auto& t = in_.facets.triangles[i];
      const std::uint32_t cavity = finder.cavity_of_triangle(i);
      for (const Side side : {above, below}) {
        const OrientedFace face(t[0], t[side == above ? 1 : 2], t[side == above ? 2 : 1]);
        const auto number = static_cast<std::uint32_t>(2 * i + side);
        faces_.insert(face, {state_of(in_, number), cavity, number});
        if (plc_open_[number] && in_.codes[i] == no_neighbor) undelaunay_.push_back(face);
      }
    }
    result_.undelaunay_faces = undelaunay_.size();
  }

  /// Takes a face from the front, if it is there.
  bool close(State* found, State& state) {
    if (found == nullptr) return false;
    state = *found;
    if (state.side == no_side) {
      faces_.erase(found);
      return true;
    }
    return std::exchange(plc_open_[state.side], false) != 0;
  }

  void add_tetrahedron(const OrientedFace& base, std::uint32_t apex, const State& state) {
    const auto& [a, b, c] = base.corners;
    result_.tetrahedra.push_back({a, b, c, apex});
    result_.regions.push_back(state.face.region);
    // The other faces, with the tetrahedron above them.
    pass({a, c, apex}, state);
    pass({c, b, apex}, state);
    pass({b, a, apex}, state);
  }

  /// Closes a face that waited for this tetrahedron, or opens its other side (paper, section 5.3).
  void pass(const OrientedFace& inner, const State& state) {
    State* waiting = faces_.find(inner);
    if (State closed; close(waiting, closed)) return;
    if (waiting != nullptr) return fail(inner, "the front passed a facet");
    const OrientedFace outer = inner.reversed();
    const std::uint32_t code =
        face_protection_ ? star_.find_face(outer.corners[0], outer.corners[1], outer.corners[2]) : no_neighbor;
    if (!faces_.insert(outer, {{state.face.region, code}, state.cavity, no_side}).second)
      return fail(outer, "two tetrahedra of the front overlap");
    if (code != no_neighbor) return;
    undelaunay_.push_back(outer);
    ++result_.undelaunay_faces;
  }

  const FrontInput& in_;
  const bool face_protection_;
  delaunay::CellStar& star_;
  std::vector<std::uint8_t> plc_open_;  // by 2 * triangle + side
  HashTable<OrientedFace, State, OrientedFaceTraits> faces_;
  std::vector<OrientedFace> undelaunay_;  // a stack, so that the front moves on nearby; some may be closed meanwhile
  FrontResult result_;
  std::size_t finder_bytes_ = 0;
};

/// The front that need not advance: all faces of the PLC.
FrontResult standing_front(const FrontInput& in) {
  FrontResult result;
  result.open.reserve(2 * in.codes.size());
  const std::vector<std::uint8_t> is_within = sides_within(in);
  for (std::size_t side = 0; side < is_within.size(); ++side)
    if (is_within[side]) result.open.push_back(state_of(in, side));
  return result;
}

}  // namespace

std::vector<std::uint32_t> find_delaunay_faces(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(facets.triangles.size(), no_neighbor);
  std::uint32_t vertices = 0;  // ids from here on are of vertices that no face has
  for (const auto& t : facets.triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  const FaceMap faces(facets.triangles, vertices);
  std::uint64_t faces_tested = 0;
  // One pass over the cells, most of which are inside and passed over at once. (The ghosts' faces are theirs too.)
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c) {
    const delaunay::Cell& cell = delaunay.cells[c];
    const auto& v = cell.vertices;
    const unsigned inner = (v[0] >= vertices) + (v[1] >= vertices) + (v[2] >= vertices) + (v[3] >= vertices);
    if (inner > 1 || delaunay.is_dead(c)) continue;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (inner == 1 && v[f] < vertices) continue;
      if (delaunay::face_code(c, f) > cell.neighbors[f]) continue;  // once a face
      const auto [p, q, r] = delaunay::corners_of_face(v, f);
      const std::uint32_t face = faces.find(p, q, r);
      ++faces_tested;
      if (face == FaceMap::none) continue;
      // The cell is above the face if it sees the corners in their order.
      const auto& t = facets.triangles[face];
      const bool is_above = (p == t[0] && q == t[1]) || (q == t[0] && r == t[1]) || (r == t[0] && p == t[1]);
      codes[face] = is_above ? delaunay::face_code(c, f) : cell.neighbors[f];
    }
  }
  work_done.faces_tested += faces_tested;
  work_done.cells_visited += delaunay.cells.size();
  note_bytes(bytes_of(codes, facets.triangles));
  return codes;
}

FrontResult advance_front(const FrontInput& in, const FrontOptions& options, const Progress& progress) {
  const auto& [plc, facets, codes, delaunay] = in;
  if (std::ranges::find(codes, no_neighbor) == codes.end()) return standing_front(in);
  delaunay::CellStar star(delaunay);
  Front front(in, options.face_protection, star);
  switch (options.locator) {
    case locate::LocatorKind::grid:
      front.advance(WholeModelFinder(facets, delaunay,
                                     locate::GridLocator(delaunay.vertices, facets.triangles, options.grid_scale)),
                    progress);
      break;
    case locate::LocatorKind::octree:
      front.advance(WholeModelFinder(facets, delaunay, locate::OctreeLocator(delaunay.vertices, facets.triangles)),
                    progress);
      break;
    case locate::LocatorKind::cavity:
      front.advance(CavityFinder(facets, codes, !options.face_protection, delaunay, star), progress);
      break;
  }
  return front.finish();
}

}  // namespace ccdt::front
