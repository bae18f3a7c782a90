#pragma once

#include <array>
#include <cstdint>

namespace ccdt {

/// What the engine did, in numbers that depend only on the input and the options: the same on every machine, whatever
/// the compiler and the load. If they change, the algorithm has changed. There are two exceptions: a time limit for
/// improvement, and several threads, which insert vertices in a different order.
struct Work {
  // ---- Signs of determinants (engine/geometry)
  std::uint64_t orient3d_filter_failures = 0;  ///< `orient3d` that floating point could not decide
  std::uint64_t insphere_filter_failures = 0;  ///< `insphere` that floating point could not decide
  std::uint64_t centroid_filter_failures = 0;  ///< `orient3d_centroid` that floating point could not decide
  std::uint64_t narrow_evaluations = 0;        ///< determinants evaluated in integers of 64 and 128 bits
  std::uint64_t wide_evaluations = 0;   ///< determinants evaluated in integers of 256 bits and more, or fractions
  std::uint64_t perturbed_ties = 0;     ///< zero `insphere` that the ranks of the vertices decided (perturbed lifting)
  std::uint64_t exact_evaluations = 0;  ///< narrow evaluations, wide evaluations and perturbed ties together

  // ---- Searches, wherever they are used
  std::uint64_t octree_nodes = 0;    ///< nodes of octrees that searches visited, entered or skipped
  std::uint64_t grid_cells = 0;      ///< cells of uniform grids that searches visited, empty or not
  std::uint64_t box_tree_nodes = 0;  ///< nodes of binary trees of boxes that searches visited, entered or skipped
  std::uint64_t box_pairs = 0;       ///< items whose boxes were found to meet a given box, or each other's

  // ---- Delaunay tetrahedralization (engine/delaunay), also of the surface's vertices alone
  std::uint64_t insertions = 0;         ///< vertices for which the cavity was found, whether or not it was then filled
  std::uint64_t walk_steps = 0;         ///< tetrahedra that walks to a new vertex went through, the first one included
  std::uint64_t cells_tested = 0;       ///< cells whose circumsphere was compared with a new vertex to find its cavity
  std::uint64_t cells_created = 0;      ///< tetrahedra that were made, ghosts included; in improvement too
  std::uint64_t cells_destroyed = 0;    ///< tetrahedra that others replaced, ghosts included; in improvement too
  std::uint64_t largest_cavity = 0;     ///< the most cells that one vertex destroyed, or would have
  std::uint64_t large_cavities = 0;     ///< filled cavities with more than 64 vertices, which take longer than others
  std::uint64_t cells_visited = 0;      ///< cells that searches visited around a vertex, along a walk, or one by one
  std::uint64_t apex_searches = 0;      ///< `wrap`: faces for which the fourth vertex was searched
  std::uint64_t vertices_examined = 0;  ///< `wrap`: vertices of the grid that were tried as the fourth one

  // ---- Triangulation of facets (engine/planar, engine/facets)
  std::uint64_t edges_tested = 0;       ///< `incircle` tests that find out whether an edge is Delaunay
  std::uint64_t edges_flipped = 0;      ///< edges that the other diagonal replaced; in the surface remesher too
  std::uint64_t triangles_visited = 0;  ///< triangles that searches visited around a vertex or on the way to a point

  // ---- Protection of the surface (engine/folds)
  std::uint64_t fold_rounds = 0;  ///< times that nearly flat facets were divided, and protection started again

  // ---- Interior points (engine/lattice)
  std::uint64_t octree_nodes_created = 0;  ///< of the octree of lattice cells and those of locators
  std::uint64_t rays_cast = 0;             ///< rays to find out whether a place is inside
  std::uint64_t ray_triangles = 0;         ///< triangles near a ray that were tried
  std::uint64_t sites_tested = 0;          ///< lattice points near the surface that were tested against it
  std::uint64_t obstacles_tested = 0;  ///< spheres and triangles of the surface that a lattice point was tested against

  // ---- Faces of the input that are not Delaunay (engine/front, engine/locate)
  std::uint64_t faces_tested = 0;      ///< faces of cells that were looked for among the faces of the input
  std::uint64_t front_candidates = 0;  ///< vertices that a locator named for the apex above a face of the front
  std::uint64_t visibility_tests = 0;  ///< faces of the input that were tested because they may hide a candidate
  std::uint64_t piercing_tests = 0;    ///< cells that were tested because a missing face may cut them

  // ---- Improvement (engine/tets, engine/steiner, engine/improve)
  std::uint64_t changes_tried = 0;   ///< plans to remove an edge or a face, to collapse an edge, to insert a vertex
  std::uint64_t moves_tried = 0;     ///< vertices for which a better place was searched; in the remesher too
  std::uint64_t vertices_moved = 0;  ///< of those, the ones that were moved
  std::uint64_t ascent_steps = 0;    ///< steps of these searches
  std::uint64_t quality_evaluations = 0;  ///< tetrahedra whose quality was computed, at each place of a corner anew

  // ---- Remeshing of the surface (engine/surface)
  std::uint64_t remesh_rounds = 0;        ///< rounds of split, collapse, flip and relaxation, over all attempts
  std::uint64_t edges_split = 0;          ///< edges that were split by a vertex in their middle
  std::uint64_t edges_collapsed = 0;      ///< edges that were collapsed into one of their ends
  std::uint64_t triangles_evaluated = 0;  ///< triangles whose quality was computed, at each place of a corner anew

