#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include "baselines/stop.h"
#include "bench/gate/baseline.h"
#include "bench/gate/benchmark_target.h"
#include "bench/gate/calibration.h"
#include "bench/gate/compare.h"
#include "bench/gate/instructions.h"
#include "bench/gate/judge_times.h"
#include "bench/gate/layouts.h"
#include "bench/gate/measure_times.h"
#include "bench/gate/program_counts.h"
#include "bench/gate/timed_targets.h"
#include "bench/run/environment.h"
#include "bench/run/numbers.h"
#include "bench/sweep/sweep_document.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "tools/folder_lock.h"
#include "tools/gate_command.h"
#include "tools/gate_progress.h"
#include "tools/sweep_command.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

using gate::Judgment;
using gate::Layer;

constexpr baselines::Limits limits_of_programs = {.seconds = 600};  ///< of the first run of a program

/// A program with the cases of the sweep, in a folder of its own.
struct MeasuredProgram {
  PreparedSweep sweep;
  gate::Recording recording = {};
};

gate::Programs programs_of(const GateCommand& command) {
  gate::Programs programs;
  if (!command.base.empty()) programs.base = gate::command_from(command.base, "--base");
  if (!command.head.empty()) programs.head = gate::command_from(command.head, "--head");
  return programs;
}

/// The path of a program that a sweep runs.
/// \throw InputError  it has arguments
std::filesystem::path path_of(const gate::Command& program) {
  if (program.size() > 1)
    throw InputError(
        "a sweep needs a program without arguments, and this is a command: " + baselines::command_line(program), {},
        "name the program alone, and put the options into the spec");
  return program.front();
}

/// Makes a recorded command call the measured program.
void name_program(const std::filesystem::path& program, std::string& command) {
  constexpr std::string_view recorded = " && ccdt ";
  const auto at = command.find(recorded);
  if (at != std::string::npos)
    command.replace(at, recorded.size(), " && " + baselines::command_line({program.string()}) + " ");
}

MeasuredProgram prepare(const GateCommand& command, const std::filesystem::path& program, const char* side, bool runs) {
  SweepCommand sweep;
  sweep.spec = command.sweep;
  sweep.folder = (std::filesystem::path(command.folder) / side).string();
  sweep.program = program;
  sweep.refresh = true;  // records may come from another program
  // Records of an earlier gate prove nothing: a library or another program that this one calls may have changed, even
  // if its own file did not.
  if (std::filesystem::exists(sweep::sweep_file(sweep.folder)))
    std::filesystem::remove_all(std::filesystem::path(sweep.folder) / "runs");
  MeasuredProgram measured{prepare_sweep(sweep)};
  if (!runs) return measured;
  run_cases(sweep, measured.sweep, measured.sweep.cases);
  measured.recording = gate::read_recording(sweep.folder);
  for (gate::CaseFigures& one : measured.recording.cases) name_program(sweep.program, one.command);
  return measured;
}

std::vector<bench::Case> cases_of(const MeasuredProgram& measured) {
  return sweep::asked_of(measured.sweep.cases);
}

void append(std::vector<gate::JudgedFigure> figures, gate::Verdict& verdict) {
  std::ranges::move(figures, std::back_inserter(verdict.figures));
}

/// The cases that did not fail.
std::vector<bench::Case> good_cases(const MeasuredProgram& measured, const gate::Verdict& verdict) {
  std::set<std::string> failed;
  for (const gate::JudgedFigure& figure : verdict.figures)
    if (figure.name == "status" && (figure.head_text != "ok" || figure.base_text != "ok"))
      failed.insert(figure.case_name);
  std::vector<bench::Case> good = cases_of(measured);
  std::erase_if(good, [&](const bench::Case& one) { return failed.contains(one.name); });
  return good;
}

gate::Recording count_instructions(const std::filesystem::path& program, const gate::Rules& rules,
                                   const std::vector<bench::Case>& cases, const std::filesystem::path& folder) {
  gate::Recording counts;
  GateProgress progress;
  gate::add_instructions(program, cases, rules, folder, counts, progress.counted());
  return counts;
}

bool has_instructions(const gate::Recording& recording) {
  return std::ranges::any_of(recording.identity,
                             [](const auto& field) { return field.first.starts_with("instructions."); });
}

