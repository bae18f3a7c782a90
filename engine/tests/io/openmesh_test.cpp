// clang-format off
#include <OpenMesh/Core/IO/MeshIO.hh>  // must come before the mesh types
// clang-format on
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using OpenMeshSurface = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

plc::InputPlc pyramid() {
  plc::InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1.5, 0, 0}, {1.5, 1.25, 0}, {0, 1.25, 0}, {0.75, 0.5, -2}};
  plc.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  plc.polygon_facets.push_back({{{3, 2, 1, 0}}, {}, 0, 4});
  return plc;
}

TEST(OpenMeshCrossRead, ReadsTheSameSurfaceFromWhatWeWrite) {
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl"}) {
    SCOPED_TRACE(name);
    const Folder folder;
    plc::InputPlc plc = pyramid();
    if (std::string(name) == "a.stl") {
      plc.polygon_facets.clear();
      plc.triangles.push_back({2, 1, 0}), plc.triangles.push_back({3, 2, 0});
    }
    io::write_plc(plc, folder / name);
    OpenMeshSurface mesh;
    OpenMesh::IO::Options options = OpenMesh::IO::Options::Default;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, (folder / name).string(), options));
    EXPECT_EQ(mesh.n_vertices(), plc.vertices.size());
    EXPECT_EQ(mesh.n_faces(), plc.facet_count());
    const plc::InputPlc ours = io::read_plc(folder / name);
    ASSERT_EQ(ours.vertices.size(), mesh.n_vertices());
    if (std::string(name) == "a.stl") continue;  // merged by either in its own order
    for (const auto vertex : mesh.vertices()) {
      const OpenMesh::Vec3d p = mesh.point(vertex);
      EXPECT_EQ(ours.vertices[static_cast<std::size_t>(vertex.idx())], (Point3{p[0], p[1], p[2]}));
    }
  }
}

TEST(OpenMeshCrossRead, WeReadWhatItWrites) {
  OpenMeshSurface mesh;
  std::vector<OpenMeshSurface::VertexHandle> handles;
  for (const Point3& p : pyramid().vertices) handles.push_back(mesh.add_vertex({p.x, p.y, p.z}));
  for (const auto& t : pyramid().triangles) mesh.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
  mesh.add_face(handles[3], handles[2], handles[1], handles[0]);
  for (const char* name : {"a.off", "a.obj", "a.ply"})
    for (const bool binary : {false, true}) {
      if (binary && std::string(name) != "a.ply") continue;  // we read no binary OFF, and OBJ has none
      SCOPED_TRACE(name);
      const Folder folder;
      OpenMesh::IO::Options options = binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default;
      ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, (folder / name).string(), options));
      const plc::InputPlc plc = io::read_plc(folder / name);
      EXPECT_EQ(plc.vertices, pyramid().vertices);
      EXPECT_EQ(plc.triangles, pyramid().triangles);
      ASSERT_EQ(plc.polygon_facets.size(), 1u);
      EXPECT_EQ(plc.polygon_facets[0].polygons[0].size(), 4u);
    }
}

}  // namespace
}  // namespace ccdt
