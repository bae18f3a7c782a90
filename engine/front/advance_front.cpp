#include "engine/front/advance_front.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/apex_finders.h"
#include "engine/front/find_swallowed.h"
#include "engine/front/stuck.h"
#include "engine/geometry/predicates.h"
#include "engine/locate/grid_locator.h"
#include "engine/locate/octree_locator.h"

namespace ccdt::front {
namespace {

struct OrientedFaceTraits {
  static OrientedFace none() { return {ghost_vertex, ghost_vertex, ghost_vertex}; }
  static std::size_t hash(const OrientedFace& f) { return HashTraits<FaceKey>::hash(f.corners); }
};

enum Side : std::size_t { above = 0, below = 1 };

constexpr std::size_t grain = 4096;  ///< of loops on several threads

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
  parallel_for(in.facets.triangles.size(), grain, [&](std::size_t i) {
    const plc::Facet& facet = in.plc.facets[in.facets.facet[i]];
    is_within[2 * i + above] = in.plc.regions[facet.above].inside;
    is_within[2 * i + below] = in.plc.regions[facet.below].inside;
  });
  return is_within;
}

/// The front: sides of PLC faces as bits, because most of them are Delaunay and never looked at again; a table for
/// those that the front may meet and for the faces that it makes.
///
/// The vertices near a face nearly always include its apex, but this is not certain. If the tetrahedra fit together,
/// they are right: they are positive, share their faces, end at the facets, contain no other vertices, and their inner
/// faces are locally Delaunay, so they are the constrained Delaunay tetrahedralization (the Delaunay lemma, Shewchuk
/// 2008). Where one does not fit, its apex is searched for among all vertices. Tetrahedra that it still contradicts are
/// taken back, and their apexes are searched for in the same way.
class Front {
 public:
  Front(const FrontInput& input, bool face_protection)
      : in_(input), face_protection_(face_protection), plc_open_(sides_within(input)) {}

  template <class Finder>
  void advance(Finder finder, const Progress& progress) {
    first_search_ = finder.first_search();
    add_plc_faces(finder);
    finder_bytes_ = finder.bytes();
    while (!undelaunay_.empty()) {
      fill_all(finder, progress);
      take_back_swallowing(finder);
    }
  }

  /// The remaining front: faces of the PLC and its own.
  FrontResult finish() {
    result_.open.reserve(static_cast<std::size_t>(std::ranges::count(plc_open_, 1)) + faces_.size());
    for (std::size_t side = 0; side < plc_open_.size(); ++side) {
      if (!plc_open_[side]) continue;
      result_.open.push_back(state_of(in_, side));
      // Both sides of a plate may have the same triangle, but the front knows only one.
      if (result_.open.back().code == no_neighbor)
        fail(face_of_side(side), "a face of the front was not found in the tetrahedralization");
    }
    note_bytes(bytes_of(plc_open_, undelaunay_, result_.tetrahedra, result_.regions, result_.open) + faces_.bytes() +
               owners_.bytes() + doubts_.bytes() + bytes_of(cavities_) + finder_bytes_);
    faces_.for_each([&](const OrientedFace&, const State& state) {
      if (state.side == none) result_.open.push_back(state.face);
    });
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < result_.tetrahedra.size(); ++i) {
      if (result_.tetrahedra[i] == no_tetrahedron) continue;
      result_.tetrahedra[kept] = result_.tetrahedra[i];
      result_.regions[kept++] = result_.regions[i];
    }
    result_.tetrahedra.resize(kept);
    result_.regions.resize(kept);
    return std::move(result_);
  }

 private:
  using Tetrahedron = std::array<std::uint32_t, 4>;

  static constexpr Tetrahedron no_tetrahedron = {ghost_vertex, ghost_vertex, ghost_vertex, ghost_vertex};

  struct State {
    FrontFace face;
    std::uint32_t cavity = none;  // of the tetrahedron below, or of the missing face
    std::uint32_t side = none;    // of the PLC, if any: such entries stay when they are closed
  };

  static OrientedFace base_of(const Tetrahedron& t) { return {t[0], t[1], t[2]}; }
  static std::array<OrientedFace, 4> faces_of(const Tetrahedron& t) {
    return {base_of(t), {t[0], t[2], t[3]}, {t[2], t[1], t[3]}, {t[1], t[0], t[3]}};
  }