/// The recorded counts if they are valid on this machine; otherwise those of the base program, counted now.
gate::Recording instruction_base(const GateCommand& command, const gate::Rules& rules, const gate::Recording& recorded,
                                 const gate::Recording& head, const std::vector<bench::Case>& cases,
                                 gate::Verdict& verdict) {
  const bool holds = has_instructions(recorded) && gate::other_conditions(recorded, head).empty();
  if (holds || command.base.empty()) return recorded;
  if (has_instructions(recorded))
    verdict.notes.push_back("the instructions of the base were counted again: " +
                            gate::other_conditions(recorded, head));
  const auto folder = std::filesystem::absolute(command.folder) / "base";
  std::filesystem::create_directories(folder);
  gate::Recording base = count_instructions(path_of(programs_of(command).base), rules, cases, folder);
  if (const std::string other = gate::other_conditions(base, head); !other.empty())
    verdict.notes.push_back("the programs were built differently: " + other);
  base.identity = head.identity;  // both were counted here, so only the programs differ
  return base;
}

/// Adds the counts to the figures of the same cases.
void merge(const gate::Recording& counts, gate::Recording& recording) {
  for (const gate::CaseFigures& one : counts.cases) {
    auto& figures = gate::case_named(one.name, recording).figures;
    figures.insert(figures.end(), one.figures.begin(), one.figures.end());
  }
  recording.identity.insert(counts.identity.begin(), counts.identity.end());
}

/// Adds the instruction layer. If instructions cannot be counted, it is left out, unless the user asked for it.
void compare_instructions(const GateCommand& command, const gate::Rules& rules, const gate::Recording& recorded,
                          MeasuredProgram& head, gate::Verdict& verdict) {
  if (!rules.layers.contains(Layer::instructions)) return;
  try {
    const std::vector<bench::Case> cases = good_cases(head, verdict);
    const gate::Recording counts =
        count_instructions(path_of(programs_of(command).head), rules, cases, head.sweep.folder);
    const gate::Recording base = instruction_base(command, rules, recorded, counts, cases, verdict);
    append(gate::compare_instructions(base, counts, rules), verdict);
    if (const std::string other = gate::other_conditions(base, counts); has_instructions(base) && !other.empty())
      verdict.notes.push_back("instructions are not compared: " + other +
                              "; --base PROGRAM counts those of a base on this machine");
    merge(counts, head.recording);
  } catch (const InputError& error) {
    if (rules.layers_are_chosen) throw;
    verdict.notes.push_back(std::string("instructions were not counted: ") + error.what() + "; " + error.remedy());
  }
}

std::uint64_t seed_of(const GateCommand& command) {
  return command.seed ? *command.seed : std::random_device()();
}

std::filesystem::path samples_file(const GateCommand& command) {
  return std::filesystem::path(command.folder) / "samples.json";
}

/// Is it compiled? A script may call something else in each folder.
bool is_compiled(const std::string& file) {
  std::array<char, 4> begins{};
  std::ifstream(file, std::ios::binary).read(begins.data(), begins.size());
  return std::string_view(begins.data(), begins.size()) ==
         "\x7f"
         "ELF";
}

/// What a program is: the hash of its file, with its path if it is a script, and its arguments. Copies of a compiled
/// program are the same.
std::string identity_of(gate::Command program) {
  const std::string file = program.front();
  program.front() = bench::sha256_of_file(file);
  if (!is_compiled(file)) program.insert(program.begin(), file);
  return baselines::command_line(program);
}

/// New samples, or with --resume those of a stopped gate.
/// \throw InputError  they are those of other programs
gate::SampleSet start_samples(const GateCommand& command, const gate::Programs& programs) {
  gate::SampleSet anew;
  anew.seed = seed_of(command);
  anew.clock_seconds = gate::clock_step();
  anew.is_rebuilt = static_cast<bool>(programs.rebuilt);
  anew.base_program = identity_of(programs.base);
  anew.head_program = identity_of(programs.head);
  if (!command.resume) return anew;
  gate::SampleSet stopped = gate::read_samples(samples_file(command));
  if (stopped.base_program != anew.base_program || stopped.head_program != anew.head_program ||
      stopped.is_rebuilt != anew.is_rebuilt)
    throw InputError("these times are those of other programs, so the gate cannot go on with them",
                     io::place_in(samples_file(command).string()), "start again without --resume");
  return stopped;
}

