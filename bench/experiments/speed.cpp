#include "bench/experiments/speed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "baselines/mesher.h"
#include "bench/experiments/surfaces.h"

namespace ccdt::experiments {
namespace {

constexpr const char *surface_alone = "surface alone", *end_to_end = "end to end";
constexpr unsigned projected_threads = 64;

const std::vector<std::string> speed_definitions = {
    "Surface alone: a mesh of the input without interior points (--lattice none).",
    "End to end: the surface is kept, the inside gets vertices, and the tetrahedra are improved.",
    "Seconds: meshing alone, without reading and writing.",
    "Of ccdt: all stages. Of others: the call of the library, or the time that the program reports.",
    "Ratio: seconds over those of ccdt on one thread in the same task; above 1, ccdt is faster.",
    "Other meshers run on one thread. They choose their own vertices, so compare microseconds per tetrahedron too.",
    "Strong scaling: the same model on more threads. Weak scaling: the number of tetrahedra grows with the threads.",
    "Speedup: seconds on one thread over seconds on several; for weak scaling, the ratio of tetrahedra per second.",
    "Serial share (Karp and Flatt 1990): it would explain the speedup if the other work were divided evenly.",
    "Projection: the speedup on 64 threads by Amdahl's law with this serial share. It was not measured.",
};

std::string threads_words(unsigned threads) {
  return "--threads " + std::to_string(threads);
}

/// 1, 2, 4, ... and all cores.
std::vector<unsigned> thread_counts() {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  std::vector<unsigned> counts;
  for (unsigned threads = 1; threads < cores; threads *= 2) counts.push_back(threads);
  counts.push_back(cores);
  return counts;
}

// ---- Tables

RowColumn<SpeedRow> quality_column(const char* name, double (*measure)(const bench::Quality&), const char* unit = "") {
  return run_column(figure_column(name, "", unit),
                    [measure](const RunRecord& run) { return Cell(measure(run.quality)); });
}

RowColumns<SpeedRow> columns_of_case(const RowColumns<SpeedRow>& more) {
  RowColumns<SpeedRow> columns = {
      {label_column("task"), &SpeedRow::task},
      {label_column("model"), &SpeedRow::model},
      {label_column("mesher"), [](const SpeedRow& row) { return mesher_of(row); }},
      {label_column("threads"), [](const SpeedRow& row) { return std::to_string(row.threads); }}};
  append(columns, more);
  return columns;
}

/// Microseconds per tetrahedron; none for a run that failed.
std::optional<Estimate> microseconds_of(const SpeedRow& row) {
  const auto seconds = seconds_of(row);
  const auto count = static_cast<double>(row.measured.first.counts.tetrahedra);
  if (!seconds || count == 0) return {};
  const double factor = 1e6 / count;
  return Estimate{factor * seconds->value, factor * seconds->low, factor * seconds->high};
}

/// A row with its ratio to ccdt on one thread.
struct ComparedRow : SpeedRow {
  std::optional<Estimate> ratio = {};
};

RowColumns<ComparedRow> speed_columns() {
  const RowColumns<SpeedRow> of_case =
      columns_of_case({status_column(), count_column("tetrahedra", &MeshCounts::tetrahedra), seconds_column()});
  const RowColumns<SpeedRow> rest = {
      {time_column("microseconds_per_tetrahedron", "", "us"), microseconds_of},
      run_column(time_column("memory", "peak memory", "MB"),
                 [](const RunRecord& run) { return Cell(static_cast<double>(run.peak_rss_bytes) / 1e6); }),
      quality_column("worst_r", [](const bench::Quality& q) { return q.r.max; }),
      quality_column(
          "smallest_dihedral", [](const bench::Quality& q) { return q.dihedral_degrees.min; }, "degrees"),
      reason_column()};
  RowColumns<ComparedRow> columns;
  for (const auto& column : of_case) columns.emplace_back(column);
  columns.push_back({time_column("ratio", "over ccdt on one thread"), &ComparedRow::ratio});
  for (const auto& column : rest) columns.emplace_back(column);
  return columns;
}

RowColumns<SpeedRow> stage_columns() {
  RowColumns<SpeedRow> columns = columns_of_case({});
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    if (stage.value != Stage::remesh)  // no case has it
      columns.push_back({time_column(std::string(stage.name), "", "s"), [stage = stage.value](const SpeedRow& row) {
                           const auto samples = samples_of(row.measured, stage_seconds(stage));
                           return samples.empty() ? Cell() : Cell(bench::median(samples));
                         }});
  return columns;
}

/// A decreasing function of an estimate.
template <class Function>
Estimate decreasing(const Estimate& e, Function function) {
  if (!e.has_interval()) return bench::without_interval(function(e.value));
  return {function(e.value), function(e.high), function(e.low)};
}

/// The speedup on several threads.
struct ScalingRow {
  SpeedRow several, one;
  Estimate speedup;

