// Shows progress and cancels: an exception from the callback ends the meshing and reaches the caller.
//
//   progress_and_cancel INPUT [STAGE]      cancels in this stage, such as "delaunay"
#include <ccdt/ccdt.h>

#include <cstdio>
#include <string>

namespace {
struct Canceled {};
}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string cancel_in = argc > 2 ? argv[2] : "";
  std::string last;
  // Called often: print only what is new.
  const auto show = [&](std::string_view stage, std::uint64_t, std::uint64_t) {
    if (stage == cancel_in) throw Canceled{};
    if (stage == last) return;
    last = stage;
    std::printf("stage %s\n", last.c_str());
  };

  ccdt::MeshOptions options;
  options.edge_length = 0.2;
  try {
    const ccdt::TetMesh mesh = ccdt::mesh_plc(ccdt::read_plc(argv[1]), options, show).mesh;
    std::printf("%s\n", mesh.tetrahedra.empty() ? "no mesh" : "done");
  } catch (const Canceled&) {
    std::printf("canceled in %s\n", cancel_in.c_str());
  }
}
