#include "baselines/mesher_options.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "engine/base/digits.h"
#include "engine/options/option_table.h"

namespace ccdt::baselines {
namespace {

constexpr std::string_view value_none = "none";

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
  const options::MeshOption* const option = options::find_mesh_option(use.name);
  return option == nullptr || std::ranges::all_of(option->needs, [&](const options::Need& need) {
           return (asked.value(std::string(need.option)) == need.value) == need.is;
         });
}

}  // namespace

bool names_a_file(std::string_view option) {
  const options::MeshOption* const known = options::find_mesh_option(option);
  return known != nullptr && std::holds_alternative<options::FileKind>(known->kind);
}

const NamedOptions& usual_options() {
  static const NamedOptions all = [] {
    NamedOptions usual;
    MeshOptions defaults;
    for (const options::MeshOption& option : options::mesh_options())
      usual[std::string(option.name)] =
          option.usual ? *option.usual : options::text_of(options::recorded_value(option, defaults));
    return usual;
  }();
  return all;
}

NamedOptions options_of(Strategies strategies, const NamedOptions& given) {
  NamedOptions options;
  if (strategies == Strategies::paper)
    options = {{"delaunay", "wrap"},
               {"improve", "swap-smooth"},
               {"locator", "grid"},
               {"protection", "midpoint"},
               {"visibility", "faces"}};
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
  for (const options::MeshOption& option : options::mesh_options())
    all.push_back({.name = std::string(option.name), .only_inside = option.of_inside});
  return all;
}

NamedOptions effective_options(const Mesher& mesher, const NamedOptions& options) {
  const Asked asked(options);
  const std::string surface = asked.value("surface");
  const bool is_remeshed = surface == "remesh" || surface == "auto";
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
    const bool is_used = use != mesher.options.end() && matters(*use, asked);
    if (const options::MeshOption* const option = options::find_mesh_option(name)) {
      const bool is_of_surface = (is_remeshed && option->of_remeshing) || (is_refined && option->of_refinement);
      const bool has_effect = is_used || is_of_surface || option->of_any_mesher;
      if (!has_effect || value == usual(name)) continue;
    }
    const bool is_any =
        is_used && use->only_none && value != value_none;  // all values except none have the same effect
    if (is_any && usual(name) != value_none) continue;
    effective[name] = is_any ? usual_options().at(name) : value;
  }
  return effective;
}

}  // namespace ccdt::baselines
