#include "bench/sweep/input_size.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "bench/run/surface_measures.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "models/solids.h"

namespace ccdt::sweep {
namespace {

constexpr double coarser =
    3;  ///< models are measured with longer edges than the default: that is fast, and changes little

/// The area of the regular triangle and the volume of the regular tetrahedron with edges of length 1.
const double triangle_area = std::sqrt(3) / 4;
const double tetrahedron_volume = std::sqrt(2) / 12;

/// Tetrahedra per vertex of a surface without interior vertices, as measured.
constexpr double tetrahedra_per_triangle = 1.5;

ShapeSize measure(const plc::InputPlc& input) {
  const plc::Plc plc = plc::build_plc(input);
  ShapeSize size;
  size.volume = std::abs(bench::enclosed_volume(plc));
  for (const auto& t : plc.triangles) {
    const Point3& a = plc.world[t[0]];
    size.area += std::sqrt(squared_length(cross(plc.world[t[1]] - a, plc.world[t[2]] - a))) / 2;
    ++size.triangles;
  }
  return size;
}

ShapeSize size_of_model(const std::string& name) {
  const auto solid = std::ranges::find(models::solids(), name, &models::Solid::name);
  return measure(models::make_solid(name, std::min(coarser * solid->default_edge_length, solid->coarsest)));
}

ShapeSize size_of_file(const std::filesystem::path& file) {
  try {
    return measure(io::read_plc(file));
  } catch (const Error&) {
    return {};  // the run will report the error
  }
}

double number_of(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

ShapeSize size_of(const CaseInput& input) {
  static std::map<std::string, ShapeSize> known;
  const bool is_model = !input.model.empty();
  const auto [found, is_new] = known.try_emplace(is_model ? input.model : input.file.string());
  if (is_new) found->second = is_model ? size_of_model(input.model) : size_of_file(input.file);
  ShapeSize size = found->second;
  if (is_model) size.triangles = size.area / (triangle_area * std::pow(input.edge_length, 2));
  return size;
}

double estimated_tetrahedra(const ShapeSize& size, const std::vector<std::pair<std::string, std::string>>& options) {
  const auto value = [&](const char* name) {
    const auto option = std::ranges::find(options, name, &std::pair<std::string, std::string>::first);
    return option == options.end() ? std::string() : option->second;
  };
  double triangles = size.triangles, edge_length = number_of(value("edge-length"));
  if (edge_length > 0 && value("surface") != "keep" && !value("surface").empty()) {
    const double even = size.area / (triangle_area * std::pow(edge_length, 2));
    triangles = value("surface") == "refine" ? std::max(triangles, even) : even;
  }
  if (edge_length <= 0 && triangles > 0) edge_length = std::sqrt(size.area / triangles / triangle_area);
  const double inside =
      edge_length > 0 && value("lattice") != "none" ? size.volume / (tetrahedron_volume * std::pow(edge_length, 3)) : 0;
  return std::max({1.0, inside, tetrahedra_per_triangle * triangles});
}

}  // namespace ccdt::sweep