[[noreturn]] void keep_and_stop(const GateCommand& command, const gate::SampleSet& samples) {
  gate::write_samples(samples, samples_file(command));
  std::size_t pairs = 0;
  for (const gate::PairedSamples& one : samples.cases) pairs += one.screening.size() + one.confirmation.size();
  print_error_line("Stopped. " + std::to_string(pairs) + " pairs of runs of " + std::to_string(samples.cases.size()) +
                   " cases are kept in " + samples_file(command).string() +
                   ".\nThe same command with --resume goes on from there; without it, the gate starts again.");
  throw baselines::Stopped();
}

/// Measures the targets in turns; what was measured is in DIR/samples.json, also if the user stops it.
gate::SampleSet measure_samples(const GateCommand& command, const gate::Rules& rules, const gate::Programs& programs,
                                std::span<const gate::TimedTarget> targets, const gate::Calibration* calibration) {
  gate::SampleSet samples = start_samples(command, programs);
  GateProgress progress;
  const gate::MeasureOptions options = {calibration, command.most_seconds,
                                        [&](const gate::TimeProgress& now) { progress.show(now); }};
  try {
    gate::measure_times(targets, rules, options, samples);
  } catch (const baselines::Stopped&) {
    keep_and_stop(command, samples);
  }
  gate::write_samples(samples, samples_file(command));
  return samples;
}

/// \return  the names of the cases that both programs ran
std::set<std::string> compare_times(const GateCommand& command, const gate::Rules& rules,
                                    const gate::Programs& programs, std::span<const gate::TimedTarget> targets,
                                    gate::Verdict& verdict) {
  const auto calibration = command.calibration.empty() ? std::optional<gate::Calibration>()
                                                       : std::optional(gate::read_calibration(command.calibration));
  const gate::Calibration* known = calibration ? &*calibration : nullptr;
  const gate::SampleSet samples = measure_samples(command, rules, programs, targets, known);
  append(gate::judge_times(samples, rules, known), verdict);
  if (rules.layers.contains(Layer::time)) verdict.correction = gate::correction_words();
  verdict.notes.push_back("all times are in samples.json; --seed " + std::to_string(samples.seed) +
                          " repeats the order of the runs");
  std::set<std::string> names;
  for (const gate::PairedSamples& one : samples.cases)
    if (one.is_comparable()) names.insert(one.case_name);
  return names;
}

/// The cases whose times are judged.
std::vector<bench::Case> timed_cases(std::vector<bench::Case> all, const gate::Rules& rules) {
  std::erase_if(all, [&](const bench::Case& one) { return !gate::matches(rules.time.cases, one.name); });
  return all;
}

std::filesystem::path times_folder(const GateCommand& command) {
  auto folder = std::filesystem::absolute(command.folder) / "times";
  std::filesystem::create_directories(folder);
  return folder;
}

/// With --rebuild, programs with other layouts.
gate::Programs with_layouts(const GateCommand& command, gate::Programs programs) {
  if (command.rebuild.empty()) return programs;
  const auto folder = std::filesystem::absolute(command.folder) / "layouts";
  if (!command.resume) std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  programs.rebuilt = gate::layout_builder(command.rebuild, programs, folder);
  return programs;
}

bool are_benchmarks(const GateCommand& command, const gate::Programs& programs) {
  return gate::is_benchmark(command.words) || gate::is_benchmark(programs.base) || gate::is_benchmark(programs.head);
}

gate::TimedTarget target_of(const GateCommand& command, const gate::Rules& rules, const gate::Programs& programs) {
  if (are_benchmarks(command, programs))
    return gate::benchmark_target(programs, command.words, rules, limits_of_programs, times_folder(command));
  return gate::command_target(programs, command.words, limits_of_programs);
}

