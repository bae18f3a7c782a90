#include "engine/options/option_table.h"

#include <algorithm>
#include <charconv>
#include <type_traits>
#include <utility>

#include "engine/base/digits.h"
#include "engine/base/platform.h"

namespace ccdt::options {
namespace {

template <class Enum>
ChoiceKind choice(std::function<Enum(const MeshOptions&)> get, std::function<void(MeshOptions&, Enum)> set) {
  ChoiceKind kind;
  for (const NamedValue<Enum>& value : names_of(Enum{})) kind.names.push_back({value.name, value.what});
  kind.get = [=](const MeshOptions& options) { return name_of(get(options)); };
  kind.set = [=](MeshOptions& options, std::string_view name) {
    if (const auto value = value_of<Enum>(name)) set(options, *value);
  };
  return kind;
}

/// \param member  the member of `MeshOptions`, constant or not
template <class Member>
ChoiceKind choice(Member member) {
  using Enum = std::remove_reference_t<decltype(member(std::declval<MeshOptions&>()))>;
  return choice<Enum>(member, [=](MeshOptions& options, Enum value) { member(options) = value; });
}

ChoiceKind switch_of(std::string_view on, std::string_view off, bool MeshOptions::*member) {
  return {.names = {{"on", on}, {"off", off}},
          .get = [=](const MeshOptions& options) -> std::string_view { return options.*member ? "on" : "off"; },
          .set = [=](MeshOptions& options, std::string_view name) { options.*member = name == "on"; }};
}

std::vector<MeshOption> make_table() {
  const std::vector<Need> remeshing = {{"surface", false, "keep"}, {"surface", false, "refine"}},
                          improvement = {{"improve", false, "none"}};
  return {
      {.name = "face-protection",
       .kind = switch_of("only faces that are not Delaunay, found by a check", "all", &MeshOptions::face_protection),
       .what = "faces that go through the front",
       .in_report = "on or off"},
      {.name = "lattice",
       .kind = choice([](auto& o) -> auto& { return o.lattice; }),
       .what = "crystal lattice whose points fill the inside"},
      {.name = "protection",
       .kind = choice([](auto& o) -> auto& { return o.protection; }),
       .what = "where missing segments are split"},
      {.name = "locator",
       .kind = choice([](auto& o) -> auto& { return o.locator; }),
       .what = "search structure for the vertices near a face and the faces near an edge"},
      {.name = "delaunay",
       .kind = choice([](auto& o) -> auto& { return o.delaunay; }),
       .what = "method of Delaunay tetrahedralization; all give the same result"},
      {.name = "visibility",
       .kind = choice([](auto& o) -> auto& { return o.visibility; }),
       .what = "how the front finds out whether a vertex can be seen from a face"},
      {.name = "surface",
       .kind = choice([](auto& o) -> auto& { return o.surface; }),
       .what = "surface of the mesh",
       .of_remeshing = true},
      {.name = "periodic",
       .kind = choice([](auto& o) -> auto& { return o.periodic; }),
       .what = "axes along which the part repeats: opposite sides get the same vertices and triangles",
       .in_report = "axes along which opposite sides are equal",
       .needs = {{"surface", false, "remesh"}, {"surface", false, "auto"}}},
      {.name = "sharp-angle",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.sharp_angle; }, surface::least_sharp_angle,
                          surface::most_sharp_angle},
       .what =
           "edges between facets whose normals differ by more than this, in degrees, are sharp: remeshing keeps them, "
           "and they bound the facets of a marker by angle",
       .in_report = "degrees; only with remesh and auto",
       .needs = remeshing,
       .of_remeshing = true},
      {.name = "deviation",
       .kind = NumberKind{.member = [](MeshOptions& o) -> double& { return o.deviation; }, .excludes_least = true},
       .what = "the new surface stays within this distance of the input's, in units of the input; default: any "
               "distance, or with --surface auto a ten-thousandth of the diagonal of the bounding box",
       .in_report = "in units of the input; 0: the default; only with remesh and auto",
       .needs = remeshing,
       .of_remeshing = true,
       .usual = ""},
      {.name = "threads",
       .kind = CountKind{[](MeshOptions& o) -> unsigned& { return o.threads; }, 1, 1024},  // starting more takes longer
       .what = "largest number of threads; the result does not depend on it",
       .in_report = "the largest number of threads",
       .usual = "1"},
      {.name = "improve",
       .kind = choice<Improvement>(improvement_of,
                                   [](MeshOptions& o, Improvement value) { o.improve.improvement = value; }),
       .what = "how the worst tetrahedra are improved; default with --lattice none: none"},
      {.name = "objective",
       .kind = choice([](auto& o) -> auto& { return o.improve.objective; }),
       .what = "quality measure to improve",
       .needs = improvement},
      {.name = "boundary",
       .kind = choice([](auto& o) -> auto& { return o.improve.boundary; }),
       .what = "whether improvement may move boundary vertices",
       .needs = improvement},
      {.name = "steiner",
       .kind = choice([](auto& o) -> auto& { return o.improve.steiner; }),
       .what = "what happens to the vertices that split segments"},
      {.name = "target-dihedral",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.improve.target_dihedral; }, 0, 60},
       .what = "improve until all dihedral angles are between this and 180 minus this, in degrees",
       .in_report = "degrees",
       .needs = improvement},
      {.name = "target-r",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.improve.target_r; }, 1, 1e6},
       .what = "improve until no tetrahedron has a greater r; with --objective r",
       .in_report = "no tetrahedron shall have a greater r",
       .needs = {{"improve", false, "none"}, {"objective", true, "r"}}},
      {.name = "improve-time",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.improve.time; }},
       .what = "stop improvement after this many seconds; 0: no limit",
       .in_report = "seconds; 0: no limit",
       .needs = improvement},
      {.name = "edge-length",
       .kind = NumberKind{.member = [](MeshOptions& o) -> double& { return o.edge_length; }, .excludes_least = true},
       .what = "target edge length in units of the input; default: that of the surface, "
               "or with --surface refine and auto a fortieth of the diagonal of the bounding box",
       .in_report = "in units of the input; 0: that of the surface",
       .of_inside = true,
       .of_refinement = true,
       .of_remeshing = true,
       .usual = ""},
      {.name = "grading",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.grading; }},
       .what = "growth of the edge length per unit of distance from the surface; 0: uniform",
       .in_report = "growth of the edge length per unit of distance",
       .of_inside = true,
       .of_refinement = true},
      {.name = "sizes",
       .kind = FileKind{[](MeshOptions& o) -> std::string& { return o.background.name; }},
       .what = "file with a size function: .sol beside its .mesh, .mtr beside its .node or .poly",
       .in_report = "the file with the size function; empty: none",
       .of_inside = true,
       .of_refinement = true,
       .of_remeshing = true},
      {.name = "size-field",
       .kind = FileKind{[](MeshOptions& o) -> std::string& { return o.local.name; }},
       .what = "file with edge lengths for markers, regions, boxes and balls (JSON, schema ccdt.sizefield/1)",
       .in_report = "the file with the size field; empty: none",
       .of_inside = true,
       .of_refinement = true,
       .of_remeshing = true},
      {.name = "curvature-angle",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.local.curvature_angle; }, 0,
                          sizes::most_curvature_angle},
       .what = "edges along curved surfaces turn by at most about this angle, in degrees; 0: any",
       .in_report = "degrees that edges along curved surfaces may turn by; 0: any",
       .of_inside = true,
       .of_refinement = true,
       .of_remeshing = true},
      {.name = "elements-through",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.local.elements_through; }, 0,
                          sizes::most_elements_through},
       .what = "about this many edges fit through thin parts; 0: any",
       .in_report = "edges through thin parts; 0: any",
       .of_inside = true,
       .of_refinement = true,
       .of_remeshing = true},
      {.name = "tetrahedra",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.tetrahedra; }},
       .what = "scale all edge lengths until the mesh has this many tetrahedra, within 5%; 0: do not",
       .in_report = "how many were wanted; 0: any number",
       .of_any_mesher = true},
      {.name = "most-tetrahedra",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.most_tetrahedra; }},
       .what = "refuse to make a mesh of more tetrahedra, with exit code 4; 0: any number",
       .in_report = "of more, no mesh is made; 0: any number",
       .of_any_mesher = true},
      {.name = "sphere-factor",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.sphere_factor; }},
       .what = "keep interior points out of the smallest spheres of surface triangles, with radii times this factor",
       .in_report = "of the spheres that interior points keep out of",
       .of_inside = true},
      {.name = "clearance",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.clearance; }},
       .what = "least distance of interior points from the surface, in edge lengths there",
       .in_report = "in edge lengths",
       .of_inside = true},
      {.name = "radius-edge",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.radius_edge; }, 1, 100},
       .what = "--lattice refinement: largest circumradius of a tetrahedron over its shortest edge",
       .in_report = "circumradius over shortest edge; of Delaunay refinement",
       .needs = {{"lattice", true, "refinement"}}},
      {.name = "grid-scale",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.grid_scale; }, 0.1, 100},
       .what = "factor of the cell size of the paper's uniform grids",
       .in_report = "factor of the cell size of uniform grids"},
      {.name = "flatness",
       .kind = NumberKind{[](MeshOptions& o) -> double& { return o.flatness; }},
       .what =
           "tolerance for triangles in one plane to be one facet, as a fraction of the bounding box; the default is "
           "larger for coordinates rounded to single precision",
       .in_report = "fraction of the bounding box",
       .of_remeshing = true},
  };
}

