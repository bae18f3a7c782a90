#include "bench/gate/layouts.h"

#include "baselines/external_program.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& file) {
  return fs::is_regular_file(file) && (fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms::none;
}

}  // namespace

std::function<fs::path(Side, int layout)> layout_builder(const std::string& command, const Programs& programs,
                                                         const fs::path& folder) {
  return [=, given = std::pair(programs.base.front(), programs.head.front())](Side side, int layout) -> fs::path {
    const std::string& program = side == Side::base ? given.first : given.second;
    if (layout == 0) return program;
    // Both names have the same length, so that the stack begins at the same place.
    const fs::path home = fs::absolute(folder) / (std::string(name_of(side)) + "-" + std::to_string(layout));
    fs::path built = home / fs::path(program).filename();
    if (is_program(built)) return built;
    fs::create_directories(home);
    const fs::path log = home / "build.log";
    const auto ended = baselines::run_program({"/bin/sh", "-c", command},
                                              {.environment = {{"CCDT_GATE_SIDE", std::string(name_of(side))},
                                                               {"CCDT_GATE_SEED", std::to_string(layout)},
                                                               {"CCDT_GATE_PROGRAM", program},
                                                               {"CCDT_GATE_OUTPUT", built.string()}},
                                               .log = log,
                                               .limits = baselines::Limits{}});
    const std::string lines = baselines::last_lines(log);
    if (ended.status != baselines::RunStatus::ok)
      throw InputError("--rebuild: the command failed: " + ended.reason + (lines.empty() ? "" : ": " + lines),
                       io::place_in(log.string()),
                       "run it by hand with the variables that the documentation of gates names");
    if (!is_program(built))
      throw InputError("--rebuild: the command succeeded but wrote no program", io::place_in(built.string()),
                       "let it write the program to $CCDT_GATE_OUTPUT");
    return built;
  };
}

}  // namespace ccdt::gate
