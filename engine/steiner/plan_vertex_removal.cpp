#include "engine/steiner/plan_vertex_removal.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/numbers/predicates.h"
#include "engine/tets/crossing_faces.h"
#include "engine/tets/swaps.h"
#include "engine/tets/vertex_star.h"

namespace ccdt::steiner {

using tets::Cell, tets::SegmentMerge, tets::cell_of, tets::corners_of_face, tets::face_code, tets::no_corners;
namespace {

/// How many fans of a page are tried.
constexpr std::size_t most_fans = 5;

template <class List>
bool has(const List& list, std::uint32_t value) {
  return std::ranges::find(list, value) != list.end();
}

}  // namespace

bool VertexRemoval::plan(std::uint32_t vertex, const std::array<std::uint32_t, 2>& neighbors, RemovalEffort effort,
                         Change& change) {
  vertex_ = vertex;
  neighbors_ = neighbors;
  gather_cells(x_, vertex, marks_, star_);
  if (!find_pages()) return false;
  if (effort != RemovalEffort::collapse) return plan_fill(change);
  return plan_better_collapse(change);
}

/// Plans to move the vertex onto that of its neighbors which leaves better cells, unless faces would cross.
bool VertexRemoval::plan_better_collapse(Change& change) {
  bool is_planned = plan_collapse(0, change), is_other_planned = plan_collapse(1, other_);
  if (is_other_planned && (!is_planned || worst_of(other_.new_cells) > worst_of(change.new_cells))) {
    std::swap(change, other_);
    std::swap(is_planned, is_other_planned);
  }
  if (is_planned && !would_cross(x_, change)) return true;
  std::swap(change, other_);
  return is_other_planned && !would_cross(x_, change);
}

/// Finds the faces around the vertex on each facet. \return false: they are no pages of a book along the segment
bool VertexRemoval::find_pages() {
  faces_.clear();
  for (const std::uint32_t c : star_) {
    const auto& v = x_.cell(c).vertices;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (v[f] == vertex_ || !x_.is_wall(face_code(c, f))) continue;
      const auto corners = corners_of_face(v, f);
      const auto face = x_.find_face(corners[0], corners[1], corners[2]);
      if (!face) return false;
      const auto& oriented = x_.faces()[*face];
      const auto place = std::ranges::find(oriented, vertex_) - oriented.begin();
      const FaceAtVertex found{*face, oriented[(place + 1) % 3], oriented[(place + 2) % 3]};
      if (std::ranges::find(faces_, found.face, &FaceAtVertex::face) == faces_.end()) faces_.push_back(found);
    }
  }
  pages_.clear();
  std::size_t used = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (!has(neighbors_, faces_[i].from)) continue;
    if (!follow_page(i, pages_.emplace_back())) return false;
    used += pages_.back().faces.size();
  }
  return used == faces_.size();
}

/// Follows the faces of one facet around the vertex, from one neighbor to the other.
bool VertexRemoval::follow_page(std::size_t first, Page& page) const {
  page.polygon = {faces_[first].from};
  page.facet = x_.facet_of_face()[faces_[first].face];
  for (const FaceAtVertex* face = &faces_[first];;) {
    page.faces.push_back(face->face);
    page.polygon.push_back(face->to);
    if (has(neighbors_, face->to)) return page.polygon.size() > 2;
    const auto next = std::ranges::find(faces_, face->to, &FaceAtVertex::from);
    if (next == faces_.end() || page.faces.size() >= faces_.size()) return false;
    face = &*next;
  }
}

