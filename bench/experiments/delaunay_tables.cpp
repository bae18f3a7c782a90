#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "bench/experiments/delaunay.h"
#include "bench/results/numbers.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

/// One method on one set of points: all repetitions.
struct Measured {
  std::string points, size, method;
  int family = 0;  ///< the program's order
  double vertices = 0, tetrahedra = 0;
  std::vector<double> seconds = {};
  std::string fault = {};
};

constexpr std::array<std::array<const char*, 2>, 4> methods = {
    {{"insert", "insert"}, {"wrap", "wrap"}, {"cgal", "CGAL"}, {"tetgen", "TetGen"}}};
constexpr std::array<std::array<const char*, 2>, 2> sets = {{{"random", "uniform random"}, {"lattice", "FCC lattice"}}};

template <class Names>
std::string title_of(const Names& names, const std::string& name) {
  for (const auto& [known, title] : names)
    if (name == known) return title;
  return name;
}

double seconds_in(const std::string& unit) {
  constexpr std::array<std::pair<const char*, double>, 4> units = {
      {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}}};
  for (const auto& [name, seconds] : units)
    if (unit == name) return seconds;
  throw InputError("Google Benchmark's JSON has times in '" + unit + "'", {}, "measure again");
}

/// "delaunay/wrap/random/1000", or "delaunay/wrap/part.off".
Measured named(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    parts.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.resize(4);
  return {.points = title_of(sets, parts[2]), .size = parts[3], .method = title_of(methods, parts[1])};
}

/// The benchmarks in the program's order, whichever order they ran in.
std::vector<Measured> measured_in(const Json& json) {
  std::map<std::string, Measured> by_name;
  for (const Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration") continue;
    const std::string name = run.at("run_name");
    Measured& measured = by_name.try_emplace(name, named(name)).first->second;
    measured.family = run.at("family_index");
    if (run.value("error_occurred", false)) {
      measured.fault = run.value("error_message", "it failed");
      continue;
    }
    measured.vertices = run.at("vertices");
    measured.tetrahedra = run.at("cells");
    measured.seconds.push_back(run.at("cpu_time").get<double>() * seconds_in(run.at("time_unit")));
  }
  std::map<std::string, int> order;  // of the points
  for (const auto& [name, measured] : by_name)
    order[measured.points] =
        std::min(order.try_emplace(measured.points, measured.family).first->second, measured.family);
  std::vector<Measured> all;
  for (auto& [name, measured] : by_name) all.push_back(std::move(measured));
  std::ranges::sort(all, {}, [&](const Measured& m) {
    return std::tuple(order[m.points], m.size.size(), m.size, m.family);  // sizes are numbers without leading zeros
  });
  return all;
}

ResultTable times_table() {
  return {.name = "times",
          .title = "Delaunay tetrahedralization",
          .columns = {{"points", "points", ColumnKind::label},
                      {"size", "size", ColumnKind::label},
                      {"method", "method", ColumnKind::label},
                      {"status", "status", ColumnKind::label},
                      {"vertices", "vertices", ColumnKind::figure},
                      {"tetrahedra", "tetrahedra", ColumnKind::figure},
                      {"seconds", "seconds", ColumnKind::time, "s"},
                      {"microseconds_per_vertex", "time a vertex", ColumnKind::time, "µs"},
                      {"reason", "reason", ColumnKind::note}}};
}

ResultTable ratios_table() {
  return {.name = "ratios",
          .title = "How the times compare",
          .columns = {{"points", "points", ColumnKind::label},
                      {"size", "size", ColumnKind::label},
                      {"vertices", "vertices", ColumnKind::figure},
                      {"insert_over_cgal", "insert / CGAL", ColumnKind::time},
                      {"wrap_over_insert", "wrap / insert", ColumnKind::time},
                      {"tetgen_over_insert", "TetGen / insert", ColumnKind::time}}};
}

ResultRow times_row(const Measured& m) {
  if (!m.fault.empty() || m.seconds.empty())
    return {{m.points, m.size, m.method, "failed", std::monostate(), std::monostate(), std::monostate(),
             std::monostate(), m.fault}};
  const Estimate seconds = median_estimate(m.seconds);
  const double scale = 1e6 / m.vertices;
  return {{m.points, m.size, m.method, "ok", m.vertices, m.tetrahedra, seconds,
           Estimate{seconds.value * scale, seconds.low * scale, seconds.high * scale}, std::monostate()}};
}

/// The methods on the same points.
using Group = std::vector<const Measured*>;

const Measured* find(const Group& group, std::string_view method) {
  const auto found =
      std::ranges::find_if(group, [&](const Measured* m) { return m->method == method && m->fault.empty(); });
  return found == group.end() || (*found)->seconds.empty() ? nullptr : *found;
}

