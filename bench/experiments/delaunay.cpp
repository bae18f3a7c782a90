#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "baselines/parse_json.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::experiments {
namespace {

constexpr const char* program_name = "bench_delaunay";
constexpr const char* output_file = "benchmarks/bench_delaunay.json";
constexpr const char* nothing_measured = R"({"benchmarks": []})";

using Names = std::vector<std::pair<std::string, std::string>>;  ///< in the benchmarks' names, and for people
const Names methods = {{"insert", "insert"}, {"wrap", "wrap"}, {"cgal", "CGAL"}, {"tetgen", "TetGen"}};
const Names sets = {{"random", "uniform random"}, {"lattice", "FCC lattice"}};

std::string title_of(const Names& names, const std::string& name) {
  const auto found = std::ranges::find(names, name, &Names::value_type::first);
  return found == names.end() ? name : found->second;
}

std::vector<std::string> delaunay_definitions(const std::string& command) {
  return {
      "Points: uniformly random in a cube; a perfect face-centered lattice; the vertices of a mesh of a model or file.",
      "Insert: vertex by vertex along a Hilbert curve. Wrap: the paper's method, face by face in a uniform grid.",
      "CGAL: Delaunay_triangulation_3 with exact predicates. TetGen: its library, without switches.",
      "Seconds are CPU time of one thread, from the points in memory to the finished structure.",
      "They are medians of repetitions in random order.",
      "A method that this build lacks, or that is not measured on this many points, has no row.",
      "Before timing, the results are compared: insert and wrap have the same tetrahedra.",
      "CGAL and TetGen fill the same volume, with the same number of tetrahedra on random points.",
      "Other points have many Delaunay tetrahedralizations, which differ in the number of tetrahedra.",
      "A ratio is the median of the ratios of repetitions with the same number.",
      "All rows come from " + std::string(output_file) +
          ", as written by Google Benchmark. To repeat it in the folder of the report: " + command,
  };
}

/// A method on a set of points: all repetitions.
struct Measured {
  std::string points, size, method, status = "ok", fault = {};
  int family = 0;  ///< the program's order
  std::optional<double> vertices = {}, tetrahedra = {};
  std::vector<double> seconds = {};

  bool ok() const { return fault.empty() && !seconds.empty(); }
};
using DelaunayGroup = std::span<const Measured>;  ///< the methods on the same points

Estimate scaled(const Estimate& e, double factor) {
  return {e.value * factor, e.low * factor, e.high * factor};
}

std::optional<Estimate> seconds_of(const Measured& m) {
  return m.ok() ? std::optional(bench::median_estimate(m.seconds)) : std::nullopt;
}

const Measured* find(DelaunayGroup group, std::string_view method) {
  const auto found = std::ranges::find(group, method, &Measured::method);
  return found != group.end() && found->ok() ? &*found : nullptr;
}

std::optional<Estimate> ratio(DelaunayGroup group, std::string_view above, std::string_view below) {
  const Measured *a = find(group, above), *b = find(group, below);
  if (a == nullptr || b == nullptr || std::ranges::min(b->seconds) <= 0) return {};
  return bench::median_ratio(a->seconds, b->seconds);
}

const RowColumns<Measured> delaunay_time_columns = {
    {label_column("points"), &Measured::points},
    {label_column("size"), &Measured::size},
    {label_column("method"), &Measured::method},
    {label_column("status"), &Measured::status},
    {figure_column("vertices"), &Measured::vertices},
    {figure_column("tetrahedra"), &Measured::tetrahedra},
    {time_column("seconds", "", "s"), seconds_of},
    {time_column("microseconds_per_vertex", "time a vertex", "µs"),
     [](const Measured& m) { return m.ok() ? Cell(scaled(*seconds_of(m), 1e6 / *m.vertices)) : Cell(); }},
    {note_column("reason"), [](const Measured& m) { return cell_if(!m.fault.empty(), m.fault); }}};

RowColumn<DelaunayGroup> ratio_column(const char* name, const char* title, const char* above, const char* below) {
  return {time_column(name, title), [=](DelaunayGroup group) { return ratio(group, above, below); }};
}
const RowColumns<DelaunayGroup> delaunay_ratio_columns = {
    {label_column("points"), [](DelaunayGroup group) { return group.front().points; }},
    {label_column("size"), [](DelaunayGroup group) { return group.front().size; }},
    {figure_column("vertices"),
     [](DelaunayGroup group) { return find(group, "insert") ? find(group, "insert")->vertices : std::nullopt; }},
    ratio_column("insert_over_cgal", "insert / CGAL", "insert", "CGAL"),
    ratio_column("wrap_over_insert", "wrap / insert", "wrap", "insert"),
    ratio_column("tetgen_over_insert", "TetGen / insert", "TetGen", "insert")};

double seconds_in(const std::string& unit) {
  const std::map<std::string, double> units = {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}};
  if (const auto found = units.find(unit); found != units.end()) return found->second;
  throw InputError("Google Benchmark's JSON has times in '" + unit + "'", {}, "measure again");
}