  double serial_share(double s) const {
    const double n = several.threads;
    return std::clamp((1 / s - 1 / n) / (1 - 1 / n), 0.0, 1.0);
  }
  Estimate serial() const {
    return decreasing(speedup, [this](double s) { return serial_share(s); });
  }
};
std::vector<std::string> runs_of(const ScalingRow& row) {
  return all_runs_of(std::array{row.several, row.one});
}

double amdahl(double serial) {
  return 1 / (serial + (1 - serial) / projected_threads);
}

RowColumns<ScalingRow> scaling_columns() {
  return {{label_column("task"), [](const ScalingRow& row) { return row.several.task; }},
          {label_column("model"), [](const ScalingRow& row) { return row.several.model; }},
          {label_column("scaling"),
           [](const ScalingRow& row) { return std::string(row.several.is_weak ? "weak" : "strong"); }},
          {label_column("threads"), [](const ScalingRow& row) { return std::to_string(row.several.threads); }},
          {time_column("speedup"), &ScalingRow::speedup},
          {time_column("serial_share", "serial share"), &ScalingRow::serial},
          {time_column("projection", "projected speedup on 64 threads"),
           [](const ScalingRow& row) { return decreasing(row.serial(), amdahl); }}};
}

/// The row of ccdt on one thread in the same task; null if there is none.
const SpeedRow* on_one_thread(std::span<const SpeedRow> rows, const SpeedRow& row) {
  const auto found = std::ranges::find_if(rows, [&](const SpeedRow& other) {
    return is_ours(other) && other.threads == 1 && other.task == row.task && other.model == row.model;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::optional<ScalingRow> scaling_of(const SpeedRow& several, const SpeedRow& one) {
  const auto ratio = ratio_of(one, several);
  if (!ratio) return {};
  const double growth = static_cast<double>(several.measured.first.counts.tetrahedra) /
                        static_cast<double>(one.measured.first.counts.tetrahedra);
  return ScalingRow{several, one, {growth * ratio->value, growth * ratio->low, growth * ratio->high}};
}

std::string finding_of(const ScalingRow& row) {
  return row.several.model + ", " + row.several.task + ", " + std::to_string(row.several.threads) + " threads" +
         (row.several.is_weak ? " on a mesh that is larger by that factor" : "") + ": " + with_interval(row.speedup) +
         " times the speed of one";
}

// ---- Cases

struct Plan {
  const ExperimentOptions& options;
  std::vector<SpeedRow> rows = {};

  void add(const SurfaceFile& surface, const char* task, const std::string& mesher, std::string words,
           unsigned threads = 1, bool is_weak = false) {
    SpeedRow row{{}, task, surface.name, threads, is_weak};
    const std::string name =
        surface.name + ", " + task + ", " + mesher + ", " + threads_words(threads) + (is_weak ? ", weak" : "");
    if (mesher == "ccdt") words += (words.empty() ? "" : " ") + threads_words(threads);
    row.measured.asked = timed_case(options, "speed " + surface.name + " " + task,
                                    single_case(options, name, mesher, surface.file, words_of(words)));
    rows.push_back(row);
  }
};

void plan_surface(const SurfaceFile& surface, Plan& plan) {
  for (const auto& [task, words] : {std::pair(surface_alone, "--lattice none"), std::pair(end_to_end, "")}) {
    for (const unsigned threads : thread_counts()) plan.add(surface, task, "ccdt", words, threads);
    if (is_timed(plan.options, "tetgen")) plan.add(surface, task, "tetgen", words);
    if (task == end_to_end && is_timed(plan.options, "cgal-mesh3")) plan.add(surface, task, "cgal-mesh3", words);
    for (const std::string& file : described_meshers(plan.options)) plan.add(surface, task, file, words);
  }
}

void plan_weak_scaling(const ExperimentOptions& options, const PaperModel& model, Plan& plan) {
  for (const unsigned threads : thread_counts()) {
    if (threads == 1) continue;
    SurfaceFile larger = write_solid(options, "speed-" + std::to_string(threads), model.name,
                                     model.edge_length * std::cbrt(1.0 / threads));
    plan.add(larger, end_to_end, "ccdt", "", threads, true);
  }
}

}  // namespace

ExperimentResult speed_result(std::span<const SpeedRow> rows) {
  ExperimentResult result{.definitions = speed_definitions};
  std::vector<ComparedRow> compared;
  std::vector<SpeedRow> stages;
  std::vector<ScalingRow> scaling;
  for (const SpeedRow& row : rows) {
    add_problem_of(row, result);
    const SpeedRow* one = on_one_thread(rows, row);
    if (!row.is_weak) compared.push_back({row, one != nullptr ? ratio_of(row, *one) : std::nullopt});
    if (!is_ours(row)) continue;
    if (!row.is_weak) stages.push_back(row);
    if (one == nullptr || row.threads == 1) continue;
    if (const auto found = scaling_of(row, *one)) scaling.push_back(*found);
  }
  for (const ScalingRow& row : scaling) result.findings.push_back(finding_of(row));
  result.tables = {table_of_rows("speed", "Seconds, memory and quality", speed_columns(), compared),
                   table_of_rows("stages", "Seconds of the stages of ccdt", stage_columns(), stages),
                   table_of_rows("scaling", "Threads", scaling_columns(), scaling)};
  return result;
}

ExperimentResult measure_speed(const ExperimentOptions& options, bench::Runner& runner) {
  Plan plan{options};
  for (const PaperModel& model : paper_models) {
    if (!is_chosen(options, model.name)) continue;
    plan_surface(write_solid(options, "speed", model.name, model.edge_length), plan);
    plan_weak_scaling(options, model, plan);
  }
  for (const SurfaceFile& input : input_files(options)) plan_surface(input, plan);
  check_something_is_measured(plan.rows.size(), "speed");
  measure_rows(runner, plan.rows);
  ExperimentResult result = speed_result(plan.rows);
  result.definitions.push_back(repetition_words(options));
  return result;
}

}  // namespace ccdt::experiments
