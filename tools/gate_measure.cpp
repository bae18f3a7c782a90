#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "baselines/stop.h"
#include "bench/gate/baseline.h"
#include "bench/gate/calibration.h"
#include "bench/gate/compare.h"
#include "bench/gate/instructions.h"
#include "bench/gate/time_layer.h"
#include "bench/gate/timed_targets.h"
#include "bench/results/numbers.h"
#include "bench/sweep/sweep_document.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "tools/folder_lock.h"
#include "tools/gate_command.h"
#include "tools/progress_bar.h"
#include "tools/sweep_command.h"

namespace ccdt::tools {
namespace {

using gate::Judgment;
using gate::Layer;

constexpr baselines::Limits limits_of_programs = {.seconds = 3600};  ///< of one run of a program with arguments

/// A program with the cases of the sweep, in a folder of its own.
struct MeasuredProgram {
  PreparedSweep sweep;
  gate::Recording recording = {};
};

std::filesystem::path absolute(const std::string& program) {
  return std::filesystem::absolute(program).lexically_normal();
}

/// Makes a recorded command call the measured program.
void name_program(const std::filesystem::path& program, std::string& command) {
  constexpr std::string_view recorded = " && ccdt ";
  const auto at = command.find(recorded);
  if (at != std::string::npos)
    command.replace(at, recorded.size(), " && " + baselines::command_line({program.string()}) + " ");
}

MeasuredProgram prepare(const GateCommand& command, const std::string& program, const char* side, bool runs) {
  SweepCommand sweep;
  sweep.spec = command.sweep;
  sweep.folder = (std::filesystem::path(command.folder) / side).string();
  sweep.program = absolute(program);
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

std::vector<cases::Case> cases_of(const MeasuredProgram& measured) {
  return sweep::asked_of(measured.sweep.cases);
}

void append(std::vector<gate::JudgedFigure> figures, gate::Verdict& verdict) {
  std::ranges::move(figures, std::back_inserter(verdict.figures));
}

/// The cases that did not fail.
std::vector<cases::Case> good_cases(const MeasuredProgram& measured, const gate::Verdict& verdict) {
  std::set<std::string> failed;
  for (const gate::JudgedFigure& figure : verdict.figures)
    if (figure.name == "status" && (figure.head_text != "ok" || figure.base_text != "ok"))
      failed.insert(figure.case_name);
  std::vector<cases::Case> good = cases_of(measured);
  std::erase_if(good, [&](const cases::Case& one) { return failed.contains(one.name); });
  return good;
}

gate::Recording count_instructions(const std::string& program, const gate::Rules& rules,
                                   const std::vector<cases::Case>& cases, const std::filesystem::path& folder) {
  gate::Recording counts;
  ProgressBar bar;
  gate::add_instructions(absolute(program), cases, rules, folder, counts, bar.progress());
  return counts;
}

bool has_instructions(const gate::Recording& recording) {
  return std::ranges::any_of(recording.identity,
                             [](const auto& field) { return field.first.starts_with("instructions."); });
}

/// The recorded counts if they are valid on this machine; otherwise those of the base program, counted now.
gate::Recording instruction_base(const GateCommand& command, const gate::Rules& rules, const gate::Recording& recorded,
                                 const gate::Recording& head, const std::vector<cases::Case>& cases,
                                 gate::Verdict& verdict) {
  const bool holds = has_instructions(recorded) && gate::other_conditions(recorded, head).empty();
  if (holds || command.base.empty()) return recorded;
  if (has_instructions(recorded))
    verdict.notes.push_back("the instructions of the base were counted again: " +
                            gate::other_conditions(recorded, head));
  const auto folder = std::filesystem::absolute(command.folder) / "base";
  std::filesystem::create_directories(folder);
  gate::Recording base = count_instructions(command.base, rules, cases, folder);
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
    const std::vector<cases::Case> cases = good_cases(head, verdict);
    const gate::Recording counts = count_instructions(command.head, rules, cases, head.sweep.folder);
    const gate::Recording base = instruction_base(command, rules, recorded, counts, cases, verdict);
    append(gate::compare_instructions(base, counts, rules), verdict);
    if (const std::string other = gate::other_conditions(base, counts); has_instructions(base) && !other.empty())
      verdict.notes.push_back("instructions are not compared: " + other +
                              "; --base PROGRAM counts those of a base on this machine");
    merge(counts, head.recording);
  } catch (const InputError& error) {
    if (!command.layers.empty() || !command.rules.empty()) throw;
    verdict.notes.push_back(std::string("instructions were not counted: ") + error.what() + "; " + error.remedy());
  }
}

std::uint64_t seed_of(const GateCommand& command) {
  return command.seed ? *command.seed : std::random_device()();
}

/// A program failed while its time was measured.
gate::JudgedFigure judged_failure(const gate::ProgramFailed& failure) {
  gate::JudgedFigure judged;
  const bool is_base = failure.side() == gate::Side::base;
  judged.name = "status";
  judged.case_name = failure.place().file;
  judged.layer = Layer::time;
  judged.base_text = is_base ? "failed" : "ok";
  judged.head_text = is_base ? "" : "failed";
  judged.verdict = is_base ? Judgment::incomparable : Judgment::worse;
  judged.changed = !is_base;
  judged.words = failure.what();
  judged.command = failure.command();
  return judged;
}

void compare_times(const GateCommand& command, const gate::Rules& rules, std::span<const gate::TimedTarget> targets,
                   gate::Verdict& verdict) {
  const auto calibration = command.calibration.empty() ? std::optional<gate::Calibration>()
                                                       : std::optional(gate::read_calibration(command.calibration));
  const gate::Calibration* known = calibration ? &*calibration : nullptr;
  ProgressBar bar;
  try {
    const gate::SampleSet samples = gate::measure_times(targets, rules, known, seed_of(command), bar.progress());
    gate::write_samples(samples, std::filesystem::path(command.folder) / "samples.json");
    append(gate::judge_times(samples, rules, known), verdict);
    verdict.correction = gate::correction_words();
    verdict.notes.push_back("all times are in samples.json; --seed " + std::to_string(samples.seed) +
                            " repeats the order of the runs");
  } catch (const gate::ProgramFailed& failure) {
    verdict.figures.push_back(judged_failure(failure));
  }
}

/// The cases whose times are judged.
std::vector<cases::Case> timed_cases(std::vector<cases::Case> all, const gate::Rules& rules) {
  std::erase_if(all, [&](const cases::Case& one) { return !gate::matches(rules.time.cases, one.name); });
  return all;
}

std::filesystem::path times_folder(const GateCommand& command) {
  auto folder = std::filesystem::absolute(command.folder) / "times";
  std::filesystem::create_directories(folder);
  return folder;
}

std::vector<gate::TimedTarget> targets_of(const GateCommand& command, const gate::Programs& programs) {
  const bool is_benchmark =
      std::ranges::any_of(command.words, [](const std::string& word) { return word.starts_with("--benchmark"); });
  if (is_benchmark) return {gate::benchmark_target(programs, command.words, limits_of_programs, times_folder(command))};
  return {gate::command_target(programs, command.words, limits_of_programs)};
}

void measure_sweep(const GateCommand& command, const gate::Rules& rules, GateResult& result) {
  gate::Verdict& verdict = result.verdict;
  const bool is_exact = rules.layers.contains(Layer::exact);
  MeasuredProgram head = prepare(command, command.head, "head", is_exact);
  gate::Recording base;
  if (!command.against.empty()) {
    if (!command.update || std::filesystem::exists(command.against)) base = gate::read_recording(command.against);
  } else if (is_exact) {
    base = prepare(command, command.base, "base", true).recording;
  }
  append(gate::compare_exact(base, head.recording, rules), verdict);
  compare_instructions(command, rules, base, head, verdict);
  const auto timed = timed_cases(good_cases(head, verdict), rules);
  if (rules.layers.contains(Layer::time) && !command.base.empty() && !timed.empty())
    compare_times(
        command, rules,
        gate::sweep_targets({absolute(command.base), absolute(command.head)}, timed, rules, times_folder(command)),
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
  const FolderLock lock(command.folder);
  GateResult result;
  result.verdict.head = command.head;
  result.verdict.base = command.against.empty() ? command.base : command.against;
  if (!command.sweep.empty())
    measure_sweep(command, rules, result);
  else
    compare_times(command, rules, targets_of(command, {absolute(command.base), absolute(command.head)}),
                  result.verdict);
  return result;
}

gate::Calibration measure_calibration(const GateCommand& command, const gate::Rules& rules) {
  const FolderLock lock(command.folder);
  const gate::Programs programs = {absolute(command.base), absolute(command.base)};
  std::vector<gate::TimedTarget> targets;
  if (command.sweep.empty()) {
    targets = targets_of(command, programs);
  } else {
    const MeasuredProgram base = prepare(command, command.base, "base", false);
    targets = gate::sweep_targets(programs, timed_cases(cases_of(base), rules), rules, times_folder(command));
  }
  ProgressBar bar;
  const gate::SampleSet samples = gate::measure_noise(targets, command.pairs, seed_of(command), bar.progress());
  bar.erase();
  const std::filesystem::path folder = command.folder;
  gate::write_samples(samples, folder / "samples.json");
  gate::Calibration calibration = calibration_of(samples, rules);
  calibration.program = command.base;
  calibration.identity = cases::identity_of({"ccdt"}, absolute(command.base));
  gate::write_calibration(calibration, folder / "calibration.json");
  return calibration;
}

}  // namespace ccdt::tools
