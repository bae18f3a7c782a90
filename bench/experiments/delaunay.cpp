#include "bench/experiments/delaunay.h"

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"

namespace ccdt {
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
  for (const char* model : {"piston", "bracket", "stepping-pole"}) {
    const bool is_wanted = options.models.empty() ? std::string_view(model) == "piston" : is_asked_for(options, model);
    if (is_wanted) sets.emplace_back(model);
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

/// "a|b|c"
std::string any_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
  return text;
}

/// As one would type it.
std::string in_a_shell(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) {
    const bool is_plain = word.find_first_of(" '\"\\|()$&;*?<>[]{}") == std::string::npos;
    line += (line.empty() ? "" : " ") + (is_plain ? word : "'" + word + "'");
  }
  return line;
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

/// Of a child that left no JSON: a row for all that it was to measure.
void add_failure(const ExperimentOptions& options, const ProcessResult& child, ExperimentResult& result) {
  evaluate_delaunay(R"({"benchmarks": []})", result);
  for (const std::string& set : point_sets(options))
    for (const std::string& method : wanted_methods(options))
      result.tables[0].rows.push_back({{set, "", method, std::string(name_of(child.status)), std::monostate(),
                                        std::monostate(), std::monostate(), std::monostate(), child.reason}});
  result.problems.push_back(std::string(program_name) + " did not end well: " + child.reason);
  result.is_good = false;
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
                                      "--benchmark_filter=^delaunay/(" + any_of(wanted_methods(options)) + ")/(" +
                                          any_of(point_sets(options)) + ")(/[0-9]+)?$",
                                      "--benchmark_repetitions=" + std::to_string(options.runs),
                                      "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_min_time=0.001",
                                      "--benchmark_out=" + output.string(),
                                      "--benchmark_out_format=json"};
  for (const auto& input : options.inputs)
    command.insert(command.end(), {"--input", std::filesystem::absolute(input).string()});
  return command;
}

ExperimentResult measure_delaunay(const ExperimentOptions& options, const Progress& progress) {
  ExperimentResult result{.name = "delaunay",
                          .title = "Delaunay tetrahedralization of the same points by four programs",
                          .section = "5",
                          .how = start_experiment(options)};
  const auto file = options.folder / output_file;
  const auto program = find_bench_delaunay(options.program);
  check_something_is_measured(point_sets(options).size(), "delaunay");
  result.definitions = definitions(in_a_shell(bench_delaunay_command(program_name, options, output_file)));
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
  Limits limits = options.limits;
  limits.seconds *= options.runs;  // there are many runs in this one
  const ProcessResult child = run_program(bench_delaunay_command(program, options, file), {.limits = limits});
  if (evaluate_file(file, result)) {
    result.raw_files = {output_file};
    return result;
  }
  std::filesystem::remove(file);
  add_failure(options, child, result);
  return result;
}

}  // namespace ccdt
