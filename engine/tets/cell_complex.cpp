#include "engine/tets/cell_complex.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <tuple>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/base/sort_in_buckets.h"
#include "engine/geometry/predicates.h"

namespace ccdt::tets {

namespace {

constexpr std::size_t grain = 4096;  // of loops on several threads

/// A face of a cell that has no neighbor there.
struct OpenCellFace {
  FaceKey key;
  std::uint32_t code;

  bool operator<(const OpenCellFace& other) const { return std::tie(key, code) < std::tie(other.key, other.code); }
};

FaceKey key_of_face(const std::array<std::uint32_t, 4>& v, std::uint32_t f) {
  const auto [a, b, c] = corners_of_face(v, f);
  return face_key(a, b, c);
}

FaceKey key_of(const Triangle& corners) {
  return face_key(corners[0], corners[1], corners[2]);
}

bool is_new_wall(const std::vector<FaceChange>& faces, const FaceKey& key) {
  return std::ranges::any_of(faces, [&](const FaceChange& face) { return is_same_key(key, key_of(face.corners)); });
}

}  // namespace

void Change::clear() {
  old_cells.clear();
  new_cells.clear();
  faces.clear();
  new_vertex.reset();
  merge.reset();
  space_taken = empty_box;
}

CellComplex::CellComplex(std::vector<Triangle> faces, std::span<const std::array<std::uint32_t, 2>> edges,
                         LargeVector<Cell> cells, std::vector<int> regions, std::vector<Point3> points,
                         std::vector<std::uint32_t> facet_of_face, std::uint32_t first_interior,
                         const QualityGoal& goal)
    : goal_(goal),
      points_(std::move(points)),
      first_interior_(first_interior),
      cell_at_(points_.size()),
      changed_at_(points_.size(), 0),
      merged_(first_interior, false),
      cells_(std::move(cells)),
      walls_(cells_.size()),
      regions_(std::move(regions)),
      qualities_(cells_.size()),
      generations_(cells_.size()),
      faces_(std::move(faces)),
      facet_of_face_(std::move(facet_of_face)) {
  // Only a few vertices will be inserted, but without room for them, the first one would double the list.
  points_.reserve(points_.size() + points_.size() / 64);
  parallel_ranges(cells_.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::fill(walls_.data() + begin, walls_.data() + end, std::uint8_t{0});
    std::fill(generations_.data() + begin, generations_.data() + end, std::uint16_t{0});
    compute_qualities(goal_, points_, std::span(cells_).subspan(begin, end - begin),
                      std::span(qualities_).subspan(begin, end - begin));
  });
  const auto list_segments = [&] {
    segments_.reserve(edges.size());
    for (const auto& edge : edges) segments_.insert(edge_key(edge[0], edge[1]));
  };
  const auto list_faces = [&] {
    face_table_.reserve(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) face_table_.insert(key_of(faces_[f]), f);
  };
  parallel_for(3, 1, [&](std::size_t i) { i == 0 ? list_segments() : i == 1 ? list_faces() : find_facet_axes(); });
  join_open_faces();
  find_walls();
  find_last_cells();
}

void CellComplex::find_facet_axes() {
  if (faces_.empty()) return;
  std::vector<Point3> normals(*std::ranges::max_element(facet_of_face_) + std::size_t{1});
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto& [a, b, c] = faces_[f];
    Point3& normal = normals[facet_of_face_[f]];
    normal = normal + area_vector({points_[a], points_[b], points_[c]});
  }
  for (const Point3& normal : normals) facet_axes_.push_back(facets::axis_along(normal));
}

/// Gives each vertex the last of its cells.
void CellComplex::find_last_cells() {
  parallel_ranges(cells_.size(), grain, [&](std::size_t begin, std::size_t end) {
    // Backward, so that most vertices get their last cell at once.
    for (std::size_t i = end; i-- > begin;) {
      const CellId c(i);
      for (const std::uint32_t v : cells_[c].vertices) {
        const auto last = as_atomic(cell_at_[v]);
        CellId before = last.load(std::memory_order_relaxed);
        while ((before.is_none() || before < c) && !last.compare_exchange_weak(before, c, std::memory_order_relaxed)) {
        }
      }
    }
  });
}

void CellComplex::index_faces() {
  if (face_tree_) return;
  face_tree_.emplace(faces_, [&](const Triangle& face) { return face == no_corners ? Box{} : box_of_face(face); });
}

void CellComplex::set_wall(std::uint32_t code) {
  walls_[cell_of(code)] |= static_cast<std::uint8_t>(1u << face_of(code));
}

/// Joins the cells on both sides of each face where neighbors are missing. The remaining faces are on the boundary.
void CellComplex::join_open_faces() {
  auto open = parallel_collect<OpenCellFace>(
      cells_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<OpenCellFace>& found) {
        for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c)
          for (std::uint32_t f = 0; f < 4; ++f)
            if (cells_[c].neighbors[f] == no_neighbor)
              found.push_back({key_of_face(cells_[c].vertices, f), face_code(c, f)});
      });
  sort_in_buckets(open, [](const OpenCellFace& face) { return face.key[0]; });
  for (std::size_t i = 1; i < open.size(); ++i)
    if (open[i - 1].key == open[i].key) join_faces(cells_, open[i - 1].code, open[i].code);
}

