#include "bench/experiments/fig8.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

/// Calls for every series, with its model.
template <class Visit>
void for_each_series(const Fig8& fig8, Visit visit) {
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series) visit(model.name, series);
}

std::vector<std::string> all_runs(const Fig8Series& series) {
  std::vector<std::string> runs;
  for (const Fig8Point& point : series.points) runs.insert(runs.end(), point.runs.begin(), point.runs.end());
  return runs;
}

ResultTable points_table(const Fig8& fig8) {
  ResultTable points{"points",
                     "Seconds against size",
                     {{"model", "model", ColumnKind::label},
                      {"mesher", "mesher", ColumnKind::label},
                      {"strategy", "strategy", ColumnKind::label},
                      {"status", "status", ColumnKind::label},
                      {"edge_length", "edge length", ColumnKind::figure, "mm"},
                      {"vertices", "vertices"},
                      {"tetrahedra", "tetrahedra"},
                      {"seconds", "seconds", ColumnKind::time, "s"},
                      {"reason", "reason", ColumnKind::note}}};
  for_each_series(fig8, [&](const std::string& model, const Fig8Series& series) {
    for (const Fig8Point& p : series.points)
      points.rows.push_back({{cell_of(model), cell_of(series.mesher), cell_of(series.label), cell_of(name_of(p.status)),
                              p.edge_length, p.seconds ? cell_of(p.counts.vertices) : Cell(),
                              p.seconds ? cell_of(p.counts.tetrahedra) : Cell(), cell_of(p.seconds), cell_of(p.reason)},
                             p.runs});
  });
  return points;
}

Estimate in_microseconds(const Estimate& e) {
  return {1e6 * e.value, 1e6 * e.low, 1e6 * e.high};
}

ResultTable fits_table(const Fig8& fig8) {
  ResultTable fits{"fits",
                   "How the seconds grow with the number of vertices",
                   {{"model", "model", ColumnKind::label},
                    {"mesher", "mesher", ColumnKind::label},
                    {"strategy", "strategy", ColumnKind::label},
                    {"quantity", "seconds of", ColumnKind::label},
                    {"points", "sizes"},
                    {"exponent", "exponent", ColumnKind::time},
                    {"exponent_r2", "R2 of the exponent", ColumnKind::time},
                    {"microseconds_per_vertex", "slope, a vertex", ColumnKind::time, "us"},
                    {"seconds_at_zero", "seconds at zero", ColumnKind::time, "s"},
                    {"r2", "R2 of the line", ColumnKind::time}}};
  for_each_series(fig8, [&](const std::string& model, const Fig8Series& series) {
    for (const Fig8Fit& fit : series.fits)
      fits.rows.push_back({{cell_of(model), cell_of(series.mesher), cell_of(series.label), cell_of(fit.quantity),
                            cell_of(fit.points), fit.power.slope, fit.power.r_squared, in_microseconds(fit.line.slope),
                            fit.line.intercept, fit.line.r_squared},
                           all_runs(series)});
  });
  return fits;
}

/// The ends of the straight lines of the first quantity of each series.
ResultTable lines_table(const Fig8& fig8) {
  ResultTable lines{"lines",
                    "Straight lines through the points",
                    {{"model", "model", ColumnKind::label},
                     {"mesher", "mesher", ColumnKind::label},
                     {"strategy", "strategy", ColumnKind::label},
                     {"vertices", "vertices"},
                     {"seconds", "seconds", ColumnKind::time, "s"}},
                    {},
                    true};
  for_each_series(fig8, [&](const std::string& model, const Fig8Series& series) {
    if (series.fits.empty()) return;
    const Fig8Fit& fit = series.fits.front();
    for (const double vertices : {fit.least_vertices, fit.most_vertices})
      lines.rows.push_back({{cell_of(model), cell_of(series.mesher), cell_of(series.label), vertices,
                             fit.line.intercept + vertices * fit.line.slope.value},
                            all_runs(series)});
  });
  return lines;
}

std::string claim_words(Claim claim) {
  switch (claim) {
    case Claim::holds:
      return "holds";
    case Claim::undecided:
      return "undecided, the bound is within the interval";
    case Claim::fails:
      return "does not hold";
  }
  return "";
}

void add_findings(const std::string& model, const Fig8Series& series, ExperimentResult& result) {
  const std::string who = model + ", " + series.label + ": ";
  if (series.fits.empty()) {
    result.findings.push_back(who + "too few sizes for a fit");
    return;
  }
  const Estimate& exponent = series.fits.front().power.slope;
  result.findings.push_back(who + "the exponent is " + with_interval(exponent) + "; that it is at most " +
                            rounded(claimed_exponent) + ": " + claim_words(is_at_most(exponent, claimed_exponent)));
}

void add_problems(const std::string& model, const Fig8Series& series, ExperimentResult& result) {
  for (const Fig8Point& p : series.points) {
    if (p.seconds) continue;
    result.problems.push_back(model + ", " + series.label + ", edge length " + rounded(p.edge_length) + ": " +
                              std::string(name_of(p.status)) + ": " + p.reason);
    result.is_good = result.is_good && series.mesher != "ccdt";
  }
}

}  // namespace

ExperimentResult result_of(const Fig8& fig8) {
  ExperimentResult result{.how = fig8.how,
                          .definitions = fig8_definitions(),
                          .tables = {fits_table(fig8), points_table(fig8), lines_table(fig8)}};
  for_each_series(fig8, [&](const std::string& model, const Fig8Series& series) {
    add_findings(model, series, result);
    add_problems(model, series, result);
  });
  return result;
}

}  // namespace ccdt
