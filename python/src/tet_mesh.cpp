#include "engine/mesh/tet_mesh.h"

#include <pybind11/stl.h>

#include "python/src/arrays.h"
#include "python/src/bindings.h"

namespace ccdt::python {
using mesh::TetMesh;

void bind_tet_mesh(py::module_& module) {
  py::class_<TetMesh> type(module, "TetMesh");
  type.def(py::init<>());
  type.def_readwrite("names", &TetMesh::face_names);
  type.def_readonly("constrained_delaunay", &TetMesh::constrained_delaunay);
  add_list(type, "vertices", &TetMesh::vertices);
  add_list(type, "tetrahedra", &TetMesh::tetrahedra);
  add_list(type, "regions", &TetMesh::regions);
  add_list(type, "faces", &TetMesh::faces);
  add_list(type, "face_markers", &TetMesh::face_markers);
  add_list(type, "edges", &TetMesh::edges);
  add_list(type, "edge_markers", &TetMesh::edge_markers);
}

}  // namespace ccdt::python