  [[noreturn]] void fail(const OrientedFace& face, const char* what) const {
    const auto& [a, b, c] = face.corners;
    throw stuck_near(what, in_.plc, std::array{in_.delaunay.point(a), in_.delaunay.point(b), in_.delaunay.point(c)});
  }

  OrientedFace face_of_side(std::size_t side) const {
    const auto& t = in_.facets.triangles[side / 2];
    return {t[0], t[side % 2 == above ? 1 : 2], t[side % 2 == above ? 2 : 1]};
  }

  template <class Finder>
  void add_plc_faces(const Finder& finder) {
    const std::vector<std::uint32_t> triangles = finder.triangles();
    faces_.reserve(2 * triangles.size());
    for (const std::uint32_t i : triangles) {
      const std::uint32_t cavity = finder.cavity_of_triangle(i);
      for (const Side side : {above, below}) {
        const auto number = static_cast<std::uint32_t>(2 * i + side);
        const OrientedFace face = face_of_side(number);
        faces_.insert(face, {state_of(in_, number), cavity, number});
        if (plc_open_[number] && in_.codes[i] == no_neighbor) undelaunay_.push_back(face);
      }
    }
    result_.undelaunay_faces = undelaunay_.size();
  }

  bool is_open(const State& state) const { return state.side == none || plc_open_[state.side]; }

  /// Takes a face from the front, if it is there.
  bool close(State* found, State& state) {
    if (found == nullptr || !is_open(*found)) return false;
    state = *found;
    if (state.side == none)
      faces_.erase(found);
    else
      plc_open_[state.side] = false;
    return true;
  }

  /// Puts a face into the front, for the first time or again.
  void open(const OrientedFace& face, const State& state) {
    if (state.side == none)
      faces_.insert(face, state);
    else
      plc_open_[state.side] = true;
    if (state.face.code == no_neighbor) undelaunay_.push_back(face);
  }

  template <class Finder>
  void fill_all(Finder& finder, const Progress& progress) {
    std::uint64_t done = 0;
    while (!undelaunay_.empty()) {
      const OrientedFace face = undelaunay_.back();
      undelaunay_.pop_back();
      State state;
      if (close(faces_.find(face), state)) fill(finder, face, state);
      if ((++done & 0xFFF) == 0) report(progress, "front", done, done + undelaunay_.size());
    }
  }

  /// Removes the tetrahedra that contain a vertex that the searches missed.
  template <class Finder>
  void take_back_swallowing(Finder& finder) {
    contradicted_ = find_swallowing(result_.tetrahedra, in_.facets, in_.delaunay);
    if (contradicted_.empty() || take_back_contradicted(finder)) return;
    fail(base_of(result_.tetrahedra[contradicted_.front()]), "a tetrahedron of the front contains a vertex");
  }

  /// Makes the tetrahedron above a face taken from the front, or removes what conflicts with it.
  template <class Finder>
  void fill(Finder& finder, const OrientedFace& face, State state) {
    const Search first = doubts_.contains(face) ? Search::full : first_search_;
    auto apex = finder.find(face, state.face.region, first, state.cavity);
    const char* problem = problem_of(face, apex, state);
    if (problem != nullptr && first == Search::near) {
      doubts_.insert(face);
      apex = finder.find(face, state.face.region, Search::full, state.cavity);
      problem = problem_of(face, apex, state);
    }
    if (problem == nullptr) return add_tetrahedron(face, *apex, state);
    // The face is right if everything that it rests on is right. Then its apex is right too, and whatever contradicts
    // that is wrong or rests on something wrong.
    open(face, state);
    if (state.side == none) contradict(face.reversed());
    if (!take_back_contradicted(finder)) fail(face, problem);
  }

  /// Removes the uncertain tetrahedra that the contradicted ones rest on.
  /// \return  false if all are certain
  template <class Finder>
  bool take_back_contradicted(Finder& finder) {
    std::vector<OrientedFace> unsure;
    for (const std::uint32_t tetrahedron : contradicted_)
      if (const auto base = first_unsure_base(finder, tetrahedron)) unsure.push_back(*base);
    for (const OrientedFace& base : unsure) take_back(base);
    return !unsure.empty();
  }

