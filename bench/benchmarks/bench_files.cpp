// What is measured: read_plc and read_tet_mesh, from a file in the system's cache to the surface or mesh in
// memory. bytes_per_second counts the bytes of the file.
//
//   read/surface/FORMAT/sheet/N     a curved sheet of N triangles
//   read/surface/FORMAT/piston/N    the surface of a mesh of about N vertices
//   read/mesh/FORMAT/piston/N       that mesh
//   read/surface/FORMAT/FILE, read/mesh/FORMAT/FILE    the same for a file given by --input
//
// "vertices" are those that are read, "cells" the tetrahedra. Before anything is timed, what is read must be what was
// written.

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>

#include "bench/benchmarks/benchmark_main.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::benchmarks {
namespace {

/// A folder that is gone when the program ends.
class Folder {
 public:
  Folder() { std::filesystem::create_directories(path_); }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("ccdt-bench-files-" + std::to_string(::getpid()));
};

plc::InputPlc sheet_of(std::int64_t triangles) {
  const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
  plc::InputPlc sheet;
  for (std::uint32_t i = 0; i <= side; ++i)
    for (std::uint32_t j = 0; j <= side; ++j)
      sheet.vertices.push_back({0.01 * i + std::cos(0.1 * j), 0.013 * j, std::sin(0.07 * i + 0.02 * j)});
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      sheet.triangles.push_back({a, a + 1, b});
      sheet.triangles.push_back({a + 1, b + 1, b});
    }
  return sheet;
}

plc::InputPlc surface_of(const Stages& s) {
  plc::InputPlc surface;
  surface.vertices.assign(s.plc.vertices.begin(), s.plc.vertices.end());
  for (const auto& [a, b, c] : s.plc.triangles) surface.triangles.push_back({a, b, c});
  return surface;
}

mesh::TetMesh mesh_of(const Stages& s) {
  mesh::TetMesh mesh;
  mesh.vertices = points_of(s.delaunay);
  mesh.tetrahedra = s.tetrahedra;
  mesh.regions.assign(mesh.tetrahedra.size(), 1);
  mesh.faces = surface_of(s).triangles;
  mesh.face_markers.assign(mesh.faces.size(), 2);
  return mesh;
}

// write_plc writes STL and PLY in binary only.

void write_stl_text(const plc::InputPlc& plc, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "solid sheet\n" << std::scientific << std::setprecision(8);
  for (const auto& triangle : plc.triangles) {
    out << "  facet normal 0.0 0.0 1.0\n    outer loop\n";
    for (const std::uint32_t v : triangle)
      out << "      vertex " << plc.vertices[v].x << ' ' << plc.vertices[v].y << ' ' << plc.vertices[v].z << '\n';
    out << "    endloop\n  endfacet\n";
  }
  out << "endsolid sheet\n";
}

void write_ply_text(const plc::InputPlc& plc, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "ply\nformat ascii 1.0\nelement vertex " << plc.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << plc.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n"
      << std::setprecision(17);
  for (const Point3& p : plc.vertices) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& [a, b, c] : plc.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
}

struct SurfaceFormat {
  std::string name, ending;
  void (*write)(const plc::InputPlc&, const std::filesystem::path&) = io::write_plc;
  bool keeps_vertices = true;  ///< STL rounds them, and two may become one
};

const std::vector<SurfaceFormat>& surface_formats() {
  static const std::vector<SurfaceFormat> formats = {{"stl", ".stl", io::write_plc, false},
                                                     {"stl-text", ".stl", write_stl_text, false},
                                                     {"off", ".off"},
                                                     {"obj", ".obj"},
                                                     {"ply", ".ply"},
                                                     {"ply-text", ".ply", write_ply_text},
                                                     {"poly", ".poly"},
                                                     {"smesh", ".smesh"},
                                                     {"mesh", ".mesh"},
                                                     {"meshb", ".meshb"}};
  return formats;
}

const std::vector<std::string> mesh_endings = {".mesh", ".meshb", ".vtu", ".msh", ".msh4", ".ele"};

/// The file of a subject in a format. The first call writes it.
template <class Write>
std::filesystem::path file_of(const std::string& name, const std::string& ending, const Write& write) {
  static const Folder folder;
  static std::map<std::string, std::filesystem::path> written;
  auto& file = written[name];
  if (file.empty()) {
    file = folder / (std::to_string(written.size()) + ending);
    write(file);
  }
  return file;
}

