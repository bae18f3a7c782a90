#include "tools/gate_command.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "baselines/process.h"
#include "baselines/stop.h"
#include "bench/gate/baseline.h"
#include "bench/gate/compare.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "reports/verdict_text.h"
#include "tools/commands.h"
#include "tools/error_words.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

using gate::Judgment;
using gate::Verdict;

gate::Rules rules_of(const GateCommand& command) {
  gate::Rules rules = command.rules.empty() ? gate::Rules() : gate::read_rules(command.rules);
  if (!command.layers.empty()) {
    rules.layers = {command.layers.begin(), command.layers.end()};
    rules.layers_are_chosen = true;
  }
  if (command.layouts > 0) {
    rules.time.layouts = command.layouts;
    for (gate::CaseRules& special : rules.special) special.time.layouts = command.layouts;
  }
  rules.shadow = rules.shadow || command.shadow;
  return rules;
}

std::string names_of_cases(const gate::Recording& recording) {
  constexpr std::size_t most_names = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most_names, recording.cases.size()); ++i)
    text += (i == 0 ? "'" : ", '") + recording.cases[i].name + "'";
  return text + (recording.cases.size() > most_names ? ", ..." : "");
}

/// The command that measures times in turns, instead of two recordings.
std::string command_in_turns(const gate::Recording& base, const gate::Recording& head) {
  const auto quoted = [](const std::string& command) { return baselines::command_line({command}); };
  std::string then = "PROGRAM", now = "PROGRAM", more;
  if (base.kind == gate::Source::hyperfine && head.kind == gate::Source::hyperfine) {
    then = quoted(base.cases.front().command);
    now = quoted(head.cases.back().command);
  } else if (head.kind == gate::Source::google_benchmark) {
    const auto program_of = [&](const gate::Recording& one) {
      const auto found = one.identity.find("benchmark.executable");
      return found == one.identity.end() ? "PROGRAM" : quoted(found->second);
    };
    then = program_of(base);
    now = program_of(head);
    more = " -- --benchmark_min_time=0.05";
  } else if (head.kind == gate::Source::runs) {
    more = " --sweep SPEC.json";
  }
  return "ccdt gate --base " + then + " --head " + now + " -o gate" + more;
}

/// Notes which parts of two recordings are not compared, and why.
void add_notes(const gate::Recording& base, const gate::Recording& head, Verdict& verdict) {
  for (const gate::Recording* one : {&base, &head})
    for (const std::string& note : one->notes)
      if (std::ranges::find(verdict.notes, note) == verdict.notes.end()) verdict.notes.push_back(note);
  if (verdict.figures.empty())
    verdict.notes.push_back("nothing can be compared: the cases of the base are " + names_of_cases(base) +
                            ", those of the head " + names_of_cases(head));
  const bool has_times = std::ranges::any_of(head.cases, [](const gate::CaseFigures& one) {
    return std::ranges::any_of(one.figures, [](const gate::Figure& f) { return f.layer == gate::Layer::time; });
  });
  if (has_times)
    verdict.notes.push_back("times that were recorded earlier are never judged; this runs both programs in turns: " +
                            command_in_turns(base, head));
}

/// The commands of one call of hyperfine: their times were measured one after the other.
GateResult compare_alone(const GateCommand& command, const gate::Rules& rules) {
  GateResult result;
  result.head = gate::read_recording(command.words[0]);
  if (result.head.kind != gate::Source::hyperfine || result.head.cases.size() < 2)
    throw CLI::RequiredError("--against");
  gate::Recording base = result.head, head = result.head;
  base.cases.resize(1);
  head.cases.erase(head.cases.begin(), head.cases.end() - 1);
  result.verdict.base = base.cases.front().name;
  result.verdict.head = head.cases.front().name;
  result.verdict.figures = gate::compare_recordings(base, head, rules);
  add_notes(base, head, result.verdict);
  return result;
}

GateResult compare_recorded(const GateCommand& command, const gate::Rules& rules) {
  GateResult result;
  result.head = gate::read_recording(command.words[0]);
  require_baseline(command);
  const bool is_there = std::filesystem::exists(command.against);
  const gate::Recording base =
      is_there ? gate::read_recording(command.against) : gate::Recording{command.against, gate::Source::baseline};
  result.verdict.base = command.against;
  result.verdict.head = command.words[0];
  result.verdict.figures = gate::compare_recordings(base, result.head, rules);
  if (is_there) add_notes(base, result.head, result.verdict);
  return result;
}