  // ---- Limits that ended a search although more could be done; see `limit_counts`
  /// Attempts to remesh where triangles crossed however short the edges: old triangles stay.
  std::uint64_t remeshing_halvings = 0;
  /// Improvements of the worst triangles of a new surface that were not at their end.
  std::uint64_t remeshing_sweeps = 0;
  /// Times that features would have cost too many triangles: their shortest edges are longer.
  std::uint64_t feature_triangles = 0;
  std::uint64_t thin_places = 0;       ///< searches for thin places of a refined surface that left the thinnest out
  std::uint64_t refinement_walks = 0;  ///< places for vertices of a refined surface that were not reached
  /// 1: edges are left that could still be split so that interior points may be near them.
  std::uint64_t rounds_of_room = 0;
  std::uint64_t removal_turns = 0;   ///< Steiner vertices that were left when their turns were over
  std::uint64_t filling_steps = 0;   ///< polyhedra of improvement whose filling was not searched to the end
  std::uint64_t cell_tries = 0;      ///< bad tetrahedra that were given up although something near them had changed
  std::uint64_t shaking_rounds = 0;  ///< 1: very bad tetrahedra were left after all random changes

  /// The peak bytes of a stage's large arrays, both result and working memory: of elements in use, without reserved
  /// memory. It is the same on every machine, unlike the memory of the process, which is `peak_rss_bytes` of
  /// `ccdt.run/1`.
  std::uint64_t peak_bytes = 0;

  /// Adds other work: counts are summed, and maxima stay maxima.
  Work& operator+=(const Work& more);
  friend bool operator==(const Work&, const Work&) = default;
};

/// How to combine two counts.
enum class WorkKind { sum, largest };

struct WorkCount {
  const char* name;
  std::uint64_t Work::*count;
  WorkKind kind = WorkKind::sum;
};

/// All counts, with their names in the `ccdt.run/1` schema.
inline constexpr auto work_counts = std::to_array<WorkCount>({
    {"orient3d_filter_failures", &Work::orient3d_filter_failures},
    {"insphere_filter_failures", &Work::insphere_filter_failures},
    {"centroid_filter_failures", &Work::centroid_filter_failures},
    {"narrow_evaluations", &Work::narrow_evaluations},
    {"wide_evaluations", &Work::wide_evaluations},
    {"perturbed_ties", &Work::perturbed_ties},
    {"exact_evaluations", &Work::exact_evaluations},
    {"octree_nodes", &Work::octree_nodes},
    {"grid_cells", &Work::grid_cells},
    {"box_tree_nodes", &Work::box_tree_nodes},
    {"box_pairs", &Work::box_pairs},
    {"insertions", &Work::insertions},
    {"walk_steps", &Work::walk_steps},
    {"cells_tested", &Work::cells_tested},
    {"cells_created", &Work::cells_created},
    {"cells_destroyed", &Work::cells_destroyed},
    {"largest_cavity", &Work::largest_cavity, WorkKind::largest},
    {"large_cavities", &Work::large_cavities},
    {"cells_visited", &Work::cells_visited},
    {"apex_searches", &Work::apex_searches},
    {"vertices_examined", &Work::vertices_examined},
    {"edges_tested", &Work::edges_tested},
    {"edges_flipped", &Work::edges_flipped},
    {"triangles_visited", &Work::triangles_visited},
    {"fold_rounds", &Work::fold_rounds},
    {"octree_nodes_created", &Work::octree_nodes_created},
    {"rays_cast", &Work::rays_cast},
    {"ray_triangles", &Work::ray_triangles},
    {"sites_tested", &Work::sites_tested},
    {"obstacles_tested", &Work::obstacles_tested},
    {"faces_tested", &Work::faces_tested},
    {"front_candidates", &Work::front_candidates},
    {"visibility_tests", &Work::visibility_tests},
    {"piercing_tests", &Work::piercing_tests},
    {"changes_tried", &Work::changes_tried},
    {"moves_tried", &Work::moves_tried},
    {"vertices_moved", &Work::vertices_moved},
    {"ascent_steps", &Work::ascent_steps},
    {"quality_evaluations", &Work::quality_evaluations},
    {"remesh_rounds", &Work::remesh_rounds},
    {"edges_split", &Work::edges_split},
    {"edges_collapsed", &Work::edges_collapsed},
    {"triangles_evaluated", &Work::triangles_evaluated},
    {"peak_bytes", &Work::peak_bytes, WorkKind::largest},
});

/// How often a limit ended a search early, so that the result is worse than it could be; with their names in
/// `limits_reached` of `ccdt.run/1`, whose schema says what each means for the mesh. Limits that belong to the
/// definition of an algorithm, and those that end in an error, are not among them.
inline constexpr auto limit_counts = std::to_array<WorkCount>({
    {"remeshing_halvings", &Work::remeshing_halvings},
    {"remeshing_sweeps", &Work::remeshing_sweeps},
    {"feature_triangles", &Work::feature_triangles},
    {"thin_places", &Work::thin_places},
    {"refinement_walks", &Work::refinement_walks},
    {"rounds_of_room", &Work::rounds_of_room},
    {"removal_turns", &Work::removal_turns},
    {"filling_steps", &Work::filling_steps},
    {"cell_tries", &Work::cell_tries},
    {"shaking_rounds", &Work::shaking_rounds},
});
static_assert(sizeof(Work) == (work_counts.size() + limit_counts.size()) * sizeof(std::uint64_t),
              "every count has its name");

inline Work& Work::operator+=(const Work& more) {
  const auto add = [&](const WorkCount& c) {
    if (c.kind == WorkKind::sum)
      this->*c.count += more.*c.count;
    else if (more.*c.count > this->*c.count)
      this->*c.count = more.*c.count;
  };
  for (const WorkCount& c : work_counts) add(c);
  for (const WorkCount& c : limit_counts) add(c);
  return *this;
}

}  // namespace ccdt