/// "delaunay/wrap/random/1000", or "delaunay/wrap/part.off".
Measured measured_named(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream text(name);
  for (std::string part; std::getline(text, part, '/');) parts.push_back(part);
  parts.resize(4);
  return {.points = title_of(sets, parts[2]), .size = parts[3], .method = title_of(methods, parts[1])};
}

void add_repetition(const bench::Json& run, Measured& measured) {
  measured.family = run.at("family_index");
  if (run.value("error_occurred", false)) {
    measured.status = "failed";
    measured.fault = run.value("error_message", "the benchmark failed");
    return;
  }
  measured.vertices = run.at("vertices").get<double>();
  measured.tetrahedra = run.at("cells").get<double>();
  measured.seconds.push_back(run.at("cpu_time").get<double>() * seconds_in(run.at("time_unit")));
}

/// The benchmarks in the order of the program, not in that of the runs.
std::vector<Measured> measured_in(const bench::Json& json) {
  std::map<std::string, Measured> by_name;
  for (const bench::Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration") continue;
    const std::string name = run.at("run_name");
    add_repetition(run, by_name.try_emplace(name, measured_named(name)).first->second);
  }
  std::vector<Measured> all;
  std::map<std::string, int> order;  // of the points
  for (auto& [name, measured] : by_name) {
    int& first = order.try_emplace(measured.points, measured.family).first->second;
    first = std::min(first, measured.family);
    all.push_back(std::move(measured));
  }
  std::ranges::sort(all, {}, [&](const Measured& m) {
    return std::tuple(order[m.points], m.size.size(), m.size, m.family);  // sizes are numbers without leading zeros
  });
  return all;
}

std::string subject(const Measured& m) {
  return m.points + ", " + with_separators(static_cast<std::uint64_t>(*m.vertices)) + " points";
}

/// "piston, 10,521 points: insert takes 0.50 [0.49, 0.52] times as long as CGAL: it is faster."
void add_comparison(DelaunayGroup group, const char* method, const char* other, std::vector<std::string>& findings) {
  const auto estimate = ratio(group, method, other);
  if (!estimate) return;
  const std::string verdict = is_at_most(*estimate, 1) == BoundTest::holds    ? "it is faster"
                              : is_at_least(*estimate, 1) == BoundTest::holds ? "it is slower"
                                                                              : "neither is certainly faster";
  findings.push_back(subject(*find(group, other)) + ": " + method + " takes " + with_interval(*estimate) +
                     " times as long as " + other + ": " + verdict + ".");
}

/// The growth of the time per vertex from the smallest to the largest set of these points.
void add_growth(DelaunayGroup small, DelaunayGroup large, std::vector<std::string>& findings) {
  std::vector<std::string> growths;
  for (const auto& [name, method] : methods) {
    const Measured *first = find(small, method), *last = find(large, method);
    if (first == nullptr || last == nullptr) continue;
    const Estimate r = bench::median_ratio(last->seconds, first->seconds);
    growths.push_back(method + " " + with_interval(scaled(r, *first->vertices / *last->vertices)));
  }
  if (!growths.empty())
    findings.push_back(small.front().points +
                       ": time per vertex of the largest set over that of the smallest: " + joined(growths) + ".");
}

/// Adds failures, and differences between results that must agree.
void add_problems(DelaunayGroup group, ExperimentResult& result) {
  const Measured* inserted = find(group, "insert");
  for (const Measured& m : group) {
    const bool is_ours = m.method == "insert" || m.method == "wrap", has_no_ties = m.points == sets[0].second;
    if (!m.fault.empty())
      add_problem(result, m.points + " " + m.size + ", " + m.method + ": " + m.fault, is_ours);
    else if (inserted != nullptr && m.tetrahedra != inserted->tetrahedra && (is_ours || has_no_ties))
      add_problem(result, subject(m) + ": " + m.method + " does not have as many tetrahedra as insert", is_ours);
  }
}

