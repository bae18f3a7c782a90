#include "engine/locate/cavity_locator.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/index_lists.h"
#include "engine/base/platform.h"
#include "engine/base/union_find.h"
#include "engine/geometry/predicates.h"

namespace ccdt::locate {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using CellVertices = std::array<std::uint32_t, 4>;

/// The exact test of whether a triangle and a cell, both closed, intersect; vertices are given by id.
class TriangleCellTest {
 public:
  /// \param sides  by corner of the cell: the side of the triangle's plane that it is on
  TriangleCellTest(const delaunay::Delaunay& d, const Triangle& t, const CellVertices& cell,
                   const std::array<int, 4>& sides)
      : d_(d), t_(t), cell_(cell), sides_(sides) {
    for (std::size_t i = 0; i < 4; ++i)
      for (unsigned k = 0; k < 3; ++k) shared_[i] |= unsigned{cell[i] == t[k]} << k;
  }

  /// Do the cell and the inside of the triangle meet? Exact, unless they meet only in a corner of the cell: the inside
  /// of a face of the mesh has no vertices.
  bool intersect() const {
    const auto above = std::ranges::count(sides_, 1), below = std::ranges::count(sides_, -1);
    if ((above == 0 || below == 0) && above + below > 2) return false;
    for (unsigned k = 0; k < 3; ++k)
      if (section_is_outside_edge(k, above > 0 ? 1 : -1)) return false;
    return !is_outside_a_face();
  }

 private:
  const Point3& point(std::uint32_t v) const { return d_.point(v); }

  /// Is the section of the cell with the triangle's plane on the outer side of edge k of the triangle, or partly on its
  /// line?
  ///
  /// \param from  the side of some corners. If no corners are above, those below give the corners of the section.
  bool section_is_outside_edge(unsigned k, int from) const {
    const unsigned next = k < 2 ? k + 1 : 0, ends = 1U << k | 1U << next;
    // The cell's edge from i to j on the other side, or the section's corner j, passes the line of edge k on the
    // triangle's side.
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (sides_[i] == from && sides_[j] != from && ((shared_[i] | shared_[j]) & ends) == 0 &&
            orient3d(point(t_[k]), point(t_[next]), point(cell_[j]), point(cell_[i])) == from)
          return false;
    return true;
  }

  /// Is the triangle on the outer side of a face of the cell, or partly in the face's plane?
  bool is_outside_a_face() const {
    return std::ranges::any_of(delaunay::face_corners, [&](const auto& f) {
      const unsigned on_face = shared_[f[0]] | shared_[f[1]] | shared_[f[2]];
      bool is_outside = false;
      for (unsigned k = 0; k < 3; ++k) {
        if ((on_face >> k & 1) != 0) continue;
        const int side = orient3d(point(cell_[f[0]]), point(cell_[f[1]]), point(cell_[f[2]]), point(t_[k]));
        if (side > 0) return false;
        is_outside |= side < 0;
      }
      return is_outside;
    });
  }

  const delaunay::Delaunay& d_;
  const Triangle& t_;
  const CellVertices& cell_;
  const std::array<int, 4>& sides_;
  std::array<unsigned, 4> shared_{};  // by corner of the cell: a bit for the corner of the triangle that it equals
};

/// Finds the finite cells that meet the inside of some missing face: cells that the face cuts, and cells that touch it
/// with an edge or a face within its plane. The cells of a face are connected, so each face has one part.
class PiercedCellSearch {
 public:
  /// \param missing   numbers of triangles of `facets` that are not Delaunay faces
  /// \param at_edges  of their first edges: the results of `find_edge`
  PiercedCellSearch(const facets::FacetMesh& facets, std::span<const std::uint32_t> missing,
                    std::span<const std::uint32_t> at_edges, const delaunay::Delaunay& d)
      : facets_(facets),
        missing_(missing),
        at_edges_(at_edges),
        d_(d),
        star_(d),
        sides_(d.vertices.size(), {none, 0}),
        parts_(missing.size()) {}

  PiercedCells find() {
    for (std::uint32_t i = 0; i < missing_.size(); ++i) flood(i);
    for (const auto& [cell, owner] : owned_)
      for (const std::uint32_t code : d_.cells[cell].neighbors)
        if (const Visit* next = visits_.find(delaunay::cell_of(code)); next != nullptr && next->owner != none)
          parts_.join(owner, next->owner);
    return number_parts();
  }

 private:
  struct Visit {
    std::uint32_t last = none;   ///< the last missing face that visited the cell
    std::uint32_t owner = none;  ///< the first one that met the cell
  };

