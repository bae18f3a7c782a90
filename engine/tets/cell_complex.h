#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_axis.h"
#include "engine/geometry/box_tree.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/tets/cell_quality.h"

namespace ccdt::tets {

using delaunay::Cell, delaunay::corners_of_face, delaunay::face_code, delaunay::face_of, delaunay::ghost_vertex,
    delaunay::join_faces, delaunay::no_neighbor;

/// The corners of a face.
using Triangle = std::array<std::uint32_t, 3>;

/// The cell of a face code.
constexpr CellId cell_of(std::uint32_t code) {
  return CellId(delaunay::cell_of(code));
}

/// Is the value in the list?
template <class List, class Value>
bool has(const List& list, const Value& value) {
  return std::ranges::find(list, value) != std::ranges::end(list);
}

/// A cell to be made.
struct NewCell {
  std::array<std::uint32_t, 4> vertices;  ///< positively oriented
  int region;
  double quality;
};

/// A face on a facet gets other corners, or is no longer needed.
struct FaceChange {
  std::uint32_t face;  ///< its number
  Triangle corners;    ///< the new ones, in the orientation of the facet; `no_corners` for none
};
inline constexpr Triangle no_corners = {ghost_vertex, ghost_vertex, ghost_vertex};

/// A vertex inside a segment is removed: its edges to both neighbors on the segment become one.
struct SegmentMerge {
  std::uint32_t vertex;
  std::array<std::uint32_t, 2> neighbors;
};

/// A plan: cells to remove, and cells that fill the same space instead.
struct Change {
  std::vector<CellId> old_cells;
  std::vector<NewCell> new_cells;
  std::vector<FaceChange> faces;     ///< on facets; together they cover the same parts of the same facets
  std::optional<Point3> new_vertex;  ///< its id is the number of vertices before the change
  std::optional<SegmentMerge> merge;
  /// Encloses the space outside that its new faces take, or would have taken if no face were in the way.
  Box space_taken = empty_box;

  void clear();
  /// Does it leave the faces on facets and the segments alone?
  bool keeps_surface() const { return faces.empty() && !merge; }
};

/// The space of the old cells of a change.
struct Cavity {
  /// A face that waits for the cell on its other side.
  struct Face {
    FaceKey key;
    std::uint32_t code;  ///< of the existing cell; `no_neighbor` if the face is on the boundary
    bool is_wall;
  };

  std::vector<Face> faces;
  std::vector<std::uint32_t> lost_vertices;  ///< of old cells, but not of new ones
};

/// A tetrahedral mesh that can be changed: cells know their neighbors, and which of their faces and edges must stay.
///
/// As in the Delaunay tetrahedralization, but without ghosts: the code of a missing neighbor is `no_neighbor`. A *wall*
/// is a face on a facet, on the boundary or inside. Vertices below the first interior one are vertices of the PLC, or
/// Steiner vertices on its segments and facets; *interior* vertices may move anywhere or be removed.
class CellComplex {
 public:
  /// \param faces           of the mesh, on its facets
  /// \param edges           of the mesh, on its segments
  /// \param cells           the tetrahedra; neighbors may be missing
  /// \param regions         the region attribute of each cell; empty if all are in one region
  /// \param points          the vertices of the mesh in grid units
  /// \param facet_of_face   the facet of each of the faces: edges between faces of one facet may be exchanged
  /// \param first_interior  the least interior vertex
  CellComplex(std::vector<Triangle> faces, std::span<const std::array<std::uint32_t, 2>> edges, LargeVector<Cell> cells,
              std::vector<int> regions, std::vector<Point3> points, std::vector<std::uint32_t> facet_of_face,
              std::uint32_t first_interior, const QualityGoal& goal);

  const QualityGoal& goal() const { return goal_; }
  std::uint64_t change_count() const { return change_count_; }