template <class T>
void read_number(std::string_view text, T& number) {
  T value = {};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) number = value;
}

struct ValueReader {
  MeshOptions& options;  // is not changed

  OptionValue operator()(const ChoiceKind& kind) const {
    const std::string_view name = kind.get(options);
    if (name == "on" || name == "off") return name == "on";
    return std::string(name);
  }
  OptionValue operator()(const NumberKind& kind) const { return kind.member(options); }
  OptionValue operator()(const CountKind& kind) const { return static_cast<double>(kind.member(options)); }
  OptionValue operator()(const FileKind& kind) const { return kind.member(options); }
};

struct ValueWriter {
  std::string_view value;
  MeshOptions& options;

  void operator()(const ChoiceKind& kind) const { kind.set(options, value); }
  void operator()(const NumberKind& kind) const { read_number(value, kind.member(options)); }
  void operator()(const CountKind& kind) const { read_number(value, kind.member(options)); }
  void operator()(const FileKind& kind) const { kind.member(options) = value; }
};

}  // namespace

const std::vector<MeshOption>& mesh_options() {
  static const std::vector<MeshOption> table = make_table();
  return table;
}

const MeshOption* find_mesh_option(std::string_view name) {
  const auto found = std::ranges::find(mesh_options(), name, &MeshOption::name);
  return found == mesh_options().end() ? nullptr : &*found;
}

OptionValue recorded_value(const MeshOption& option, const MeshOptions& options) {
  return std::visit(ValueReader{const_cast<MeshOptions&>(options)}, option.kind);
}

void set_value(const MeshOption& option, std::string_view value, MeshOptions& options) {
  std::visit(ValueWriter{value, options}, option.kind);
}

std::string text_of(const OptionValue& value) {
  if (const bool* on = std::get_if<bool>(&value)) return *on ? "on" : "off";
  if (const double* number = std::get_if<double>(&value)) return digits(*number);
  return std::get<std::string>(value);
}

}  // namespace ccdt::options