  /// Finds the cells that missing face i meets, starting from the first such cell around an edge or, failing that,
  /// around a corner.
  void flood(std::uint32_t i) {
    const auto& [a, b, c] = facets_.triangles[missing_[i]];
    const Triangle t = {a, b, c};
    stack_.clear();
    const auto is_first = [&](std::uint32_t cell) {
      visit_cell(cell, i, t);
      return !stack_.empty();
    };
    if (at_edges_[i] != delaunay::no_neighbor)
      delaunay::walk_around_edge(d_, a, b, at_edges_[i],
                                 [&](std::uint32_t cell, std::uint32_t, std::uint32_t) { return !is_first(cell); });
    else
      std::ranges::find_if(star_.around(a), is_first);
    while (!stack_.empty()) {
      const std::uint32_t cell = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t code : d_.cells[cell].neighbors) visit_cell(delaunay::cell_of(code), i, t);
    }
  }

  void visit_cell(std::uint32_t cell, std::uint32_t i, const Triangle& t) {
    if (d_.is_ghost(cell)) return;
    Visit& visit = *visits_.insert(cell, {}).first;
    if (visit.last == i) return;
    visit.last = i;
    ++work_done.piercing_tests;
    const CellVertices& vertices = d_.cells[cell].vertices;
    std::array<int, 4> sides;
    for (std::size_t k = 0; k < 4; ++k) sides[k] = side(vertices[k], i, t);
    if (!TriangleCellTest(d_, t, vertices, sides).intersect()) return;
    if (visit.owner == none) {
      visit.owner = i;
      owned_.emplace_back(cell, i);
    }
    parts_.join(visit.owner, i);
    stack_.push_back(cell);
    for (const std::uint32_t code : d_.cells[cell].neighbors) prefetch(&d_.cells[delaunay::cell_of(code)]);
  }

  /// The side of the plane of missing face i that a vertex is on.
  int side(std::uint32_t v, std::uint32_t i, const Triangle& t) {
    auto& [face, side] = sides_[v];
    if (face == i) return side;
    face = i;
    const bool is_corner = v == t[0] || v == t[1] || v == t[2];
    side = is_corner ? 0 : orient3d(d_.point(t[0]), d_.point(t[1]), d_.point(t[2]), d_.point(v));
    return side;
  }

  PiercedCells number_parts() {
    PiercedCells result;
    std::vector<std::uint32_t> number(missing_.size(), none);
    for (std::uint32_t i = 0; i < missing_.size(); ++i) {
      std::uint32_t& part = number[parts_.find(i)];
      if (part == none) {
        part = static_cast<std::uint32_t>(result.cells.size());
        result.cells.emplace_back();
      }
      result.part_of_face.push_back(part);
    }
    result.part_of.reserve(owned_.size());
    for (const auto& [cell, owner] : owned_) {
      const std::uint32_t part = result.part_of_face[owner];
      result.cells[part].push_back(cell);
      result.part_of.insert(cell, part);
    }
    return result;
  }

  const facets::FacetMesh& facets_;
  std::span<const std::uint32_t> missing_, at_edges_;
  const delaunay::Delaunay& d_;
  delaunay::CellStar star_;
  HashTable<std::uint32_t, Visit> visits_;
  std::vector<std::pair<std::uint32_t, int>> sides_;            // of vertices, seen from the last missing face
  std::vector<std::pair<std::uint32_t, std::uint32_t>> owned_;  // cells and their owners
  UnionFind parts_;                                             // of missing faces
  std::vector<std::uint32_t> stack_;
};

std::vector<std::uint32_t> vertices_of(const delaunay::Delaunay& d, const std::vector<std::uint32_t>& cells) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(4 * cells.size());
  for (const std::uint32_t cell : cells)
    vertices.insert(vertices.end(), d.cells[cell].vertices.begin(), d.cells[cell].vertices.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

template <class Condition>
std::vector<std::uint32_t> only(const std::vector<std::uint32_t>& all, const Condition& condition) {
  std::vector<std::uint32_t> some;
  std::ranges::copy_if(all, std::back_inserter(some), condition);
  return some;
}

/// The regions of the domain at each face and at each vertex on a facet.
class RegionsOfDomain {
 public:
  RegionsOfDomain(const plc::Plc& plc, const facets::FacetMesh& facets, std::size_t vertex_count)
      : plc_(plc), facets_(facets) {
    if (std::ranges::count(plc.regions, true, &plc::Region::inside) < 2) return;
    of_vertex_ = make_index_lists(vertex_count, [&](const auto& emit) {
      for (std::uint32_t f = 0; f < facets.triangles.size(); ++f)
        for (const VertexId v : facets.triangles[f])
          for (const RegionId region : of_face(f)) emit(v, region);
    });
  }

  std::array<RegionId, 2> of_face(std::uint32_t face) const {
    const plc::Facet& facet = plc_.facets[facets_.facet[face]];
    return {facet.above, facet.below};
  }

  /// The regions on either side of some of the faces.
  std::vector<RegionId> at(std::span<const std::uint32_t> faces) const {
    std::vector<RegionId> regions;
    for (const std::uint32_t face : faces)
      for (const RegionId region : of_face(face))
        if (plc_.regions[region].inside && std::ranges::find(regions, region) == regions.end())
          regions.push_back(region);
    return regions;
  }

  bool is_at_face(RegionId region, std::uint32_t face) const { return std::ranges::count(of_face(face), region) > 0; }
  /// A vertex on no facet may be in any region.
  bool may_be_at_vertex(RegionId region, std::uint32_t vertex) const {
    const auto regions = of_vertex_.of(vertex);
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }

 private:
  const plc::Plc& plc_;
  const facets::FacetMesh& facets_;
  IndexLists of_vertex_;  // none if there is only one region
};

}  // namespace