/// Two programs of any kind. Their instructions are counted if the user chose that layer: it takes long.
void measure_programs(const GateCommand& command, gate::Rules rules, gate::Verdict& verdict) {
  const gate::Programs programs = with_layouts(command, programs_of(command));
  const bool is_benchmark = are_benchmarks(command, programs);
  std::set<std::string> names;
  if (rules.layers.contains(Layer::time) || rules.layers.contains(Layer::exact)) {
    names = compare_times(command, rules, programs, std::vector{target_of(command, rules, programs)}, verdict);
  } else if (is_benchmark) {
    for (std::string& name :
         gate::list_benchmarks(gate::command_of(programs, {gate::Side::head}, command.words), times_folder(command)))
      names.insert(std::move(name));
  }
  if (!rules.layers.contains(Layer::instructions)) return;
  if (!rules.layers_are_chosen) {
    verdict.notes.push_back(
        "instructions, system calls and allocations were not counted; --layers "
        "exact,instructions,time counts them");
    return;
  }
  GateProgress progress;
  append(gate::compare_counts(programs, {command.words, is_benchmark ? names : std::set<std::string>()}, rules,
                              progress.counted()),
         verdict);
}

void measure_sweep(const GateCommand& command, const gate::Rules& rules, GateResult& result) {
  gate::Verdict& verdict = result.verdict;
  const bool is_exact = rules.layers.contains(Layer::exact);
  const gate::Programs programs = with_layouts(command, programs_of(command));
  const std::filesystem::path head_program = path_of(programs.head);
  MeasuredProgram head = prepare(command, head_program, "head", is_exact);
  gate::Recording base;
  if (!command.against.empty()) {
    if (!command.update || std::filesystem::exists(command.against)) base = gate::read_recording(command.against);
  } else if (is_exact) {
    base = prepare(command, path_of(programs.base), "base", true).recording;
  }
  append(gate::compare_exact(base, head.recording, rules), verdict);
  compare_instructions(command, rules, base, head, verdict);
  const auto timed = timed_cases(good_cases(head, verdict), rules);
  if (rules.layers.contains(Layer::time) && !command.base.empty() && !timed.empty())
    compare_times(command, rules, programs, gate::sweep_targets(programs, timed, rules, times_folder(command)),
                  verdict);
  else if (rules.layers.contains(Layer::time) && timed.empty())
    verdict.notes.push_back("no case is timed: the rules name no case that works");
  else if (rules.layers.contains(Layer::time))
    verdict.notes.push_back("times are only judged against a base that is also measured: --base PROGRAM");
  result.head = std::move(head.recording);
}

/// \throw InputError  too few samples; the remedy names options of this command
gate::Calibration calibration_of(const gate::SampleSet& samples, const gate::Rules& rules) {
  try {
    return gate::calibrate(samples, rules);
  } catch (const gate::TooFewSamples& error) {
    throw InputError(error.what(), error.place(), "call it with --pairs " + std::to_string(error.needed()));
  }
}

}  // namespace

GateResult measure(const GateCommand& command, const gate::Rules& rules) {
  require_baseline(command);
  const FolderLock lock(command.folder);
  GateResult result;
  result.verdict.head = command.head;
  result.verdict.base = command.against.empty() ? command.base : command.against;
  if (!command.sweep.empty())
    measure_sweep(command, rules, result);
  else
    measure_programs(command, rules, result.verdict);
  return result;
}

gate::Calibration measure_calibration(const GateCommand& command, const gate::Rules& rules) {
  const FolderLock lock(command.folder);
  GateCommand twice = command;
  twice.head = command.base;
  const gate::Programs programs = with_layouts(command, programs_of(twice));
  std::vector<gate::TimedTarget> targets;
  if (command.sweep.empty()) {
    targets = {target_of(command, rules, programs)};
  } else {
    const MeasuredProgram base = prepare(command, path_of(programs.base), "base", false);
    targets = gate::sweep_targets(programs, timed_cases(cases_of(base), rules), rules, times_folder(command));
  }
  gate::Rules all_pairs = gate::rules_of_calibration(rules, command.pairs);
  const gate::SampleSet samples = measure_samples(command, all_pairs, programs, targets, nullptr);
  gate::Calibration calibration = calibration_of(samples, rules);
  calibration.program = command.base;
  calibration.identity = bench::identity_of({"ccdt"}, programs.base.front());
  gate::write_calibration(calibration, std::filesystem::path(command.folder) / "calibration.json");
  return calibration;
}

}  // namespace ccdt::tools