std::optional<Estimate> ratio(const Group& group, std::string_view numerator, std::string_view denominator) {
  const Measured *above = find(group, numerator), *below = find(group, denominator);
  if (above == nullptr || below == nullptr || quantile(below->seconds, 0) <= 0) return {};
  return ratio_of_medians(above->seconds, below->seconds);
}

std::string subject(const Measured& m) {
  return m.points + ", " + with_separators(static_cast<std::uint64_t>(m.vertices)) + " points";
}

/// "piston, 10,521 points: insert takes 0.50 [0.49, 0.52] times as long as CGAL, so it is faster."
void add_comparison(const Group& group, const char* who, const char* whom, std::vector<std::string>& findings) {
  const auto estimate = ratio(group, who, whom);
  if (!estimate) return;
  const char* verdict = is_at_most(*estimate, 1) == Claim::holds    ? "it is faster"
                        : is_at_least(*estimate, 1) == Claim::holds ? "it is slower"
                                                                    : "neither is surely faster";
  findings.push_back(subject(*find(group, whom)) + ": " + who + " takes " + with_interval(*estimate) +
                     " times as long as " + whom + ": " + verdict + ".");
}

/// How the time of a vertex grows from the smallest to the largest set of these points.
void add_growth(const Group& small, const Group& large, std::vector<std::string>& findings) {
  std::string growths;
  for (const auto& [name, method] : methods) {
    const Measured *first = find(small, method), *last = find(large, method);
    if (first == nullptr || last == nullptr) continue;
    const Estimate r = ratio_of_medians(last->seconds, first->seconds);
    const double scale = first->vertices / last->vertices;
    growths += (growths.empty() ? "" : ", ") + std::string(method) + " " +
               with_interval(Estimate{r.value * scale, r.low * scale, r.high * scale});
  }
  if (!growths.empty())
    findings.push_back(small[0]->points +
                       ": the largest set takes so many times as long a vertex as the smallest: " + growths + ".");
}

/// What the timed results must have in common.
void check_counts(const Group& group, ExperimentResult& result) {
  const Measured* inserted = find(group, "insert");
  for (const Measured* m : group) {
    const bool is_ours = m->method == "insert" || m->method == "wrap";
    if (!m->fault.empty()) {
      result.problems.push_back(m->points + " " + m->size + ", " + m->method + ": " + m->fault);
      result.is_good = result.is_good && !is_ours;
      continue;
    }
    const bool has_no_ties = m->points == title_of(sets, "random");
    if (inserted == nullptr || m->tetrahedra == inserted->tetrahedra || !(is_ours || has_no_ties)) continue;
    result.problems.push_back(subject(*m) + ": " + m->method + " has not as many tetrahedra as insert");
    result.is_good = result.is_good && !is_ours;
  }
}

std::vector<Group> groups_of(const std::vector<Measured>& all) {
  std::vector<Group> groups;
  for (const Measured& m : all) {
    const bool same = !groups.empty() && groups.back()[0]->points == m.points && groups.back()[0]->size == m.size;
    if (!same) groups.emplace_back();
    groups.back().push_back(&m);
  }
  return groups;
}

void add_findings(const std::vector<Group>& groups, std::vector<std::string>& findings) {
  for (std::size_t begin = 0, end = 0; begin < groups.size(); begin = end) {
    while (end < groups.size() && groups[end][0]->points == groups[begin][0]->points) ++end;
    const Group& largest = groups[end - 1];
    add_comparison(largest, "insert", "CGAL", findings);
    add_comparison(largest, "wrap", "insert", findings);
    add_comparison(largest, "TetGen", "insert", findings);
    if (end - begin > 1) add_growth(groups[begin], largest, findings);
  }
}

}  // namespace

void evaluate_delaunay(const std::string& benchmark_json, ExperimentResult& result) {
  std::vector<Measured> all;
  try {
    all = measured_in(Json::parse(benchmark_json));
  } catch (const nlohmann::json::exception& error) {
    throw InputError("no JSON of Google Benchmark: " + std::string(error.what()), {}, "measure again");
  }
  ResultTable times = times_table(), ratios = ratios_table();
  const std::vector<Group> groups = groups_of(all);
  for (const Measured& m : all) times.rows.push_back(times_row(m));
  for (const Group& group : groups) {
    const Measured* any = find(group, "insert");
    ratios.rows.push_back({{group[0]->points, group[0]->size, any == nullptr ? Cell() : Cell(any->vertices),
                            cell_of(ratio(group, "insert", "CGAL")), cell_of(ratio(group, "wrap", "insert")),
                            cell_of(ratio(group, "TetGen", "insert"))}});
    check_counts(group, result);
  }
  add_findings(groups, result.findings);
  result.tables = {times, ratios};
}

}  // namespace ccdt
