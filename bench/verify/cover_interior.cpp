#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "bench/verify/covers.h"
#include "bench/verify/exact.h"

namespace ccdt::verification {

namespace {

using Face = std::array<std::uint32_t, 3>;

/// Spreads a sheet of inner faces of the mesh over a patch, from the links around it inwards.
///
/// A facet that is flat only within the tolerance may carry flat tetrahedra, so that more than one sheet spans it. The
/// sheet taken is the topmost: its faces have tetrahedra above that are not flat, wherever the links are edges of that
/// sheet.
class Sheet {
 public:
  Sheet(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Patches& patches,
        std::uint32_t patch)
      : mesh_(mesh),
        topology_(topology),
        normal_(patches.normal[patch]),
        centre_(patches.centre[patch]),
        flat_(surface.tolerances.flat),
        greatest_area_(1.001 * patches.area[patch] + surface.tolerances.flat * patches.perimeter[patch]) {
    for (const auto& [a, b] : patches.links_of(patch)) {
      walls_.insert(key(a, b));
      open_.push_back({a, b});
    }
  }

  std::vector<Face> faces;           ///< seen from above
  std::vector<std::uint32_t> above;  ///< the tetrahedron above each face

  /// \return whether the sheet spans the patch
  bool spread() {
    while (!open_.empty()) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      if (done_.count(key(a, b)) > 0) continue;
      if (!add_face(a, b)) return false;
    }
    return true;
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32) | b; }

  const Point3& at(std::uint32_t v) const { return mesh_.vertices[v]; }

  bool in_plane(std::uint32_t v) const { return std::fabs(dot(normal_, at(v) - centre_)) <= flat_; }

  double area_above(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return 0.5 * dot(normal_, cross(at(b) - at(a), at(c) - at(a)));
  }

  bool is_inner(const Face& face) const {
    const std::uint32_t f = find_face(topology_, face);
    return f != none && !topology_.on_boundary(f);
  }

  /// Adds the topmost face to the left of a directed edge.
  bool add_face(std::uint32_t a, std::uint32_t b) {
    std::uint32_t best = none, best_tet = none;
    bool best_is_topmost = false;
    double best_area = -flat_ * std::sqrt(squared_length(at(b) - at(a)));
    for (std::uint32_t i = topology_.star_begin[a]; i < topology_.star_begin[a + 1]; ++i) {
      const std::uint32_t t = topology_.star[i];
      const auto& tet = mesh_.tetrahedra[t];
      if (std::find(tet.begin(), tet.end(), b) == tet.end()) continue;
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t apex = tet[corner];
        if (apex == a || apex == b) continue;
        const auto [u, v, w] = outward(mesh_, 4 * t + corner);
        const std::uint32_t third = u != a && u != b ? u : v != a && v != b ? v : w;
        // Seen from within the tetrahedron, which is to be above, the face runs the other way round than outward.
        const bool runs = (u == b && v == a) || (v == b && w == a) || (w == b && u == a);
        if (!runs || !in_plane(third) || !is_inner({a, b, third})) continue;
        const bool topmost = !in_plane(apex);
        const double area = area_above(a, b, third);
        if (topmost < best_is_topmost || (topmost == best_is_topmost && area <= best_area)) continue;
        if (area < -flat_ * std::sqrt(squared_length(at(b) - at(a)))) continue;
        best = third;
        best_tet = t;
        best_area = area;
        best_is_topmost = topmost;
      }
    }
    if (best == none) return false;
    faces.push_back({a, b, best});
    above.push_back(best_tet);
    area_ += best_area;
    return area_ <= greatest_area_ && close(a, b) && close(b, best) && close(best, a);
  }

  /// An edge of a new face: a link, or to be shared with the next face.
  bool close(std::uint32_t a, std::uint32_t b) {
    if (!done_.insert(key(a, b)).second) return false;
    if (walls_.count(key(a, b)) == 0 && done_.count(key(b, a)) == 0) open_.push_back({b, a});
    return true;
  }

  const TetMesh& mesh_;
  const Topology& topology_;
  Point3 normal_, centre_;
  double flat_, greatest_area_, area_ = 0;
  std::unordered_set<std::uint64_t> walls_, done_;
  std::vector<std::array<std::uint32_t, 2>> open_;
};

class InteriorCover {
 public:
  InteriorCover(const TetMesh& mesh, const Topology& topology, const Surface& surface, Covers& covers)
      : mesh_(mesh), topology_(topology), surface_(surface), covers_(covers) {}

