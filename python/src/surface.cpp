#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <utility>

#include "engine/plc/input.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"

namespace ccdt::python {
namespace {

using plc::InputPlc, plc::PolygonFacet;

/// Adds polygons. Those of three corners become triangles, as in files.
///
/// \param corners  of all polygons, one after the other
/// \param ends     where each polygon ends
/// \param markers  empty, or one per polygon
void add_polygons(InputPlc& input, const Array<std::uint32_t>& corners, const Array<std::uint64_t>& ends,
                  const Array<int>& markers) {
  const std::vector<std::uint32_t> all = vector_of<std::uint32_t>(corners);
  const std::vector<int> given = vector_of<int>(markers);
  std::size_t begin = 0;
  std::uint32_t number = 0;
  for (const std::uint64_t end : vector_of<std::uint64_t>(ends)) {
    const int marker = given.empty() ? 0 : given.at(number);
    if (end - begin == 3) {
      input.triangles.push_back({all[begin], all[begin + 1], all[begin + 2]});
      input.triangle_markers.push_back(marker);
      input.triangle_numbers.push_back(number);
    } else {
      const auto polygon =
          std::vector(all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end));
      input.polygon_facets.push_back({{polygon}, {}, marker, number});
    }
    begin = end;
    ++number;
  }
}

using Region = std::tuple<std::array<double, 3>, int, double>;

void add_region(InputPlc& input, const Region& region) {
  const auto& [seed, attribute, max_volume] = region;
  input.regions.push_back({{seed[0], seed[1], seed[2]}, attribute, max_volume});
}

std::vector<Region> regions_of(const InputPlc& input) {
  std::vector<Region> regions;
  for (const InputPlc::RegionSeed& region : input.regions)
    regions.emplace_back(as_array(region.seed), region.attribute, region.max_volume);
  return regions;
}

std::vector<std::vector<std::vector<std::uint32_t>>> polygons_of(const InputPlc& input) {
  std::vector<std::vector<std::vector<std::uint32_t>>> polygons;
  for (const PolygonFacet& facet : input.polygon_facets) polygons.push_back(facet.polygons);
  return polygons;
}

std::vector<int> polygon_markers_of(const InputPlc& input) {
  std::vector<int> markers;
  for (const PolygonFacet& facet : input.polygon_facets) markers.push_back(facet.marker);
  return markers;
}

bool is_by_seeds(const InputPlc& input) {
  return input.inside == InputPlc::Inside::seeds;
}
void set_by_seeds(InputPlc& input, bool by_seeds) {
  input.inside = by_seeds ? InputPlc::Inside::seeds : InputPlc::Inside::even_odd;
}

}  // namespace

void bind_surface(py::module_& module) {
  py::class_<InputPlc> type(module, "Surface");
  type.def(py::init<>());
  type.def_readwrite("name", &InputPlc::name);
  type.def_readwrite("names", &InputPlc::marker_names);
  type.def_readonly("notes", &InputPlc::notes);
  type.def_property("is_by_seeds", is_by_seeds, set_by_seeds);
  add_list(type, "vertices", &InputPlc::vertices);
  add_list(type, "triangles", &InputPlc::triangles);
  add_list(type, "triangle_markers", &InputPlc::triangle_markers);
  add_list(type, "segments", &InputPlc::segments);
  add_list(type, "segment_markers", &InputPlc::segment_markers);
  add_list(type, "holes", &InputPlc::holes);
  type.def_property_readonly("regions", regions_of);
  type.def_property_readonly("polygons", polygons_of);
  type.def_property_readonly("polygon_markers", polygon_markers_of);
  type.def("add_polygons", add_polygons);
  type.def("add_region", add_region);
}

}  // namespace ccdt::python
