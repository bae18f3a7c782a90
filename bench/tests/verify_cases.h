#pragma once

#include <string>

#include "bench/tests/grid_mesh.h"
#include "bench/verify/verify.h"

namespace ccdt {

std::string all_lines(const verify::Verification& verification);
const verify::Check& check_named(const verify::Verification& verification, const std::string& name);

/// Most of these meshes list no faces.
inline constexpr verify::VerifyOptions tetrahedra_alone = {.lists = verify::VerifyOptions::Lists::tetrahedra};

void expect_ok(const MeshedInput& m, verify::VerifyOptions options = tetrahedra_alone);
/// The check of that name fails, and says where.
void expect_failure(const MeshedInput& m, const std::string& name, verify::VerifyOptions options = tetrahedra_alone);

int everywhere(int, int, int);
int around_a_hole(int i, int j, int k);

/// 3 x 3 x 3 unit cubes.
MeshedInput cube();
/// 4 x 3 x 3 unit cubes; those with x < 2 have region 1, the others 2.
MeshedInput two_regions(bool turned_diagonals = false, const Transform& transform = unmoved);
/// The unit cube as six quadrilaterals.
plc::InputPlc unit_cube();
MeshedInput cube_in_five();
/// A triangle and two points far above and below it: two tetrahedra are Delaunay, three around the axis are not.
MeshedInput bipyramid(bool delaunay);
/// A plate with a square hole through it; its top and bottom are polygons with holes.
MeshedInput plate();

std::uint32_t vertex_at(const mesh::TetMesh& mesh, const Point3& p);

}  // namespace ccdt
