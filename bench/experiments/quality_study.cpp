#include "bench/experiments/quality_study.h"

#include <algorithm>
#include <cmath>

#include "baselines/mesher_input.h"
#include "bench/experiments/count_search.h"
#include "bench/experiments/measured_case.h"
#include "bench/experiments/surfaces.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

/// A solid's name or a file, to be read when its turn comes.
struct Source {
  std::string name;
  std::filesystem::path file = {};  ///< none of a solid
};

std::vector<Source> sources_of(const ExperimentOptions& options, const StudyPlan& plan) {
  std::vector<Source> sources;
  for (const std::string& model : plan.models)
    if (is_asked_for(options, model)) sources.push_back({model});
  for (const auto& input : options.inputs) sources.push_back({input.filename().string(), input});
  return sources;
}

std::vector<std::string> words_for(const QualityVariant& variant, double edge_length) {
  std::vector<std::string> words = variant.words;
  words.insert(words.end(), {"--edge-length", digits(edge_length), "--grading", "0"});
  return words;
}

/// One source at one size, while it is measured.
struct Work {
  const ExperimentOptions& options;
  const StudyPlan& plan;
  const SurfaceSource& source;
  std::string stem;                 ///< of the names of its files
  std::vector<MeasuredCase> cases;  ///< one a variant
  std::vector<KeptMesh> meshes = {};

  std::filesystem::path mesh() const { return options.folder / "meshes" / (plan.experiment + ".vtu"); }

  MeasuredCase case_of(const QualityVariant& variant, const std::filesystem::path& surface, double edge_length) const {
    std::string name = variant.name;
    std::ranges::replace(name, ' ', '-');
    return {variant.name, stem + "-" + name, {variant.mesher, surface, mesh(), words_for(variant, edge_length)}};
  }
};

/// Looks for the edge length of the surface at which our FCC lattice makes the wanted number of tetrahedra, the surface
/// having edges of the length of those inside.
EvenSurface find_surface(const Work& work, double wanted) {
  const QualityVariant bare = {"surface", "ccdt", {"--lattice", "fcc", "--improve", "none"}};
  const auto file = work.options.folder / "models" / (work.stem + ".poly");
  EvenSurface surface;
  std::string reason;
  const auto count_of = [&](double edge_length) -> std::optional<std::uint64_t> {
    surface = make_even_surface(work.source, edge_length, file);
    MeasuredCase measured = work.case_of(bare, file, edge_length);
    run_once(work.options, measured, 0);
    reason = measured.first.reason;
    if (measured.failed()) return {};
    return measured.first.counts.tetrahedra;
  };
  const double regular = std::cbrt(work.source.volume / wanted / regular_tetrahedron_volume(1));
  const auto found = search_edge_length({.wanted = wanted,
                                         .first = regular,
                                         .shortest = work.source.shortest,
                                         .longest = work.source.longest,
                                         .most_tries = 5},
                                        count_of);
  if (!found) throw MeshError("no surface of this source was meshed: " + reason, {}, "");
  if (found->edge_length != surface.edge_length) surface = make_even_surface(work.source, found->edge_length, file);
  return surface;
}

/// Runs a variant for the first time, at the edge length that makes as many tetrahedra as the first variant has.
void run_at_equal_count(Work& work, const QualityVariant& variant, const EvenSurface& surface) {
  const double wanted = static_cast<double>(work.cases.front().first.counts.tetrahedra);
  MeasuredCase tried, best;
  const auto count_of = [&](double edge_length) -> std::optional<std::uint64_t> {
    tried = work.case_of(variant, surface.file, edge_length);
    run_once(work.options, tried, 0);
    const double count = static_cast<double>(tried.first.counts.tetrahedra);
    const auto error = [&](double n) { return std::abs(std::log(std::max(n, 1.0) / wanted)); };
    const double least = static_cast<double>(best.first.counts.tetrahedra);
    if (best.stem.empty() || (!tried.failed() && error(count) < error(least))) best = tried;
    if (tried.failed()) return {};
    return tried.first.counts.tetrahedra;
  };
  search_edge_length({.wanted = wanted, .first = surface.edge_length}, count_of);
  work.cases.push_back(best);
}

void run_first(Work& work, const QualityVariant& variant, const EvenSurface& surface) {
  const bool has_reference = !work.cases.empty() && !work.cases.front().failed();
  if (work.plan.equal_counts && has_reference) return run_at_equal_count(work, variant, surface);
  work.cases.push_back(work.case_of(variant, surface.file, surface.edge_length));
  run_once(work.options, work.cases.back(), 0);
}

/// Keeps the mesh that a variant has just made, if it is wanted and not too large.
void keep_small_mesh(Work& work, const MeasuredCase& measured) {
  if (!work.plan.keeps_meshes || measured.failed()) return;
  if (measured.first.counts.tetrahedra > most_kept_tetrahedra) return;
  work.meshes.push_back(keep_mesh(work.options, measured, work.source.name + ", " + measured.name));
}

