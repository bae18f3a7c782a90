#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <new>
#include <sstream>
#include <utility>

#include "baselines/external_program.h"
#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "baselines/process.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"

namespace ccdt::baselines {
namespace {

/// The radius-edge ratio of the examples in TetGen's manual for meshes of good quality, and the smallest dihedral angle
/// in degrees. Ten degrees avoid slivers; the manual says that larger angles may not be reached.
constexpr const char* quality_switch = "q1.414/10";

/// `p`: the constrained Delaunay tetrahedralization of a piecewise linear complex; `Y`, `q`, `a`: refined inside, with
/// the surface kept as our engine keeps it, and a bound on the volume; `A`: region attributes; `Q`: quiet.
std::string switches_for(const InputPlc& input, const MeshOptions& options) {
  std::string switches = "p";
  if (options.lattice != Lattice::none) {
    const double bound = largest_tetrahedron_volume(target_edge_length(input, options));
    switches += std::string("Y") + quality_switch;
    if (bound > 0) switches += "a" + digits(bound);
  }
  if (!input.regions.empty()) switches += "A";
  return switches + "Q";
}

void copy_point(const Point3& p, REAL* to) {
  to[0] = p.x;
  to[1] = p.y;
  to[2] = p.z;
}

REAL* copy_points(const std::vector<Point3>& points) {
  REAL* list = new REAL[3 * points.size()];
  for (std::size_t i = 0; i < points.size(); ++i) copy_point(points[i], list + 3 * i);
  return list;
}

template <class Loop>
void fill_polygon(tetgenio::polygon& polygon, const Loop& loop) {
  tetgenio::init(&polygon);
  polygon.numberofvertices = static_cast<int>(loop.size());
  polygon.vertexlist = new int[loop.size()];
  std::ranges::transform(loop, polygon.vertexlist, [](std::uint32_t v) { return static_cast<int>(v); });
}

void fill_facets(const InputPlc& input, tetgenio& io) {
  io.numberoffacets = static_cast<int>(input.facet_count());
  io.facetlist = new tetgenio::facet[input.facet_count()];
  io.facetmarkerlist = new int[input.facet_count()];
  std::size_t f = 0;
  for (std::size_t t = 0; t < input.triangles.size(); ++t, ++f) {
    tetgenio::facet& facet = io.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    fill_polygon(facet.polygonlist[0], input.triangles[t]);
    io.facetmarkerlist[f] = input.triangle_markers.empty() ? 0 : input.triangle_markers[t];
  }
  for (const PolygonFacet& polygons : input.polygon_facets) {
    tetgenio::facet& facet = io.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = static_cast<int>(polygons.polygons.size());
    facet.polygonlist = new tetgenio::polygon[polygons.polygons.size()];
    for (std::size_t i = 0; i < polygons.polygons.size(); ++i) fill_polygon(facet.polygonlist[i], polygons.polygons[i]);
    facet.numberofholes = static_cast<int>(polygons.holes.size());
    if (!polygons.holes.empty()) facet.holelist = copy_points(polygons.holes);
    io.facetmarkerlist[f++] = polygons.marker;
  }
}

void fill_segments(const InputPlc& input, tetgenio& io) {
  if (input.segments.empty()) return;
  io.numberofedges = static_cast<int>(input.segments.size());
  io.edgelist = new int[2 * input.segments.size()];
  io.edgemarkerlist = new int[input.segments.size()];
  for (std::size_t s = 0; s < input.segments.size(); ++s) {
    for (std::size_t end : {0, 1}) io.edgelist[2 * s + end] = static_cast<int>(input.segments[s][end]);
    io.edgemarkerlist[s] = input.segment_markers.empty() ? 0 : input.segment_markers[s];
  }
}

void fill_seeds(const InputPlc& input, tetgenio& io) {
  if (!input.holes.empty()) {
    io.numberofholes = static_cast<int>(input.holes.size());
    io.holelist = copy_points(input.holes);
  }
  if (input.regions.empty()) return;
  io.numberofregions = static_cast<int>(input.regions.size());
  io.regionlist = new REAL[5 * input.regions.size()];
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    REAL* region = io.regionlist + 5 * r;
    copy_point(input.regions[r].seed, region);
    region[3] = input.regions[r].attribute;
    region[4] = input.regions[r].max_volume > 0 ? input.regions[r].max_volume : -1;
  }
}

template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> tuples(const int* list, int count) {
  std::vector<std::array<std::uint32_t, N>> all(static_cast<std::size_t>(count));
  for (auto& tuple : all)
    for (auto& v : tuple) v = static_cast<std::uint32_t>(*list++);
  return all;
}

std::vector<int> markers(const int* list, int count) {
  return list == nullptr ? std::vector<int>(static_cast<std::size_t>(count), 0) : std::vector<int>(list, list + count);
}

TetMesh read_back(const tetgenio& io) {
  TetMesh mesh;
  for (int v = 0; v < io.numberofpoints; ++v) {
    const REAL* p = io.pointlist + 3 * v;
    mesh.vertices.push_back({p[0], p[1], p[2]});
  }
  mesh.tetrahedra = tuples<4>(io.tetrahedronlist, io.numberoftetrahedra);
  mesh.regions.assign(mesh.tetrahedra.size(), 0);
  if (io.numberoftetrahedronattributes > 0)
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      const auto stride = static_cast<std::size_t>(io.numberoftetrahedronattributes);
      mesh.regions[t] = static_cast<int>(io.tetrahedronattributelist[stride * t]);
    }
  mesh.faces = tuples<3>(io.trifacelist, io.numberoftrifaces);
  mesh.face_markers = markers(io.trifacemarkerlist, io.numberoftrifaces);
  mesh.edges = tuples<2>(io.edgelist, io.numberofedges);
  mesh.edge_markers = markers(io.edgemarkerlist, io.numberofedges);
  orient_positively(mesh);
  return mesh;
}