/// All bytes that are read: a mesh of TetGen consists of several files.
std::size_t bytes_of(const std::filesystem::path& file) {
  std::size_t bytes = std::filesystem::file_size(file);
  if (file.extension() != ".ele") return bytes;
  for (const char* ending : {".node", ".face", ".edge"})
    bytes += std::filesystem::file_size(std::filesystem::path(file).replace_extension(ending));
  return bytes;
}

void set_bytes(benchmark::State& state, const std::filesystem::path& file) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes_of(file)));
}

using Surface = std::function<plc::InputPlc(std::int64_t size)>;

void add_surface(const std::string& subject, const std::vector<std::int64_t>& sizes, const Surface& surface) {
  for (const SurfaceFormat& format : surface_formats()) {
    const std::string name = "read/surface/" + format.name + "/" + subject;
    const auto file = [=](std::int64_t size) {
      return file_of(name + "/" + std::to_string(size), format.ending,
                     [&](const std::filesystem::path& f) { format.write(surface(size), f); });
    };
    add_family({.name = name,
                .sizes = sizes,
                .find_fault = [=](std::int64_t size) -> std::string {
                  const plc::InputPlc read = io::read_plc(file(size)), wanted = surface(size);
                  if (read.triangles.size() != wanted.triangles.size()) return "different triangles were read";
                  if (format.keeps_vertices && read.vertices != wanted.vertices) return "different vertices were read";
                  if (format.keeps_vertices && read.triangles != wanted.triangles) return "different corners were read";
                  return {};
                },
                .measure =
                    [=](benchmark::State& state, std::int64_t size) {
                      const std::filesystem::path read = file(size);
                      std::size_t vertices = 0;
                      time_runs(state, [&] {
                        plc::InputPlc plc = io::read_plc(read);
                        vertices = plc.vertices.size();
                        return plc;
                      });
                      set_counters(state, vertices, 0);
                      set_bytes(state, read);
                    }});
  }
}

using StagesOf = std::function<const Stages&(std::int64_t size)>;

void add_mesh(const std::string& subject, const std::vector<std::int64_t>& sizes, const StagesOf& stages) {
  for (const std::string& ending : mesh_endings) {
    const std::string name = "read/mesh/" + ending.substr(1) + "/" + subject;
    const auto file = [=](std::int64_t size) {
      return file_of(name + "/" + std::to_string(size), ending,
                     [&](const std::filesystem::path& f) { io::write_tet_mesh(mesh_of(stages(size)), f); });
    };
    add_family({.name = name,
                .sizes = sizes,
                .find_fault = [=](std::int64_t size) -> std::string {
                  const mesh::TetMesh read = io::read_tet_mesh(file(size)), wanted = mesh_of(stages(size));
                  if (read.vertices != wanted.vertices) return "different vertices were read";
                  if (read.tetrahedra != wanted.tetrahedra) return "different tetrahedra were read";
                  return read.faces == wanted.faces ? "" : "different faces were read";
                },
                .measure =
                    [=](benchmark::State& state, std::int64_t size) {
                      const std::filesystem::path read = file(size);
                      time_runs(state, [&] { return io::read_tet_mesh(read); });
                      set_counters(state, stages(size).delaunay.vertices.size(), stages(size).tetrahedra.size());
                      set_bytes(state, read);
                    }});
  }
}

void add_both(const std::string& subject, const std::vector<std::int64_t>& sizes, const StagesOf& stages) {
  add_surface(subject, sizes, [stages](std::int64_t size) { return surface_of(stages(size)); });
  add_mesh(subject, sizes, stages);
}

}  // namespace

void add_benchmarks(const Files& files) {
  add_surface("sheet", {10000, 100000, 1000000}, sheet_of);
  add_both("piston", {model_sizes.begin(), model_sizes.end()},
           [](std::int64_t size) -> const Stages& { return stages_of_model("piston", false, size); });
  for (const auto& file : files)
    add_both(file.filename().string(), {}, [file](std::int64_t) -> const Stages& { return stages_of_file(file); });
}

}  // namespace ccdt::benchmarks
