#include "bench/gate/program_counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "baselines/external_program.h"
#include "bench/gate/callgrind_profile.h"
#include "bench/gate/foreign_json.h"
#include "bench/gate/instructions.h"
#include "bench/run/numbers.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

namespace fs = std::filesystem;

constexpr baselines::Limits limits_of_counting = {.seconds = 3600};
constexpr std::array<std::size_t, 2> paddings = {0, 997};  ///< bytes of the environment of the two runs of the base
constexpr std::size_t most_functions = 3;                  ///< named in a verdict

bool is_allocation(std::string_view name) {
  static constexpr std::array all = {"malloc",         "calloc",        "realloc", "reallocarray", "memalign",
                                     "posix_memalign", "aligned_alloc", "valloc",  "pvalloc"};
  return std::ranges::any_of(all, [&](const char* one) { return bare_name(name) == one; });
}

/// The loop of a benchmark begins and ends with these functions of Google Benchmark.
constexpr const char* loop_begins = "--zero-before=benchmark::State::StartKeepRunning()";
constexpr const char* loop_ends = "--dump-before=benchmark::State::FinishKeepRunning()";

Command under_callgrind(const fs::path& valgrind, const fs::path& profile, bool is_loop) {
  Command command = {"/usr/bin/env",
                     "LD_BIND_NOW=1",
                     same_on_all_processors,
                     valgrind.string(),
                     "-q",
                     "--tool=callgrind",
                     "--trace-children=yes",
                     "--collect-systime=yes",
                     "--callgrind-out-file=" + profile.string() + ".%p"};
  if (is_loop) command.insert(command.end(), {loop_begins, loop_ends});
  return command;
}

/// The profiles of a run: of the loop of a benchmark, "profile.PID.1", if there are such, and otherwise of all
/// processes.
std::vector<fs::path> profiles_in(const fs::path& folder, bool is_loop) {
  std::vector<fs::path> whole, loops;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("profile.")) (std::ranges::count(name, '.') == 2 ? loops : whole).push_back(entry.path());
  }
  return is_loop && !loops.empty() ? loops : whole;
}

/// Counts one run. \throw ProgramFailed
ProgramCounts count_run(const fs::path& valgrind, const Programs& programs, const RunRequest& request,
                        const CountOptions& options) {
  const baselines::TemporaryFolder folder;
  const bool is_loop = !request.cases.empty();
  Command command = command_of(programs, request, options.arguments);
  if (is_loop)
    command.insert(command.end(), {"--benchmark_filter=" + pattern_of(request.cases), "--benchmark_min_time=0",
                                   "--benchmark_repetitions=1"});
  Command counted = under_callgrind(valgrind, folder.path() / "profile", is_loop);
  counted.insert(counted.end(), command.begin(), command.end());
  run(request, counted, limits_of_counting);
  ProgramCounts counts;
  for (const fs::path& profile : profiles_in(folder.path(), is_loop))
    add_profile(io::read_whole_file(profile).bytes, counts);
  if (counts.instructions == 0) fail(request.side, command, "callgrind counted nothing");
  return counts;
}

std::string with_sign(double change) {
  return (change < 0 ? "-" : "+") + bench::with_separators(static_cast<std::uint64_t>(std::abs(change)));
}

/// The functions whose instructions grew most: "parse(char const*) +1,234".
std::string growth_words(const ProgramCounts& base, const ProgramCounts& head) {
  std::vector<std::pair<double, std::string>> changes;
  for (const auto& [name, now] : head.functions) {
    const auto then = base.functions.find(name);
    const double before = then == base.functions.end() ? 0 : static_cast<double>(then->second);
    if (static_cast<double>(now) > before) changes.emplace_back(static_cast<double>(now) - before, name);
  }
  std::ranges::sort(changes, std::greater());
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(most_functions, changes.size()); ++i)
    words.push_back(changes[i].second + " " + with_sign(changes[i].first));
  return words.empty() ? "" : "; grew most: " + bench::joined(words);
}

JudgedFigure start(const std::string& name, const std::string& case_name, std::uint64_t base, std::uint64_t head) {
  JudgedFigure judged;
  judged.name = name;
  judged.case_name = case_name;
  judged.layer = Layer::instructions;
  judged.base = static_cast<double>(base);
  judged.head = static_cast<double>(head);
  if (base > 0) judged.ratio = *judged.head / *judged.base;
  judged.badness = judged.ratio ? std::log(*judged.ratio) : std::numeric_limits<double>::max() / 2;
  return judged;
}

