#pragma once

#include <functional>
#include <ranges>
#include <set>
#include <span>

#include "bench/verify/topology.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/input.h"

namespace ccdt::verify {

/// The tolerances, as lengths.
struct Tolerances {
  double box;                   ///< largest extent of the input's bounding box
  double rounding;              ///< of coordinates
  double place;                 ///< two points are in one place
  double flat;                  ///< a patch is flat
  double touch;                 ///< a line lies on a piece
  bool exact_contacts = false;  ///< a vertex is on an edge, and a line on a triangle, only if it is exactly there
};

Tolerances find_tolerances(const plc::InputPlc& input, double flatness);

/// A part of the tolerances, from 0 (only the rounding) to 1.
Tolerances narrowed(const Tolerances& given, double part);

/// The tolerances for rounded coordinates (`put_on_grid`): equal positions and contacts are exact up to the rounding of
/// new vertices, and planes have a part of the given tolerance. If the part is 0, everything is exact up to the
/// rounding of computations.
Tolerances exact_contacts(const Tolerances& given, double part);

/// The positions of the input's vertices, identified with vertices of the mesh, so that input and mesh can be compared
/// by indices. A position without a vertex of the mesh gets a number after those of the mesh.
struct Sites {
  std::vector<std::uint32_t> of_input;  ///< site of each input vertex
  std::vector<Point3> position;  ///< of each site, in the input; of a vertex that is not in the input, in the mesh
  std::vector<bool> is_given;    ///< by site: is a vertex of the input there?
  std::uint32_t mesh_vertices = 0;

  bool in_mesh(std::uint32_t site) const { return site < mesh_vertices; }
};

/// Matches exact coordinates first, then the nearest vertex in use within `tolerances.place`.
Sites match_sites(const plc::InputPlc& input, const Topology& topology, const Tolerances& tolerances);

/// A tree of boxes in the units of the input, scaled internally for any size of the input.
class ScaledBoxTree {
 public:
  ScaledBoxTree(RawVector<Box> boxes, const Tolerances& tolerances);

  /// Calls visit(i) for all boxes that meet the given one.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    tree_.for_each_meeting(scaled(box), visit);
  }

 private:
  Box scaled(const Box& box) const { return {scale_ * box.low, scale_ * box.high}; }

  double scale_;
  BoxTree tree_;
};

/// A part of a facet without inner edges: the directed edges of its outer loop and of the loops that are cut out of
/// it, with the cell to their left.
using PolygonCell = std::vector<Edge>;

/// The faces of a planar drawing.
struct DrawnLoops {
  std::vector<PolygonCell> loops;  ///< closed walks, each with a face to its left
  std::vector<double> areas;       ///< of each loop; positive if it is the outer loop of its face
  std::vector<PolygonCell> cells;  ///< each outer loop, with the loops of everything inside it
};

/// \param normal      of the plane, from the side that it is seen from
/// \param undirected  ascending
DrawnLoops trace_drawing(const Point3& normal, const std::set<Edge>& undirected, std::span<const Point3> position);

/// Is a point within a loop of edges, or an odd number of them, seen along the plane's normal?
bool encloses(const Point3& normal, std::span<const Edge> loop, std::span<const Point3> position, const Point3& point);

/// Parts of the input's facets that are bounded by directed edges between sites: triangles, and cells of polygons with
/// holes. A piece is seen from *above* where its outer loop is counterclockwise.
struct Pieces {
  std::vector<std::uint32_t> piece_begin = {0};  ///< directed edges of each piece: [piece_begin[p], piece_begin[p+1])
  std::vector<Edge> directed;                    ///< from, to
  std::vector<int> marker;                       ///< of each piece
  std::vector<std::uint32_t> number;             ///< of each piece: number of its facet in the file

  std::uint32_t pieces() const { return static_cast<std::uint32_t>(marker.size()); }
  std::span<const Edge> edges_of(std::uint32_t piece) const {
    return {directed.data() + piece_begin[piece], directed.data() + piece_begin[piece + 1]};
  }
  /// The indices of the directed edges of a piece.
  auto uses_of(std::uint32_t piece) const { return std::views::iota(piece_begin[piece], piece_begin[piece + 1]); }
  void add(std::span<const Edge> edges, int its_marker, std::uint32_t its_number);
};

/// The pieces of the input's facets, and how they are connected.
///
/// An edge on which another facet has a vertex is split there, so that facets which share a line share edges.
struct Surface : Pieces {
  Sites sites;
  Tolerances tolerances;
  std::vector<std::uint32_t> piece_of;  ///< of each directed edge
  std::vector<std::uint32_t> edge_of;   ///< of each directed edge
  std::vector<Point3> area_vector;      ///< of each piece: normal, as long as its area

  std::vector<Edge> edges;     ///< ascending sites
  IndexLists uses;             ///< the directed edges along each edge
  std::vector<Edge> segments;  ///< that the input lists explicitly
  std::vector<bool> slides;    ///< by site: not required of the mesh (`let_vertices_slide`); empty: all are required

  std::size_t use_count(std::uint32_t edge) const { return uses.of(edge).size(); }
  const Point3& at(std::uint32_t site) const { return sites.position[site]; }
  /// Some point of the piece's plane.
  const Point3& origin(std::uint32_t piece) const { return at(directed[piece_begin[piece]][0]); }
  RawVector<Box> boxes_of_pieces() const;
  bool is_triangle(std::uint32_t piece) const { return edges_of(piece).size() == 3; }
  /// Does the directed edge run from the smaller site to the larger?
  bool is_forward(std::uint32_t use) const { return directed[use][0] < directed[use][1]; }
};

/// Replaces the pieces, and updates edges and areas.
void set_pieces(Pieces pieces, Surface& surface);

/// Splits the directed edges at the sites that `within` gives for an edge, from the edge's first end to its second.
void split_directed(const std::function<std::vector<std::uint32_t>(std::uint32_t edge)>& within, Surface& surface);

/// Those of the given sites that are strictly within an edge, in order from its first end to its second.
std::vector<std::uint32_t> select_within(const Surface& surface, const Edge& edge,
                                         std::span<const std::uint32_t> sites);

Surface find_surface(const plc::InputPlc& input, Sites sites, const Tolerances& tolerances);

/// Splits the chosen segments at the input vertices on them.
void split_segments(const std::vector<bool>& chosen, Surface& surface);

}  // namespace ccdt::verify