GateResult judge(const GateCommand& command, const gate::Rules& rules) {
  if (command.measures()) return measure(command, rules);
  return command.against.empty() ? compare_alone(command, rules) : compare_recorded(command, rules);
}

/// Appends to a file that may exist already, such as `$GITHUB_STEP_SUMMARY`.
void append(const std::filesystem::path& file, const std::string& text) {
  if (!std::filesystem::exists(file)) {
    io::OutputFile output(file);
    output << text;
    output.commit();
    return;
  }
  const auto size = std::filesystem::file_size(file);
  std::ofstream output(file, std::ios::app | std::ios::binary);
  output << text << std::flush;
  if (output) return;
  std::error_code ignored;
  std::filesystem::resize_file(file, size, ignored);  // without a part of the text
  throw OutputError("cannot be written to", io::place_in(file.string()), "choose another file");
}

/// A baseline that holds no performance figure would gate nothing.
void require_figures(const gate::Recording& head, const gate::Rules& rules, const GateCommand& command) {
  const bool has_some = std::ranges::any_of(head.cases, [&](const gate::CaseFigures& one) {
    return std::ranges::any_of(one.figures, [&](const gate::Figure& figure) {
      const bool is_end = figure.name == "status" || figure.name == "kind" || figure.name == "exit_codes";
      return !is_end && figure.layer != gate::Layer::time && gate::is_gated(rules, figure.layer, one.name, figure.name);
    });
  });
  if (!has_some)
    throw InputError(
        "it holds times only, and a time that was recorded earlier is never judged; a baseline of it would "
        "gate nothing",
        io::place_in(command.words.empty() ? command.head : command.words[0]),
        "run both programs in turns: " + command_in_turns(head, head));
}

void write_new_baseline(const GateCommand& command, const gate::Rules& rules, GateResult& result) {
  require_figures(result.head, rules, command);
  const bool is_first = !std::filesystem::exists(command.against);
  const gate::Baseline old = is_first ? gate::Baseline() : gate::read_baseline(command.against);
  const gate::Baseline anew = gate::updated(old, result.head, rules, result.verdict.figures, command.reason);
  gate::write_baseline(anew, command.against);
  for (std::string& note : gate::history_notes(anew.history)) result.verdict.notes.push_back(std::move(note));
}

void add_history(const GateCommand& command, Verdict& verdict) {
  if (command.against.empty() || std::filesystem::is_directory(command.against)) return;
  const gate::Recording base = gate::read_recording(command.against);
  if (base.kind != gate::Source::baseline) return;
  for (std::string& note : gate::history_notes(gate::read_baseline(command.against).history))
    verdict.notes.push_back(std::move(note));
}

ExitCode exit_code_for(Judgment judgment) {
  switch (judgment) {
    case Judgment::passed:
      return done;
    case Judgment::worse:
      return failed_a_check;
    case Judgment::undecided:
      return undecided;
    case Judgment::incomparable:
      break;
  }
  return bad_input;
}

/// The text of a verdict begins with its name, which is colored.
void print_verdict(const Verdict& verdict) {
  const std::string name(name_of(verdict.verdict));
  const Tone tone = verdict.verdict == Judgment::passed  ? Tone::good
                    : verdict.verdict == Judgment::worse ? Tone::bad
                                                         : Tone::note;
  print(name, tone);
  print(reports::to_terminal(verdict).substr(name.size()));
}

ExitCode run_gate(const GateCommand& command) {
  const gate::Rules rules = rules_of(command);
  if (!command.markdown.empty()) check_can_be_written(command.markdown);
  if (!command.folder.empty()) std::filesystem::create_directories(command.folder);
  if (command.calibrate) {
    print(gate::to_text(measure_calibration(command, rules)));
    return done;
  }
  GateResult result = judge(command, rules);
  Verdict& verdict = result.verdict;
  verdict.shadow = rules.shadow;
  verdict.rules = rules;
  gate::conclude(verdict);
  if (command.update)
    write_new_baseline(command, rules, result);
  else
    add_history(command, verdict);
  if (!command.folder.empty())
    bench::write_json(to_json(verdict), std::filesystem::path(command.folder) / "verdict.json");
  if (!command.markdown.empty()) append(command.markdown, reports::to_markdown(verdict));
  if (!verdict.figures.empty() || !command.update) print_verdict(verdict);
  if (command.update) print("Updated the baseline " + command.against + ".\n");
  return command.update || verdict.shadow ? done : exit_code_for(verdict.verdict);
}

