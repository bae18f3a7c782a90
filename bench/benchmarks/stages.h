#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

/// The inputs of each stage of the engine, computed once, so that a benchmark times only its stage.
namespace ccdt::benchmarks {

/// The sizes of the benchmarks: approximate numbers of vertices in the mesh of a model.
inline constexpr std::array<std::int64_t, 5> model_sizes = {5000, 10000, 20000, 40000, 80000};

/// The paper's models.
inline constexpr std::array<const char*, 3> model_names = {"piston", "bracket", "stepping-pole"};

/// The largest size of the flattened models, in which many faces go through the front.
inline constexpr std::int64_t largest_flattened = 20000;

/// The inputs of `place_lattice_points`.
struct LatticeInput {
  std::vector<Point3> vertices;
  std::vector<lattice::SurfaceTriangle> triangles;
  std::vector<std::array<VertexId, 2>> subsegments;
  lattice::LatticeOptions options;  ///< of the kind fcc
};

/// Tetrahedra that can be compared: sorted lists of sorted vertices.
using Tetrahedra = std::vector<std::array<std::uint32_t, 4>>;

/// One run with the default strategies, except for the grid locator, and its results after each stage; in the order of
/// `mesh_plc`.
struct Stages {
  plc::Plc plc;
  delaunay::Delaunay input_delaunay;  ///< of the vertices of the PLC, before protection
  protection::SegmentChains chains;   ///< after protection, and the splits that make room for interior points
  LatticeInput lattice;
  std::size_t first_interior = 0;    ///< the vertices from here on are lattice points
  delaunay::Delaunay delaunay;       ///< of all vertices
  facets::FacetMesh facets;          ///< up to date with all vertices
  std::vector<std::uint32_t> codes;  ///< of the facets' triangles in `delaunay`
  front::FrontResult front;
  Tetrahedra tetrahedra;  ///< of the front and the labeled cells
};

/// The stages of a model at one of `model_sizes`, of a uniform edge length inside as on the surface. Made at the first
/// call. The models' surfaces are so even that all their edges and faces are Delaunay. Where that leaves a stage idle,
/// there is a flattened model: its z is scaled by 0.3, so that many triangles are thin and many edges and faces
/// missing.
const Stages& stages_of_model(const std::string& model, bool flattened, std::int64_t size);

/// The stages of a file, meshed as `ccdt mesh` does by default: inside the edges grow away from the surface.
///
/// \throw Error  the file cannot be read or meshed
const Stages& stages_of_file(const std::filesystem::path& file);

Tetrahedra sorted(Tetrahedra tetrahedra);

/// The finite cells.
Tetrahedra finite_cells(const delaunay::Delaunay& delaunay);

/// The total volume of tetrahedra.
double volume_of(const Tetrahedra& tetrahedra, const std::vector<Point3>& points);

}  // namespace ccdt::benchmarks
