#include "bench/experiments/interior_points.h"

#include <algorithm>
#include <array>

#include "bench/experiments/case_runner.h"
#include "bench/experiments/surfaces.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt {
namespace {

constexpr std::array lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};
constexpr std::array rules = {InteriorRule::paper, InteriorRule::no_spheres, InteriorRule::no_distances};
constexpr std::uint64_t tetrahedra_a_trial = 100;  ///< so many small PLCs a family are tried for the wanted tetrahedra
constexpr std::array coarsenings = {4.0, 2.0, 1.0};  ///< of a solid's usual edge length

std::vector<std::string> options_of(InteriorRule rule) {
  switch (rule) {
    case InteriorRule::paper:
      return {"--sphere-factor", "1"};
    case InteriorRule::no_spheres:
      return {"--sphere-factor", "0"};
    case InteriorRule::no_distances:
      return {"--sphere-factor", "0", "--clearance", "0.01"};
  }
  return {};
}

std::vector<SurfaceFile> surfaces(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files;
  for (const Solid& solid : solids()) {
    if (!is_asked_for(options, solid.name)) continue;
    std::vector<Point3> before;
    for (const double coarsening : coarsenings) {
      const SurfaceFile surface =
          write_solid(options, "interior-points", std::string(solid.name), coarsening * solid.default_edge_length);
      std::vector<Point3> vertices = read_plc(surface.file).vertices;
      if (vertices == before) continue;  // too coarse for a difference, or always the same
      files.push_back(surface);
      before = std::move(vertices);
    }
  }
  std::ranges::copy(input_files(options), std::back_inserter(files));
  return files;
}

InteriorCase run(const ExperimentOptions& options, const SurfaceFile& surface, Lattice lattice, InteriorRule rule,
                 std::uint64_t number) {
  std::vector<std::string> words = options_of(rule);
  words.insert(words.end(), {"--improve", "none", "--lattice", std::string(name_of(lattice))});
  const std::string record = "runs/interior-points-" + std::to_string(number) + ".json";
  const RunRecord run = run_case(options.program, options.folder,
                                 {"ccdt", surface.file, options.folder / "meshes" / "interior-points.vtu", words},
                                 options.folder / record, options.limits);
  return {surface.name,
          surface.edge_length,
          lattice,
          rule,
          run.counts.interior_vertices,
          run.counts.dropped_interior_vertices,
          run.status,
          run.reason,
          {record}};
}

template <class Chosen>
InteriorSummary summarize_if(std::span<const InteriorCase> cases, Chosen is_chosen) {
  InteriorSummary summary;
  for (const InteriorCase& c : cases) {
    if (!is_chosen(c)) continue;
    if (c.status != RunStatus::ok) {
      ++summary.failed;
      continue;
    }
    ++summary.cases;
    summary.harmed += c.dropped > 0;
    summary.placed += c.placed;
    summary.dropped += c.dropped;
  }
  return summary;
}

}  // namespace

InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule) {
  return summarize_if(cases, [&](const InteriorCase& c) { return c.rule == rule; });
}

InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule, Lattice lattice) {
  return summarize_if(cases, [&](const InteriorCase& c) { return c.rule == rule && c.lattice == lattice; });
}

std::string_view name_of(InteriorRule rule) {
  switch (rule) {
    case InteriorRule::paper:
      return "paper";
    case InteriorRule::no_spheres:
      return "no spheres";
    case InteriorRule::no_distances:
      return "no distances";
  }
  return "";
}

std::vector<std::string> interior_points_definitions() {
  return {
      "The paper, section 3: \"Insertion of interior points does not affect CDT existence.\" It gives no proof.",
      "Family: small random PLCs with a CDT, to which one interior point is added; existence is tested by exhaustion.",
      "Existence rests on edge protection: each grazeable edge is a chain of Delaunay edges.",
      "A point does harm, and is dropped, if with it a protected edge would be Delaunay no more.",
      "Rule paper: no point in the smallest sphere of a face or subsegment, nor near to the surface.",
      "Near: within 0.55 edge lengths.",
      "Rule no spheres: the distance alone (--sphere-factor 0).",
      "Rule no distances: neither (--sphere-factor 0 --clearance 0.01).",
      "A case is one input at one density, with one lattice and one rule.",
      "The smallest counterexample we know is a tetrahedron with a dent, five vertices, and one point below the dent.",
      "With that point it has tetrahedralizations, but no constrained Delaunay one.",
      "See engine/tests/interior_points_test.cpp.",
  };
}

InteriorPoints measure_interior_points(const ExperimentOptions& options, const Progress& progress) {
  InteriorPoints points;
  points.how = start_experiment(options);
  points.how.runs = 1;
  const std::vector<SurfaceFile> files = surfaces(options);
  check_something_is_measured(files.size(), "interior-points");
  const std::uint64_t total = files.size() * lattices.size() * rules.size();
  for (const SurfaceFile& file : files)
    for (const Lattice lattice : lattices)
      for (const InteriorRule rule : rules) {
        const std::uint64_t number = points.cases.size();
        report(progress, file.name + " " + std::string(name_of(lattice)), number, total);
        points.cases.push_back(run(options, file, lattice, rule, number));
      }
  std::filesystem::remove(options.folder / "meshes" / "interior-points.vtu");
  points.existence = try_interior_points(static_cast<std::uint64_t>(options.tetrahedra) / tetrahedra_a_trial);
  return points;
}

}  // namespace ccdt