ExitCode run(const GateCommand& command) {
  const baselines::StopSignals signals;
  try {
    const std::string& what = command.words.empty() ? command.folder : command.words.front();
    return with_stage_of_limits(what, "gate", [&] { return run_gate(command); });
  } catch (const baselines::Stopped&) {
    throw;
  } catch (const CLI::Error&) {
    throw;
  } catch (const std::exception& error) {
    // Only a verdict ends with 1: whatever else fails, nothing was judged.
    print_error_line(in_words(error));
    return exit_code_of(error) == failed_a_check ? bad_input : exit_code_of(error);
  }
}

void require(bool holds, const std::string& option, const std::string& what) {
  if (!holds) throw CLI::ValidationError(option, what);
}

/// Checks that the options fit together.
void check(const GateCommand& command) {
  const bool has_reason = command.reason.find_first_not_of(" \t\n") != std::string::npos;
  require(!command.update || has_reason, "--reason", "say why the baseline changes");
  require(command.update || !has_reason, "--reason", "use it with --update only");
  require(!command.update || !command.against.empty(), "--update", "name the baseline with --against");
  if (!command.measures()) {
    require(command.words.size() == 1, "CURRENT", "give one recording, or --base and --head programs to measure");
    require(command.sweep.empty() && !command.calibrate && command.rebuild.empty() && !command.resume,
            "--sweep, --calibrate, --rebuild, --resume", "give the programs to measure");
    return;
  }
  require(!command.folder.empty(), "-o,--output", "name the folder for the measurements");
  require(command.sweep.empty() || command.words.empty(), "--sweep",
          "cannot be combined with arguments of the programs");
  require(command.rebuild.empty() || !command.base.empty(), "--rebuild", "name the base: both programs are rebuilt");
  if (command.calibrate) return require(!command.base.empty(), "--base", "name the base: a calibration measures it");
  require(!command.head.empty(), "--head", "the program to judge is missing");
  require(!command.base.empty() || !command.against.empty(), "--base",
          "give a base program, or a baseline with --against");
  require(command.against.empty() || !command.sweep.empty(), "--against", "a baseline needs the cases of a --sweep");
}

constexpr const char* gate_footer =
    "Finds out whether a program is worse than another one, or than a recording. There are three layers:\n\n"
    "  exact         counts, quality and work of `ccdt mesh`, counters of benchmarks: figures that must stay the same "
    "may not change; more work fails, less work passes\n"
    "  instructions  what callgrind counts: in each stage of `ccdt mesh`; of any other program in all, with its "
    "system calls and allocations (for these only with --layers)\n"
    "  time          base and head run in turns on this host; a time that was recorded earlier is never judged\n\n"
    "Passing is a statement: every gated figure was judged, and a slowdown beyond its limit is excluded.\n\n"
    "CURRENT and BASELINE are folders of `ccdt sweep`, reports of `ccdt mesh --report` or folders of them, JSON of "
    "Google Benchmark (--benchmark_out) or of hyperfine (--export-json), or baselines (ccdt.baseline/1) that --update "
    "wrote. The verdict goes to the terminal, to DIR/verdict.json (ccdt.verdict/1) and, in Markdown, to --markdown.\n\n"
    "Exit codes: 0 passed, 1 worse, 3 not comparable or an error, 5 undecided (too noisy); with --shadow all verdicts "
    "are 0.\n\n"
    "Example: keep a baseline beside the source, and gate every change with it\n"
    "  ccdt gate build/sweep --against gate/baseline.json --update --reason 'first baseline'\n"
    "  ccdt gate build/sweep --against gate/baseline.json -o build/gate --markdown \"$GITHUB_STEP_SUMMARY\"\n"
    "Example: all layers, over the cases of a sweep\n"
    "  ccdt gate --base old/ccdt --head new/ccdt --sweep gate/cases.json -o build/gate\n"
    "Example: two programs on Google Benchmark, or commands of any kind\n"
    "  ccdt gate --base old/bench_x --head new/bench_x -o build/gate -- --benchmark_filter=Insert\n"
    "  ccdt gate --base 'old/tool input.txt' --head 'new/tool input.txt' -o build/gate\n"
    "Example: several builds of each, so that the place of code in memory does not decide\n"
    "  ccdt gate --base old/bench_x --head new/bench_x --rebuild ./relink -o build/gate -- --benchmark_filter=Insert\n"
    "Example: how noisy is this host?\n"
    "  ccdt gate --base old/ccdt --sweep gate/cases.json --calibrate -o build/calibration\n"
    "Example: rules (--rules) that ignore a figure, let another get 1% worse, and judge times from 3% on\n"
    "  {\"schema\": \"ccdt.rules/1\",\n"
    "   \"exact\": {\"ignore\": [\"counts.improve.*\"], \"tolerances\": {\"work.front.*\": 0.01}},\n"
    "   \"time\": {\"relative\": 0.03}}\n";

