#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "reports/check_text.h"
#include "tools/commands.h"
#include "tools/freed_memory.h"
#include "tools/limit_errors.h"
#include "tools/markers.h"
#include "tools/options.h"
#include "tools/part_of_result.h"
#include "tools/progress_bar.h"
#include "tools/streams.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct CheckCommand {
  std::string input, input_format, output, format, report;
  bool repair = false, details = false;
  MarkerOptions markers;
  repair::RepairOptions options;
  unsigned threads = 0;
};

void check_files(const CheckCommand& command) {
  give_standard_output({command.output, command.report});
  check_surface_stream(command.output, command.format);
  for (const std::string& file : {command.output, command.report}) {
    if (file.empty()) continue;
    check_can_be_written(file);
    check_are_different(command.input, file);
  }
}

void check_markers(const CheckCommand& command) {
  if (command.markers.source == surface::MarkerSource::file ||
      io::keeps_markers(is_stream(command.output) ? "output." + command.format : command.output))
    return;
  throw OutputError("this format does not keep markers", io::place_in(command.output),
                    "choose .obj, .ply, .poly, .smesh, .mesh or .meshb");
}

void print_diagnosis(const std::string& file, const repair::Diagnosis& diagnosis, bool details) {
  constexpr std::size_t usual_places = 3;
  print(reports::to_terminal(diagnosis, details ? std::string::npos : usual_places) + file + ": ");
  diagnosis.is_valid() ? print("valid", Tone::good) : print("NOT VALID", Tone::bad);
  print(": " + reports::in_few_words(diagnosis) + "\n");
}

/// Repairs an input, writes the copy unless a limit forbids it, and checks what was written.
reports::CheckReport::Copy repaired_copy(const CheckCommand& command, const plc::InputPlc& input,
                                         const Progress& progress) {
  repair::Repaired repaired = repair::repair_input(input, command.options, progress);
  reports::CheckReport::Copy copy{
      {}, std::move(repaired.steps), repaired.certificate, std::move(repaired.refused), repaired.is_out_of_time, {}};
  if (copy.refused.empty()) {
    copy.output = name_of_output(command.output);
    mark(repaired.input, command.markers, command.options.flatness);
    write_output(command.output, command.format, [&](const std::filesystem::path& file) {
      io::write_plc(repaired.input, file);
      // The format may round coordinates, so the file is checked, not what was written into it.
      repaired.input = io::read_plc(file);
    });
  }
  PartOfResult written(copy.output.empty() || is_stream(command.output) ? "" : command.output);
  copy.diagnosis = repair::find_faults(repaired.input, command.options.flatness, progress);
  written.keep();
  return copy;
}

ExitCode code_of(const reports::CheckReport& report) {
  if (!report.copy) return report.diagnosis.is_valid() ? done : bad_input;
  if (report.copy->is_out_of_time) return limit_reached;
  return report.copy->refused.empty() && report.copy->diagnosis.is_valid() ? done : bad_input;
}

void print_copy(const CheckCommand& command, const reports::CheckReport::Copy& copy) {
  print(reports::to_terminal(copy));
  for (const std::string& refusal : copy.refused) print_error_line("not repaired: " + refusal);
  if (copy.is_out_of_time)
    print_error_line("out of time: the copy is unfinished; --time gives the repair more seconds");
  if (!copy.output.empty()) print_diagnosis(copy.output, copy.diagnosis, command.details);
}

/// \return  0 if the input, or its repaired copy, is valid
ExitCode run(const CheckCommand& command) {
  keep_freed_memory();
  check_files(command);
  check_markers(command);
  reports::CheckReport report{.input = name_of_input(command.input)};
  with_progress(report.input, command.threads, [&](const Progress& progress) {
    const plc::InputPlc input = read_plc(command.input, command.input_format);
    report.diagnosis = repair::find_faults(input, command.options.flatness, progress);
    if (command.repair) report.copy = repaired_copy(command, input, progress);
  });
  print_diagnosis(report.input, report.diagnosis, command.details);
  if (report.copy) print_copy(command, *report.copy);
  if (!command.report.empty()) write_text(command.report, reports::to_json(report));
  return code_of(report);
}

}  // namespace

void add_check_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* verb = app.add_subcommand("check", "list everything that is wrong with an input, and repair it");
  verb->add_option("INPUT", command->input, std::string("surface or PLC: ") + read_plc_endings)->required();
  add_input_format(*verb, "--input-format", command->input_format, io::plc_format_names());
  CLI::Option* repair = verb->add_flag("--repair", command->repair, "write a repaired copy of the input");
  CLI::Option* output = verb->add_option(
      "-o,--output", command->output,
      "the repaired copy: .stl .off .obj .ply .poly .smesh .mesh .meshb; - is standard output, with --format");
  add_surface_format(*verb, command->format);
  repair->needs(output);
  output->needs(repair);
  verb->add_option("--gap", command->options.gap,
                   "with --repair: width of the widest gap between open edges to close, in units of the input; "
                   "default: a ten-thousandth of the largest extent")
      ->check(positive_number())
      ->needs(repair);
  verb->add_option(
          "--limit", command->options.limit,
          "with --repair: how far lids may reach from the rims of their holes, and how far everything else may "
          "move, in units of the input; default: a thousandth of the largest extent for lids, a millionth for "
          "everything else, or --gap where gaps were closed")
      ->check(positive_number())
      ->needs(repair);
  verb->add_option("--time", command->options.seconds,
                   "with --repair: seconds after which it stops and says how far it came; default: 20, and 1 for each "
                   "1,000 facets")
      ->check(positive_number())
      ->needs(repair);
  add_markers(*verb, command->markers);
  verb->get_option("--markers")->needs(repair);
  verb->add_option(
          "--flatness", command->options.flatness,
          "tolerance for flat facets, as a fraction of the bounding box; the default is larger for coordinates rounded "
          "to single precision")
      ->check(non_negative_number())
      ->capture_default_str();
  add_threads(*verb, command->threads);
  verb->add_flag("--details", command->details, "list the first 1,000 places of each fault, not only three");
  add_report(*verb, "write all faults to this file as JSON (schema ccdt.check/1)", command->report);
  verb->footer(
      "Errors keep an input from being meshed; notes do not, but the input may not be what was meant. "
      "Facets are numbered from 0, as in the file.\n"
      "Exit codes: 0 the input, or the repaired copy, is valid; 3 it is not, or a limit forbade the repair; "
      "4 the repair ran out of time.\n\n"
      "Example: list what is wrong with a part\n"
      "  ccdt check part.stl\n"
      "Example: repair it, close gaps of up to 0.01 units, and mesh the copy\n"
      "  ccdt check part.stl --repair --gap 0.01 -o repaired.off && ccdt mesh repaired.off -o part.vtu\n"
      "Example: fill holes with lids that reach up to 5 units from their rims\n"
      "  ccdt check part.stl --repair --limit 5 -o repaired.off\n");
  verb->callback([command, &exit_code] {
    exit_code = with_stage_of_limits(command->input, "report", [&] { return run(*command); });
  });
}

}  // namespace ccdt::tools