  /// Covers what is left of the pieces patch by patch.
  void cover(const Patches& patches) {
    for (std::uint32_t n = 0; n < patches.count(); ++n) {
      const auto pieces = patches.pieces_of(n);
      const auto is_left = [&](std::uint32_t p) { return covers_.found[p] == Found::nothing; };
      if (!std::all_of(pieces.begin(), pieces.end(), is_left)) continue;
      const bool is_flat = patches.thickness[n] <= surface_.tolerances.flat;
      if (is_flat) covers_.planes.push_back({patches.normal[n], patches.centre[n]});
      if (cover_piece_by_piece(pieces, is_flat) || patches.open[n] || !is_flat) continue;
      cover_by_sheet(patches, n);
    }
  }

 private:
  std::uint32_t last_plane() const { return static_cast<std::uint32_t>(covers_.planes.size() - 1); }

  /// Each piece is a face of the mesh as it is.
  /// \param is_flat  the pieces lie in the last of the planes
  bool cover_piece_by_piece(std::span<const std::uint32_t> pieces, bool is_flat) {
    std::vector<CoverFace> faces;
    for (const std::uint32_t p : pieces) {
      if (!surface_.is_triangle(p)) return false;
      const std::uint32_t begin = surface_.piece_begin[p];
      const Face corners = {surface_.directed[begin][0], surface_.directed[begin + 1][0],
                            surface_.directed[begin + 2][0]};
      const std::uint32_t f = find_face(topology_, corners);
      if (f == none || topology_.on_boundary(f)) return false;
      const auto out = outward(mesh_, topology_.half_faces[f][0]);
      const bool first_is_below = std::find(out.begin(), out.end(), corners[0]) - out.begin() ==
                                  (std::find(out.begin(), out.end(), corners[1]) - out.begin() + 2) % 3;
      const std::uint32_t first = topology_.half_faces[f][0] / 4, second = topology_.half_faces[f][1] / 4;
      faces.push_back(
          {f, p, first_is_below ? second : first, first_is_below ? first : second, is_flat ? last_plane() : none});
    }
    add(pieces, faces);
    return true;
  }

  void cover_by_sheet(const Patches& patches, std::uint32_t n) {
    Sheet sheet(mesh_, topology_, surface_, patches, n);
    const std::uint32_t piece = patches.pieces_of(n)[0];
    if (!sheet.spread()) {
      covers_.problem[piece] = "no sheet of faces spans it";
      return;
    }
    const std::string problem = compare_with_patch(mesh_, surface_, patches, n, sheet.faces);
    if (!problem.empty()) {
      covers_.problem[piece] = problem;
      return;
    }
    std::vector<CoverFace> faces;
    for (std::size_t i = 0; i < sheet.faces.size(); ++i) {
      const std::uint32_t f = find_face(topology_, sheet.faces[i]);
      const auto& halves = topology_.half_faces[f];
      std::uint32_t above = sheet.above[i], below = halves[0] / 4 == above ? halves[1] / 4 : halves[0] / 4;
      if (patches.flipped[piece]) std::swap(above, below);
      faces.push_back({f, piece, above, below, last_plane()});
    }
    add(patches.pieces_of(n), faces);
  }

  void add(std::span<const std::uint32_t> pieces, const std::vector<CoverFace>& faces) {
    for (const std::uint32_t p : pieces) covers_.found[p] = Found::interior;
    covers_.faces.insert(covers_.faces.end(), faces.begin(), faces.end());
  }

  const TetMesh& mesh_;
  const Topology& topology_;
  const Surface& surface_;
  Covers& covers_;
};

}  // namespace

void cover_interior(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                    const std::vector<bool>& features, Covers& covers) {
  if (std::find(covers.found.begin(), covers.found.end(), Found::nothing) == covers.found.end()) return;
  InteriorCover interior(mesh, topology, surface, covers);
  // Whole facets first, since the sheets of a facet need not agree about its inner edges; then as small as the mesh's
  // edges allow, for facets that are bent a little.
  std::vector<bool> joined(surface.edges.size());
  for (const bool whole : {true, false}) {
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
      const auto left = [&](std::uint32_t i) {
        return covers.found[surface.piece_of[surface.uses[surface.use_begin[e] + i]]] == Found::nothing;
      };
      joined[e] = surface.use_count(e) == 2 && left(0) && left(1) && (chains.missing(e) || (whole && !features[e]));
    }
    interior.cover(group_pieces(surface, chains, joined));
  }
}

}  // namespace ccdt::verification
