#include "engine/surface/remesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/check_arguments.h"
#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/surface_distance.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/check_input.h"
#include "engine/plc/connect_parts.h"
#include "engine/plc/gather_parts.h"
#include "engine/sizes/interpolated_sizes.h"
#include "engine/sizes/wanted_places.h"
#include "engine/surface/surface_change.h"
#include "engine/surface/working_mesh.h"

namespace ccdt::surface {

namespace {

using sizes::SizedPlace;

// Rounds of splits, collapses, flips and relaxation.
constexpr int rounds_of_all = 8, rounds_near_places = 3;

// If triangles cross, the edge length there is halved at most this many times; then the old triangles stay, in a
// growing neighborhood.
constexpr int most_halvings = 8;
constexpr int most_attempts = 9;

// The edge length is halved within this many edge lengths of the place where triangles cross.
constexpr double halved_around = 1.6;

void check_options(const plc::InputPlc& input, const RemeshOptions& options) {
  const Place place{.file = input.name};
  const bool is_positive = options.edge_length > 0 && std::isfinite(options.edge_length);
  if (!is_positive)
    throw InputError("the edge length for remeshing is not a positive number", place,
                     "give the edge length of the new surface, in the units of the input");
  check_number("flatness", options.flatness);
  check_number("deviation", options.deviation);
  if (options.background != nullptr) sizes::check_background(*options.background);
  check_number("angle of sharp edges", options.sharp_angle, least_sharp_angle, most_sharp_angle);
}

/// \throw LimitError  triangles of this edge length would be too many to be counted
void check_count(const plc::InputPlc& input, const OriginalSurface& original, double edge_length) {
  constexpr double most = 1e9, area_of_unit = 0.433;
  double area = 0;
  for (const auto& [a, b, c] : original.triangles)
    area += 0.5 * length(area_vector({original.points[a], original.points[b], original.points[c]}));
  if (area > most * area_of_unit * edge_length * edge_length)
    throw LimitError("the new surface would have more than 1,000,000,000 triangles", {.file = input.name},
                     "give a larger edge length");
}

/// What must stay the same: the regions, in any order.
std::vector<std::pair<bool, int>> regions_of(const plc::Plc& plc) {
  std::vector<std::pair<bool, int>> regions;
  for (const plc::Region& c : plc.regions) regions.emplace_back(c.inside, c.attribute);
  std::sort(regions.begin(), regions.end());
  return regions;
}

// Bad triangles with their smallest angles, the worst first.
std::vector<std::pair<double, FaceHandle>> bad_triangles(const WorkingMesh& m) {
  constexpr double good_angle = 36;  // degrees
  std::vector<std::pair<double, FaceHandle>> found;
  for (const FaceHandle f : m.mesh.faces()) {
    if (m.is_frozen(f)) continue;
    const double angle = smallest_angle(m.points(m.corners(m.mesh.halfedge_handle(f))));
    if (angle < to_radians(good_angle)) found.emplace_back(angle, f);
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The halfedges of a triangle, that of the longest edge first.
std::array<HalfedgeHandle, 3> halfedges_by_length(const WorkingMesh& m, FaceHandle f) {
  const HalfedgeHandle h = m.mesh.halfedge_handle(f);
  std::array<HalfedgeHandle, 3> halfedges = {h, m.mesh.next_halfedge_handle(h), m.mesh.prev_halfedge_handle(h)};
  const auto size = [&](HalfedgeHandle e) { return m.edge_length(m.ends(e)[0], m.ends(e)[1]); };
  std::stable_sort(halfedges.begin(), halfedges.end(),
                   [&](HalfedgeHandle e, HalfedgeHandle g) { return size(e) > size(g); });
  return halfedges;
}

bool improve_triangle(WorkingMesh& m, FaceHandle f) {
  const std::array<HalfedgeHandle, 3> halfedges = halfedges_by_length(m, f);
  for (const HalfedgeHandle h : halfedges)
    if (improve_by_flip(m, m.mesh.edge_handle(h))) return true;
  bool any = false;
  for (const VertexHandle v : m.corners(halfedges[0])) any = improve_by_move(m, v) || any;
  if (any) return true;
  for (auto h = halfedges.rbegin(); h != halfedges.rend(); ++h)
    if (improve_by_collapse(m, *h) || improve_by_collapse(m, m.mesh.opposite_halfedge_handle(*h))) return true;
  return false;
}

// The triangles that a change around a triangle may affect: those at neighbors of neighbors of its corners, in all
// patches.
std::vector<FaceHandle> triangles_near(const WorkingMesh& m, FaceHandle f) {
  std::vector<VertexHandle> near;
  const auto add = [&](VertexHandle v) {
    if (m.at(v).knot == none) {
      near.push_back(v);
    } else {
      near.insert(near.end(), m.knots[m.at(v).knot].copies.begin(), m.knots[m.at(v).knot].copies.end());
    }
  };
  for (const VertexHandle v : m.corners(m.mesh.halfedge_handle(f))) add(v);
  for (int ring = 0; ring < 2; ++ring) {
    const std::vector<VertexHandle> inner = near;
    for (const VertexHandle v : inner)
      for (auto n = m.mesh.cvv_iter(v); n.is_valid(); ++n) add(*n);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }
  std::vector<FaceHandle> faces;
  for (const VertexHandle v : near)
    for (auto t = m.mesh.cvf_iter(v); t.is_valid(); ++t) faces.push_back(*t);
  return faces;
}

/// Flips, collapses and moves around triangles with small angles, the worst first, regardless of the wanted lengths,
/// until nothing helps. Triangles that could not be improved are tried again only after a change nearby.
void improve_worst_triangles(WorkingMesh& m) {
  constexpr int most_sweeps = 30;
  std::vector<char> is_settled(m.mesh.n_faces(), 0);
  bool any = true;
  for (int sweep = 0; any && sweep < most_sweeps; ++sweep) {
    any = false;
    for (const auto& [angle, f] : bad_triangles(m)) {
      char& settled = is_settled[static_cast<std::size_t>(f.idx())];
      if (settled || m.mesh.status(f).deleted()) continue;
      const std::vector<FaceHandle> near = triangles_near(m, f);
      settled = 1;
      if (!improve_triangle(m, f)) continue;
      for (const FaceHandle t : near) is_settled[static_cast<std::size_t>(t.idx())] = 0;
      any = true;
    }
  }
  if (any) ++work_done.remeshing_sweeps;
}

/// The rounds of remeshing, and the improvement at their end.
void remesh(WorkingMesh& m, int rounds, const Progress& progress) {
  for (int i = 0; i < rounds; ++i) {
    report(progress, "remesh", static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(rounds));
    find_wanted_lengths(m, i > 0);
    ++work_done.remesh_rounds;
    split_long_edges(m);
    collapse_short_edges(m);
    flip_edges_for_valence(m);
    relax_vertices(m);
  }
  flip_edges_for_quality(m);
  relax_vertices(m);
  flip_edges_for_quality(m);
  improve_worst_triangles(m);
  report(progress, "remesh", static_cast<std::uint64_t>(rounds), static_cast<std::uint64_t>(rounds));
}

/// Places, in the units of the surface, where its triangles or segments share more than vertices and edges, or where a
/// triangle has no area. Finds up to a few thousand, while `build_plc` stops at the first.
std::vector<Point3> find_crossings(const plc::InputPlc& surface, double flatness) {
  constexpr std::size_t most_places = 4000;
  plc::Plc plc;
  plc::snap_vertices(surface, plc);
  plc::TriangleSet triangles = plc::gather_triangles(surface, plc);
  std::vector<Point3> places;
  for (const plc::VertexTriple& t : triangles.corners)
    if (has_no_area(plc::points_of(plc.vertices, t))) places.push_back(plc.world[t[0]]);
  if (!places.empty()) return places;

  const std::vector<plc::TrianglePair> close = plc::find_close_triangles(plc.vertices, triangles);
  const plc::Overlaps overlaps =
      plc::connect_parts(plc, std::move(triangles), plc::gather_segments(surface, plc), close, {flatness}, most_places)
          .overlaps;
  for (const auto* list : {&overlaps.covering, &overlaps.crossing, &overlaps.of_segments})
    for (const plc::Overlap& o : *list) places.push_back(plc.grid.to_world(o.where));
  return places;
}

/// Places where the result cannot be built, and the error message if nothing helps there.
struct Defects {
  std::vector<Point3> places;
  std::string words;
};

Defects find_defects(const plc::InputPlc& input, const plc::InputPlc& result, const plc::Plc& before,
                     const RemeshOptions& options) {
  Defects defects{find_crossings(result, options.flatness), "triangles of the new surface cross each other"};
  if (!defects.places.empty()) return defects;
  try {
    const plc::Plc after = plc::build_plc(result, {options.flatness});
    if (regions_of(after) == regions_of(before)) {
      if (options.deviation == 0) return {};
      // `measure_change` reports a bound, which is larger.
      return {points_beyond(input, result, options.deviation / DistancePrecision().relative),
              "the new surface is too far from the old one"};
    }
    defects.words = "the new surface divides space differently from the old one";
    for (const plc::InputPlc::RegionSeed& region : result.regions) defects.places.push_back(region.seed);
    defects.places.insert(defects.places.end(), result.holes.begin(), result.holes.end());
  } catch (const InputError& error) {
    defects.words = std::string("the new surface is not valid: ") + error.what();
    for (const auto& [x, y, z] : error.place().points) defects.places.push_back({x, y, z});
  }
  if (defects.places.empty()) defects.places.push_back(result.vertices.front());
  return defects;
}

/// Merges places near each other into one, with the longest edge of the triangles there.
std::vector<SizedPlace> thinned(const std::vector<Point3>& places, const plc::InputPlc& surface, double usual) {
  const auto corners = [&](std::size_t t) {
    const auto& [a, b, c] = surface.triangles[t];
    return std::array<Point3, 3>{surface.vertices[a], surface.vertices[b], surface.vertices[c]};
  };
  const BoxTree tree(std::views::iota(std::size_t{0}, surface.triangles.size()),
                     [&](std::size_t t) { return expanded(bounding_box(corners(t)), 1e-6 * usual); });
  std::vector<SizedPlace> kept;
  for (const Point3& p : places) {
    double edge = 0;
    tree.for_each_meeting(box_of(p), [&](std::uint32_t t) {
      const std::array<Point3, 3> c = corners(t);
      for (int k = 0; k < 3; ++k) edge = std::max(edge, length(c[(k + 1) % 3] - c[k]));
    });
    edge = edge > 0 ? std::min(edge, usual) : usual;
    if (std::none_of(kept.begin(), kept.end(), [&](const SizedPlace& q) { return length(p - q.box.low) < q.size; }))
      kept.push_back({box_of(p), edge});
  }
  return kept;
}

void freeze(const OriginalSurface& original, const std::vector<SizedPlace>& places, double edges_around,
            std::vector<char>& frozen) {
  const BoxTree tree(places, [&](const SizedPlace& p) { return expanded(p.box, edges_around * p.size); });
  for (std::uint32_t t = 0; t < original.triangles.size(); ++t) {
    const auto [a, b, c] = original.triangles[t];
    const std::array<Point3, 3> corners = {original.points[a], original.points[b], original.points[c]};
    tree.for_each_meeting(bounding_box(corners), [&](std::uint32_t) { frozen[t] = 1; });
  }
}

[[noreturn]] void throw_not_remeshed(const plc::InputPlc& input, const Defects& defects, double edge_length) {
  const Place place{.file = input.name, .points = {as_array(defects.places.front())}};
  throw MeshError(
      "the surface could not be remeshed to edges of length " + std::to_string(edge_length) + ": " + defects.words,
      place, "give a smaller edge length, or mesh the surface as it is");
}

/// Remeshes only near some places, with shorter edges.
void remesh_near(WorkingMesh& m, const std::vector<SizedPlace>& places, const Progress& progress) {
  constexpr double edges_around = 6;
  const BoxTree tree(places, [&](const SizedPlace& p) { return expanded(p.box, edges_around * p.size); });
  const std::vector<char> frozen_faces = m.face_is_frozen;
  const std::vector<WorkingMesh::Vertex> vertices = m.vertices;
  for (const FaceHandle f : m.mesh.faces()) {
    const std::array<VertexHandle, 3> corners = m.corners(m.mesh.halfedge_handle(f));
    bool is_near = false;
    tree.for_each_meeting(bounding_box(m.points(corners)), [&](std::uint32_t) { is_near = true; });
    if (is_near) continue;
    m.face_is_frozen[static_cast<std::size_t>(f.idx())] = 1;
    for (const VertexHandle v : corners) m.at(v).is_frozen = true;
  }
  remesh(m, rounds_near_places, progress);
  std::copy(frozen_faces.begin(), frozen_faces.end(), m.face_is_frozen.begin());
  for (std::size_t v = 0; v < vertices.size(); ++v) m.vertices[v].is_frozen = vertices[v].is_frozen;
}

/// Where the user and the regions want shorter edges, in the units of the input.
std::vector<SizedPlace> wanted_places_of(const plc::InputPlc& input, const plc::Plc& plc,
                                         const RemeshOptions& options) {
  const sizes::LocalSizes none;
  std::vector<SizedPlace> places =
      sizes::wanted_places(input, plc, options.local != nullptr ? *options.local : none,
                           options.edge_length / plc.grid.unit, to_radians(options.sharp_angle));
  for (SizedPlace& place : places)
    place = {{plc.grid.to_world(place.box.low), plc.grid.to_world(place.box.high)}, plc.grid.unit * place.size};
  return places;
}

plc::InputPlc remesh(const plc::InputPlc& input, const RemeshOptions& options, const Progress& progress) {
  plc::check_input(input);
  check_options(input, options);
  plc::Plc plc = plc::build_plc(input, {options.flatness}, progress);
  if (options.local != nullptr) sizes::set_volumes(*options.local, plc);
  const OriginalSurface original = cut_surface(input, plc, options);
  check_count(input, original, options.edge_length);
  const FeatureCurves features = chain_features(original, options.sharp_angle);
  const ClosestPoint closest(original);
  const double deviation = options.deviation > 0 ? options.deviation : HUGE_VAL;
  const sizes::SizeField shape = lengths_of_shape(plc, original, features, options.edge_length, deviation);
  std::vector<SizedPlace> shorter = wanted_places_of(input, plc, options);
  shorter.insert(shorter.end(), original.rounded.begin(), original.rounded.end());
  sizes::SizeField lengths(options.edge_length, length_growth, shorter, options.background);
  std::vector<char> frozen(original.triangles.size(), 0);
  for (int attempt = 0;; ++attempt) {
    WorkingMesh mesh = make_working_mesh(original, features, closest, lengths, shape, deviation, frozen);
    remesh(mesh, rounds_of_all, progress);
    for (int halving = 0;; ++halving) {
      note_bytes(bytes_of(original.points, original.triangles, original.wedges, mesh.vertices, mesh.face_is_frozen));
      plc::InputPlc result = to_plc(mesh, input);
      if (options.most_tetrahedra > 0 && static_cast<double>(result.triangles.size()) > options.most_tetrahedra)
        throw LimitError("the new surface alone has more triangles than tetrahedra are allowed", {.file = input.name},
                         "allow more tetrahedra, or a larger deviation");
      const Defects defects = find_defects(input, result, plc, options);
      if (defects.places.empty()) return result;
      const std::vector<SizedPlace> places = thinned(defects.places, result, options.edge_length);
      if (halving == most_halvings) {
        if (attempt == most_attempts) throw_not_remeshed(input, defects, options.edge_length);
        ++work_done.remeshing_halvings;
        freeze(original, places, std::ldexp(1, attempt), frozen);
        break;
      }
      for (const SizedPlace& p : places) shorter.push_back({expanded(p.box, halved_around * p.size), 0.5 * p.size});
      lengths = sizes::SizeField(options.edge_length, length_growth, shorter, options.background);
      remesh_near(mesh, places, progress);
    }
  }
}

}  // namespace

plc::InputPlc remesh_surface(const plc::InputPlc& input, const RemeshOptions& options, const Progress& progress) {
  return with_file_in_errors(input.name, [&] { return remesh(input, options, progress); });
}

}  // namespace ccdt::surface
