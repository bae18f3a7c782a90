#pragma once

#include "tools/exit_codes.h"

namespace CLI {
class App;
}

namespace ccdt {

/// Each adds a verb with its options to the program. When the verb is on the command line, parsing it runs it and sets
/// the exit code; errors leave as exceptions.
void add_model_command(CLI::App& app, ExitCode& exit_code);
void add_mesh_command(CLI::App& app, ExitCode& exit_code);
void add_verify_command(CLI::App& app, ExitCode& exit_code);
void add_reproduce_command(CLI::App& app, ExitCode& exit_code);
void add_report_command(CLI::App& app, ExitCode& exit_code);

}  // namespace ccdt
