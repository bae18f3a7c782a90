#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/point.h"
#include "engine/tets/cell_complex.h"
#include "engine/tets/vertex_sides.h"

namespace ccdt::tets {

/// Fills a polyhedron with tetrahedra, adding no vertices: joins its faces to one of its vertices or, if none sees them
/// all, searches. At each step of the search, a tetrahedron is put onto the face of the front with the fewest possible
/// apexes (after Liu, Sun, Wang 2006, "Small polyhedron reconnection"; Marot, Verhetsel, Remacle 2020, "Reviving the
/// search for optimal tetrahedralizations").
///
/// The result is right by construction: all tetrahedra are exactly positive, and each of their faces is shared by two
/// of them or is one of the polyhedron. The tests for crossings only cut the search short.
class PolyhedronFiller {
 public:
  /// A polyhedron with more vertices is not tried.
  static constexpr std::size_t most_vertices = VertexSides::most_vertices;

  /// Fills a polyhedron.
  ///
  /// \param hull   corners of its faces, the inside above
  /// \param least  all tetrahedra are better than this
  /// \param cells  get the tetrahedra
  /// \return       were they found? The search gives up after a number of steps.
  bool fill(const CellComplex& complex, const std::vector<Triangle>& hull, int region, double least,
            std::vector<NewCell>& cells);

 private:
  /// A face between the filled part, below, and the unfilled part, above.
  struct FrontFace {
    CornerTriangle corners;
    Sides sides;
    CornerSet apexes;  ///< possible apexes if nothing were filled yet
  };
  /// By vertex: the other ends of edges.
  using EdgeSets = std::array<CornerSet, most_vertices>;

  bool load(const CellComplex& complex, const std::vector<Triangle>& hull);
  void find_free_edges();
  void add_front(const CornerTriangle& t);
  bool join_to_vertex();
  double quality_on(const CornerTriangle& t, Corner apex) const;
  double quality_from(Corner v, double least) const;
  bool keeps_all_faces(Corner v) const;
  bool has_apex(const CornerTriangle& t) const;
  bool search();
  bool search_on();
  bool is_blocked(const CornerTriangle& base, Corner apex) const;
  bool is_pierced(const CornerTriangle& t) const;
  bool put(const CornerTriangle& base, Corner apex);

  QualityGoal goal_;
  double least_ = 0;
  std::vector<std::uint32_t> vertices_;
  std::vector<Point3> points_;
  std::vector<CornerTriangle> hull_;
  VertexSides sides_;
  EdgeSets free_edges_{};  // those that do not cross the hull
  std::vector<FrontFace> front_;
  std::vector<FrontFace> saved_front_;  // of all steps of the search, one after another
  EdgeSets edges_{};                    // of the hull and the tetrahedra
  std::vector<std::array<Corner, 4>> tetrahedra_;
  int steps_left_ = 0;
};

}  // namespace ccdt::tets