/// Marks the faces on facets. Interior vertices are not on facets.
void CellComplex::find_walls() {
  parallel_for(cells_.size(), grain, [&](std::size_t i) {
    const CellId c(i);
    const auto& v = cells_[c].vertices;
    const auto interior = std::ranges::count_if(v, [&](std::uint32_t corner) { return is_interior(corner); });
    for (std::uint32_t f = 0; f < 4; ++f) {
      const bool may_be_on_facet = interior == (is_interior(v[f]) ? 1 : 0);
      if (cells_[c].neighbors[f] == no_neighbor || (may_be_on_facet && face_table_.find(key_of_face(v, f)) != nullptr))
        set_wall(face_code(c, f));
    }
  });
}

bool CellComplex::all_positive(const Change& change) const {
  const auto at = [&](std::uint32_t v) -> const Point3& {
    return v < points_.size() ? points_[v] : *change.new_vertex;
  };
  return std::ranges::all_of(change.new_cells, [&](const NewCell& cell) {
    const auto& v = cell.vertices;
    return orient3d(at(v[0]), at(v[1]), at(v[2]), at(v[3])) > 0;
  });
}

std::size_t CellComplex::bytes() const {
  return bytes_of(points_, cell_at_, changed_at_, cells_, walls_, regions_, qualities_, generations_, free_, faces_,
                  facet_of_face_, facet_axes_) +
         segments_.bytes() + face_table_.bytes() + (face_tree_ ? face_tree_->bytes() : 0);
}

void CellComplex::find_cavity(const Change& change, Cavity& cavity) const {
  cavity.faces.clear(), cavity.lost_vertices.clear();
  // There are only a few old and new cells: comparing with all of them costs less than marks in another array.
  const auto stays = [&](std::uint32_t v) {
    return std::ranges::any_of(change.new_cells, [&](const NewCell& cell) { return has(cell.vertices, v); });
  };
  for (const CellId c : change.old_cells) {
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (!stays(cells_[c].vertices[f])) cavity.lost_vertices.push_back(cells_[c].vertices[f]);
      const std::uint32_t outside = cells_[c].neighbors[f];
      if (outside != no_neighbor && has(change.old_cells, cell_of(outside))) continue;
      cavity.faces.push_back({key_of_face(cells_[c].vertices, f), outside, is_wall(face_code(c, f))});
    }
  }
}

bool CellComplex::has_changed_beyond(const Cavity& cavity, std::uint64_t since) const {
  return std::ranges::any_of(cavity.faces, [&](const Cavity::Face& face) {
    return std::ranges::all_of(face.key, [&](std::uint32_t v) { return changed_at_[v] > since; });
  });
}

CellId CellComplex::take_place() {
  if (!free_.empty()) {
    const CellId place = free_.back();
    free_.pop_back();
    return place;
  }
  const CellId place(cells_.size());
  cells_.emplace_back();
  walls_.push_back(0);
  if (!regions_.empty()) regions_.push_back(0);
  qualities_.push_back(0);
  generations_.push_back(0);
  return place;
}

/// Joins a face of a new cell to the face that waits for it, or lets it wait.
void CellComplex::connect(std::uint32_t code, const std::vector<FaceChange>& new_walls,
                          std::vector<Cavity::Face>& open) {
  const FaceKey key = key_of_face(cells_[cell_of(code)].vertices, face_of(code));
  const bool becomes_wall = !new_walls.empty() && is_new_wall(new_walls, key);
  for (Cavity::Face& face : open) {
    if (!is_same_key(face.key, key)) continue;
    cells_[cell_of(code)].neighbors[face_of(code)] = face.code;
    if (face.code != no_neighbor) cells_[cell_of(face.code)].neighbors[face_of(face.code)] = code;
    if (face.is_wall || becomes_wall) set_wall(code);
    face = open.back();
    open.pop_back();
    return;
  }
  cells_[cell_of(code)].neighbors[face_of(code)] = no_neighbor;
  if (becomes_wall) set_wall(code);
  open.push_back({key, code, becomes_wall});
}

void CellComplex::change_faces(const std::vector<FaceChange>& changes) {
  for (const FaceChange& change : changes) face_table_.erase(face_table_.find(key_of(faces_[change.face])));
  for (const FaceChange& change : changes) {
    faces_[change.face] = change.corners;
    if (change.corners == no_corners) continue;
    face_table_.insert(key_of(change.corners), change.face);
    if (face_tree_) face_tree_->enlarge(change.face, box_of_face(change.corners));
  }
}

void CellComplex::merge_segment(const SegmentMerge& merge) {
  const auto [a, b] = merge.neighbors;
  for (const std::uint32_t end : merge.neighbors) segments_.erase(segments_.find(edge_key(merge.vertex, end)));
  segments_.insert(edge_key(a, b));
  merged_[merge.vertex] = true;
}

