#include "engine/io/tet_mesh_files.h"

#include "engine/base/errors.h"
#include "engine/io/tet_mesh_formats.h"

namespace ccdt {

namespace {

struct Format {
  std::string_view ending;
  TetMesh (*read)(const io::FileBytes&);  ///< null: TetGen's, of several files
  void (*write)(const TetMesh&, io::OutputFile&);
};

constexpr Format formats[] = {
    {".mesh", io::read_medit_mesh, io::write_medit_mesh},
    {".vtu", io::read_vtu, io::write_vtu},
    {".msh", io::read_gmsh, io::write_gmsh},
    {".node", nullptr, nullptr},
    {".ele", nullptr, nullptr},
    {".face", nullptr, nullptr},
};

const char* known_endings = ".mesh (Medit), .vtu (VTK), .msh (Gmsh), .node, .ele and .face (TetGen)";

const Format* format_of(const std::filesystem::path& file) {
  const std::string ending = io::lower_ending(file);
  for (const Format& format : formats)
    if (format.ending == ending) return &format;
  return nullptr;
}

}  // namespace

namespace io {

bool claims_constrained_delaunay(const FileBytes& file) {
  return std::string_view(file.bytes).substr(0, 1024).find(constrained_delaunay_claim) != std::string_view::npos;
}

}  // namespace io

bool is_tet_mesh_file(const std::filesystem::path& file) {
  return format_of(file) != nullptr;
}

void write_tet_mesh(const TetMesh& mesh, const std::filesystem::path& file) {
  const Format* format = format_of(file);
  if (!format)
    throw OutputError("unknown ending '" + io::lower_ending(file) + "'", io::place_in(file.string()),
                      std::string("choose one of ") + known_endings);
  if (!format->write) return io::write_tetgen_mesh(mesh, file);
  io::OutputFile out(file);
  format->write(mesh, out);
  out.commit();
}

TetMesh read_tet_mesh(const std::filesystem::path& file) {
  if (const Format* format = format_of(file))
    return format->read ? format->read(io::read_whole_file(file)) : io::read_tetgen_mesh(file);
  io::check_is_file(file);  // no such file is the better message
  throw InputError("unknown ending '" + io::lower_ending(file) + "'", io::place_in(file.string()),
                   std::string("known are ") + known_endings + ": convert or rename the file");
}

}  // namespace ccdt
