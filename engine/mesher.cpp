#include "engine/mesher.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/stage_scope.h"
#include "engine/cores/lattice_core.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/protect_facets.h"
#include "engine/front/advance_front.h"
#include "engine/front/count_segments.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/improve/improve_mesh.h"
#include "engine/label/label_cells.h"
#include "engine/lattice/place_circumcenters.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesh/collect_tetrahedra.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/gather_parts.h"
#include "engine/protection/make_room.h"
#include "engine/protection/protect_edges.h"
#include "engine/refine/refine_plc.h"
#include "engine/surface/prepare_surface.h"

namespace ccdt {
namespace {

/// What the steps of a run share.
struct Run {
  MeshOptions options;
  const Progress& progress;
  StageCosts costs = {};

  /// Runs a step; its costs are those of the stage.
  template <class Step>
  auto measured(Stage stage, const Step& step) {
    const StageScope scope(costs[stage]);
    return step();
  }
};

BackgroundSizes in_grid_units(BackgroundSizes background, const DyadicGrid& grid) {
  for (Point3& p : background.vertices) p = (1 / grid.unit) * (p - grid.origin);
  for (double& size : background.sizes) size /= grid.unit;
  return background;
}

std::vector<Point3> points_of(const delaunay::Delaunay& delaunay) {
  std::vector<Point3> points;
  points.reserve(delaunay.vertices.size());
  for (const delaunay::DelaunayVertex& v : delaunay.vertices) points.push_back(v.point);
  return points;
}

/// The points of the lattice, or of Delaunay refinement. They keep away from faces and subsegments.
lattice::LatticePoints place_points(const plc::Plc& plc, const protection::ProtectedDelaunay& surface,
                                    const facets::FacetMesh& facets, const MeshOptions& options,
                                    const Progress& progress) {
  RawVector<lattice::SurfaceTriangle> triangles(facets.triangles.size());
  parallel_for(triangles.size(), 4096, [&](std::size_t i) {
    const plc::Facet& facet = plc.facets[facets.facet[i]];
    triangles[i] = {facets.triangles[i], plc.regions[facet.above].inside, plc.regions[facet.below].inside};
  });
  const std::vector<std::array<VertexId, 2>> subsegments = surface.chains.pieces();
  const BackgroundSizes background = in_grid_units(options.background, plc.grid);
  const lattice::LatticeOptions lattice{options.lattice,   options.edge_length / plc.grid.unit,
                                        options.grading,   options.sphere_factor,
                                        options.clearance, options.radius_edge,
                                        &background};
  const std::vector<Point3> vertices = points_of(surface.delaunay);
  const lattice::DomainSurface domain{vertices, triangles, subsegments};
  if (options.lattice == Lattice::refinement)
    return lattice::place_circumcenters(domain, surface.delaunay, lattice, progress);
  return lattice::place_lattice_points(domain, lattice, progress);
}

/// The Delaunay tetrahedralization of the surface's vertices and the points.
///
/// \param lattice  its memory is free afterward
delaunay::Delaunay add_points(lattice::LatticePoints lattice, delaunay::Delaunay d, const MeshOptions& options,
                              const Progress& progress, MeshCounts& counts) {
  if (options.delaunay == DelaunayMethod::wrap) {
    append_vertices(d, lattice.points, lattice.later_rounds);
    return delaunay::wrap_delaunay(std::move(d.vertices), options.grid_scale, progress);
  }
  const bool is_lattice = options.lattice != Lattice::refinement;
  if (is_lattice && options.delaunay == DelaunayMethod::core && lattice.share_in_one_level >= options.least_core)
    counts.core_tetrahedra = cores::insert_points(lattice, d, progress);
  else
    insert_points(d, lattice.points, lattice.later_rounds, progress);
  return d;
}

/// The constrained Delaunay tetrahedralization of an input as a mesh.
struct Tetrahedralization {
  plc::Plc plc;
  protection::SegmentChains chains;
  TetMesh mesh;                              ///< without coordinates
  LargeVector<delaunay::Cell> cells;         ///< its tetrahedra, some of them joined, for improvement
  std::vector<Point3> points;                ///< of the mesh, in grid units
  std::size_t first_interior = 0;            ///< of the points
  std::vector<std::uint32_t> facet_of_face;  ///< by face of the mesh
  MeshCounts counts;
};

std::size_t first_steiner_vertex(const Tetrahedralization& t) {
  return t.plc.vertices.size() + t.counts.refined_on_segments;
}

/// Does anything remain to be done to the constrained Delaunay tetrahedralization?
bool improves(const MeshOptions& options, const Tetrahedralization& t) {
  const bool removes = options.improve.steiner == SteinerRule::remove && first_steiner_vertex(t) < t.first_interior;
  return removes || improvement_of(options) != Improvement::none;
}

/// The mesh of the space that the facets enclose.
///
/// \param delaunay  loses its cells and vertices
/// \param codes     of the faces of the facets, see `front::FrontInput`
void fill_domain(delaunay::Delaunay& delaunay, facets::FacetMesh& facets, std::vector<std::uint32_t> codes, Run& run,
                 Tetrahedralization& t) {
  const MeshOptions& options = run.options;
  if (!options.face_protection) std::ranges::fill(codes, delaunay::no_neighbor);
  const front::FrontOptions strategy{options.locator, options.grid_scale, options.face_protection, options.visibility};
  front::FrontResult front = run.measured(Stage::front, [&] {
    return front::advance_front({t.plc, facets, codes, delaunay}, strategy, run.progress);
  });
  t.counts.front_tetrahedra = front.tetrahedra.size();
  t.counts.front_faces = front.undelaunay_faces;

  RawVector<RegionId> regions =
      run.measured(Stage::label, [&] { return label::label_cells(t.plc, delaunay, front.open, codes); });
  t.points = points_of(delaunay);
  // The next steps need the most memory.
  release(delaunay.vertices), release(delaunay.cell_at), release(codes);
  mesh::CollectedMesh collected = run.measured(Stage::label, [&] {
    return mesh::collect_tetrahedra(t.plc, front, std::move(regions), delaunay.cells, t.points.size());
  });
  front = {};
  run.measured(Stage::finish, [&] {
    mesh::check_volume(t.plc, facets, t.points, collected.mesh);
    t.facet_of_face = mesh::finish_mesh(t.plc, t.chains, t.points, std::move(facets), collected);
  });
  if (improves(options, t))
    t.cells = run.measured(Stage::improve, [&] {
      return mesh::join_tetrahedra(collected.mesh, std::move(collected.sources), std::move(delaunay.cells));
    });
  t.mesh = std::move(collected.mesh);
}

/// The faces of the facets in the tetrahedralization. Most are triangles that the check of the input has found there.
std::vector<std::uint32_t> find_faces_again(const plc::Plc& plc, const facets::FacetMesh& facets,
                                            const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> earlier(facets.facet.size(), plc::no_face);
  parallel_ranges(earlier.size(), 4096, [&](std::size_t i, std::size_t end) {
    std::size_t first = i;  // of the facet
    while (first > 0 && facets.facet[first - 1] == facets.facet[i]) --first;
    for (; i < end; ++i) {
      if (facets.facet[i] != facets.facet[first]) first = i;
      // Where a facet has got other triangles, this may be the face of another one.
      const plc::Facet& facet = plc.facets[facets.facet[i]];
      if (i - first < facet.triangle_count) earlier[i] = plc.faces[facet.first_triangle + (i - first)];
    }
  });
  return front::find_delaunay_faces_again(facets.triangles, earlier, delaunay);
}

/// The faces of the facets in the tetrahedralization, after bent facets have taken those that it has there.
std::vector<std::uint32_t> find_faces(const Tetrahedralization& t, const delaunay::Delaunay& delaunay,
                                      facets::FacetMesh& facets) {
  std::vector<std::uint32_t> codes = find_faces_again(t.plc, facets, delaunay);
  if (t.counts.interior_vertices > 0 && facets::follow_interior_vertices(t.plc, t.chains, delaunay, codes, facets))
    codes = find_faces_again(t.plc, facets, delaunay);
  return codes;
}

/// The Delaunay tetrahedralization of the vertices of an input; none if they are flat. Protection works on a
/// tetrahedralization that grows by one vertex at a time, so this one is made by insertion whatever the method is. With
/// another method, it serves only protection.
std::optional<delaunay::Delaunay> tetrahedralize_vertices(std::span<const Point3> points, Run& run) {
  const bool stays = run.options.delaunay != DelaunayMethod::wrap;
  return run.measured(stays ? Stage::delaunay : Stage::protect, [&]() -> std::optional<delaunay::Delaunay> {
    try {
      return delaunay::build_delaunay(points, run.progress);
    } catch (const MeshError&) {
      return {};
    }
  });
}

/// An input on the grid, and the Delaunay tetrahedralization of its vertices if that was needed to check it.
struct CheckedInput {
  plc::Plc plc;
  std::optional<delaunay::Delaunay> delaunay;
};

CheckedInput check_input(const InputPlc& input, Run& run) {
  const plc::PlcOptions flat{run.options.flatness};
  plc::UncheckedPlc gathered = run.measured(Stage::plc, [&] { return plc::gather_plc(input, flat, run.progress); });
  CheckedInput checked;
  // Refinement adds vertices, and the ranks of all depend on them. So a tetrahedralization would serve only this check.
  if (run.options.surface != SurfaceRule::refine)
    checked.delaunay = tetrahedralize_vertices(gathered.plc.vertices, run);
  static_assert(plc::no_face == delaunay::no_neighbor);
  if (checked.delaunay)
    gathered.triangles.faces = run.measured(
        Stage::plc, [&] { return front::find_delaunay_faces(gathered.triangles.corners, *checked.delaunay); });
  checked.plc =
      run.measured(Stage::plc, [&] { return plc::check_plc(input, std::move(gathered), flat, run.progress); });
  return checked;
}

/// Gives the PLC the vertices of refinement.
///
/// \return  all points: those of the PLC, then those on segments
std::vector<Point3> refine_surface(Run& run, Tetrahedralization& t) {
  const std::size_t vertices_before = t.plc.vertices.size();
  refine::RefinedPlc refined = run.measured(Stage::refine, [&] {
    return refine::refine_plc(t.plc,
                              {.edge_length = run.options.edge_length / t.plc.grid.unit,
                               .grading = run.options.grading,
                               .most_tetrahedra = run.options.thin_tetrahedra},
                              run.progress);
  });
  t.plc = std::move(refined.plc);
  t.chains = std::move(refined.chains);
  t.counts.refined_in_facets = t.plc.vertices.size() - vertices_before;
  t.counts.refined_on_segments = refined.on_segments.size();
  std::vector<Point3> points = t.plc.vertices;
  points.insert(points.end(), refined.on_segments.begin(), refined.on_segments.end());
  return points;
}

/// Protects the surface and fills the space around it with points.
///
/// \param all  gets the Delaunay tetrahedralization of all vertices
/// \return     the faces of the surface
facets::FacetMesh add_interior_points(folds::SurfaceProtector& protector, Run& run, Tetrahedralization& t,
                                      delaunay::Delaunay& all) {
  protection::ProtectedDelaunay surface = run.measured(Stage::protect, [&] { return protector.protect(run.progress); });
  const std::size_t refined = t.plc.vertices.size() + t.counts.refined_on_segments;
  facets::FacetMesh facets;
  const auto triangulate_facets = [&] {
    t.first_interior = surface.delaunay.vertices.size();
    facets = run.measured(Stage::facets, [&] {
      return facets::triangulate_facets(t.plc, surface.chains, surface.delaunay, run.progress);
    });
  };
  triangulate_facets();
  lattice::LatticePoints lattice;
  if (run.options.lattice != Lattice::none) {
    run.measured(Stage::lattice, [&] {
      lattice = place_points(t.plc, surface, facets, run.options, run.progress);
      t.counts.dropped_interior_vertices = lattice.points.size();
      const auto avoided =
          run.options.sphere_factor >= 1 ? protection::Avoided::smallest_spheres : protection::Avoided::nothing;
      keep_only(protection::make_room(lattice.points, t.plc, run.options.protection, surface, avoided, run.progress),
                lattice);
      t.counts.dropped_interior_vertices -= lattice.points.size();
    });
  }
  if (t.first_interior < surface.delaunay.vertices.size()) triangulate_facets();
  t.counts.steiner_vertices = t.first_interior - refined;
  t.counts.splits_by_level = protection::count_splits_by_level(surface.chains);
  t.chains = std::move(surface.chains);
  all = run.measured(Stage::delaunay, [&] {
    return add_points(std::move(lattice), std::move(surface.delaunay), run.options, run.progress, t.counts);
  });
  t.counts.interior_vertices = all.vertices.size() - t.first_interior;
  return facets;
}

/// All stages but improvement.
Tetrahedralization tetrahedralize(const InputPlc& input, Run& run) {
  Tetrahedralization t;
  CheckedInput checked = check_input(input, run);
  t.plc = std::move(checked.plc);
  std::optional<delaunay::Delaunay>& delaunay = checked.delaunay;
  if (run.options.surface == SurfaceRule::refine) delaunay = tetrahedralize_vertices(refine_surface(run, t), run);
  if (!delaunay) delaunay::refuse_flat_points();
  folds::SurfaceProtector protector(t.plc, *std::move(delaunay), std::move(t.chains),
                                    plc::tolerance_of(t.plc, run.options.flatness), run.options.protection);
  for (;;) {
    delaunay::Delaunay all;
    facets::FacetMesh facets = add_interior_points(protector, run, t, all);
    std::vector<std::uint32_t> codes = run.measured(Stage::face_check, [&] { return find_faces(t, all, facets); });
    if (!run.measured(Stage::face_check, [&] { return protector.is_protected(all, t.chains, facets, codes); }))
      continue;
    t.counts.faces = facets.triangles.size();
    // Only for the report, so it is not the work of a stage.
    t.counts.segments = front::count_segments(t.plc, t.chains, facets, codes, all);
    t.counts.undelaunay_faces = static_cast<std::size_t>(std::ranges::count(codes, delaunay::no_neighbor));
    try {
      fill_domain(all, facets, std::move(codes), run, t);
      return t;
    } catch (const MeshError&) {
      if (!protector.protect_folds()) throw;
    }
  }
}

}  // namespace

Improvement improvement_of(const MeshOptions& options) {
  return options.improve.improvement.value_or(options.lattice == Lattice::none ? Improvement::none : Improvement::all);
}

namespace {

MeshResult mesh_on_threads(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const surface::PreparedSurface surface = surface::prepare_surface(
      input, options.surface, {options.edge_length, options.sharp_angle, options.flatness}, progress);
  Run run{options, progress, surface.costs};
  run.options.edge_length = surface.edge_length;
  Tetrahedralization t = tetrahedralize(surface.changed ? *surface.changed : input, run);

  ImproveOptions improve = options.improve;
  improve.improvement = improvement_of(options);
  if (improves(options, t)) {
    improve::ImproveInput mesh{
        t.plc, t.chains, std::move(t.cells), std::move(t.facet_of_face), first_steiner_vertex(t), t.first_interior};
    const std::size_t faces_before = t.mesh.faces.size();
    mesh.first_sliding = t.plc.vertices.size() - t.counts.refined_in_facets;
    t.counts.improve = run.measured(
        Stage::improve, [&] { return improve::improve_mesh(std::move(mesh), improve, t.points, t.mesh, progress); });
    const std::uint64_t removed = t.counts.improve.removed_steiner_vertices;
    t.counts.steiner_vertices -= removed;
    t.counts.faces -= faces_before - t.mesh.faces.size();
    t.counts.interior_vertices = t.points.size() - (t.first_interior - removed);
    t.counts.splits_by_level = protection::count_splits_by_level(t.chains);
    t.counts.segments->restored = t.counts.segments->split - protection::count_split(t.chains);
  }
  t.mesh.vertices = run.measured(Stage::finish, [&] { return mesh::to_world(t.plc, t.points, t.mesh.tetrahedra); });
  if (const auto attribute = mesh::common_attribute(t.plc.regions))
    t.mesh.regions.assign(t.mesh.tetrahedra.size(), *attribute);
  t.counts.vertices = t.mesh.vertices.size();
  t.counts.tetrahedra = t.mesh.tetrahedra.size();
  for (const StageCost& cost : run.costs.stages) run.costs.mesh_seconds += cost.seconds;
  run.costs.mesh_seconds -= run.costs[Stage::remesh].seconds;
  return {std::move(t.mesh), std::move(t.counts), run.costs, t.plc.largest_rounding, t.plc.idle_holes.size()};
}

}  // namespace

unsigned number_of_threads(const MeshOptions& options) {
  return options.threads == 0 ? thread_backend::core_count() : options.threads;
}

MeshResult mesh_plc(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  return with_file_in_errors(input.name, [&] {
    return with_threads(options.threads, [&] { return mesh_on_threads(input, options, progress); });
  });
}

}  // namespace ccdt