  /// Notes the tetrahedron above a face, if there is one.
  void contradict(const OrientedFace& face) {
    if (const std::uint32_t* const owner = owners_.find(face); owner != nullptr) contradicted_.push_back(*owner);
  }

  bool is_of_plc(const OrientedFace& face) const {
    const State* const state = faces_.find(face);
    return state != nullptr && state->side != none;
  }

  /// The base of the tetrahedron, or of the nearest one below it, for which not all vertices were tried. None if only
  /// certain tetrahedra are between it and the PLC.
  template <class Finder>
  std::optional<OrientedFace> first_unsure_base(Finder& finder, std::uint32_t tetrahedron) {
    for (;;) {
      const OrientedFace base = base_of(result_.tetrahedra[tetrahedron]);
      if (first_search_ == Search::near && doubts_.insert(base, {}).second && !is_confirmed(finder, tetrahedron))
        return base;
      if (is_of_plc(base)) return std::nullopt;
      tetrahedron = *owners_.find(base.reversed());
    }
  }

  /// Does a search among all vertices give the same tetrahedron again? Tried only after much was taken back. Usually it
  /// is cheaper to take back a right tetrahedron than to check it by a search. But where thousands rest on it, they
  /// would be made again and again.
  template <class Finder>
  bool is_confirmed(Finder& finder, std::uint32_t tetrahedron) {
    const Tetrahedron& t = result_.tetrahedra[tetrahedron];
    std::uint32_t cavity = cavities_[tetrahedron];
    return 2 * taken_back_ > result_.tetrahedra.size() &&
           finder.find(base_of(t), result_.regions[tetrahedron], Search::full, cavity) == t[3];
  }

  /// Why the face and the apex do not make a constrained Delaunay tetrahedron that fits those around it; `nullptr` if
  /// they do. Notes the contradicted ones.
  const char* problem_of(const OrientedFace& base, std::optional<std::uint32_t> apex, const State& state) {
    contradicted_.clear();
    if (!apex) return "the front found no vertex that is visible from a face";
    const auto& [a, b, c] = base.corners;
    const Tetrahedron t = {a, b, c, *apex};
    const char* problem = nullptr;
    for (const OrientedFace& face : faces_of(t)) {
      const State* other = faces_.find(face);
      const bool is_of_plc = face == base ? state.side != none : other != nullptr && other->side != none;
      if (owners_.contains(face)) {
        problem = "two tetrahedra of the front overlap";
        contradict(face);
      } else if (is_of_plc && face != base && !is_open(*other)) {
        problem = "the front passed a facet";
      } else if (!is_of_plc && is_neighbor_in_sphere(t, face)) {
        problem = "a tetrahedron of the front is not constrained Delaunay";
        contradict(face.reversed());
      }
    }
    return problem;
  }

