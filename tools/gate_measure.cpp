#include "bench/gate/baseline.h"
#include "bench/gate/compare.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "tools/folder_lock.h"
#include "tools/gate_command.h"
#include "tools/sweep_command.h"

namespace ccdt::tools {
namespace {

/// Runs the cases of the sweep with a program, and reads what was recorded. Nothing is run twice.
gate::Recording record(const GateCommand& command, const std::string& program, const char* side) {
  SweepCommand sweep;
  sweep.spec = command.sweep;
  sweep.folder = (std::filesystem::path(command.folder) / side).string();
  sweep.program = std::filesystem::canonical(program);
  sweep.refresh = true;  // another program may have filled the folder
  const PreparedSweep prepared = prepare_sweep(sweep);
  run_cases(sweep, prepared, prepared.cases);
  return gate::read_recording(sweep.folder);
}

}  // namespace

GateResult measure(const GateCommand& command, const gate::Rules& rules) {
  const FolderLock lock(command.folder);
  GateResult result;
  gate::Verdict& verdict = result.verdict;
  verdict.head = command.head;
  verdict.base = command.against.empty() ? command.base : command.against;
  if (command.sweep.empty()) throw InputError("times cannot be measured yet", {}, "give a --sweep");
  result.head = record(command, command.head, "head");
  const bool is_first = command.update && !std::filesystem::exists(command.against);
  const gate::Recording base = is_first                  ? gate::Recording()
                               : command.against.empty() ? record(command, command.base, "base")
                                                         : gate::read_recording(command.against);
  verdict.figures = gate::compare_exact(base, result.head, rules);
  return result;
}

}  // namespace ccdt::tools