void evaluate(const std::vector<Measured>& all, ExperimentResult& result) {
  std::vector<DelaunayGroup> groups;
  const auto of_one = [](auto member) {
    return [member](const Measured& a, const Measured& b) { return a.*member == b.*member; };
  };
  for (const DelaunayGroup set : neighbors(DelaunayGroup(all), of_one(&Measured::points))) {
    const std::vector<DelaunayGroup> sizes = neighbors(set, of_one(&Measured::size));
    for (const DelaunayGroup group : sizes) add_problems(group, result);
    add_comparison(sizes.back(), "insert", "CGAL", result.findings);
    add_comparison(sizes.back(), "wrap", "insert", result.findings);
    add_comparison(sizes.back(), "TetGen", "insert", result.findings);
    if (sizes.size() > 1) add_growth(sizes.front(), sizes.back(), result.findings);
    append(groups, sizes);
  }
  result.tables = {table_of_rows("times", "Delaunay tetrahedralization", delaunay_time_columns, all),
                   table_of_rows("ratios", "How the times compare", delaunay_ratio_columns, groups)};
}

/// The approximate number of points in the largest sets, for this number of tetrahedra per model. Wrapping takes
/// longest and determines it.
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
std::vector<std::string> wanted_sets(const ExperimentOptions& options) {
  std::vector<std::string> wanted;
  if (std::ranges::find(options.models, "none") == options.models.end()) wanted = {"random", "lattice"};
  for (const std::string& model : names_of_paper_models())
    if (options.models.empty() ? model == "piston" : is_chosen(options, model)) wanted.push_back(model);
  for (const auto& input : options.inputs) wanted.push_back(escaped(input.filename().string()));
  return wanted;
}

/// The names of the methods in the benchmarks' names. The program leaves out what it was built without.
std::vector<std::string> wanted_methods(const ExperimentOptions& options) {
  std::vector<std::string> wanted = {"insert", "wrap"};
  if (is_measured(options, "cgal-delaunay")) wanted.emplace_back("cgal");
  if (is_measured(options, "tetgen")) wanted.emplace_back("tetgen");
  return wanted;
}

/// Adds a row for everything that a child process without JSON was meant to measure.
void add_failure(const ExperimentOptions& options, const baselines::ProcessResult& child, ExperimentResult& result) {
  std::vector<Measured> all;
  for (const std::string& set : wanted_sets(options))
    for (const std::string& method : wanted_methods(options))
      all.push_back({set, "", method, std::string(name_of(child.status)), child.reason});
  result.tables[0] = table_of_rows("times", result.tables[0].title, delaunay_time_columns, all);
  add_problem(result, std::string(program_name) + " failed: " + child.reason);
}

/// Evaluates the JSON that the program wrote.
/// \return  is it complete, and marked as such?
bool evaluate_file(const std::filesystem::path& file, const std::string& stamp, ExperimentResult& result) {
  try {
    const std::string text = io::read_whole_file(file).bytes;
    if (text.find(stamp) == std::string::npos) return false;
    evaluate_delaunay(text, result);
    result.raw_files = {output_file};
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
                                          joined(wanted_sets(options), "|") + ")(/[0-9]+)?$",
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
  try {
    evaluate(measured_in(baselines::parse_json(benchmark_json)), result);
  } catch (const nlohmann::json::exception& error) {
    throw InputError("no JSON of Google Benchmark: " + std::string(error.what()), {}, "measure again");
  }
}

ExperimentResult measure_delaunay(const ExperimentOptions& options, bench::Runner& runner) {
  ExperimentResult result;
  const auto file = options.folder / output_file, program = find_bench_delaunay(options.program);
  check_something_is_measured(wanted_sets(options).size(), "delaunay");
  result.definitions =
      delaunay_definitions(baselines::command_line(bench_delaunay_command(program_name, options, output_file)));
  evaluate_delaunay(nothing_measured, result);
  if (program.empty()) {
    std::filesystem::remove(file);
    result.problems.push_back("there is no program " + std::string(program_name) + " beside " +
                              options.program.string() +
                              ": build it by `cmake --build --preset release --target bench_delaunay`, with "
                              "CCDT_BUILD_BENCHMARKS on");
    return result;
  }
  std::vector<std::string> command = bench_delaunay_command(program, options, file);
  const std::string stamp = bench::sha256_of_text(baselines::command_line(command) + bench::sha256_of_file(program));
  if (evaluate_file(file, stamp, result)) return result;  // it was measured before

  command.push_back("--benchmark_context=stamp=" + stamp);
  std::filesystem::create_directories(file.parent_path());
  std::filesystem::remove(file);
  report(runner.settings().progress, program_name, 0, 0);
  baselines::Limits limits = options.limits;
  limits.seconds *= options.runs;  // this command makes many runs
  const baselines::ProcessResult child = baselines::run_program(command, {.limits = limits});
  if (evaluate_file(file, "", result)) return result;
  std::filesystem::remove(file);
  add_failure(options, child, result);
  return result;
}

}  // namespace ccdt::experiments
