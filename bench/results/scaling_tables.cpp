#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "bench/results/sweep_tables.h"
#include "bench/run/statistics.h"

namespace ccdt::results {
namespace {

constexpr std::size_t fewest_sizes = 3;
constexpr std::size_t most_facets = 6;
constexpr double least_span = 10;  ///< the largest over the smallest number of tetrahedra

/// Cases that differ only in size.
struct Family {
  std::vector<const CaseSummary*> cases = {};
  std::vector<double> sizes = {}, seconds = {};  ///< tetrahedra, and the median times
};

/// The shape of a family: a model, or the same file with several edge lengths.
std::string family_name(const CaseRuns& one) {
  return one.input.model.empty() ? one.input.name : one.input.model;
}

std::vector<Family> families_of(const Sweep& sweep, std::span<const CaseSummary> cases) {
  std::map<std::string, Family> families;
  for (const CaseSummary& s : cases) {
    const double size = number_of(s, "tetrahedra").value_or(0);
    if (!s.seconds || !(s.seconds->value > 0) || !(size > 0)) continue;
    std::string key = family_name(*s.of) + '\n' + s.of->mesher;
    for (std::size_t i = 0; i < sweep.options.size(); ++i)
      if (sweep.options[i] != "edge-length") key += '\n' + s.of->values[i];
    Family& family = families[key];
    family.cases.push_back(&s);
    family.sizes.push_back(size);
    family.seconds.push_back(s.seconds->value);
  }
  std::vector<Family> large;
  for (auto& [key, family] : families)
    if (std::set(family.sizes.begin(), family.sizes.end()).size() >= fewest_sizes) large.push_back(std::move(family));
  return large;
}

/// The common labels of a family; empty where its members differ.
std::vector<Cell> common_labels(const RowColumns<CaseSummary>& labels, const Family& family) {
  std::vector<Cell> common = cells_of(labels, *family.cases.front());
  for (const CaseSummary* one : family.cases)
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (const Cell label = labels[i].cell(*one); !std::holds_alternative<std::string>(label) || common[i] != label)
        common[i] = Cell();
  return common;
}

}  // namespace

ScalingTables scaling_tables(const Sweep& sweep, std::span<const CaseSummary> cases) {
  const RowColumns<CaseSummary> labels = label_columns(sweep);
  const std::vector<Column> of_point = {
      {"family", "family", ColumnKind::note},           {"facet", "facet", ColumnKind::note},
      {"series", "series", ColumnKind::note},           {"legend", "legend", ColumnKind::note},
      {"tetrahedra", "tetrahedra", ColumnKind::figure}, {"seconds", "seconds", ColumnKind::time, "s"}};
  ScalingTables tables{labeled_table(sweep, "scaling", "Growth of the time with the number of tetrahedra",
                                     {{"sizes", "sizes", ColumnKind::figure},
                                      {"smallest", "smallest, tetrahedra", ColumnKind::figure},
                                      {"largest", "largest, tetrahedra", ColumnKind::figure},
                                      {"exponent", "exponent", ColumnKind::time},
                                      {"explained", "variance explained", ColumnKind::time},
                                      {"speed", "tetrahedra per second, at the largest size", ColumnKind::time}}),
                       labeled_table(sweep, "scaling_points", "Times and sizes", of_point, true),
                       labeled_table(sweep, "scaling_lines", "Fitted lines", of_point, true)};
  const std::vector<Family> families = families_of(sweep, cases);
  std::set<std::string> names;
  for (const Family& family : families) names.insert(family_name(*family.cases.front()->of));
  for (const Family& family : families) {
    const std::vector<Cell> common = common_labels(labels, family);
    const std::string name = family_name(*family.cases.front()->of);
    const std::string facet = names.size() > most_facets ? "all inputs" : name;
    const std::string &series = family.cases.front()->series, &legend = family.cases.front()->legend;
    const auto [low, high] = std::ranges::minmax(family.sizes);
    std::vector<std::string> runs;
    for (const CaseSummary* one : family.cases) {
      add_labeled_row(tables.points, one->runs, cells_of(labels, *one),
                      cells(name, facet, series, legend, *number_of(*one, "tetrahedra"), *one->seconds));
      runs.insert(runs.end(), one->runs.begin(), one->runs.end());
    }
    if (high < least_span * low) continue;
    const bench::LineFit fit = bench::fit_power(family.sizes, family.seconds);
    const auto largest = static_cast<std::size_t>(std::ranges::max_element(family.sizes) - family.sizes.begin());
    add_labeled_row(
        tables.fits, std::move(runs), common,
        cells(std::uint64_t{family.sizes.size()}, low, high, fit.slope, fit.r_squared, high / family.seconds[largest]));
    for (const double size : {low, high})
      add_labeled_row(
          tables.lines, {}, common,
          cells(name, facet, series, legend, size, std::exp(fit.intercept + fit.slope.value * std::log(size))));
  }
  return tables;
}

}  // namespace ccdt::results