void CellComplex::announce(Change& change, const Cavity& cavity, std::vector<CellId>& places) {
  if (change.new_vertex) {
    for (NewCell& cell : change.new_cells) cell.vertices[3] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(*change.new_vertex);
    cell_at_.emplace_back();
    changed_at_.push_back(0);
  }
  free_.insert(free_.end(), change.old_cells.begin(), change.old_cells.end());
  ++change_count_;
  places.clear();
  for (const NewCell& cell : change.new_cells) {
    places.push_back(take_place());
    for (const std::uint32_t v : cell.vertices) cell_at_[v] = places.back(), changed_at_[v] = change_count_;
  }
  for (const std::uint32_t v : cavity.lost_vertices) cell_at_[v] = {};
  // A later change may take the other places before this one's cavity is filled.
  const std::size_t unused = std::max(change.old_cells.size(), places.size()) - places.size();
  for (const CellId c : std::span(free_).last(unused)) cells_[c].vertices[0] = ghost_vertex;
}

void CellComplex::fill_cavity(const Change& change, std::span<const CellId> places, Cavity& cavity) {
  work_done.cells_destroyed += change.old_cells.size();
  work_done.cells_created += change.new_cells.size();
  for (const CellId c : change.old_cells) ++generations_[c];
  for (std::size_t i = 0; i < places.size(); ++i) {
    const NewCell& cell = change.new_cells[i];
    const CellId c = places[i];
    cells_[c].vertices = cell.vertices;
    walls_[c] = 0;
    if (!regions_.empty()) regions_[c] = cell.region;
    qualities_[c] = cell.quality;
    for (std::uint32_t f = 0; f < 4; ++f) connect(face_code(c, f), change.faces, cavity.faces);
  }
  // A change on a boundary facet leaves faces open: its old triangles, which are gone, and the new ones, which are
  // walls already.
  if (!change.faces.empty()) change_faces(change.faces);
  if (change.merge) merge_segment(*change.merge);
}

void CellComplex::apply(Change& change, std::vector<CellId>& made) {
  find_cavity(change, cavity_);
  announce(change, cavity_, made);
  fill_cavity(change, made, cavity_);
}

void CellComplex::announce_move(std::uint32_t v, const Point3& place, std::span<const CellId> star) {
  ++change_count_;
  const bool moves_faces = face_tree_ && !is_interior(v);
  for (const CellId c : star) {
    for (std::uint32_t f = 0; f < 4; ++f) {
      changed_at_[cells_[c].vertices[f]] = change_count_;
      if (!moves_faces || cells_[c].vertices[f] == v || !is_wall(face_code(c, f))) continue;
      const auto [p, q, r] = corners_of(face_code(c, f));
      if (const auto face = find_face(p, q, r)) face_tree_->enlarge(*face, box_of(place));
    }
  }
}

void CellComplex::move_vertex(std::uint32_t v, const Point3& place, std::span<const CellId> star) {
  points_[v] = place;
  for (const CellId c : star) qualities_[c] = quality_of(cells_[c].vertices);
}

std::vector<Point3> CellComplex::take_mesh(mesh::TetMesh& mesh) && {
  // The tetrahedra get the memory of arrays that are no longer needed.
  release(qualities_), release(generations_), release(walls_), release(changed_at_), release(facet_of_face_);
  release(face_table_), release(segments_), face_tree_.reset();
  std::vector<std::uint32_t> number(points_.size());
  std::vector<Point3> points;
  const auto number_vertices = [&] {
    points.reserve(points_.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      number[v] = static_cast<std::uint32_t>(points.size());
      if (!is_removed(v)) points.push_back(points_[v]);
    }
  };
  parallel_pack(
      cells_.size(), grain,
      [&](std::size_t c, std::size_t end) {
        std::size_t count = 0;
        for (; c < end; ++c) count += !is_dead(CellId(c));
        return count;
      },
      [&](std::size_t count) {
        // On this thread, which gets back the memory that it released.
        parallel_both([&] { mesh.tetrahedra.resize(count), mesh.regions.resize(regions_.empty() ? 0 : count); },
                      number_vertices);
      },
      [&](std::size_t c, std::size_t end, std::size_t place) {
        for (; c < end; ++c) {
          if (is_dead(CellId(c))) continue;
          const auto& v = cells_[c].vertices;
          mesh.tetrahedra[place] = {number[v[0]], number[v[1]], number[v[2]], number[v[3]]};
          if (!regions_.empty()) mesh.regions[place] = regions_[c];
          ++place;
        }
      });
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f] == no_corners) continue;
    mesh.face_markers[kept] = mesh.face_markers[f];
    faces_[kept++] = {number[faces_[f][0]], number[faces_[f][1]], number[faces_[f][2]]};
  }
  faces_.resize(kept);
  mesh.face_markers.resize(kept);
  mesh.faces = std::move(faces_);
  for (auto& [a, b] : mesh.edges) a = number[a], b = number[b];
  return points;
}

}  // namespace ccdt::tets
