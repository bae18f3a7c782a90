#include <array>
#include <cmath>

#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/geometry/tetrahedron_shape.h"
#include "engine/mesh/tet_mesh.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"

namespace ccdt::python {
namespace {

using mesh::TetMesh;

/// The corners of a tetrahedron, in another unit of length: with a power of two, no digit changes, and products of
/// lengths neither overflow nor vanish.
class Corners {
 public:
  explicit Corners(const TetMesh& mesh) : mesh_(mesh) {
    const double extent = largest_extent(mesh.vertices);
    exponent_ = extent > 0 && std::isfinite(extent) ? std::ilogb(extent) : 0;
  }
  std::array<Point3, 4> operator[](std::size_t t) const {
    std::array<Point3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k)
      corners[k] = std::ldexp(1, -exponent_) * mesh_.vertices.at(mesh_.tetrahedra[t][k]);
    return corners;
  }
  int exponent() const { return exponent_; }

 private:
  const TetMesh& mesh_;
  int exponent_ = 0;
};

/// Measures every tetrahedron.
///
/// \param measure  from the shape and the exponent of the unit of length to a number or an array
template <class Measure>
auto measured(const TetMesh& mesh, const Measure& measure) {
  using Value = decltype(measure(std::declval<TetrahedronShape>(), 0));
  auto values = std::make_unique<std::vector<Value>>(mesh.tetrahedra.size());
  {
    const py::gil_scoped_release released;
    const Corners corners(mesh);
    parallel_for(values->size(), 4096,
                 [&](std::size_t t) { (*values)[t] = measure(TetrahedronShape(corners[t]), corners.exponent()); });
  }
  std::vector<Value>& all = *values;
  const py::capsule owner(values.release(), [](void* last) { delete static_cast<std::vector<Value>*>(last); });
  return view_of(all, owner);
}

}  // namespace

void bind_quality(py::module_& module) {
  module.def("dihedral_angles", [](const TetMesh& mesh) {
    return measured(mesh, [](const TetrahedronShape& shape, int) { return dihedral_angles(shape); });
  });
  module.def("shape_measures", [](const TetMesh& mesh) {
    return measured(mesh, [](const TetrahedronShape& shape, int) { return shape_measure(shape); });
  });
  module.def("aspect_ratios", [](const TetMesh& mesh) {
    return measured(mesh, [](const TetrahedronShape& shape, int) { return aspect_ratio(shape); });
  });
  module.def("radius_edge_ratios", [](const TetMesh& mesh) {
    return measured(mesh, [](const TetrahedronShape& shape, int) { return radius_edge_ratio(shape); });
  });
  module.def("volumes", [](const TetMesh& mesh) {
    return measured(mesh, [](const TetrahedronShape& shape, int exponent) {
      return std::ldexp(shape.six_volumes / 6, 3 * exponent);
    });
  });
}

}  // namespace ccdt::python