/// A count that must stay the same.
JudgedFigure judge_exactly(JudgedFigure judged, std::uint64_t again, const Rules& rules) {
  if (*judged.base != static_cast<double>(again)) {
    judged.verdict = Judgment::incomparable;
    judged.is_gated = false;
    judged.words = "differs between two runs of the base: " + bench::with_separators(again) + " in the second";
    return judged;
  }
  const double tolerated = *judged.base * (1 + tolerance_of(rules.exact, judged.name));
  judged.changed = *judged.head != *judged.base;
  judged.smallest_found = 0;
  if (*judged.head > tolerated) judged.verdict = Judgment::worse;
  if (judged.changed) judged.words = *judged.head < *judged.base ? "better" : "counted exactly";
  return judged;
}

JudgedFigure failed(const std::string& case_name, const std::string& words, Judgment verdict) {
  JudgedFigure judged;
  judged.name = "status";
  judged.case_name = case_name;
  judged.layer = Layer::instructions;
  judged.base_text = verdict == Judgment::worse ? "ok" : "failed";
  judged.head_text = verdict == Judgment::worse ? "failed" : "";
  judged.verdict = verdict;
  judged.changed = true;
  judged.words = words;
  return judged;
}

}  // namespace

void add_profile(std::string_view profile, ProgramCounts& counts) {
  const CallGraph graph = read_callgrind(profile);
  for (const auto& [name, instructions] : graph.own) {
    counts.instructions += instructions;
    counts.functions[name] += instructions;
  }
  counts.system_calls += graph.system_calls;
  for (const auto& [caller, callee] : graph.calls)
    if (is_allocation(callee.name) && !is_allocation(caller)) counts.allocations += callee.calls;
}

std::vector<JudgedFigure> judge_counts(const std::string& case_name, const ProgramCounts& base,
                                       const ProgramCounts& again, const ProgramCounts& head, const Rules& rules) {
  JudgedFigure total = start("instructions.total", case_name, base.instructions, head.instructions);
  const auto [fewest, most] = std::minmax(base.instructions, again.instructions);
  const double relative = rules.instructions.relative;
  const double spread = static_cast<double>(most - fewest) / static_cast<double>(std::max<std::uint64_t>(1, most));
  const auto now = static_cast<double>(head.instructions);
  total.smallest_found = relative + spread;
  if (now > static_cast<double>(most) * (1 + relative)) {
    total.verdict = Judgment::worse;
    total.changed = true;
    total.words = "beyond " + bench::percent(relative) + "; counted" + growth_words(base, head);
  } else if (spread > relative / 2) {
    total.verdict = Judgment::undecided;
    total.words = "two runs of the base differ by " + bench::percent(spread) +
                  ": its work depends on its environment, the time or chance; make it repeatable, or set "
                  "instructions.relative in the rules to more than twice as much";
  } else if (now < static_cast<double>(fewest) * (1 - relative)) {
    total.changed = true;
    total.words = "better";
  }
  std::vector<JudgedFigure> all = {std::move(total)};
  const auto add = [&](const char* name, std::uint64_t ProgramCounts::*count) {
    JudgedFigure judged = start(name, case_name, base.*count, head.*count);
    if (!matches(rules.exact.ignore, judged.name)) all.push_back(judge_exactly(std::move(judged), again.*count, rules));
  };
  add("instructions.system_calls", &ProgramCounts::system_calls);
  add("instructions.allocations", &ProgramCounts::allocations);
  return all;
}

std::vector<JudgedFigure> compare_counts(const Programs& programs, const CountOptions& options, const Rules& rules,
                                         const Progress& progress) {
  const fs::path valgrind = find_valgrind();
  std::vector<std::set<std::string>> cases;
  for (const std::string& name : options.cases) cases.push_back({name});
  Command whole = programs.head;
  whole.insert(whole.end(), options.arguments.begin(), options.arguments.end());
  if (cases.empty()) cases.emplace_back();
  std::vector<JudgedFigure> all;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = cases[i].empty() ? short_name(whole) : *cases[i].begin();
    if (!matches(rules.instructions.cases, name)) continue;
    try {
      const ProgramCounts base = count_run(valgrind, programs, {Side::base, paddings[0], cases[i]}, options);
      const ProgramCounts again = count_run(valgrind, programs, {Side::base, paddings[1], cases[i]}, options);
      const ProgramCounts head = count_run(valgrind, programs, {Side::head, paddings[0], cases[i]}, options);
      for (JudgedFigure& figure : judge_counts(name, base, again, head, rules)) all.push_back(std::move(figure));
    } catch (const ProgramFailed& failure) {
      const bool is_base = failure.side() == Side::base;
      all.push_back(failed(name,
                           std::string(is_base ? "the base" : "the head") + " fails under callgrind: " + failure.what(),
                           is_base ? Judgment::incomparable : Judgment::worse));
      all.back().command = failure.command();
    }
    report(progress, "instructions", i + 1, cases.size());
  }
  return all;
}

}  // namespace ccdt::gate
