#include "engine/steiner/plan_vertex_removal.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/geometry/predicates.h"
#include "engine/tets/crossing_faces.h"
#include "engine/tets/swaps.h"

namespace ccdt::steiner {

using tets::cell_of, tets::corners_of_face, tets::face_code, tets::has, tets::Triangle;

namespace {

/// How many fans of a page are tried.
constexpr std::size_t most_fans = 5;

/// A face around the vertex, on a facet.
struct FaceAtVertex {
  std::uint32_t face;      ///< its number
  std::uint32_t from, to;  ///< its other corners, in the orientation of the facet
};

/// The faces around the vertex on one facet, from one neighbor to the other.
struct Page {
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> polygon;  ///< without the vertex; the first and the last are the neighbors
  std::uint32_t facet;
  std::vector<Triangle> triangles;  ///< instead of the faces
};

/// The space around the vertex between two pages.
struct Sector {
  int region;
  std::vector<Triangle> hull;  ///< its faces except on pages, the inside above
  struct Side {
    std::uint32_t page;
    bool is_above;  ///< is the sector above the page?
    bool operator==(const Side&) const = default;
  };
  std::vector<Side> pages;
};

/// The pages around a vertex that is to be removed.
class Book {
 public:
  Book(const CellComplex& x, std::uint32_t vertex, const std::array<std::uint32_t, 2>& neighbors,
       RemovalScratch& scratch)
      : x_(x), vertex_(vertex), neighbors_(neighbors), scratch_(scratch) {
    scratch.star.gather_star(x, vertex);
  }

  /// Finds the faces around the vertex on each facet. \return false: if they are not pages of a book along the segment
  bool find_pages() {
    std::vector<FaceAtVertex> faces;
    bool are_all_known = true;
    for (const CellId c : star())
      visit_walls(c, [&](const Triangle&, std::optional<std::uint32_t> face) {
        are_all_known = are_all_known && face;
        if (!are_all_known || std::ranges::find(faces, *face, &FaceAtVertex::face) != faces.end()) return;
        const auto& oriented = x_.faces()[*face];
        const auto place = std::ranges::find(oriented, vertex_) - oriented.begin();
        faces.push_back({*face, oriented[(place + 1) % 3], oriented[(place + 2) % 3]});
      });
    std::size_t used = 0;
    for (std::size_t i = 0; are_all_known && i < faces.size(); ++i) {
      if (!has(neighbors_, faces[i].from)) continue;
      if (!follow_page(faces, i, pages_.emplace_back())) return false;
      used += pages_.back().faces.size();
    }
    return are_all_known && used == faces.size();
  }

  /// Plans to move the vertex onto the neighbor that gives better cells, unless faces would cross.
  bool plan_better_collapse(Change& change) {
    Change& other = scratch_.other;
    bool is_planned = plan_collapse(0, change), is_other_planned = plan_collapse(1, other);
    if (is_other_planned && (!is_planned || worst_of(other.new_cells) > worst_of(change.new_cells))) {
      std::swap(change, other);
      std::swap(is_planned, is_other_planned);
    }
    if (is_planned && !would_cross(x_, change)) return true;
    std::swap(change, other);
    return is_other_planned && !would_cross(x_, change);
  }

  bool plan_fill(Change& change) {
    if (pages_.empty()) return false;  // the edge must be in the mesh, which the filler does not know
    find_sectors();
    return fill_sectors(0, change);
  }

 private:
  const std::vector<CellId>& star() const { return scratch_.star.cells(); }

  /// Calls visit(corners, face) for the walls of a cell at the vertex; face is the wall's number, if it is on a facet.
  template <class Visit>
  void visit_walls(CellId c, const Visit& visit) const {
    const auto& v = x_.cell(c).vertices;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (v[f] == vertex_ || !x_.is_wall(face_code(c, f))) continue;
      const Triangle corners = corners_of_face(v, f);
      visit(corners, x_.find_face(corners[0], corners[1], corners[2]));
    }
  }

  /// Follows the faces of one facet around the vertex, from one neighbor to the other.
  bool follow_page(const std::vector<FaceAtVertex>& faces, std::size_t first, Page& page) const {
    page.polygon = {faces[first].from};
    page.facet = x_.facet_of_face()[faces[first].face];
    for (const FaceAtVertex* face = &faces[first];;) {
      page.faces.push_back(face->face);
      page.polygon.push_back(face->to);
      if (has(neighbors_, face->to)) return page.polygon.size() > 2;
      const auto next = std::ranges::find(faces, face->to, &FaceAtVertex::from);
      if (next == faces.end() || page.faces.size() >= faces.size()) return false;
      face = &*next;
    }
  }

  /// Triangulates the polygon of a page by a fan. \return are all its triangles new and upright?
  bool find_fan(Page& page, std::size_t from) const {
    page.triangles.clear();
    const auto& polygon = page.polygon;
    const std::size_t n = polygon.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Triangle t = {polygon[from], polygon[(from + i) % n], polygon[(from + i + 1) % n]};
      page.triangles.push_back(t);
      if (!is_new_and_upright(x_, t, page.facet) || is_on_hull(t)) return false;
    }
    return true;
  }

