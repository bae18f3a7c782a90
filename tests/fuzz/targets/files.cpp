#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "engine/io/plc_files.h"
#include "engine/io/read_sizes.h"
#include "engine/io/tet_mesh_files.h"
#include "tests/fuzz/targets/target.h"
#include "tests/fuzz/targets/temporary_folder.h"

// All readers of surfaces, meshes and sizes. The first byte chooses one: 'a' is the first line of the table. Where it
// takes several files, a zero byte is between them. What was read is written and read again, and must be the same.

namespace ccdt::fuzz {
namespace {

using mesh::TetMesh;
using plc::InputPlc;

enum class Kind { plc, mesh, sizes };

struct Door {
  Kind kind;
  std::vector<const char*> endings;  ///< that of the file that is named first, then those beside it
};

const std::vector<Door> doors = {
    {Kind::plc, {".stl"}},
    {Kind::plc, {".off"}},
    {Kind::plc, {".obj"}},
    {Kind::plc, {".ply"}},
    {Kind::plc, {".poly"}},
    {Kind::plc, {".smesh"}},
    {Kind::plc, {".node"}},
    {Kind::plc, {".mesh"}},
    {Kind::plc, {".meshb"}},
    {Kind::mesh, {".mesh"}},
    {Kind::mesh, {".meshb"}},
    {Kind::mesh, {".vtu"}},
    {Kind::mesh, {".msh"}},
    {Kind::mesh, {".node", ".ele", ".face", ".edge"}},
    {Kind::sizes, {".sol", ".mesh"}},
    {Kind::sizes, {".mtr", ".node", ".ele"}},
    {Kind::plc, {".msh"}},
    {Kind::plc, {".vtu"}},
    {Kind::plc, {".vtp"}},
    {Kind::plc, {".off.gz"}},
};

std::filesystem::path write_files(const Door& door, std::string_view contents) {
  for (std::size_t i = 0; i < door.endings.size(); ++i) {
    const std::size_t end = i + 1 == door.endings.size() ? contents.size() : contents.find('\0');
    const std::string name = std::string("given") + door.endings[i];
    if (const std::string_view part = contents.substr(0, end); part.empty())
      std::filesystem::remove(temporary_folder().path() / name);
    else
      temporary_folder().write(name, part);
    contents = end >= contents.size() ? std::string_view() : contents.substr(end + 1);
  }
  return temporary_folder().path() / (std::string("given") + door.endings.front());
}

/// Do two inputs say the same? Only some formats hold markers. Some formats keep triangles and other facets apart.
bool are_same(const InputPlc& a, const InputPlc& b, bool has_markers) {
  const auto facet_of = [&](const plc::PolygonFacet& f) {
    return std::tuple(f.polygons, f.holes, has_markers ? f.marker : 0);
  };
  const auto seed_of = [](const InputPlc::RegionSeed& r) { return std::tuple(r.seed, r.attribute, r.max_volume); };
  return a.inside == b.inside && a.vertices == b.vertices && a.triangles == b.triangles &&
         (!has_markers || a.triangle_markers == b.triangle_markers) && a.segments == b.segments &&
         a.segment_markers == b.segment_markers && a.holes == b.holes &&
         std::ranges::equal(a.regions, b.regions, {}, seed_of, seed_of) &&
         std::ranges::equal(a.polygon_facets, b.polygon_facets, {}, facet_of, facet_of);
}

bool is_written(std::string_view ending) {
  const auto endings = std::to_array<std::string_view>({".node", ".msh", ".vtu", ".vtp", ".off.gz"});
  return std::ranges::find(endings, ending) == endings.end();
}

/// STL has single precision, so what was read may change once.
void try_plc(const std::filesystem::path& file, std::string ending) {
  InputPlc given = io::read_plc(file);
  if (!is_written(ending)) ending = ".poly";
  const auto copy = temporary_folder().path() / ("copy" + ending);
  const auto read_again = [&] {
    io::write_plc(given, copy);
    try {
      return io::read_plc(copy);
    } catch (const InputError& error) {
      throw std::logic_error(std::string("a file of ours cannot be read: ") + error.what());
    }
  };
  if (ending == ".stl") given = read_again();
  const bool has_markers = ending == ".poly" || ending == ".smesh" || ending == ".mesh" || ending == ".meshb";
  require(are_same(given, read_again(), has_markers), "a written surface is another one");
}

void try_mesh(const std::filesystem::path& file) {
  const auto contents = [](const TetMesh& m) {
    return std::tie(m.vertices, m.tetrahedra, m.regions, m.faces, m.face_markers, m.edges, m.edge_markers,
                    m.constrained_delaunay);
  };
  const TetMesh given = io::read_tet_mesh(file);
  for (const char* ending : {".mesh", ".meshb", ".vtu", ".msh", ".msh4", ".node"}) {
    const auto copy = temporary_folder().path() / (std::string("copy") + ending);
    if (!accepts([&] { io::write_tet_mesh(given, copy); })) continue;
    try {
      require(contents(io::read_tet_mesh(copy)) == contents(given), std::string("another mesh in ") + ending);
    } catch (const InputError& error) {
      throw std::logic_error(std::string("a file of ours cannot be read: ") + error.what());
    }
  }
}

void try_file(const Door& door, std::string_view contents) {
  const std::filesystem::path file = write_files(door, contents);
  switch (door.kind) {
    case Kind::plc:
      return try_plc(file, door.endings.front());
    case Kind::mesh:
      return try_mesh(file);
    case Kind::sizes:
      io::read_sizes(file);
  }
}

}  // namespace
}  // namespace ccdt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ccdt::fuzz;
  Bytes bytes(data, size);
  const auto door = static_cast<std::uint8_t>(bytes.next() - 'a') % doors.size();
  accepts([&] { try_file(doors[door], bytes.text()); });
  return 0;
}
