#include <algorithm>
#include <array>
#include <functional>

#include "bench/experiments/conforming/conforming_delaunay.h"
#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "models/flatten.h"

namespace ccdt::experiments {
namespace {

constexpr std::array conforming_coarsenings = {3.0, 1.0};  ///< of a solid's usual edge length
constexpr double flattening = 0.3;                         ///< factor of z
constexpr std::array protections = {Protection::midpoint, Protection::shell};

/// The conforming search gives up when it has this many times the vertices of the input, plus some more.
constexpr std::size_t most_growth = 20, more_vertices = 1000;

std::vector<std::string> conforming_definitions() {
  return {
      "The paper, section 1: in comparison with a conforming Delaunay tetrahedralization, CCDT adds fewer vertices.",
      "Conforming: all tetrahedra are Delaunay, every segment is a union of their edges, every facet of their faces.",
      "Both start from the vertices of the input alone, and interior points are not counted (--lattice none).",
      "CCDT: the Steiner vertices of ccdt mesh --lattice none --improve none --steiner keep, all on segments.",
      "The conforming tetrahedralization is also ours: same kernel, same splits of segments (midpoint or shell).",
      "It splits all missing segments, not only the grazeable ones.",
      "A missing face gets a vertex at its circumcenter (Ruppert 1995, Shewchuk 1998).",
      "If that is beyond a segment of the facet, or in the diametral sphere of one, the segment is split instead.",
      "Vertices are added until the Delaunay tetrahedralization contains every segment and every face.",
      "Limit: a segment became too short, or the number of vertices exceeded " + std::to_string(most_growth) +
          " times that of the input plus " + with_separators(more_vertices) +
          ". Near small angles the search may never end, so such cases are shown but not judged.",
      "Flattened: z is multiplied by " + rounded(flattening) + ", so that many triangles are thin.",
  };
}

/// The solids, and flattened copies of them.
std::vector<SurfaceFile> solids_and_flattened(const ExperimentOptions& options) {
  std::vector<SurfaceFile> files = write_solids(options, "conforming", conforming_coarsenings);
  const std::size_t solids = files.size();
  for (std::size_t i = 0; i < solids; ++i) {
    SurfaceFile flat = files[i];
    flat.name += ", flattened";
    flat.file.replace_filename("flattened-" + flat.file.filename().string());
    InputPlc plc = io::read_plc(files[i].file);
    models::flatten(plc, flattening);
    io::write_plc(plc, flat.file);
    files.push_back(flat);
  }
  return files;
}

/// Counts the vertices of the conforming tetrahedralization. A run that failed says what is wrong with its input.
void conform(ConformingRow& row) {
  if (!row.ok()) return;
  const plc::Plc plc = plc::build_plc(io::read_plc(row.measured.asked.input));
  const std::size_t most = most_growth * plc.vertices.size() + more_vertices;
  const conforming::ConformingDelaunay found = conforming::make_conforming(plc, row.protection, most);
  row.missing_segments = found.missing_segments;
  row.missing_faces = found.missing_faces;
  row.on_segments = found.on_segments;
  row.in_facets = found.in_facets;
  row.is_conforming = found.is_conforming;
}

std::uint64_t ours(const ConformingRow& row) {
  return row.measured.first.counts.steiner_vertices;
}

std::uint64_t rivals(const ConformingRow& row) {
  return row.on_segments + row.in_facets;
}

ResultTable cases_table(std::span<const ConformingRow> rows) {
  const auto figure = [](std::string name, std::string title, auto value) {
    return RowColumn<ConformingRow>(
        figure_column(std::move(name), std::move(title)),
        [value](const ConformingRow& row) { return cell_if(row.ok(), std::uint64_t{std::invoke(value, row)}); });
  };
  const RowColumns<ConformingRow> columns = {
      {label_column("model"), &ConformingRow::model},
      {label_column("edge_length"),
       [](const ConformingRow& row) { return row.edge_length > 0 ? rounded(row.edge_length) : ""; }},
      {label_column("protection"), [](const ConformingRow& row) { return name_of(row.protection); }},
      status_column(),
      run_column(figure_column("vertices", "vertices of the input"),
                 [](const RunRecord& run) { return results::cell_of(run.input.vertices); }),
      figure("missing_segments", "missing segments", &ConformingRow::missing_segments),
      figure("missing_faces", "missing faces", &ConformingRow::missing_faces),
      figure("ccdt", "CCDT: Steiner vertices", ours),
      figure("on_segments", "conforming: on segments", &ConformingRow::on_segments),
      figure("in_facets", "conforming: in facets", &ConformingRow::in_facets),
      {figure_column("conforming", "conforming: found"),
       [](const ConformingRow& row) {
         return !row.ok() ? Cell() : Cell(std::string(row.is_conforming ? "yes" : "limit"));
       }},
      reason_column()};
  return table_of_rows("cases", "The cases", columns, rows);
}

ResultTable comparison_table(std::span<const ConformingRow> rows) {
  ResultTable table = table_of(
      "comparison", "Steiner vertices of CCDT and of conforming Delaunay tetrahedralizations",
      {label_column("protection"), figure_column("cases"), figure_column("limit", "conforming: none found"),
       figure_column("needed", "conforming: needs some"), figure_column("fewer", "of these, CCDT needs fewer"),
       figure_column("more", "CCDT needs more"), figure_column("none", "of these, CCDT needs none"),
       figure_column("ccdt", "CCDT: Steiner vertices"), figure_column("conforming", "conforming: Steiner vertices")});
  for (const Protection protection : protections) {
    std::uint64_t count = 0, limit = 0, needed = 0, fewer = 0, more = 0, none = 0, sum_of_ours = 0, sum_of_rivals = 0;
    std::vector<std::string> runs;
    for (const ConformingRow& row : rows) {
      if (row.protection != protection || !row.ok()) continue;
      ++count;
      append(runs, runs_of(row));
      if (!row.is_conforming) {
        ++limit;
        continue;
      }
      needed += rivals(row) > 0 ? 1 : 0;
      fewer += ours(row) < rivals(row) ? 1 : 0;
      more += ours(row) > rivals(row) ? 1 : 0;
      none += rivals(row) > 0 && ours(row) == 0 ? 1 : 0;
      sum_of_ours += ours(row);
      sum_of_rivals += rivals(row);
    }
    if (count > 0)
      add_row(table, runs, name_of(protection), count, limit, needed, fewer, more, none, sum_of_ours, sum_of_rivals);
  }
  return table;
}

std::string finding_of_conforming(const RowView& row) {
  return "Split as " + row.text("protection") + ": CCDT needs fewer Steiner vertices in " +
         share_words(row.count("fewer"), row.count("needed")) +
         " cases where a conforming one needs some, and more in " + with_separators(row.count("more")) + "; together " +
         with_separators(row.count("ccdt")) + " and " + with_separators(row.count("conforming")) +
         "; no conforming one was found in " + share_words(row.count("limit"), row.count("cases")) + " cases";
}

}  // namespace

ExperimentResult conforming_result(std::span<const ConformingRow> rows) {
  const ResultTable comparison = comparison_table(rows);
  ExperimentResult result{
      .how = once(), .definitions = conforming_definitions(), .tables = {comparison, cases_table(rows)}};
  for (const RowView& row : rows_with(comparison)) result.findings.push_back(finding_of_conforming(row));
  for (const ConformingRow& row : rows)
    if (!row.ok()) add_problem(result, row.measured.asked.name + ": " + failure(row.measured), row.edge_length > 0);
  return result;
}

ExperimentResult measure_conforming(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<SurfaceFile> files = solids_and_flattened(options);
  append(files, parts_that_come_along(options));
  append(files, input_files(options));
  check_something_is_measured(files.size(), "conforming");
  std::vector<ConformingRow> rows;
  for (const SurfaceFile& file : files)
    for (const Protection protection : protections) {
      const std::string way(name_of(protection)), at = file.edge_length > 0 ? " at " + rounded(file.edge_length) : "";
      ConformingRow& row = rows.emplace_back();
      row.model = file.name, row.edge_length = file.edge_length, row.protection = protection;
      row.measured.asked =
          single_case(options, joined({file.name + at, way}), "ccdt", file.file,
                      {"--protection", way, "--lattice", "none", "--improve", "none", "--steiner", "keep"});
    }
  measure_rows(runner, rows);
  std::ranges::for_each(rows, conform);
  return conforming_result(rows);
}

}  // namespace ccdt::experiments
