#pragma once

#include <filesystem>

#include "tools/error_words.h"

namespace CLI {
class App;
}

namespace ccdt::tools {

/// Each function adds a verb with its options to the program. If the verb is on the command line, parsing runs it and
/// sets the exit code; errors are thrown.
void add_model_command(CLI::App& app, ExitCode& exit_code);
void add_mesh_command(CLI::App& app, ExitCode& exit_code);
void add_improve_command(CLI::App& app, ExitCode& exit_code);
void add_check_command(CLI::App& app, ExitCode& exit_code);
void add_verify_command(CLI::App& app, ExitCode& exit_code);
void add_reproduce_command(CLI::App& app, ExitCode& exit_code);
void add_sweep_command(CLI::App& app, ExitCode& exit_code);
void add_gate_command(CLI::App& app, ExitCode& exit_code);
void add_report_command(CLI::App& app, ExitCode& exit_code);
void add_completion_command(CLI::App& app, ExitCode& exit_code);
void add_man_command(CLI::App& app, ExitCode& exit_code);
void add_help_command(CLI::App& app, ExitCode& exit_code);
void add_version_command(CLI::App& app, ExitCode& exit_code);

/// The file of the running program.
std::filesystem::path own_program();

/// The folder of the files that come with the program, such as the page of a report: `share/ccdt` beside the program
/// (in a build), or beside the program's folder (after installation).
std::filesystem::path share_folder();

/// Makes the report of a folder from its JSON, and prints the verdicts and the report's path.
/// \throw InputError, OutputError  as `read_report` and `write_report`
void make_report(const std::filesystem::path& folder);

}  // namespace ccdt::tools