CavityLocator::CavityLocator(const plc::Plc& plc, const facets::FacetMesh& facets, std::span<const std::uint32_t> codes,
                             const delaunay::Delaunay& delaunay) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // Delaunay faces that have no code yet
  std::vector<std::uint32_t> at_edges;                         // cells at the first edges of missing faces
  for (std::uint32_t i = 0; i < codes.size(); ++i) {
    if (codes[i] != delaunay::no_neighbor) continue;
    const auto& [a, b, c] = facets.triangles[i];
    const std::uint32_t at_edge = delaunay::find_edge(delaunay, a, b);
    const std::uint32_t code = delaunay::find_face(delaunay, a, b, c, at_edge);
    if (code == delaunay::no_neighbor)
      missing_.push_back(i), at_edges.push_back(at_edge);
    else
      found.emplace_back(i, code);
  }
  pierced_ = PiercedCellSearch(facets, missing_, at_edges, delaunay).find();

  std::vector<std::vector<std::uint32_t>> faces(pierced_.cells.size());
  for (std::size_t i = 0; i < missing_.size(); ++i) faces[pierced_.part_of_face[i]].push_back(missing_[i]);
  triangles_ = missing_;
  const auto add_delaunay_face = [&](std::uint32_t triangle, std::uint32_t code) {
    const std::uint32_t above = cavity_of_cell(delaunay::cell_of(code)),
                        below = cavity_of_cell(delaunay::cell_of(delaunay.across(code)));
    if (above != none) faces[above].push_back(triangle);
    if (below != none && below != above) faces[below].push_back(triangle);
    if (above != none || below != none) triangles_.push_back(triangle);
  };
  if (!missing_.empty()) {
    for (std::uint32_t i = 0; i < codes.size(); ++i) {
      delaunay.prefetch_after(i, codes);
      if (codes[i] != delaunay::no_neighbor) add_delaunay_face(i, codes[i]);
    }
    for (const auto& [triangle, code] : found) add_delaunay_face(triangle, code);
  }
  const RegionsOfDomain regions(plc, facets, delaunay.vertices.size());
  cavities_.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::vector<std::uint32_t> vertices = vertices_of(delaunay, pierced_.cells[i]);
    const std::vector<RegionId> here = regions.at(faces[i]);
    const auto add_chamber = [&](RegionId region, const auto& its_vertices, const auto& its_faces) {
      cavities_[i].push_back(
          {region, OctreeLocator(delaunay.vertices, its_vertices, facets.triangles, facets.facet, its_faces)});
    };
    // Usually there is only one region, and everything is in it.
    if (here.size() == 1) add_chamber(here[0], vertices, faces[i]);
    if (here.size() < 2) continue;
    for (const RegionId region : here)
      add_chamber(region, only(vertices, [&](std::uint32_t v) { return regions.may_be_at_vertex(region, v); }),
                  only(faces[i], [&](std::uint32_t f) { return regions.is_at_face(region, f); }));
  }
}

const OctreeLocator* CavityLocator::chamber(std::uint32_t cavity, RegionId region) const {
  const auto found = std::ranges::find(cavities_[cavity], region, &Chamber::region);
  return found == cavities_[cavity].end() ? nullptr : &found->locator;
}

std::uint32_t CavityLocator::cavity_of_cell(std::uint32_t cell) const {
  const std::uint32_t* part = pierced_.part_of.find(cell);
  return part == nullptr ? none : *part;
}

std::uint32_t CavityLocator::cavity_of_triangle(std::uint32_t triangle) const {
  const auto found = std::lower_bound(missing_.begin(), missing_.end(), triangle);
  return found == missing_.end() || *found != triangle ? none : pierced_.part_of_face[found - missing_.begin()];
}

}  // namespace ccdt::locate