  std::size_t vertex_count() const { return points_.size(); }
  const Point3& point(std::uint32_t v) const { return points_[v]; }
  bool is_interior(std::uint32_t v) const { return v >= first_interior_; }
  bool is_removed(std::uint32_t v) const {
    // A vertex of the PLC outside the domain never had a cell.
    return is_interior(v) ? cell_at_[v].is_none() : merged_[v];
  }
  /// A cell with the vertex; none if the vertex was removed.
  CellId cell_at(std::uint32_t v) const { return cell_at_[v]; }
  /// The number of the last change around the vertex.
  std::uint64_t changed_at(std::uint32_t v) const { return changed_at_[v]; }

  /// Includes dead cells, whose places can be reused.
  std::size_t cell_count() const { return cells_.size(); }
  std::size_t dead_count() const { return free_.size(); }
  const Cell& cell(CellId c) const { return cells_[c]; }
  bool is_dead(CellId c) const { return cells_[c].vertices[0] == ghost_vertex; }
  int region(CellId c) const { return regions_.empty() ? 0 : regions_[c]; }
  double quality(CellId c) const { return qualities_[c]; }
  /// How often the place of the cell was reused, modulo 2^16.
  std::uint16_t generation(CellId c) const { return generations_[c]; }
  /// The position of a vertex in one of its cells.
  std::uint32_t place(CellId c, std::uint32_t v) const {
    const auto& all = cells_[c].vertices;
    return all[0] == v ? 0 : all[1] == v ? 1 : all[2] == v ? 2 : 3;
  }
  /// The code of the same face in the cell on its other side.
  std::uint32_t across(std::uint32_t code) const { return cells_[cell_of(code)].neighbors[face_of(code)]; }
  /// The vertex opposite the face in its cell.
  std::uint32_t apex_of(std::uint32_t code) const { return cells_[cell_of(code)].vertices[face_of(code)]; }
  /// The corners of the face, its cell above.
  Triangle corners_of(std::uint32_t code) const {
    return corners_of_face(cells_[cell_of(code)].vertices, face_of(code));
  }
  bool is_wall(std::uint32_t code) const { return (walls_[cell_of(code)] >> face_of(code) & 1) != 0; }

  /// The faces on facets, and the facet of each.
  const std::vector<Triangle>& faces() const { return faces_; }
  const std::vector<std::uint32_t>& facet_of_face() const { return facet_of_face_; }
  /// The axis closest to the normal of a facet, on its upper side: 1, 2 or 3, or -1, -2 or -3.
  facets::FacetAxis axis_of_facet(std::uint32_t facet) const { return facet_axes_[facet]; }
  /// The number of the face with these corners; none if it is not on a facet.
  std::optional<std::uint32_t> find_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const std::uint32_t* const face = face_table_.find(face_key(a, b, c));
    return face == nullptr ? std::nullopt : std::optional(*face);
  }
  /// The edges that lie on segments, by `edge_key`.
  const HashSet<std::uint64_t>& segments() const { return segments_; }
  /// Is the edge on a segment?
  bool is_segment(std::uint32_t a, std::uint32_t b) const {
    return !is_interior(a) && !is_interior(b) && segments_.find(edge_key(a, b)) != nullptr;
  }

  /// The box of a face with these corners.
  Box box_of_face(const Triangle& corners) const {
    return bounding_box(std::array{points_[corners[0]], points_[corners[1]], points_[corners[2]]});
  }
  /// Calls visit(face) for all faces whose boxes meet the given one. Slow unless the faces are indexed.
  template <class Visit>
  void for_each_face_near(const Box& box, const Visit& visit) const {
    const auto visit_near = [&](std::uint32_t face) {
      if (faces_[face] != no_corners && box_of_face(faces_[face]).meets(box)) visit(face);
    };
    if (face_tree_) return face_tree_->for_each_meeting(box, visit_near);
    for (std::uint32_t face = 0; face < faces_.size(); ++face) visit_near(face);
  }
  /// Indexes the faces by place, unless that was done before.
  void index_faces();

