#include <functional>
#include <random>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

/// Cuts, flips and repeats bytes: any reader must either read the result or throw one of our errors.
void damage_and_read(const std::string& good, const std::filesystem::path& file, const std::function<void()>& read) {
  std::mt19937 random(20250101);
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::string_view tempting = "0123456789-+.eE \n#$<>/\"'\\=_\xff";
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string bytes = good;
    if (round % 3 == 0) bytes.resize(1 + below(bytes.size() - 1));
    for (std::size_t k = round % 3 == 0 ? 0 : 1 + below(4); k > 0; --k)
      bytes[below(bytes.size())] = round % 3 == 1 ? tempting[below(tempting.size())] : static_cast<char>(below(256));
    if (round % 7 == 6) bytes.insert(below(bytes.size()), bytes.substr(below(bytes.size()), 20));
    put(file, bytes);
    try {
      read();
    } catch (const Error& error) {
      ++refused;
      EXPECT_FALSE(error.remedy().empty());
      EXPECT_FALSE(error.place().file.empty());
    }
  }
  EXPECT_GT(refused, 10) << file << ": most damage must be seen";
}

TEST(DamagedFiles, PlcReadersReadOrRefuse) {
  const Folder folder;
  for (const std::string name :
       {"a.poly", "a.smesh", "a.mesh", "a.meshb", "a.off", "a.obj", "a.ply", "a.stl", "a.node", "text.stl"}) {
    SCOPED_TRACE(name);
    plc::InputPlc plc = name == "a.poly" ? rich_plc() : awkward_surface();
    if (name == "a.stl") plc.polygon_facets.clear(), plc.vertices.assign(5, {1, 2, 3});
    if (name == "a.node")
      put(folder / name, "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
    else if (name == "text.stl")
      put(folder / name,
          "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
          "0\nendloop\nendfacet\nendsolid x\n");
    else
      io::write_plc(plc, folder / name);
    damage_and_read(bytes_of(folder / name), folder / name, [&] { io::read_plc(folder / name); });
  }
}

TEST(DamagedFiles, TetMeshReadersReadOrRefuse) {
  const Folder folder;
  for (const std::string name : {"a.mesh", "a.meshb", "a.vtu", "a.msh", "a.msh4"}) {
    SCOPED_TRACE(name);
    io::write_tet_mesh(small_mesh(), folder / name);
    damage_and_read(bytes_of(folder / name), folder / name, [&] { io::read_tet_mesh(folder / name); });
  }
  for (const std::string name : {"b.node", "b.ele", "b.face", "b.edge"}) {
    SCOPED_TRACE(name);
    io::write_tet_mesh(small_mesh(), folder / "b.node");
    damage_and_read(bytes_of(folder / name), folder / name, [&] { io::read_tet_mesh(folder / "b.node"); });
  }
}

}  // namespace
}  // namespace ccdt
