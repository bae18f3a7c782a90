#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>

#include "baselines/stop.h"
#include "engine/version.h"
#include "tools/commands.h"
#include "tools/error_words.h"
#include "tools/last_record.h"
#include "tools/options.h"
#include "tools/terminal.h"
#include "tools/usage_words.h"

int main(int argc, char** argv) {
  using namespace ccdt::tools;
  ccdt::baselines::clean_up_on_signals(leave_last_record);
  ExitCode exit_code = wrong_usage;
  try {
    CLI::App app("tetrahedral meshing by conforming constrained Delaunay tetrahedralization, and its benchmark",
                 "ccdt");
    app.set_version_flag("--version", "ccdt " + std::string(ccdt::engine_version), "print the version and exit");
    app.set_help_flag("-h,--help", "print this help and exit");
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done; 1 no valid mesh was found, a result failed a check, a gate failed, or an internal error "
        "occurred; 2 wrong usage; 3 invalid input, a file cannot be read or written, or results cannot be compared; "
        "4 a limit (time, memory, subdivision) was reached; 5 undecided.\n\n"
        "Example: mesh a part and verify the mesh\n"
        "  ccdt mesh part.stl -o part.vtu && ccdt verify part.stl part.vtu\n");
    add_model_command(app, exit_code);
    add_mesh_command(app, exit_code);
    add_improve_command(app, exit_code);
    add_check_command(app, exit_code);
    add_verify_command(app, exit_code);
    add_reproduce_command(app, exit_code);
    add_sweep_command(app, exit_code);
    add_gate_command(app, exit_code);
    add_report_command(app, exit_code);
    for (CLI::App* verb : app.get_subcommands({})) add_quiet(*verb);
    add_completion_command(app, exit_code);
    add_man_command(app, exit_code);
    add_help_command(app, exit_code);
    add_version_command(app, exit_code);
    try {
      app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
      print_help(app.help());
      exit_code = done;
    } catch (const CLI::CallForVersion& version) {
      print(std::string(version.what()) + "\n");
      exit_code = done;
    } catch (const CLI::ParseError& error) {
      print_error_line(usage_in_words(app, error));
    }
    finish_output(exit_code != done);
  } catch (const ccdt::baselines::Stopped&) {
    return ccdt::baselines::stopped_exit_code();
  } catch (const std::bad_alloc& error) {
    // So early that no stage knows of the file yet.
    std::string words = in_words(error) + "\n  the command was:";
    for (int i = 0; i < argc; ++i) words += " " + std::string(argv[i]);
    print_error_line(words);
    return exit_code_of(error);
  } catch (const std::exception& error) {
    print_error_line(in_words(error));
    return exit_code_of(error);
  }
  return exit_code;
}
