#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"
#include "bench/run/surface_measures.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "models/stars.h"

namespace ccdt::experiments {
namespace {

constexpr std::array angles = {90.0, 60.0, 45.0, 36.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0};
constexpr std::array termination_coarsenings = {3.0, 1.0};  ///< of a solid's usual edge length
constexpr std::array termination_ways = {Protection::midpoint, Protection::shell};

bool is_star(const TerminationRow& row) {
  return row.group != "solid" && row.group != "file";
}

/// Unknown if the run failed for a reason other than the engine's limit.
std::optional<bool> has_ended(const TerminationRow& row) {
  if (row.ok()) return true;
  if (row.measured.first.kind == baselines::FailureKind::limit) return false;
  return {};
}

std::string in_words(double degrees) {
  return std::to_string(std::lround(degrees)) + " degrees";
}

std::optional<double> smallest_angle_of(const std::filesystem::path& file) {
  try {
    return bench::smallest_segment_angle(plc::build_plc(io::read_plc(file), {}));
  } catch (const Error&) {
    return {};  // the records say why
  }
}

/// An input that is protected in both ways.
void add_input(const ExperimentOptions& options, const TerminationRow& input, const std::filesystem::path& file,
               std::vector<TerminationRow>& rows) {
  const std::string name = is_star(input) ? input.group + ", " + input.label : input.label;
  const auto smallest_angle = smallest_angle_of(file);
  for (const Protection protection : termination_ways) {
    const std::string way(name_of(protection));
    TerminationRow& row = rows.emplace_back(input);
    row.smallest_angle = smallest_angle;
    row.protection = protection;
    row.measured.asked =
        single_case(options, joined({name, way}), "ccdt", file,
                    {"--protection", way, "--lattice", "none", "--improve", "none", "--steiner", "keep"});
  }
}

/// More variants of segment lengths at larger scales.
std::uint64_t variants(const ExperimentOptions& options) {
  constexpr double tetrahedra_per_variant = 10000, most = 10;
  return static_cast<std::uint64_t>(std::clamp(std::round(options.tetrahedra / tetrahedra_per_variant), 1.0, most));
}

void add_star(const ExperimentOptions& options, const models::Star& star, std::vector<TerminationRow>& rows) {
  for (const double degrees : angles)
    for (std::uint64_t variant = 0; variant < variants(options) && degrees >= star.smallest_angle; ++variant) {
      std::string file = "termination-" + std::string(star.name) + "-" + std::to_string(std::lround(degrees)) + "-" +
                         std::to_string(variant) + ".poly";
      std::ranges::replace(file, ' ', '-');
      io::write_plc(models::make_star(star, degrees, variant), options.folder / "models" / file);
      const std::string label = in_words(degrees) + ", variant " + std::to_string(variant);
      add_input(options, {{}, std::string(star.name), label, degrees}, options.folder / "models" / file, rows);
    }
}

std::vector<std::string> termination_definitions() {
  std::vector<std::string> all = {
      "The paper, section 2: midpoints of missing grazeable edges are inserted repeatedly until none is missing.",
      "It does not say that this terminates.",
      "Ended: all grazeable edges of the input are chains of Delaunay edges.",
      "Not ended: the engine stopped, because a piece would have been smaller than 2^-20 of its segment,",
      "or there were a hundred times as many pieces as vertices.",
      "Level: one more than the number of splits that led to a piece.",
      "Midpoint is the paper's method (--protection midpoint), shell is ours (--protection shell).",
      "Nothing is placed inside (--lattice none), the meshes are not improved, and no Steiner vertex is removed.",
      "In a star, segments or facets meet at one point in the middle of a cube.",
      "Variant 0 has lengths that alternate between 1 and 1 / sqrt 2, the others random ones from 0.4 to 1.6.",
  };
  for (const models::Star& star : models::stars())
    all.push_back(std::string(star.name) + ": " + std::string(star.what));
  return all;
}

Cell ended_cell(const TerminationRow& row) {
  const auto ended = has_ended(row);
  return ended ? as_cell(*ended) : Cell();
}

Cell deepest_level(const RunRecord& run) {
  return results::cell_of(std::uint64_t{run.counts.splits_by_level.size()});
}

/// One row per run on a star, a solid or a file.
ResultTable runs_table(std::string name, std::string title, std::span<const TerminationRow> rows, bool of_stars) {
  const RowColumns<TerminationRow> columns = {
      {label_column("group", "input"), &TerminationRow::group},
      {label_column("case"), &TerminationRow::label},
      {label_column("protection"), [](const TerminationRow& row) { return name_of(row.protection); }},
      status_column(),
      {figure_column("smallest_angle", "", "degrees"), &TerminationRow::smallest_angle},
      {figure_column("ended"), ended_cell},
      count_column("steiner_vertices", &MeshCounts::steiner_vertices, "Steiner vertices"),
      run_column(figure_column("deepest_level"), deepest_level),
      reason_column()};
  std::vector<TerminationRow> chosen;
  std::ranges::copy_if(rows, std::back_inserter(chosen),
                       [&](const TerminationRow& row) { return is_star(row) == of_stars; });
  return table_of_rows(std::move(name), std::move(title), columns, chosen, of_stars);
}

/// All variants of a star at one angle: the number for which each method terminated, and the largest effort.
ResultTable stars_table(std::span<const TerminationRow> rows) {
  ResultTable table = table_of(
      "stars", "Segments that meet at small angles",
      {label_column("star"), figure_column("degrees", "angle", "degrees"), figure_column("cases"),
       figure_column("midpoint_ended"), figure_column("midpoint_steiner_vertices", "midpoint: most Steiner vertices"),
       figure_column("midpoint_deepest_level", "midpoint: deepest level"), figure_column("shell_ended"),
       figure_column("shell_steiner_vertices", "shell: most Steiner vertices"),
       figure_column("shell_deepest_level", "shell: deepest level")});
  const auto add_row_of = [&](const models::Star& star, double degrees) {
    ResultRow made{cells(star.name, degrees)};
    for (const Protection way : termination_ways) {
      std::uint64_t cases = 0, ended = 0, steiner = 0, deepest = 0;
      for (const TerminationRow& row : rows) {
        if (row.group != star.name || row.degrees != degrees || row.protection != way) continue;
        ++cases;
        append(made.runs, runs_of(row));
        if (!row.ok()) continue;
        ++ended;
        steiner = std::max(steiner, row.measured.first.counts.steiner_vertices);
        deepest = std::max<std::uint64_t>(deepest, row.measured.first.counts.splits_by_level.size());
      }
      if (way == termination_ways.front()) made.cells.push_back(as_cell(cases));
      append(made.cells, cells(ended, cell_if(ended > 0, steiner), cell_if(ended > 0, deepest)));
    }
    if (!made.runs.empty()) table.rows.push_back(std::move(made));
  };
  for (const models::Star& star : models::stars())
    for (const double degrees : angles) add_row_of(star, degrees);
  return table;
}

/// The angles at which midpoint splitting of a star terminated, from its rows in order of decreasing angle.
std::string midpoint_finding(const std::string& star, const RowViews& rows) {
  const auto has_stopped = [](const RowView& row) { return row.number("midpoint_ended") < row.number("cases"); };
  const auto angle = [](const RowView& row) { return in_words(row.number("degrees")); };
  const std::string share =
      "Midpoint, " + star + ": ended in " + share_words(sum(rows, "midpoint_ended"), sum(rows, "cases")) + " cases";
  const auto largest = std::ranges::find_if(rows, has_stopped);
  if (largest == rows.end()) return share + ", down to " + angle(rows.back());
  const auto least = std::ranges::find_if(rows.rbegin(), rows.rend(), has_stopped);
  const std::string safe = largest == rows.begin() ? "it did not always terminate at any angle"
                                                   : "from " + angle(*(largest - 1)) + " up, it always terminated";
  return share + "; " + safe + "; it did not at " + std::to_string(largest->count("degrees")) + " to " + angle(*least);
}

/// The number of these runs in which one method terminated.
void add_share(const std::string& what, const ResultTable& runs, Protection way, std::vector<std::string>& findings) {
  const std::string name(name_of(way));
  const std::size_t cases = rows_with(runs, {{"protection", name}}).size(),
                    ended = rows_with(runs, {{"protection", name}, {"ended", "yes"}}).size();
  if (cases > 0) findings.push_back(what + " ended in " + share_words(ended, cases) + " cases");
}

}  // namespace

ExperimentResult termination_result(std::span<const TerminationRow> rows) {
  const ResultTable stars = stars_table(rows), solids = runs_table("solids", "Solids and files", rows, false),
                    star_runs = runs_table("star_runs", "Each run on a star", rows, true);
  ExperimentResult result{
      .how = once(), .definitions = termination_definitions(), .tables = {stars, solids, star_runs}};
  for (const models::Star& star : models::stars()) {
    const std::string name(star.name);
    const RowViews rows_of_star = rows_with(stars, {{"star", name}});
    if (!rows_of_star.empty()) result.findings.push_back(midpoint_finding(name, rows_of_star));
  }
  add_share("Midpoint on solids and files", solids, Protection::midpoint, result.findings);
  add_share("Shell on solids and files", solids, Protection::shell, result.findings);
  add_share("Shell on stars", star_runs, Protection::shell, result.findings);
  for (const TerminationRow& row : rows)
    if (!has_ended(row))
      add_problem(result, row.measured.asked.name + ": " + failure(row.measured), row.group != "file");
  return result;
}

ExperimentResult measure_termination(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<TerminationRow> rows;
  for (const models::Star& star : models::stars())
    if (is_chosen(options, star.name)) add_star(options, star, rows);
  for (const SurfaceFile& surface : write_solids(options, "termination", termination_coarsenings))
    add_input(options, {{}, "solid", surface.name + " at " + rounded(surface.edge_length)}, surface.file, rows);
  for (const SurfaceFile& surface : input_files(options))
    add_input(options, {{}, "file", surface.name}, surface.file, rows);
  check_something_is_measured(rows.size(), "termination");
  measure_rows(runner, rows);
  return termination_result(rows);
}

}  // namespace ccdt::experiments
