#include <cstdio>
#include <memory>

#include "bench/verify/verify.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/bent_facets.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/progress_bar.h"

namespace ccdt::tools {
namespace {

struct VerifyCommand {
  std::string input, mesh, report;
  verify::VerifyOptions options;
};

bool run(const VerifyCommand& command) {
  if (!command.report.empty()) {
    check_can_be_written(command.report);
    check_are_different(command.input, command.report);
    check_are_different(command.mesh, command.report);
  }
  verify::Verification verification;
  {
    ProgressBar bar;
    const InputPlc given = io::read_plc(command.input);
    const InputPlc input = plc::triangulate_bent_facets(given).value_or(given);
    const TetMesh mesh = io::read_tet_mesh(command.mesh);
    verification = verify::verify(input, mesh, command.options, bar.progress());
  }
  std::fputs(reports::to_terminal(verification).c_str(), stdout);
  std::printf("%s: %s\n", command.mesh.c_str(), verification.ok() ? "right" : "WRONG");
  if (!command.report.empty()) {
    io::OutputFile report(command.report);
    report << reports::to_json(verification, command.input, command.mesh);
    report.commit();
  }
  return verification.ok();
}

}  // namespace

void add_verify_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<VerifyCommand>();
  CLI::App* verb = app.add_subcommand("verify", "check a mesh of any mesher exactly against its input");
  verb->add_option("INPUT", command->input, "the surface or PLC that was meshed")->required();
  verb->add_option("MESH", command->mesh, "the mesh: .vtu .msh .mesh .node")->required();
  verb->add_option("--flatness", command->options.flatness,
                   "what counts as flat and as the same place; fraction of the bounding box")
      ->check(non_negative_number())
      ->capture_default_str();
  add_choice(*verb, "--constrained-delaunay", command->options.delaunay, "must the mesh be constrained Delaunay?");
  add_choice(*verb, "--surface", command->options.surface, "whose surface the mesh must have");
  add_choice(*verb, "--boundary", command->options.boundary, "where the vertices of the input have to be");
  verb->add_option("--report", command->report, "write the checks there as JSON (schema ccdt.verify/1)");
  verb->footer(
      "Exit code 0: the mesh is right; 1: it is not.\n\n"
      "Example: does the mesh fill exactly the part?\n"
      "  ccdt verify part.stl part.vtu\n"
      "Example: the same of a mesh that was improved with --boundary slide\n"
      "  ccdt verify --boundary slide part.stl part.vtu\n"
      "Example: is this a mesh at all, by a mesher that makes a surface of its own?\n"
      "  ccdt verify --surface own part.stl part.vtu\n");
  verb->callback([command, &exit_code] { exit_code = run(*command) ? done : failed_a_check; });
}

}  // namespace ccdt::tools
