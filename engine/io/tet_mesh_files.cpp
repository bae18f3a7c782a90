#include "engine/io/tet_mesh_files.h"

#include "engine/base/errors.h"
#include "engine/io/formats.h"

namespace ccdt::io {

namespace {

struct TetMeshFormat {
  std::string_view ending;
  mesh::TetMesh (*read)(const FileBytes&) = nullptr;  ///< null: TetGen's, of several files
  void (*write)(const mesh::TetMesh&, OutputFile&) = nullptr;
};

constexpr TetMeshFormat formats[] = {
    {".mesh", read_medit_mesh, write_medit_mesh},
    {".vtu", read_vtu, write_vtu},
    {".msh", read_gmsh, write_gmsh},
    {".node"},
    {".ele"},
    {".face"},
};

const char* known_endings = ".mesh (Medit), .vtu (VTK), .msh (Gmsh), .node, .ele and .face (TetGen)";

const TetMeshFormat* format_of(const std::filesystem::path& file) {
  const auto format = std::ranges::find(formats, lower_ending(file), &TetMeshFormat::ending);
  return format == std::end(formats) ? nullptr : format;
}

}  // namespace

bool is_tet_mesh_file(const std::filesystem::path& file) {
  return format_of(file) != nullptr;
}

void write_tet_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file) {
  const TetMeshFormat* format = format_of(file);
  if (!format)
    throw OutputError("unknown ending '" + lower_ending(file) + "'", place_in(file.string()),
                      std::string("choose one of ") + known_endings);
  if (!format->write) return write_tetgen_mesh(mesh, file);
  OutputFile out(file);
  format->write(mesh, out);
  out.commit();
}

mesh::TetMesh read_tet_mesh(const std::filesystem::path& file) {
  if (const TetMeshFormat* format = format_of(file))
    return format->read ? format->read(read_whole_file(file)) : read_tetgen_mesh(file);
  check_is_file(file);  // no such file is the better message
  throw InputError("unknown ending '" + lower_ending(file) + "'", place_in(file.string()),
                   std::string("known are ") + known_endings + ": convert or rename the file");
}

}  // namespace ccdt::io