/// Triangulates the polygon of a page by a fan. \return are all its triangles new, and upright?
bool VertexRemoval::find_fan(Page& page, std::size_t from) {
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

/// In a facet that is flat only within the tolerance, a triangle of the page can be on the hull of the star: then no
/// new cell would have it.
bool VertexRemoval::is_on_hull(const Triangle& t) const {
  return std::ranges::any_of(star_, [&](std::uint32_t c) {
    const auto& v = x_.cell(c).vertices;
    return std::ranges::all_of(t, [&](std::uint32_t corner) { return has(v, corner); });
  });
}

/// Plans all but the new cells.
void VertexRemoval::replace_star(Change& change) const {
  for (const Page& page : pages_) {
    for (std::size_t i = 0; i < page.triangles.size(); ++i) change.faces.push_back({page.faces[i], page.triangles[i]});
    change.faces.push_back({page.faces.back(), no_corners});
  }
  change.old_cells = star_;
  change.merge = SegmentMerge{vertex_, neighbors_};
}

/// Plans to move the vertex onto one of its neighbors, perhaps across other faces.
bool VertexRemoval::plan_collapse(std::size_t end, Change& change) {
  change.clear();
  const std::uint32_t to = neighbors_[end];
  for (const std::uint32_t c : star_) {
    auto vertices = x_.cell(c).vertices;
    if (has(vertices, to)) continue;
    std::ranges::replace(vertices, vertex_, to);
    const auto& [a, b, d, e] = vertices;
    if (numbers::orient3d(x_.point(a), x_.point(b), x_.point(d), x_.point(e)) <= 0) return false;
    change.new_cells.push_back({vertices, x_.region(c), x_.quality_of(vertices)});
  }
  for (Page& page : pages_)
    if (!find_fan(page, page.polygon.front() == to ? 0 : page.polygon.size() - 1)) return false;
  replace_star(change);
  return true;
}

/// Divides the star by the pages.
void VertexRemoval::find_sectors() {
  sectors_.clear();
  marks_.clear(x_.cell_count());
  for (const std::uint32_t first : star_) {
    if (marks_.is_marked(first)) continue;
    Sector& sector = sectors_.emplace_back(Sector{x_.region(first), {}, {}});
    marks_.mark(first);
    connected_ = {first};
    for (std::size_t i = 0; i < connected_.size(); ++i) {
      const std::uint32_t c = connected_[i];
      const Cell& cell = x_.cell(c);
      sector.hull.push_back(corners_of_face(cell.vertices, x_.place(c, vertex_)));
      add_pages(c, sector);
      for (std::uint32_t f = 0; f < 4; ++f) {
        const std::uint32_t next = cell.neighbors[f];
        if (cell.vertices[f] == vertex_ || x_.is_wall(face_code(c, f)) || marks_.is_marked(cell_of(next))) continue;
        marks_.mark(cell_of(next));
        connected_.push_back(cell_of(next));
      }
    }
  }
}

/// Adds the pages that the walls of a cell of the star are on.
void VertexRemoval::add_pages(std::uint32_t c, Sector& sector) const {
  const auto& v = x_.cell(c).vertices;
  for (std::uint32_t f = 0; f < 4; ++f) {
    if (v[f] == vertex_ || !x_.is_wall(face_code(c, f))) continue;
    const auto corners = corners_of_face(v, f);
    const std::uint32_t face = *x_.find_face(corners[0], corners[1], corners[2]);
    const auto page = std::ranges::find_if(pages_, [&](const Page& p) { return has(p.faces, face); });
    const auto& oriented = x_.faces()[face];
    const auto place = std::ranges::find(oriented, corners[0]) - oriented.begin();
    const Sector::Side side{static_cast<std::uint32_t>(page - pages_.begin()), oriented[(place + 1) % 3] == corners[1]};
    if (std::ranges::find(sector.pages, side) == sector.pages.end()) sector.pages.push_back(side);
  }
}

bool VertexRemoval::plan_fill(Change& change) {
  if (pages_.empty()) return false;  // the edge must be in the mesh, which the filler does not know
  find_sectors();
  return fill_sectors(0, change);
}

/// Tries all fans of this page and of those after it.
bool VertexRemoval::fill_sectors(std::size_t page, Change& change) {
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
bool VertexRemoval::fill_sector(const Sector& sector, Change& change) {
  hull_ = sector.hull;
  for (const auto& [p, is_above] : sector.pages)
    for (const auto& [a, b, c] : pages_[p].triangles) hull_.push_back(is_above ? Triangle{a, b, c} : Triangle{b, a, c});
  return filler_.fill(hull_, sector.region, -std::numeric_limits<double>::infinity(), change.new_cells);
}

}  // namespace ccdt::steiner
