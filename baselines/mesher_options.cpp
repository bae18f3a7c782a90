#include "baselines/mesher_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "engine/base/digits.h"

namespace ccdt::baselines {
namespace {

constexpr std::string_view value_none = "none";

/// Options of surface remeshing, which happens before any mesher runs.
constexpr auto options_of_surface = std::to_array<std::string_view>({"edge-length", "flatness", "sharp-angle"});
/// Options of surface refinement.
constexpr auto options_of_refinement = std::to_array<std::string_view>({"edge-length", "grading"});
/// Options of interior points.
constexpr auto options_of_lattice =
    std::to_array<std::string_view>({"clearance", "edge-length", "grading", "radius-edge", "sizes", "sphere-factor"});
/// Options of improvement.
constexpr auto options_of_improvement =
    std::to_array<std::string_view>({"boundary", "improve-time", "objective", "target-dihedral", "target-r"});
template <class Names>
bool is_among(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

template <class Enum>
std::string text_of(Enum value) {
  return std::string(name_of(value));
}

/// Normalizes values: equal numbers become equal texts, names get small letters. Names of files stay as they are.
std::string canonical(const std::string& name, std::string value) {
  if (names_a_file(name)) return value;
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error == std::errc() && end == value.data() + value.size()) return digits(number);
  for (char& c : value)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return value;
}

/// The value of an option, given or default.
class Asked {
 public:
  explicit Asked(const NamedOptions& options) {
    for (const auto& [name, value] : with_strategies(options)) options_[name] = canonical(name, value);
    // The default of improvement depends on the lattice, even for a mesher without one.
    if (!options_.contains("improve") && value("lattice") == value_none) options_["improve"] = value_none;
  }

  std::string value(const std::string& name) const {
    const auto found = options_.find(name);
    return found != options_.end() ? found->second : usual_options().at(name);
  }
  const NamedOptions& options() const { return options_; }

 private:
  NamedOptions options_;
};

bool matters(const OptionUse& use, const Asked& asked) {
  if (use.only_inside && asked.value("lattice") == value_none) return false;
  if (use.name == "radius-edge" && asked.value("lattice") != name_of(Lattice::refinement)) return false;
  if (is_among(options_of_improvement, use.name) && asked.value("improve") == value_none) return false;
  return use.name != "target-r" || asked.value("objective") == name_of(Objective::r);
}

}  // namespace

bool names_a_file(std::string_view option) {
  return option == "sizes";
}

const NamedOptions& usual_options() {
  static const NamedOptions all = [] {
    const MeshOptions o;
    return NamedOptions{{"boundary", text_of(o.improve.boundary)},
                        {"clearance", digits(o.clearance)},
                        {"delaunay", text_of(o.delaunay)},
                        {"edge-length", ""},
                        {"face-protection", "on"},
                        {"flatness", digits(o.flatness)},
                        {"grading", digits(o.grading)},
                        {"grid-scale", digits(o.grid_scale)},
                        {"improve", text_of(improvement_of(o))},
                        {"improve-time", digits(o.improve.time)},
                        {"lattice", text_of(o.lattice)},
                        {"locator", text_of(o.locator)},
                        {"objective", text_of(o.improve.objective)},
                        {"protection", text_of(o.protection)},
                        {"radius-edge", digits(o.radius_edge)},
                        {"sharp-angle", digits(o.sharp_angle)},
                        {"sizes", ""},
                        {"sphere-factor", digits(o.sphere_factor)},
                        {"steiner", text_of(o.improve.steiner)},
                        {"surface", text_of(o.surface)},
                        {"target-dihedral", digits(o.improve.target_dihedral)},
                        {"target-r", digits(o.improve.target_r)},
                        {"threads", "1"},
                        {"visibility", text_of(o.visibility)}};
  }();
  return all;
}

NamedOptions options_of(Strategies strategies, const NamedOptions& given) {
  NamedOptions options;
  if (strategies == Strategies::paper)
    options = {{"delaunay", text_of(DelaunayMethod::wrap)},
               {"improve", text_of(Improvement::swap_smooth)},
               {"locator", text_of(LocatorKind::grid)},
               {"protection", text_of(Protection::midpoint)},
               {"visibility", text_of(Visibility::faces)}};
  const auto lattice = given.find("lattice");
  if (lattice != given.end() && lattice->second == value_none) options.erase("improve");
  for (const auto& [name, value] : given) options.erase(name);
  return options;
}

NamedOptions with_strategies(NamedOptions options) {
  const auto named = options.find("strategies");
  if (named == options.end()) return options;
  const std::string name = canonical(named->first, named->second);
  options.erase(named);
  if (const auto strategies = value_of<Strategies>(name)) options.merge(options_of(*strategies, options));
  return options;
}

std::vector<OptionUse> options_of_engine() {
  std::vector<OptionUse> all;
  for (const auto& [name, value] : usual_options())
    if (name != "surface" && name != "sharp-angle")
      all.push_back({.name = name, .only_inside = is_among(options_of_lattice, name)});
  return all;
}

NamedOptions effective_options(const Mesher& mesher, const NamedOptions& options) {
  const Asked asked(options);
  const std::string surface = asked.value("surface");
  const bool is_remeshed = surface == "remesh";
  const bool is_refined = surface == "refine" && mesher.name == "ccdt";  // others do not refine
  const auto use_of = [&](const std::string& name) {
    return std::ranges::find(mesher.options, name, &OptionUse::name);
  };
  const bool is_bare = asked.value("lattice") == value_none && use_of("lattice") != mesher.options.end();
  const auto usual = [&](const std::string& name) {
    return name == "improve" && is_bare ? std::string(value_none) : usual_options().at(name);
  };
  NamedOptions effective;
  for (const auto& [name, value] : asked.options()) {
    const auto use = use_of(name);
    const bool is_of_surface = (name == "surface" && (is_refined || surface != "refine")) ||
                               (is_remeshed && is_among(options_of_surface, name)) ||
                               (is_refined && is_among(options_of_refinement, name));
    const bool is_used = use != mesher.options.end() && matters(*use, asked);
    const bool is_known = usual_options().contains(name);
    if (is_known && !is_of_surface && !is_used) continue;
    if (is_known && value == usual(name)) continue;
    const bool is_any =
        is_used && use->only_none && value != value_none;  // all values except none have the same effect
    if (is_any && usual(name) != value_none) continue;
    effective[name] = is_any ? usual_options().at(name) : value;
  }
  return effective;
}

}  // namespace ccdt::baselines
