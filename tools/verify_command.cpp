#include <exception>
#include <memory>
#include <utility>

#include "bench/verify/verify.h"
#include "engine/base/parallel.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/plc/warped_facets.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/freed_memory.h"
#include "tools/limit_errors.h"
#include "tools/markers.h"
#include "tools/options.h"
#include "tools/progress_bar.h"
#include "tools/streams.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct VerifyCommand {
  std::string input, input_format, mesh, mesh_format, report;
  bool details = false;
  verify::VerifyOptions options;
  MarkerOptions markers;
  unsigned threads = 0;
};

bool run(const VerifyCommand& command) {
  keep_freed_memory();
  give_standard_output({command.report});
  if (!command.report.empty()) {
    check_can_be_written(command.report);
    check_are_different(command.input, command.report);
    check_are_different(command.mesh, command.report);
  }
  const verify::Verification verification =
      with_progress(name_of_input(command.mesh), command.threads, [&](const Progress& progress) {
        InputPlc input;
        TetMesh mesh;
        const auto read_input = [&] {
          input = read_plc(command.input, command.input_format);
          mark(input, command.markers, command.options.flatness);
          if (auto triangulated = plc::triangulate_warped_facets(input)) input = std::move(*triangulated);
        };
        std::exception_ptr bad_mesh;  // kept, because errors of the input are reported first
        const auto read_mesh = [&] {
          try {
            mesh = read_tet_mesh(command.mesh, command.mesh_format);
          } catch (...) {
            bad_mesh = std::current_exception();
          }
        };
        // The mesh is read on the caller's thread, which can reuse the memory that reading takes.
        parallel_both(read_mesh, read_input);
        if (bad_mesh) std::rethrow_exception(bad_mesh);
        return verify::verify(input, mesh, command.options, progress);
      });
  const std::string text = command.details ? reports::to_terminal(verification) : reports::summarize(verification);
  print(text + name_of_input(command.mesh) + ": ");
  verification.ok() ? print("right", Tone::good) : print("WRONG", Tone::bad);
  print("\n");
  if (!command.report.empty())
    write_text(command.report,
               reports::to_json(verification, name_of_input(command.input), name_of_input(command.mesh)));
  return verification.ok();
}

}  // namespace

void add_verify_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<VerifyCommand>();
  CLI::App* verb =
      app.add_subcommand("verify", "check exactly that a mesh, made by any mesher, is right for its input");
  verb->add_option("INPUT", command->input, "surface or PLC that was meshed; - is standard input")->required();
  add_input_format(*verb, "--input-format", command->input_format, io::plc_format_names());
  verb->add_option("MESH", command->mesh, "mesh to check: .vtu .msh .msh4 .mesh .meshb .node; - is standard input")
      ->required();
  add_input_format(*verb, "--mesh-format", command->mesh_format, io::tet_mesh_formats());
  verb->add_option(
          "--flatness", command->options.flatness,
          "tolerance for flat facets and equal positions, as a fraction of the bounding box; the default is larger "
          "for coordinates rounded to single precision")
      ->check(non_negative_number())
      ->capture_default_str();
  add_markers(*verb, command->markers);
  add_choice(*verb, "--constrained-delaunay", command->options.delaunay,
             "whether the mesh must be constrained Delaunay");
  add_choice(*verb, "--surface", command->options.surface, "which surface the mesh must have");
  verb->add_option("--within", command->options.within,
                   "the mesh has its own surface, which is nowhere farther than this from that of the input, in its "
                   "units, and encloses the same parts")
      ->check(positive_number())
      ->excludes(verb->get_option("--surface"));
  add_choice(*verb, "--periodic", command->options.periodic,
             "axes along which opposite sides of the mesh must have the same faces");
  add_choice(*verb, "--boundary", command->options.boundary, "where the vertices of the input must be");
  add_choice(*verb, "--lists", command->options.lists, "what the mesh must list");
  add_threads(*verb, command->threads);
  verb->add_flag("--details", command->details, "list all checks, not only those that failed");
  add_report(*verb, "write all checks to this file as JSON (schema ccdt.verify/1)", command->report);
  verb->footer(
      "Exit codes: 0 the mesh is right; 1 it is wrong.\n\n"
      "Example: check that the mesh fills the part exactly\n"
      "  ccdt verify part.stl part.vtu\n"
      "Example: check a mesh that was improved with --boundary slide\n"
      "  ccdt verify --boundary slide part.stl part.vtu\n"
      "Example: check the mesh of a mesher that makes its own surface\n"
      "  ccdt verify --surface own part.stl part.vtu\n"
      "Example: check that the mesh of a remeshed surface is nowhere farther than 0.1 from the part\n"
      "  ccdt verify --within 0.1 part.stl part.vtu\n");
  verb->callback([command, &exit_code] {
    if (is_stream(command->input) && is_stream(command->mesh))
      throw CLI::ValidationError("-", "standard input is either INPUT or MESH");
    if (command->options.within) command->options.surface = verify::VerifyOptions::Surface::own;
    exit_code = with_stage_of_limits(command->mesh, "report", [&] { return run(*command); }) ? done : failed_a_check;
  });
}

}  // namespace ccdt::tools
