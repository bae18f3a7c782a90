#include "engine/improve/plan_vertex_removal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/improve/smoothing.h"
#include "engine/improve/topological_changes.h"
#include "engine/numbers/predicates.h"
#include "engine/plc/integer_points.h"

namespace ccdt::improve {
namespace {

constexpr int most_growth = 30;       ///< cells by which a sector may grow
constexpr std::size_t most_fans = 5;  ///< of a page that are tried

template <class List>
bool has(const List& list, std::uint32_t value) {
  return std::ranges::find(list, value) != list.end();
}

/// The axis closest to a direction.
Point3 axis_near(const Point3& direction) {
  std::array<double, 3> axis{};
  const int longest = plc::dominant_axis(direction);
  axis[longest] = std::copysign(1, as_array(direction)[longest]);
  return {axis[0], axis[1], axis[2]};
}

}  // namespace

bool VertexRemoval::plan(std::uint32_t vertex, const std::array<std::uint32_t, 2>& neighbors, RemovalEffort effort,
                         Change& change) {
  vertex_ = vertex;
  neighbors_ = neighbors;
  gather_cells(x_, vertex, marks_, star_);
  if (!find_pages()) return false;
  if (effort != RemovalEffort::collapse) return plan_fill(effort == RemovalEffort::fill ? 0 : most_growth, change);
  const bool is_planned = plan_collapse(0, change);
  if (!plan_collapse(1, other_)) return is_planned;
  if (!is_planned || worst_of(other_.new_cells) > worst_of(change.new_cells)) std::swap(change, other_);
  return true;
}

VertexRemoval::Triangle VertexRemoval::corners_of(std::uint32_t code) const {
  return corners_of_face(x_.cell(cell_of(code)).vertices, face_of(code));
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
  const Point3& o = x_.point(vertex_);
  page.up = axis_near(cross(x_.point(faces_[first].from) - o, x_.point(faces_[first].to) - o));
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
bool VertexRemoval::find_fan(Page& page, std::size_t from) const {
  page.triangles.clear();
  const auto& polygon = page.polygon;
  const std::size_t n = polygon.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Triangle t = {polygon[from], polygon[(from + i) % n], polygon[(from + i + 1) % n]};
    page.triangles.push_back(t);
    const Point3& a = x_.point(t[0]);
    if (numbers::orient3d(a, x_.point(t[1]), x_.point(t[2]), a + page.up) <= 0) return false;
    if (x_.find_face(t[0], t[1], t[2]) || is_in_star(t)) return false;
  }
  return true;
}

/// Is the triangle a face of a cell of the star? Around facets that are flat only within the tolerance there are cells
/// with all corners on one page.
bool VertexRemoval::is_in_star(const Triangle& t) const {
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

/// Plans to move the vertex onto one of its neighbors.
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
    Sector& sector = sectors_.emplace_back(Sector{x_.region(first), {first}, {}, {}});
    marks_.mark(first);
    for (std::size_t i = 0; i < sector.cells.size(); ++i) {
      const std::uint32_t c = sector.cells[i];
      sector.hull.push_back(face_code(c, x_.place(c, vertex_)));
      add_pages(c, sector);
      const Cell& cell = x_.cell(c);
      for (std::uint32_t f = 0; f < 4; ++f) {
        const std::uint32_t next = cell.neighbors[f];
        if (cell.vertices[f] == vertex_ || x_.is_wall(face_code(c, f)) || marks_.is_marked(cell_of(next))) continue;
        marks_.mark(cell_of(next));
        sector.cells.push_back(cell_of(next));
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

bool VertexRemoval::plan_fill(int growth, Change& change) {
  if (pages_.empty()) return false;  // the edge must be in the mesh, which the filler does not know
  find_sectors();
  return fill_sectors(0, growth, change);
}

/// Tries all fans of this page and of those after it.
bool VertexRemoval::fill_sectors(std::size_t page, int growth, Change& change) {
  if (page < pages_.size()) {
    // The fans from opposite corners of a quadrilateral are the same.
    const std::size_t n = pages_[page].polygon.size(), fans = n <= 4 ? n - 2 : std::min(n, most_fans);
    for (std::size_t from = 0; from < fans; ++from)
      if (find_fan(pages_[page], from) && fill_sectors(page + 1, growth, change)) return true;
    return false;
  }
  change.clear();
  replace_star(change);
  return std::ranges::all_of(sectors_, [&](const Sector& sector) { return fill_sector(sector, growth, change); });
}

/// Fills a sector without the vertex. Where that is not possible, the sector grows.
bool VertexRemoval::fill_sector(Sector sector, int growth, Change& change) {
  const auto size = static_cast<std::ptrdiff_t>(sector.cells.size());
  filler_.clear();
  while (true) {
    hull_.clear();
    for (const std::uint32_t code : sector.hull) hull_.push_back(corners_of(code));
    for (const auto& [p, is_above] : sector.pages)
      for (const auto& [a, b, c] : pages_[p].triangles)
        hull_.push_back(is_above ? Triangle{a, b, c} : Triangle{b, a, c});
    if (filler_.fill(hull_, sector.region, change.new_cells)) {
      change.old_cells.insert(change.old_cells.end(), sector.cells.begin() + size, sector.cells.end());
      return true;
    }
    const std::size_t blocked = filler_.blocked_face();
    if (growth-- == 0 || blocked == hull_.size() || !grow(blocked, change, sector)) return false;
  }
}

/// Adds a cell to a sector: the one behind a face of the hull, or behind one that shares corners with it.
bool VertexRemoval::grow(std::size_t blocked, const Change& change, Sector& sector) const {
  const auto shared_corners = [&](std::size_t face) {
    return std::ranges::count_if(hull_[face], [&](std::uint32_t v) { return has(hull_[blocked], v); });
  };
  for (std::ptrdiff_t shared = 3; shared > 0; --shared)
    for (std::size_t i = 0; i < sector.hull.size(); ++i)
      if (shared_corners(i) == shared && can_pass(sector.hull[i], change)) return add_cell_behind(i, sector);
  return false;
}

/// Is there a cell behind a face of the hull that is neither across a wall nor replaced already?
bool VertexRemoval::can_pass(std::uint32_t code, const Change& change) const {
  return !x_.is_wall(code) && !has(change.old_cells, cell_of(x_.across(code)));
}

/// \return false: vertices or segments would not be on the hull
bool VertexRemoval::add_cell_behind(std::size_t face, Sector& sector) const {
  const std::uint32_t behind = x_.across(sector.hull[face]), next = cell_of(behind);
  const auto& v = x_.cell(next).vertices;
  sector.hull.erase(sector.hull.begin() + static_cast<std::ptrdiff_t>(face));
  sector.cells.push_back(next);
  for (std::uint32_t f = 0; f < 4; ++f) {
    const std::uint32_t mine = face_code(next, f), others = x_.cell(next).neighbors[f];
    if (mine == behind) continue;
    const auto twin = x_.is_wall(mine) ? sector.hull.end() : std::ranges::find(sector.hull, others);
    if (twin == sector.hull.end()) {
      sector.hull.push_back(mine);
    } else {
      sector.hull.erase(twin);
    }
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (!is_on_hull(sector, v[i], v[i])) return false;
    for (std::uint32_t j = i + 1; j < 4; ++j)
      if (x_.is_segment(v[i], v[j]) && !is_on_hull(sector, v[i], v[j])) return false;
  }
  return true;
}

bool VertexRemoval::is_on_hull(const Sector& sector, std::uint32_t a, std::uint32_t b) const {
  return std::ranges::any_of(sector.hull, [&](std::uint32_t code) {
    const Triangle corners = corners_of(code);
    return has(corners, a) && has(corners, b);
  });
}

}  // namespace ccdt::improve
