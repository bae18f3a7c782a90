#include "bench/experiments/termination.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/stars.h"
#include "bench/experiments/surfaces.h"
#include "bench/results/numbers.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "models/solids.h"

namespace ccdt {
namespace {

constexpr std::array angles = {90.0, 60.0, 45.0, 36.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0};
constexpr std::array coarsenings = {3.0, 1.0};  ///< of a solid's usual edge length

struct Input {
  std::string group, name;
  double degrees;
  std::string stem;  ///< of the names of its records
  std::filesystem::path file;
};

std::string with_hyphens(std::string text) {
  std::ranges::replace(text, ' ', '-');
  return text;
}

/// More lengths of the segments where more effort is wanted.
std::uint64_t variants(const ExperimentOptions& options) {
  constexpr double tetrahedra_per_variant = 10000, most = 10;
  return static_cast<std::uint64_t>(std::clamp(std::round(options.tetrahedra / tetrahedra_per_variant), 1.0, most));
}

void add_stars(const ExperimentOptions& options, std::vector<Input>& inputs) {
  for (const Star& star : stars()) {
    if (!is_asked_for(options, star.name)) continue;
    for (const double degrees : angles)
      for (std::uint64_t variant = 0; variant < variants(options) && degrees >= star.smallest_angle; ++variant) {
        const std::string stem = "termination-" + with_hyphens(std::string(star.name)) + "-" +
                                 std::to_string(static_cast<int>(degrees)) + "-" + std::to_string(variant);
        inputs.push_back({std::string(star.name), std::to_string(variant), degrees, stem,
                          options.folder / "models" / (stem + ".poly")});
        write_plc(star.make(degrees, variant), inputs.back().file);
      }
  }
}

void add_solids(const ExperimentOptions& options, std::vector<Input>& inputs) {
  for (const Solid& solid : solids()) {
    if (!is_asked_for(options, solid.name)) continue;
    std::vector<Point3> before;
    for (const double coarsening : coarsenings) {
      const SurfaceFile surface =
          write_solid(options, "termination", std::string(solid.name), coarsening * solid.default_edge_length);
      std::vector<Point3> vertices = read_plc(surface.file).vertices;
      if (vertices == before) continue;  // as coarse as it gets, or always the same
      const std::string name = surface.name + " at " + rounded(surface.edge_length);
      inputs.push_back({"solid", name, 0, surface.file.stem().string(), surface.file});
      before = std::move(vertices);
    }
  }
}

double smallest_angle_of(const std::filesystem::path& file) {
  try {
    return smallest_angle(build_plc(read_plc(file), {}));
  } catch (const Error&) {
    return std::nan("");  // the runs say why
  }
}

TerminationCase measure(const ExperimentOptions& options, const Input& input, double smallest, Protection protection) {
  const std::string stem = input.stem + "-" + std::string(name_of(protection));
  MeasuredCase measured{stem,
                        stem,
                        {"ccdt",
                         input.file,
                         options.folder / "meshes" / (stem + ".vtu"),
                         {"--protection", std::string(name_of(protection)), "--lattice", "none", "--improve", "none"}}};
  run_once(options, measured, 0);
  std::filesystem::remove(measured.what.output);
  const RunRecord& run = measured.first;
  return {.group = input.group,
          .input = input.name,
          .degrees = input.degrees,
          .smallest_angle = smallest,
          .protection = protection,
          .status = run.status,
          .reason = run.reason,
          .steiner_vertices = run.counts.steiner_vertices,
          .deepest_level = run.counts.splits_by_level.size(),
          .runs = run_files(measured)};
}

}  // namespace

ExperimentResult measure_termination(const ExperimentOptions& options, const Progress& progress) {
  Circumstances how = start_experiment(options);
  how.runs = 1;
  std::vector<Input> inputs;
  add_stars(options, inputs);
  add_solids(options, inputs);
  for (const SurfaceFile& surface : input_files(options))
    inputs.push_back({"file", surface.name, 0, "termination-" + surface.file.filename().string(), surface.file});
  check_something_is_measured(inputs.size(), "termination");

  std::vector<TerminationCase> cases;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    report(progress, inputs[i].stem, i, inputs.size());
    const double smallest = smallest_angle_of(inputs[i].file);
    for (const Protection protection : {Protection::midpoint, Protection::shell})
      cases.push_back(measure(options, inputs[i], smallest, protection));
  }
  ExperimentResult result = termination_result(cases);
  result.how = std::move(how);
  return result;
}

}  // namespace ccdt
