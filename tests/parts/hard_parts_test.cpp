#include <gtest/gtest.h>

#include <cctype>
#include <utility>

#include "bench/verify/verify.h"
#include "engine/io/plc_files.h"
#include "engine/mesher.h"
#include "engine/plc/warped_facets.h"
#include "engine/tests/shared/plc_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "tests/fuzz/prove.h"
#include "tests/fuzz/structured_plc.h"

// Surfaces that once made the engine fail, meshed with all strategies and verified: `ctest -L hard`.

namespace ccdt {
namespace {

using HardPart = testing::TestWithParam<std::filesystem::path>;
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(HardPart);

TEST_P(HardPart, IsMeshedWithAllLatticesImprovedOrNot) {
  const InputPlc given = io::read_plc(GetParam()), input = plc::triangulate_warped_facets(given).value_or(given);
  for (const Lattice lattice : {Lattice::none, Lattice::fcc, Lattice::bcc, Lattice::sc})
    for (const Improvement improvement : {Improvement::none, Improvement::all}) {
      SCOPED_TRACE(std::string(name_of(lattice)) + ", improve " + std::string(name_of(improvement)));
      MeshOptions options;
      options.lattice = lattice;
      options.improve.improvement = improvement;
      const verify::Verification verification = verify::verify(input, mesh_plc(input, options).mesh);
      for (const verify::Check& check : verification.checks)
        EXPECT_FALSE(check.required && check.failed > 0) << check.name << ": " << check.failed << " fail";
    }
}

INSTANTIATE_TEST_SUITE_P(Files, HardPart, testing::ValuesIn(surfaces_in(folder_of_hard_parts())), [](const auto& part) {
  std::string name = part.param.filename().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

// The file is of single precision. Once the part is turned, its coordinates no longer show that rounding has bent its
// flat facets. Many of them must be divided.
TEST(TurnedPart, IsMeshedThoughRoundingHasBentItsFacets) {
  const std::filesystem::path file = folder_of_hard_parts() / "kingroon_kp3.stl";
  if (!exists(file)) GTEST_SKIP() << file << " is missing";
  const InputPlc part = io::read_plc(file);
  for (const auto& [turn, lattice] : {std::pair{plc_test::rotation(1, 1, 2, 1), Lattice::none},
                                      {plc_test::rotation(3, 2, 2, 1), Lattice::none},
                                      {plc_test::rotation(1, 2, 3, 4), Lattice::fcc}}) {
    const InputPlc input = plc_test::rotated(turn, part);
    MeshOptions options;
    options.lattice = lattice;
    EXPECT_TRUE(verify::verify(input, mesh_plc(input, options).mesh).ok());
  }
}

// Its nearly flat facets would meet each other if they all followed the Delaunay tetrahedralization.
TEST(TurnedPart, IsMeshedThoughItsFacetsAreHardlyApart) {
  const std::filesystem::path file = folder_of_hard_parts() / "trimaker_nebula_platform.stl";
  if (!exists(file)) GTEST_SKIP() << file << " is missing";
  const InputPlc input = plc_test::rotated(plc_test::rotation(1, 1, 1, 2), io::read_plc(file));
  MeshOptions options;
  options.lattice = Lattice::none;
  EXPECT_TRUE(verify::verify(input, mesh_plc(input, options).mesh).ok());
}

// New faces of its nearly flat facets could take space outside where another part of the domain is.
TEST(TurnedPart, StaysRightWithoutItsSteinerVertices) {
  const std::filesystem::path file = folder_of_hard_parts() / "kingroon_kp3.stl";
  if (!exists(file)) GTEST_SKIP() << file << " is missing";
  const InputPlc input = plc_test::rotated(plc_test::rotation(-4, -9, 7, -1), io::read_plc(file));
  MeshOptions options;
  options.flatness = 7.1e-8;
  options.lattice = Lattice::none;
  const mesh::TetMesh mesh = mesh_plc(input, options).mesh;
  EXPECT_FALSE(mesh.constrained_delaunay);
  EXPECT_TRUE(verify::verify(input, mesh, {.flatness = 7.1e-8}).ok());
}

TEST(ProvingGround, ABundleOfManyPiecesIsRight) {
  const fuzz::Proof proof = fuzz::prove(fuzz::structured_plc(4543), {.seconds = 600});
  EXPECT_EQ(proof.outcome, fuzz::Proof::Outcome::right) << proof.what;
}

}  // namespace
}  // namespace ccdt
