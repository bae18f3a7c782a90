#include "reports/fig8_report.h"

#include <algorithm>

#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/text_table.h"

namespace ccdt {
namespace {

const Fig8Point* point_at(const Fig8Series& series, double edge_length) {
  const auto found = std::ranges::find(series.points, edge_length, &Fig8Point::edge_length);
  return found != series.points.end() ? &*found : nullptr;
}

std::string seconds_words(const Fig8Point* point) {
  if (point == nullptr) return "";
  return point->cdt ? with_interval(*point->cdt) : std::string(name_of(point->status));
}

/// A row a size; the first series has all sizes.
TextTable sizes(const Fig8& fig8) {
  TextTable cells = {{"CDT seconds", "edge length", "vertices", "tetrahedra"}};
  if (!fig8.models.empty())
    for (const Fig8Series& series : fig8.models.front().series) cells[0].push_back(series.label);
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Point& point : model.series.front().points) {
      cells.push_back({model.name, rounded(point.edge_length), with_separators(point.counts.vertices),
                       with_separators(point.counts.tetrahedra)});
      for (const Fig8Series& series : model.series)
        cells.back().push_back(seconds_words(point_at(series, point.edge_length)));
    }
  return cells;
}

std::string claim_heading() {
  return "exponent <= " + rounded(claimed_exponent);
}

TextTable growth(const Fig8& fig8) {
  TextTable cells = {
      {"growth", "strategy", "stage", "points", "exponent", claim_heading(), "microseconds a vertex", "R2"}};
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series)
      for (const Fig8Fit& fit : series.fits) {
        const auto good = std::ranges::count_if(series.points, [](const Fig8Point& p) { return p.cdt.has_value(); });
        const Estimate& slope = fit.line.slope;
        cells.push_back({model.name, series.label, fit.id, std::to_string(good), with_interval(fit.power.slope),
                         std::string(name_of(is_at_most(fit.power.slope, claimed_exponent))),
                         with_interval({1e6 * slope.value, 1e6 * slope.low, 1e6 * slope.high}),
                         rounded(fit.line.r_squared, 4)});
      }
  return cells;
}

std::vector<std::string> verdict(const Fig8& fig8) {
  std::vector<std::string> lines;
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series) {
      const auto cdt = std::ranges::find(series.fits, "cdt", &Fig8Fit::id);
      if (cdt == series.fits.end()) {
        lines.push_back(model.name + ", " + series.label + ": too few sizes for a fit");
        continue;
      }
      const Estimate& exponent = cdt->power.slope;
      lines.push_back(model.name + ", " + series.label + ": the CDT's exponent is " + with_interval(exponent) +
                      "; that it is at most " + rounded(claimed_exponent) + ": " +
                      claim_words(is_at_most(exponent, claimed_exponent)));
    }
  return lines;
}

std::vector<std::string> complaints(const Fig8& fig8) {
  std::vector<std::string> lines;
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series)
      for (const Fig8Point& p : series.points)
        if (!p.cdt)
          lines.push_back(model.name + ", " + series.label + ", edge length " + rounded(p.edge_length) + ": " +
                          std::string(name_of(p.status)) + ": " + p.reason);
  return lines;
}

/// Points that have fewer runs than the others.
std::vector<std::string> remarks(const Fig8& fig8) {
  std::vector<std::string> lines;
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series)
      for (const Fig8Point& p : series.points)
        if (p.cdt && static_cast<int>(p.samples.size()) < fig8.how.runs)
          lines.push_back(model.name + ", " + series.label + ", edge length " + rounded(p.edge_length) + ": " +
                          std::to_string(p.samples.size()) + " counted runs, as it takes long");
  return lines;
}

constexpr const char* title = "Fig. 8: time of the CDT against the number of vertices";

}  // namespace

std::string to_terminal(const Fig8& fig8) {
  return std::string(title) + "\n\n" + to_terminal(sizes(fig8)) + "\n" + to_terminal(growth(fig8)) + "\n" +
         terminal_section("Is it linear?", verdict(fig8)) + terminal_section("What went wrong", complaints(fig8)) +
         terminal_section("Fewer runs", remarks(fig8)) + how_measured(fig8.how) + "\n";
}

std::string to_markdown(const Fig8& fig8) {
  return "# " + std::string(title) + "\n\n" + how_measured(fig8.how) + "\n\n" + to_markdown(sizes(fig8)) + "\n" +
         to_markdown(growth(fig8)) + "\n" + section("Is it linear?", verdict(fig8)) +
         section("What went wrong", complaints(fig8)) + section("Fewer runs", remarks(fig8)) +
         closing_sections(fig8_definitions(), fig8.how);
}

}  // namespace ccdt