  /// Is the fourth vertex of the tetrahedron below a face of t in the sphere of t?
  bool is_neighbor_in_sphere(const Tetrahedron& t, const OrientedFace& face) const {
    const std::uint32_t* below = owners_.find(face.reversed());
    if (below == nullptr) return false;
    const Tetrahedron& its = result_.tetrahedra[*below];
    const std::uint32_t fourth = *std::ranges::find_if(
        its, [&](std::uint32_t v) { return std::ranges::find(face.corners, v) == face.corners.end(); });
    const auto& vertices = in_.delaunay.vertices;
    const std::array v = {vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]], vertices[fourth]};
    return insphere_perturbed(v[0].point, v[1].point, v[2].point, v[3].point, v[4].point,
                              {v[0].rank, v[1].rank, v[2].rank, v[3].rank, v[4].rank}) >= 0;
  }

  void add_tetrahedron(const OrientedFace& base, std::uint32_t apex, const State& state) {
    const auto& [a, b, c] = base.corners;
    const Tetrahedron t = {a, b, c, apex};
    const auto number = static_cast<std::uint32_t>(result_.tetrahedra.size());
    result_.tetrahedra.push_back(t);
    result_.regions.push_back(state.face.region);
    cavities_.push_back(state.cavity);
    for (const OrientedFace& face : faces_of(t)) {
      owners_.insert(face, number);
      if (!(face == base)) pass(face, state);
    }
  }

  /// Closes a face that waited for a tetrahedron, or opens its other side (paper, section 5.3).
  void pass(const OrientedFace& inner, const State& state) {
    if (State closed; close(faces_.find(inner), closed)) return;
    const OrientedFace outer = inner.reversed();
    const FrontFace face = {state.face.region, code_of(outer)};
    open(outer, {face, state.cavity, none});
    if (face.code == no_neighbor) ++result_.undelaunay_faces;
  }

  std::uint32_t code_of(const OrientedFace& face) {
    const auto& [a, b, c] = face.corners;
    return face_protection_ ? delaunay::find_face(in_.delaunay, a, b, c) : no_neighbor;
  }

  /// Removes the tetrahedron above a base, if it still exists, and all that rest on it.
  void take_back(const OrientedFace& base) {
    std::vector<OrientedFace> bases = {base};
    while (!bases.empty()) {
      const std::uint32_t* const owner = owners_.find(bases.back());
      bases.pop_back();
      if (owner != nullptr) take_back_alone(*owner, bases);
    }
  }

  /// \param bases  gains the bases of those that rest on it
  void take_back_alone(std::uint32_t number, std::vector<OrientedFace>& bases) {
    const Tetrahedron t = std::exchange(result_.tetrahedra[number], no_tetrahedron);
    ++taken_back_;
    for (const OrientedFace& face : faces_of(t)) {
      owners_.erase(owners_.find(face));
      const OrientedFace outer = face.reversed();
      if (State* const own = faces_.find(face); own != nullptr) {  // of the PLC
        open(face, *own);
      } else if (State* const waiting = faces_.find(outer); waiting != nullptr) {
        if (waiting->face.code == no_neighbor) --result_.undelaunay_faces;
        faces_.erase(waiting);
      } else {
        const std::uint32_t below = *owners_.find(outer);
        open(face, {{result_.regions[number], code_of(face)}, cavities_[below], none});
        if (base_of(result_.tetrahedra[below]) == outer) bases.push_back(outer);
      }
    }
  }

  const FrontInput& in_;
  const bool face_protection_;
  Search first_search_ = Search::full;
  std::vector<std::uint8_t> plc_open_;  // by 2 * triangle + side
  HashTable<OrientedFace, State, OrientedFaceTraits> faces_;
  HashTable<OrientedFace, std::uint32_t, OrientedFaceTraits> owners_;  // the tetrahedra above faces
  std::vector<OrientedFace> undelaunay_;  // a stack, so that the front continues nearby; some may be closed already
  HashSet<OrientedFace, OrientedFaceTraits> doubts_;  // faces above which all vertices are tried
  std::vector<std::uint32_t> cavities_;               // of the tetrahedra
  std::vector<std::uint32_t> contradicted_;
  std::uint64_t taken_back_ = 0;  // tetrahedra
  FrontResult result_;
  std::size_t finder_bytes_ = 0;
};

/// The front when no face is missing: all faces of the PLC.
FrontResult standing_front(const FrontInput& in) {
  FrontResult result;
  const std::vector<std::uint8_t> is_within = sides_within(in);
  result.open = parallel_collect<FrontFace>(is_within.size(), grain,
                                            [&](std::size_t side, std::size_t end, std::vector<FrontFace>& open) {
                                              for (; side < end; ++side) {
                                                in.delaunay.prefetch_after(side / 2, in.codes);
                                                if (is_within[side]) open.push_back(state_of(in, side));
                                              }
                                            });
  return result;
}

}  // namespace

FrontResult advance_front(const FrontInput& in, const FrontOptions& options, const Progress& progress) {
  const auto& [plc, facets, codes, delaunay] = in;
  if (std::ranges::find(codes, no_neighbor) == codes.end()) return standing_front(in);
  Front front(in, options.face_protection);
  switch (options.locator) {
    case locate::LocatorKind::grid:
      front.advance(WholeModelFinder(facets, delaunay, options.visibility,
                                     locate::GridLocator(delaunay.vertices, facets.triangles, options.grid_scale)),
                    progress);
      break;
    case locate::LocatorKind::octree:
      front.advance(WholeModelFinder(facets, delaunay, options.visibility,
                                     locate::OctreeLocator(delaunay.vertices, facets.triangles)),
                    progress);
      break;
    case locate::LocatorKind::cavity: {
      NearVertices near(facets, codes, delaunay);
      front.advance(CavityFinder(in, options, near), progress);
      break;
    }
  }
  return front.finish();
}

}  // namespace ccdt::front
