#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <tuple>

#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::experiments {
namespace {

constexpr const char* program_name = "bench_delaunay";
constexpr const char* output_file = "benchmarks/bench_delaunay.json";

/// About how many points the largest sets have, of an experiment with about so many tetrahedra a model. Wrapping, which
/// takes longest, sets the pace.
std::int64_t largest_size(double tetrahedra) {
  constexpr double least = 1000, quick = 10000;
  return static_cast<std::int64_t>(std::max({least, std::min(tetrahedra, quick), tetrahedra / 2}));
}

/// A name as a part of a regular expression.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::string_view(".^$|()[]{}*+?\\").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

/// The names of the point sets in the benchmarks' names. "none" among the models leaves the files alone.
std::vector<std::string> point_sets(const ExperimentOptions& options) {
  std::vector<std::string> sets;
  if (std::ranges::find(options.models, "none") == options.models.end()) sets = {"random", "lattice"};
  for (const std::string& model : names_of_paper_models()) {
    const bool is_wanted = options.models.empty() ? model == "piston" : is_asked_for(options, model);
    if (is_wanted) sets.push_back(model);
  }
  for (const auto& input : options.inputs) sets.push_back(escaped(input.filename().string()));
  return sets;
}

/// The names of the methods in the benchmarks' names. The program leaves out what it was built without.
std::vector<std::string> wanted_methods(const ExperimentOptions& options) {
  std::vector<std::string> methods = {"insert", "wrap"};
  if (is_measured(options, "cgal-delaunay")) methods.emplace_back("cgal");
  if (is_measured(options, "tetgen")) methods.emplace_back("tetgen");
  return methods;
}

std::vector<std::string> definitions(const std::string& command) {
  return {
      "Points: uniformly random in a cube; a perfect face-centred lattice; the vertices of a mesh of a model or file.",
      "Insert: vertex by vertex along a Hilbert curve. Wrap: the paper's, face by face in a uniform grid.",
      "CGAL: Delaunay_triangulation_3 with exact predicates. TetGen: its library, without switches.",
      "Seconds are CPU time of the one thread that works, from the points in memory to the finished structure.",
      "They are medians of repetitions in random order.",
      "A method that this build lacks, or that is not measured on so many points, has no row.",
      "Before anything is timed, the results are compared: insert and wrap have the very same tetrahedra.",
      "CGAL and TetGen fill the same volume as they, with as many tetrahedra on random points.",
      "Other points have many Delaunay tetrahedralizations, which differ in the number of tetrahedra.",
      "Ratios are of medians.",
      "All rows stand on " + std::string(output_file) +
          ", as Google Benchmark wrote it. In the folder of the report this repeats it: " + command,
  };
}

/// One method on one set of points: all repetitions.
struct MeasuredMethod {
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
MeasuredMethod method_named(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream text(name);
  for (std::string part; std::getline(text, part, '/');) parts.push_back(part);
  parts.resize(4);
  return {.points = title_of(sets, parts[2]), .size = parts[3], .method = title_of(methods, parts[1])};
}

/// The benchmarks in the program's order, whichever order they ran in.
std::vector<MeasuredMethod> measured_in(const bench::Json& json) {
  std::map<std::string, MeasuredMethod> by_name;
  for (const bench::Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration") continue;
    const std::string name = run.at("run_name");
    MeasuredMethod& measured = by_name.try_emplace(name, method_named(name)).first->second;
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
  std::vector<MeasuredMethod> all;
  for (auto& [name, measured] : by_name) all.push_back(std::move(measured));
  std::ranges::sort(all, {}, [&](const MeasuredMethod& m) {
    return std::tuple(order[m.points], m.size.size(), m.size, m.family);  // sizes are numbers without leading zeros
  });
  return all;
}

Estimate scaled(const Estimate& e, double factor) {
  return {e.value * factor, e.low * factor, e.high * factor};
}

void add_times_row(const MeasuredMethod& m, ResultTable& times) {
  if (!m.fault.empty() || m.seconds.empty())
    return add_row(times, {}, m.points, m.size, m.method, "failed", Cell(), Cell(), Cell(), Cell(), m.fault);
  const Estimate seconds = bench::median_estimate(m.seconds);
  add_row(times, {}, m.points, m.size, m.method, "ok", m.vertices, m.tetrahedra, seconds,
          scaled(seconds, 1e6 / m.vertices), Cell());
}

/// The methods on the same points.
using PointsGroup = std::vector<const MeasuredMethod*>;

const MeasuredMethod* find(const PointsGroup& group, std::string_view method) {
  const auto found =
      std::ranges::find_if(group, [&](const MeasuredMethod* m) { return m->method == method && m->fault.empty(); });
  return found == group.end() || (*found)->seconds.empty() ? nullptr : *found;
}

std::optional<Estimate> ratio(const PointsGroup& group, std::string_view numerator, std::string_view denominator) {
  const MeasuredMethod *above = find(group, numerator), *below = find(group, denominator);
  if (above == nullptr || below == nullptr || bench::quantile(below->seconds, 0) <= 0) return {};
  return bench::ratio_of_medians(above->seconds, below->seconds);
}

std::string subject(const MeasuredMethod& m) {
  return m.points + ", " + with_separators(static_cast<std::uint64_t>(m.vertices)) + " points";
}

/// "piston, 10,521 points: insert takes 0.50 [0.49, 0.52] times as long as CGAL, so it is faster."
void add_comparison(const PointsGroup& group, const char* method, const char* other,
                    std::vector<std::string>& findings) {
  const auto estimate = ratio(group, method, other);
  if (!estimate) return;
  const std::string verdict = is_at_most(*estimate, 1) == BoundTest::holds    ? "it is faster"
                              : is_at_least(*estimate, 1) == BoundTest::holds ? "it is slower"
                                                                              : "neither is surely faster";
  findings.push_back(subject(*find(group, other)) + ": " + std::string(method) + " takes " + with_interval(*estimate) +
                     " times as long as " + other + ": " + verdict + ".");
}

/// How the time of a vertex grows from the smallest to the largest set of these points.
void add_growth(const PointsGroup& small, const PointsGroup& large, std::vector<std::string>& findings) {
  std::vector<std::string> growths;
  for (const auto& [name, method] : methods) {
    const MeasuredMethod *first = find(small, method), *last = find(large, method);
    if (first == nullptr || last == nullptr) continue;
    const Estimate r = bench::ratio_of_medians(last->seconds, first->seconds);
    const double scale = first->vertices / last->vertices;
    growths.push_back(std::string(method) + " " + with_interval(scaled(r, scale)));
  }
  if (!growths.empty())
    findings.push_back(small[0]->points + ": the largest set takes so many times as long a vertex as the smallest: " +
                       joined(growths) + ".");
}

/// What the timed results must have in common.
void check_counts(const PointsGroup& group, ExperimentResult& result) {
  const MeasuredMethod* inserted = find(group, "insert");
  for (const MeasuredMethod* m : group) {
    const bool is_ours = m->method == "insert" || m->method == "wrap";
    if (!m->fault.empty()) {
      add_problem(result, m->points + " " + m->size + ", " + m->method + ": " + m->fault, is_ours);
      continue;
    }
    const bool has_no_ties = m->points == title_of(sets, "random");
    if (inserted == nullptr || m->tetrahedra == inserted->tetrahedra || !(is_ours || has_no_ties)) continue;
    add_problem(result, subject(*m) + ": " + m->method + " has not as many tetrahedra as insert", is_ours);
  }
}

std::vector<PointsGroup> groups_of(const std::vector<MeasuredMethod>& all) {
  std::vector<PointsGroup> groups;
  for (const MeasuredMethod& m : all) {
    const bool same = !groups.empty() && groups.back()[0]->points == m.points && groups.back()[0]->size == m.size;
    if (!same) groups.emplace_back();
    groups.back().push_back(&m);
  }
  return groups;
}

void add_findings(const std::vector<PointsGroup>& groups, std::vector<std::string>& findings) {
  for (std::size_t begin = 0, end = 0; begin < groups.size(); begin = end) {
    while (end < groups.size() && groups[end][0]->points == groups[begin][0]->points) ++end;
    const PointsGroup& largest = groups[end - 1];
    add_comparison(largest, "insert", "CGAL", findings);
    add_comparison(largest, "wrap", "insert", findings);
    add_comparison(largest, "TetGen", "insert", findings);
    if (end - begin > 1) add_growth(groups[begin], largest, findings);
  }
}

/// Of a child that left no JSON: a row for all that it was to measure.
void add_failure(const ExperimentOptions& options, const baselines::ProcessResult& child, ExperimentResult& result) {
  evaluate_delaunay(R"({"benchmarks": []})", result);
  for (const std::string& set : point_sets(options))
    for (const std::string& method : wanted_methods(options))
      add_row(result.tables[0], {}, set, "", method, name_of(child.status), Cell(), Cell(), Cell(), Cell(),
              child.reason);
  add_problem(result, std::string(program_name) + " did not end well: " + child.reason);
}

/// The JSON that the program wrote, and whether it is whole.
bool evaluate_file(const std::filesystem::path& file, ExperimentResult& result) {
  try {
    evaluate_delaunay(io::read_whole_file(file).bytes, result);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::filesystem::path find_bench_delaunay(const std::filesystem::path& ccdt) {
  for (const auto& file :
       {ccdt.parent_path() / program_name, ccdt.parent_path() / "bench" / "benchmarks" / program_name})
    if (std::filesystem::is_regular_file(file)) return file;
  return {};
}

std::vector<std::string> bench_delaunay_command(const std::filesystem::path& program, const ExperimentOptions& options,
                                                const std::filesystem::path& output) {
  std::vector<std::string> command = {program.string(),
                                      "--largest",
                                      std::to_string(largest_size(options.tetrahedra)),
                                      "--no-complexity",
                                      "--benchmark_filter=^delaunay/(" + joined(wanted_methods(options), "|") + ")/(" +
                                          joined(point_sets(options), "|") + ")(/[0-9]+)?$",
                                      "--benchmark_repetitions=" + std::to_string(options.runs),
                                      "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_min_time=0.001",
                                      "--benchmark_out=" + output.string(),
                                      "--benchmark_out_format=json"};
  for (const auto& input : options.inputs)
    command.insert(command.end(), {"--input", std::filesystem::absolute(input).string()});
  return command;
}

void evaluate_delaunay(const std::string& benchmark_json, ExperimentResult& result) {
  std::vector<MeasuredMethod> all;
  try {
    all = measured_in(bench::Json::parse(benchmark_json));
  } catch (const nlohmann::json::exception& error) {
    throw InputError("no JSON of Google Benchmark: " + std::string(error.what()), {}, "measure again");
  }
  ResultTable times =
      table_of("times", "Delaunay tetrahedralization",
               {label_column("points"), label_column("size"), label_column("method"), label_column("status"),
                figure_column("vertices"), figure_column("tetrahedra"), time_column("seconds", "", "s"),
                time_column("microseconds_per_vertex", "time a vertex", "µs"), note_column("reason")});
  ResultTable ratios =
      table_of("ratios", "How the times compare",
               {label_column("points"), label_column("size"), figure_column("vertices"),
                time_column("insert_over_cgal", "insert / CGAL"), time_column("wrap_over_insert", "wrap / insert"),
                time_column("tetgen_over_insert", "TetGen / insert")});
  const std::vector<PointsGroup> groups = groups_of(all);
  for (const MeasuredMethod& m : all) add_times_row(m, times);
  for (const PointsGroup& group : groups) {
    const MeasuredMethod* any = find(group, "insert");
    const std::optional<double> vertices = any == nullptr ? std::nullopt : std::optional<double>(any->vertices);
    add_row(ratios, {}, group[0]->points, group[0]->size, vertices, ratio(group, "insert", "CGAL"),
            ratio(group, "wrap", "insert"), ratio(group, "TetGen", "insert"));
    check_counts(group, result);
  }
  add_findings(groups, result.findings);
  result.tables = {times, ratios};
}

ExperimentResult measure_delaunay(const ExperimentOptions& options, const Progress& progress) {
  ExperimentResult result{.how = start_experiment(options, options.runs)};
  const auto file = options.folder / output_file;
  const auto program = find_bench_delaunay(options.program);
  check_something_is_measured(point_sets(options).size(), "delaunay");
  result.definitions = definitions(command_line(bench_delaunay_command(program_name, options, output_file)));
  std::filesystem::create_directories(file.parent_path());
  std::filesystem::remove(file);  // or that of an earlier experiment would be taken for this one's
  if (program.empty()) {
    evaluate_delaunay(R"({"benchmarks": []})", result);
    result.problems.push_back("there is no program " + std::string(program_name) + " beside " +
                              options.program.string() +
                              ": build it by `cmake --build --preset release --target bench_delaunay`, with "
                              "CCDT_BUILD_BENCHMARKS on");
    return result;
  }
  report(progress, program_name, 0, 0);
  baselines::Limits limits = options.limits;
  limits.seconds *= options.runs;  // there are many runs in this one
  const baselines::ProcessResult child =
      baselines::run_program(bench_delaunay_command(program, options, file), {.limits = limits});
  if (evaluate_file(file, result)) {
    result.raw_files = {output_file};
    return result;
  }
  std::filesystem::remove(file);
  add_failure(options, child, result);
  return result;
}

}  // namespace ccdt::experiments