  /// In a nearly flat facet, a triangle of the page can be on the hull of the star: then no new cell would have it.
  bool is_on_hull(const Triangle& t) const {
    return std::ranges::any_of(star(), [&](CellId c) {
      const auto& v = x_.cell(c).vertices;
      return std::ranges::all_of(t, [&](std::uint32_t corner) { return has(v, corner); });
    });
  }

  /// Plans everything but the new cells.
  void replace_star(Change& change) const {
    for (const Page& page : pages_) {
      for (std::size_t i = 0; i < page.triangles.size(); ++i)
        change.faces.push_back({page.faces[i], page.triangles[i]});
      change.faces.push_back({page.faces.back(), tets::no_corners});
    }
    change.old_cells = star();
    change.merge = tets::SegmentMerge{vertex_, neighbors_};
  }

  /// Plans to move the vertex onto one of its neighbors, perhaps across other faces.
  bool plan_collapse(std::size_t end, Change& change) {
    change.clear();
    const std::uint32_t to = neighbors_[end];
    const auto is_positive = [&](tets::NewCell& cell) {
      const auto& [a, b, c, d] = cell.vertices;
      if (orient3d(x_.point(a), x_.point(b), x_.point(c), x_.point(d)) <= 0) return false;
      cell.quality = x_.quality_of(cell.vertices);
      return true;
    };
    if (!collapse_star(x_, star(), vertex_, to, is_positive, change.new_cells)) return false;
    for (Page& page : pages_)
      if (!find_fan(page, page.polygon.front() == to ? 0 : page.polygon.size() - 1)) return false;
    replace_star(change);
    return true;
  }

  /// Divides the star by the pages.
  void find_sectors() {
    CellSet& cells = scratch_.sectors;
    cells.clear(x_);
    for (const CellId first : star()) {
      if (cells.contains(first)) continue;
      const std::size_t begin = cells.cells().size();
      cells.add(first);
      cells.grow(
          x_, [&](std::uint32_t code) { return x_.apex_of(code) != vertex_ && !x_.is_wall(code); }, begin);
      Sector& sector = sectors_.emplace_back(Sector{x_.region(first), {}, {}});
      for (const CellId c : std::span(cells.cells()).subspan(begin)) {
        sector.hull.push_back(corners_of_face(x_.cell(c).vertices, x_.place(c, vertex_)));
        visit_walls(
            c, [&](const Triangle& corners, std::optional<std::uint32_t> face) { add_page(corners, *face, sector); });
      }
    }
  }

  /// Adds the page that a wall of the star is on.
  void add_page(const Triangle& corners, std::uint32_t face, Sector& sector) const {
    const auto page = std::ranges::find_if(pages_, [&](const Page& p) { return has(p.faces, face); });
    const auto& oriented = x_.faces()[face];
    const auto place = std::ranges::find(oriented, corners[0]) - oriented.begin();
    const Sector::Side side{static_cast<std::uint32_t>(page - pages_.begin()), oriented[(place + 1) % 3] == corners[1]};
    if (!has(sector.pages, side)) sector.pages.push_back(side);
  }

  /// Tries all fans of this page and of those after it.
  bool fill_sectors(std::size_t page, Change& change) {
    if (page < pages_.size()) {
      // The fans from opposite corners of a quadrilateral are the same.
      const std::size_t n = pages_[page].polygon.size(), fans = n <= 4 ? n - 2 : std::min(n, most_fans);
      for (std::size_t from = 0; from < fans; ++from)
        if (find_fan(pages_[page], from) && fill_sectors(page + 1, change)) return true;
      return false;
    }
    change.clear();
    replace_star(change);
    return !would_cross(x_, change) &&
           std::ranges::all_of(sectors_, [&](const Sector& sector) { return fill_sector(sector, change); });
  }

  /// Fills a sector without the vertex.
  bool fill_sector(const Sector& sector, Change& change) {
    std::vector<Triangle> hull = sector.hull;
    for (const auto& [p, is_above] : sector.pages)
      for (const auto& [a, b, c] : pages_[p].triangles)
        hull.push_back(is_above ? Triangle{a, b, c} : Triangle{b, a, c});
    return scratch_.filler.fill(x_, hull, sector.region, -std::numeric_limits<double>::infinity(), change.new_cells);
  }

  const CellComplex& x_;
  const std::uint32_t vertex_;
  const std::array<std::uint32_t, 2> neighbors_;
  RemovalScratch& scratch_;
  std::vector<Page> pages_;
  std::vector<Sector> sectors_;
};

}  // namespace

bool plan_vertex_removal(const CellComplex& x, std::uint32_t vertex, const std::array<std::uint32_t, 2>& neighbors,
                         RemovalEffort effort, RemovalScratch& scratch, Change& change) {
  Book book(x, vertex, neighbors, scratch);
  if (!book.find_pages()) return false;
  return effort == RemovalEffort::collapse ? book.plan_better_collapse(change) : book.plan_fill(change);
}

}  // namespace ccdt::steiner