/// Counts the runs after the first, in turn; or the first itself, if it is the only one.
void run_counted(Work& work) {
  if (work.plan.once) {
    for (MeasuredCase& measured : work.cases)
      if (!measured.failed()) measured.counted = {measured.first};
    return;
  }
  for (int number = 1; number <= work.options.runs; ++number)
    for (MeasuredCase& measured : work.cases) {
      run_once(work.options, measured, number);
      if (number == 1) keep_small_mesh(work, measured);
    }
}

/// The edge length among the options of a case.
double asked_edge_length(const MeasuredCase& measured) {
  const auto& words = measured.what.options;
  return std::stod(*(std::ranges::find(words, "--edge-length") + 1));
}

QualityRow row_of(const MeasuredCase& measured, const QualityVariant& variant, const MeasuredCase& reference) {
  QualityRow row;
  row.variant = measured.name;
  row.labels = variant.labels;
  row.runs = run_files(measured);
  row.is_ours = variant.mesher == "ccdt";
  row.edge_length = asked_edge_length(measured);
  row.status = measured.first.status;
  row.reason = measured.first.reason;
  if (measured.failed()) return row;
  row.samples = samples_of(measured.counted, [](const StageSeconds& s) { return s.mesh; });
  row.seconds = median_estimate(row.samples);
  row.improve_seconds = median(samples_of(measured.counted, [](const StageSeconds& s) { return s.improve; }));
  row.counts = measured.first.counts;
  row.quality = measured.first.quality;
  const double ratio =
      static_cast<double>(row.counts.tetrahedra) / static_cast<double>(reference.first.counts.tetrahedra);
  row.is_comparable = std::abs(ratio - 1) <= equal_count_tolerance;
  return row;
}

QualityCase measure_case(Work& work, std::uint64_t wanted, const std::function<void(const std::string&)>& announce) {
  QualityCase result;
  result.name = work.source.name;
  result.wanted = wanted;
  announce(work.stem);
  try {
    result.surface = find_surface(work, static_cast<double>(wanted));
  } catch (const Error& error) {
    result.reason = error.what();
    return result;
  }
  for (const QualityVariant& variant : work.plan.variants) {
    announce(work.stem + " " + variant.name);
    run_first(work, variant, result.surface);
  }
  run_counted(work);
  for (std::size_t i = 0; i < work.cases.size(); ++i)
    result.rows.push_back(row_of(work.cases[i], work.plan.variants[i], work.cases.front()));
  std::filesystem::remove(work.mesh());
  return result;
}

/// A source. One that cannot be read is a case without rows, not the end of the experiment.
void measure_source(const ExperimentOptions& options, const StudyPlan& plan, const Source& source, QualityStudy& study,
                    const std::function<void(const std::string&)>& announce) {
  std::optional<SurfaceSource> read;
  std::string reason;
  try {
    read = source.file.empty() ? solid_source(source.name) : file_source(source.file);
    read->name = source.name;
  } catch (const Error& error) {
    reason = error.what();
  }
  const auto wanted = static_cast<std::uint64_t>(options.tetrahedra);
  const std::string stem = plan.experiment + "-" + std::to_string(study.cases.size()) + "-" +
                           std::filesystem::path(source.name).stem().string();
  if (read) {
    Work work{options, plan, *read, stem, {}};
    study.cases.push_back(measure_case(work, wanted, announce));
    study.meshes.insert(study.meshes.end(), work.meshes.begin(), work.meshes.end());
    return;
  }
  QualityCase unread;
  unread.name = source.name;
  unread.wanted = wanted;
  unread.reason = reason;
  study.cases.push_back(unread);
}

}  // namespace

std::vector<std::string> names_of_paper_models() {
  std::vector<std::string> names;
  for (const PaperModel& model : paper_models) names.emplace_back(model.name);
  return names;
}

std::vector<std::string> study_definitions() {
  return {
      "r: the paper's measure, ((1/6) sum of squared edges)^(3/2) / (8.48528 volume); 1 is the regular tetrahedron.",
      "Dihedral angles: the smallest and the largest of the whole mesh, in degrees.",
      "Aspect ratio: the longest edge over 2 sqrt(6) times the radius of the inscribed sphere, as in VTK and Verdict.",
      "HXT improves its inverse. The regular tetrahedron's is 1.",
      "Radius-edge ratio: the circumscribed sphere's radius over the shortest edge, as in TetGen; regular: 0.612.",
      "Surface: triangles of nearly one size, at which our tetrahedra inside have edges of the surface's length.",
      "It is remeshed, unless its angles have 25 degrees or more and nine tenths of its edges differ by less than 2.",
      "Seconds are of meshing alone, with improvement, without reading and writing; one thread.",
  };
}

QualityStudy measure_study(const ExperimentOptions& options, const StudyPlan& plan, const Progress& progress) {
  QualityStudy study;
  study.how = start_experiment(options);
  study.labels = plan.labels;
  if (plan.once) study.how.runs = 1;
  const std::vector<Source> sources = sources_of(options, plan);
  check_something_is_measured(sources.size(), plan.experiment);
  const std::uint64_t total = sources.size() * (plan.variants.size() + 1);
  std::uint64_t done = 0;
  const auto announce = [&](const std::string& what) { report(progress, what, std::min(done++, total), total); };
  for (const Source& source : sources) measure_source(options, plan, source, study, announce);
  return study;
}

}  // namespace ccdt
