#include "bench/experiments/locators.h"

#include <array>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/surfaces.h"
#include "engine/io/plc_files.h"

namespace ccdt {
namespace {

constexpr std::array all_locators = {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity};

struct Model {
  const char* name;
  double edge_length;  ///< for about 20,000 vertices
  SurfaceKind kind;
};
constexpr std::array<Model, 5> models = {{{"piston", 2.3, SurfaceKind::uniform},
                                          {"bracket", 1.8, SurfaceKind::uniform},
                                          {"stepping-pole", 1.8, SurfaceKind::uniform},
                                          {"graded-cube", 0.0625, SurfaceKind::graded},
                                          {"rough-sphere", 0.06, SurfaceKind::rough}}};

/// A surface with or without the check, before and after its runs.
struct Group {
  LocatorsCase result;
  std::vector<MeasuredCase> cases;  ///< one a locator
};

Group group_of(const ExperimentOptions& options, const SurfaceFile& surface, SurfaceKind kind, bool face_protection,
               std::size_t number) {
  Group group;
  group.result = {surface.name, kind, face_protection, edge_ratio(read_plc(surface.file)), {}, {}, {}, {}};
  const std::string check = face_protection ? "on" : "off";
  for (const LocatorKind locator : all_locators) {
    const std::string name(name_of(locator));
    std::string stem = "locators-" + std::to_string(number);
    for (const std::string& part : {std::filesystem::path(surface.name).stem().string(), check, name})
      stem += "-" + part;
    std::vector<std::string> words = {"--improve", "none", "--locator", name, "--face-protection", check};
    if (kind == SurfaceKind::uniform) words.insert(words.end(), {"--grading", "0"});
    group.cases.push_back({name, stem, {"ccdt", surface.file, options.folder / "meshes" / "locators.vtu", words}});
  }
  return group;
}

std::vector<Group> plan(const ExperimentOptions& options) {
  std::vector<Group> groups;
  const auto add = [&](const SurfaceFile& surface, SurfaceKind kind) {
    groups.push_back(group_of(options, surface, kind, false, groups.size()));
    if (kind == SurfaceKind::rough || kind == SurfaceKind::input)
      groups.push_back(group_of(options, surface, kind, true, groups.size()));
  };
  for (const Model& model : models)
    if (is_asked_for(options, model.name))
      add(write_solid(options, "locators", model.name, model.edge_length), model.kind);
  for (const SurfaceFile& input : input_files(options)) add(input, SurfaceKind::input);
  return groups;
}

LocatorsCase evaluate(const Group& group) {
  LocatorsCase result = group.result;
  const auto front_seconds = [](const StageSeconds& s) { return s.front; };
  for (std::size_t i = 0; i < all_locators.size(); ++i) {
    const MeasuredCase& measured = group.cases[i];
    LocatorsRow row{all_locators[i], {}, {}, measured.first.status, measured.first.reason, run_files(measured)};
    if (!measured.failed()) {
      result.counts = measured.first.counts;
      row.samples = samples_of(measured.counted, front_seconds);
      row.seconds = median_estimate(row.samples);
    }
    result.rows.push_back(row);
  }
  const auto over_grid = [&](const LocatorsRow& row) -> std::optional<Estimate> {
    const LocatorsRow& grid = result.rows[0];
    if (!row.seconds || !grid.seconds || quantile(grid.samples, 0) <= 0) return {};
    return ratio_of_medians(row.samples, grid.samples);
  };
  result.octree_over_grid = over_grid(result.rows[1]);
  result.cavity_over_grid = over_grid(result.rows[2]);
  return result;
}

}  // namespace

std::optional<Claim> expectation(const LocatorsCase& locators) {
  if (!locators.octree_over_grid) return {};
  if (locators.kind == SurfaceKind::graded) return is_at_most(*locators.octree_over_grid, 1);
  if (locators.kind == SurfaceKind::uniform) return is_at_least(*locators.octree_over_grid, 1);
  return {};
}

std::string_view name_of(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::uniform:
      return "uniform";
    case SurfaceKind::graded:
      return "graded";
    case SurfaceKind::rough:
      return "rough";
    case SurfaceKind::input:
      return "input";
  }
  return "";
}

std::vector<std::string> locators_definitions() {
  return {
      "Seconds of the front alone; the locators' structures are built within it.",
      "Check off: every face goes through the front. Check on: only the faces that are not Delaunay do.",
      "Uniform: the paper's models with interior vertices at the density of the surface.",
      "Graded: a cube with squares on its faces that shrink towards a corner.",
      "Rough: a sphere with uneven radii, so that some faces are not Delaunay.",
      "Edge ratio: the longest edge of the surface over the shortest.",
      "Ratios are of medians. A claim holds if the whole interval is on its side of 1.",
  };
}

Locators measure_locators(const ExperimentOptions& options, const Progress& progress) {
  Locators locators;
  locators.how = start_experiment(options);
  std::vector<Group> groups = plan(options);
  check_something_is_measured(groups.size(), "locators");
  const std::uint64_t total = groups.size() * all_locators.size() * static_cast<std::uint64_t>(options.runs + 1);
  std::uint64_t done = 0;
  for (Group& group : groups) {
    for (int number = 0; number <= options.runs; ++number)
      for (MeasuredCase& measured : group.cases) {
        report(progress, measured.stem, done++, total);
        run_once(options, measured, number);
      }
    locators.cases.push_back(evaluate(group));
  }
  std::filesystem::remove(options.folder / "meshes" / "locators.vtu");
  return locators;
}

}  // namespace ccdt