/// Arrays as bytes, each preceded by its length. A mesh comes back in this form from the process that made it.
class PackedArrays {
 public:
  PackedArrays() = default;
  explicit PackedArrays(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  void put(const std::vector<T>& array) {
    const std::size_t size = array.size();
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(array.data()), size * sizeof(T));
  }

  template <class T>
  void take(std::vector<T>& array) {
    std::size_t size = 0;
    std::memcpy(&size, bytes_.data() + at_, sizeof size);
    array.resize(size);
    if (size > 0) std::memcpy(array.data(), bytes_.data() + at_ + sizeof size, size * sizeof(T));
    at_ += sizeof size + size * sizeof(T);
  }

  std::string release() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// The result of the process that runs TetGen.
struct TetgenOutput {
  std::vector<int> code;        ///< error message; otherwise empty
  std::vector<double> seconds;  ///< one
  TetMesh mesh;

  template <class Visit>
  void each_array(Visit visit) {
    visit(code), visit(seconds), visit(mesh.vertices), visit(mesh.tetrahedra), visit(mesh.regions), visit(mesh.faces);
    visit(mesh.face_markers), visit(mesh.edges), visit(mesh.edge_markers);
  }
};

constexpr int out_of_memory_code = 1;  ///< the value that TetGen throws

std::string tetrahedralize_to_bytes(const InputPlc& input, std::string switches) {
  tetgenio in, out;
  in.numberofpoints = static_cast<int>(input.vertices.size());
  in.pointlist = copy_points(input.vertices);
  fill_facets(input, in);
  fill_segments(input, in);
  fill_seeds(input, in);
  TetgenOutput output;
  const auto begin = std::chrono::steady_clock::now();
  try {
    tetrahedralize(switches.data(), &in, &out);
    output.seconds = {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
    output.mesh = read_back(out);
  } catch (int code) {
    output.code = {code};
  } catch (const std::bad_alloc&) {
    output.code = {out_of_memory_code};
  }
  PackedArrays packed;
  output.each_array([&](auto& array) { packed.put(array); });
  return packed.release();
}

/// The meanings of TetGen's exit codes, from its manual.
std::string meaning_of(int code) {
  switch (code) {
    case 2:
      return "TetGen reports an internal error";
    case 3:
      return "TetGen found that the input intersects itself";
    case 4:
      return "TetGen found a feature smaller than its tolerance";
    case 5:
      return "TetGen found two facets that are too close to each other";
    case 10:
      return "TetGen rejected the input";
    default:
      return "TetGen stopped with code " + std::to_string(code);
  }
}

[[noreturn]] void fail(std::string what, const InputPlc& input, const std::string& printed = "",
                       FailureKind kind = FailureKind::refused) {
  std::istringstream lines(printed);
  if (!printed.empty()) what += "; it printed: " + last_lines(lines);
  throw MesherError(kind, what, io::place_in(input.name), "try another mesher, or check the surface there");
}

/// Calls TetGen in a separate process: when it gives up, release 1.5 often frees its memory twice and crashes.
TetgenOutput call_tetgen(const InputPlc& input, const std::string& switches) {
  const ProcessResult call = run_function([&] { return tetrahedralize_to_bytes(input, switches); });
  if (!call.value)
    fail(call.signal == 0 ? "TetGen ended its process" : "TetGen ended with signal " + std::to_string(call.signal),
         input, call.printed, call.kind.value_or(FailureKind::refused));
  TetgenOutput output;
  PackedArrays packed(*call.value);
  output.each_array([&](auto& array) { packed.take(array); });
  if (!output.code.empty() && output.code[0] == out_of_memory_code) throw std::bad_alloc();
  if (!output.code.empty()) fail(meaning_of(output.code[0]), input, call.printed);
  return output;
}

MesherSettings settings_of_tetgen(const InputPlc& input, const MeshOptions& options) {
  return {{"switches", switches_for(input, options)}};
}

MesherRun run_tetgen(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const InputPlc merged = merge_equal_vertices(input);
  if (merged.vertices.size() < 4) fail("there are fewer than four vertices", input);
  const std::string switches = switches_for(merged, options);
  report(progress, "tetgen", 0, 0);
  TetgenOutput output = call_tetgen(merged, switches);

  MesherRun run;
  run.settings = settings_of_tetgen(input, options);
  run.result.costs.mesh_seconds = output.seconds[0];
  TetMesh& mesh = run.result.mesh;
  mesh = std::move(output.mesh);
  if (input.inside == InputPlc::Inside::even_odd) keep_odd_regions(mesh);
  if (mesh.tetrahedra.empty()) fail("there are no tetrahedra inside: the surface is open", input);
  run.result.counts = count_elements(merged, mesh);
  return run;
}

}  // namespace

Mesher tetgen_mesher() {
  return {.name = "tetgen",
          .version = CCDT_TETGEN_VERSION,
          .what = "TetGen: constrained Delaunay tetrahedralization and Delaunay refinement",
          .license = "AGPL-3.0-or-later",
          .run = run_tetgen,
          .settings = settings_of_tetgen,
          .options = {{.name = "edge-length", .only_inside = true}, {.name = "lattice", .only_none = true}}};
}

}  // namespace ccdt::baselines