void add_measuring_options(CLI::App& verb, GateCommand& command) {
  verb.add_option("--base", command.base, "program to compare with, or a command with its arguments");
  verb.add_option("--head", command.head, "program to judge, or a command with its arguments");
  verb.add_option("--sweep", command.sweep, "cases to measure: a spec of `ccdt sweep`");
  verb.add_option("--seed", command.seed, "seed of the order of the runs; default: a new one in each call");
  verb.add_flag("--calibrate", command.calibrate, "measure how noisy the base is; writes DIR/calibration.json");
  verb.add_option("--pairs", command.pairs, "number of pairs of runs of each case in a calibration")
      ->check(whole_number(5, 100000))
      ->capture_default_str();
  verb.add_option(
      "--rebuild", command.rebuild,
      "command that builds the program of $CCDT_GATE_SIDE with the layout of $CCDT_GATE_SEED, and writes it "
      "to $CCDT_GATE_OUTPUT");
  verb.add_option("--layouts", command.layouts,
                  "number of builds of each program at the first look; default: that of the rules, 20")
      ->check(whole_number(4, 1000));
  verb.add_option("--time-limit", command.most_seconds,
                  "seconds of one run; default: 20 times what the base took at first, and at least 10 s")
      ->check(CLI::PositiveNumber);
  verb.add_flag("--resume", command.resume, "go on with the times that a stopped gate left in DIR/samples.json");
  verb.add_option("--calibration", command.calibration,
                  "file that --calibrate wrote: raises the thresholds of noisy cases")
      ->check(CLI::ExistingFile);
}

}  // namespace

void require_baseline(const GateCommand& command) {
  if (command.against.empty() || command.update || std::filesystem::exists(command.against)) return;
  throw InputError("there is no baseline yet", io::place_in(command.against),
                   "write the first one: the same command with --update --reason 'first baseline'; or check the path");
}

void add_gate_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<GateCommand>();
  CLI::App* verb =
      app.add_subcommand("gate", "find out whether a program is worse than another one, or than a recording");
  verb->add_option("CURRENT", command->words, "recording to judge; after --: arguments of the measured programs");
  verb->add_option("--against", command->against, "recording or baseline to compare with");
  verb->add_option("--rules", command->rules, "rules: what is gated, and the thresholds (.json, schema ccdt.rules/1)");
  verb->add_option_function<std::vector<std::string>>(
          "--layers",
          [command](const std::vector<std::string>& names) {
            for (const std::string& name : names) command->layers.push_back(*value_of<gate::Layer>(name));
          },
          "only these layers: exact, instructions, time")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"exact", "instructions", "time"}));
  verb->add_option("-o,--output", command->folder, "folder for verdict.json and the measurements; created if needed");
  verb->add_option("--markdown", command->markdown,
                   "append the verdict in Markdown to this file, such as $GITHUB_STEP_SUMMARY");
  verb->add_flag("--shadow", command->shadow, "report the verdict, but always pass");
  verb->add_flag("--update", command->update, "write the current figures to the baseline, the file of --against");
  verb->add_option("--reason", command->reason, "why the baseline changes; stored in its history");
  add_measuring_options(*verb, *command);
  verb->footer(gate_footer);
  verb->callback([command, &exit_code] {
    check(*command);
    exit_code = run(*command);
  });
}

}  // namespace ccdt::tools
