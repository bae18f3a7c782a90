#include "engine/improve/improve_mesh.h"

#include "engine/improve/cell_complex.h"
#include "engine/improve/find_freedom.h"
#include "engine/improve/improve_cells.h"
#include "engine/improve/sort_cells.h"

namespace ccdt {

ImproveCounts improve_mesh(const Plc& plc, const SegmentChains& chains, std::vector<std::uint32_t> facet_of_face,
                           std::size_t first_interior, const ImproveOptions& options, std::vector<Point3>& points,
                           TetMesh& mesh, const Progress& progress) {
  std::vector<Freedom> freedom;
  if (options.boundary == BoundaryRule::slide) freedom = find_freedom(plc, chains, points.size());
  sort_cells(mesh);
  CellComplex complex = make_complex(mesh, std::move(points), std::move(facet_of_face),
                                     static_cast<std::uint32_t>(first_interior), goal_of(options));
  const ImproveCounts counts = improve_cells(complex, freedom, options, progress);
  if (complex.changes > 0) mesh.constrained_delaunay = false;
  points = take_mesh(std::move(complex), mesh);
  return counts;
}

}  // namespace ccdt