  /// The quality of a cell with these vertices.
  double quality_of(const std::array<std::uint32_t, 4>& v) const {
    return cell_quality(goal_, points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]]);
  }
  /// Are all new cells positive? Exact. If so, and if they have the same hull as the old ones, they fill the same space
  /// once.
  bool all_positive(const Change& change) const;

  /// Bytes of its data by vertex, by cell and by face.
  std::size_t bytes() const;

  /// Applies a change whose cells are all positive. Interior vertices without new cells are removed.
  /// \param made  the new cells
  void apply(Change& change, std::vector<CellId>& made);

  // The parts of `apply`. Several cavities can be found at the same time. Changes are announced in order. Several
  // announced changes can be made at the same time if they leave the surface alone and no two cavities have a common
  // face.

  void find_cavity(const Change& change, Cavity& cavity) const;
  /// Chooses places for the new cells, and notes the change at its vertices. The new vertex gets its number: not the
  /// planned one if vertices have been inserted since.
  void announce(Change& change, const Cavity& cavity, std::vector<CellId>& places);
  /// \param cavity  is used up
  void fill_cavity(const Change& change, std::span<const CellId> places, Cavity& cavity);
  /// May a change after this one have replaced the cell beyond a face of the cavity?
  bool has_changed_beyond(const Cavity& cavity, std::uint64_t since) const;

  // The parts of a move. Several announced moves can be made at the same time if no two stars have a common cell.

  /// Notes the change at the vertices of `star`, the cells around a vertex. If the vertex is not interior, also notes
  /// where the faces around it will be.
  void announce_move(std::uint32_t v, const Point3& place, std::span<const CellId> star);
  /// Moves a vertex to a position where all cells around it, `star`, are positive.
  void move_vertex(std::uint32_t v, const Point3& place, std::span<const CellId> star);

  /// Writes the result back to the mesh that the complex was made of: tetrahedra, regions, and faces. The edges on
  /// segments get the new numbers of their vertices. Removed items leave no gaps.
  ///
  /// \param mesh  still has the markers of all faces and the edges
  /// \return the vertices of the mesh, in grid units
  std::vector<Point3> take_mesh(mesh::TetMesh& mesh) &&;

 private:
  void join_open_faces();
  void find_facet_axes();
  void find_walls();
  void find_last_cells();
  CellId take_place();
  void set_wall(std::uint32_t code);
  void connect(std::uint32_t code, const std::vector<FaceChange>& new_walls, std::vector<Cavity::Face>& open);
  void change_faces(const std::vector<FaceChange>& changes);
  void merge_segment(const SegmentMerge& merge);

  QualityGoal goal_;
  std::uint64_t change_count_ = 0;

  // By vertex.
  std::vector<Point3> points_;  // grid units
  std::uint32_t first_interior_ = 0;
  std::vector<CellId> cell_at_;
  std::vector<std::uint64_t> changed_at_;
  std::vector<bool> merged_;  // for vertices below the first interior one: removed from its segment

  // By cell.
  LargeVector<Cell> cells_;
  RawVector<std::uint8_t> walls_;  // bit f is set if face f is a wall
  std::vector<int> regions_;       // empty: one region
  RawVector<double> qualities_;
  RawVector<std::uint16_t> generations_;
  std::vector<CellId> free_;  // places of dead cells

  // The surface.
  HashSet<std::uint64_t> segments_;               // edges that lie on segments
  HashTable<FaceKey, std::uint32_t> face_table_;  // places in `faces_`
  std::vector<Triangle> faces_;
  std::vector<std::uint32_t> facet_of_face_;
  std::vector<facets::FacetAxis> facet_axes_;  // by facet
  std::optional<BoxTree> face_tree_;           // its boxes may be too large; none until the faces are indexed

  Cavity cavity_;  // working memory of `apply`
};

}  // namespace ccdt::tets
