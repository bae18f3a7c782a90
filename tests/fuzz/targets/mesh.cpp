#include "engine/base/box.h"
#include "tests/fuzz/structured_plc.h"
#include "tests/fuzz/targets/right_mesh.h"

// Meshes structured PLCs with any options. The first bytes choose the options, the others what is built.

namespace ccdt::fuzz {
namespace {

MeshOptions options_of(Bytes& bytes) {
  MeshOptions options;
  options.threads = 1;
  options.thin_tetrahedra = 2000;
  options.face_protection = bytes.flag();
  options.lattice = bytes.pick<Lattice>();
  options.protection = bytes.pick<protection::Protection>();
  options.locator = bytes.pick<LocatorKind>();
  options.delaunay = bytes.pick<DelaunayMethod>();
  options.visibility = bytes.pick<Visibility>();
  options.surface = bytes.flag() ? SurfaceRule::refine : SurfaceRule::keep;  // remeshing takes seconds
  options.improve.improvement = bytes.pick<Improvement>();
  options.improve.objective = bytes.pick<Objective>();
  options.improve.boundary = bytes.pick<BoundaryRule>();
  options.improve.steiner = bytes.pick<SteinerRule>();
  options.least_core = bytes.flag() ? 0 : MeshOptions().least_core;
  options.edge_length = bytes.pick(std::array{0.25, 0.5, 0.125});  // of the input
  options.grading = bytes.pick(std::array{0.5, 0.0, 2.0});
  return options;
}

void try_bytes(Bytes bytes) {
  MeshOptions options = options_of(bytes);
  Random random(0, bytes.rest());
  const InputPlc input = structured_plc(random);
  options.edge_length *= largest_extent(input.vertices);
  require_right_mesh(input, options, 2);
}

}  // namespace
}  // namespace ccdt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ccdt::fuzz::accepts([&] { ccdt::fuzz::try_bytes({data, size}); });
  return 0;
}
