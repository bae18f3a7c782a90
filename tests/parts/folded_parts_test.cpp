#include <gtest/gtest.h>

#include "bench/verify/verify.h"
#include "engine/io/plc_files.h"
#include "engine/mesher.h"
#include "engine/plc/warped_facets.h"
#include "engine/tests/shared/real_parts.h"

// Small inputs with facets that are flat only within the tolerance, and that no mesh has without dividing these.

namespace ccdt {
namespace {

class FoldedPart : public testing::TestWithParam<std::filesystem::path> {};

std::uint64_t fold_rounds(const MeshResult& result) {
  std::uint64_t rounds = 0;
  for (const StageCost& cost : result.costs.stages) rounds += cost.work.fold_rounds;
  return rounds;
}

TEST_P(FoldedPart, IsMeshedWithAllLattices) {
  const InputPlc given = io::read_plc(GetParam()), input = plc::triangulate_warped_facets(given).value_or(given);
  std::uint64_t rounds = 0;
  for (const Lattice lattice : {Lattice::none, Lattice::fcc, Lattice::bcc, Lattice::sc})
    for (const Improvement improvement : {Improvement::none, Improvement::all}) {
      SCOPED_TRACE(std::string(name_of(lattice)) + ", improve " + std::string(name_of(improvement)));
      MeshOptions options;
      options.lattice = lattice;
      options.improve.improvement = improvement;
      const MeshResult result = mesh_plc(input, options);
      rounds += fold_rounds(result);
      const verify::Verification verification = verify::verify(input, result.mesh);
      for (const verify::Check& check : verification.checks)
        EXPECT_FALSE(check.required && check.failed > 0) << check.name << ": " << check.failed << " fail";
    }
  EXPECT_GT(rounds, 0u) << "none of its facets must be divided";
}

INSTANTIATE_TEST_SUITE_P(Files, FoldedPart,
                         testing::ValuesIn(surfaces_in(std::filesystem::path(CCDT_SOURCE_DIR) / "tests/parts/folded")),
                         [](const auto& part) { return "Number" + part.param.stem().string(); });

}  // namespace
}  // namespace ccdt
