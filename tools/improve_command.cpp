#include <memory>
#include <string>
#include <utility>

#include "bench/run/numbers.h"
#include "bench/run/quality.h"
#include "engine/improver.h"
#include "engine/io/files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/options/option_table.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/progress_bar.h"
#include "tools/streams.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct ImproveCommand {
  std::string mesh, input_format, output, format;
  MeshOptions options;
};

std::string words_of(const bench::Quality& quality, std::size_t tetrahedra) {
  return bench::with_separators(tetrahedra) + " tetrahedra, dihedral angles " +
         bench::rounded(quality.dihedral_degrees.min) + " to " + bench::rounded(quality.dihedral_degrees.max) +
         " degrees, r: mean " + bench::rounded(quality.r.mean) + ", worst " + bench::rounded(quality.r.max);
}

void run(const ImproveCommand& command) {
  give_standard_output({command.output});
  check_mesh_stream(command.output, command.format);
  io::check_tet_mesh_output(command.output, command.format, 1);
  check_can_be_written(command.output);
  check_are_different(command.mesh, command.output);
  with_progress(name_of_input(command.mesh), command.options.threads, [&](const Progress& progress) {
    TetMesh mesh = read_tet_mesh(command.mesh, command.input_format);
    const std::string before = words_of(bench::measure_quality(mesh), mesh.tetrahedra.size());
    ImprovedMesh improved = with_file_in_errors(name_of_input(command.mesh), [&] {
      return improve_tet_mesh(std::move(mesh), command.options.improve, command.options.threads, progress);
    });
    report(progress, "write", 0, 0);
    write_output(command.output, command.format,
                 [&](const std::filesystem::path& file) { io::write_tet_mesh(improved.mesh, file, command.format); });
    print("before      " + before + "\n" + reports::improvement_line(improved.counts));
    print(name_of_output(command.output), Tone::good);
    print(": " + words_of(bench::measure_quality(improved.mesh), improved.mesh.tetrahedra.size()) + "\n");
  });
}

}  // namespace

void add_improve_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ImproveCommand>();
  CLI::App* verb = app.add_subcommand("improve", "improve any tetrahedral mesh; its boundary and regions stay");
  verb->add_option("MESH", command->mesh, "mesh to improve: .vtu .msh .msh4 .mesh .meshb .node; - is standard input")
      ->required();
  add_input_format(*verb, "--input-format", command->input_format, io::tet_mesh_formats());
  verb->add_option("-o,--output", command->output,
                   "improved mesh: any format that `ccdt mesh` writes; - is standard output, with --format")
      ->required();
  verb->add_option("--format", command->format, "format of the mesh, if not that of its extension")
      ->check(CLI::IsMember(io::tet_mesh_formats()));
  for (const char* name : {"improve", "objective", "target-dihedral", "target-r", "improve-time", "threads"})
    add_mesh_option(*verb, *options::find_mesh_option(name), command->options);
  verb->footer(
      "Faces and edges that the mesh lists, its boundary, and faces between regions stay, with their vertices. Other "
      "vertices may move or go.\n\n"
      "Example: improve the mesh of another mesher until all dihedral angles are between 25 and 155 degrees\n"
      "  ccdt improve tetgen.mesh -o better.vtu --target-dihedral 25\n");
  verb->callback([command, &exit_code] {
    with_stage_of_limits(command->mesh, "improve", [&] { run(*command); });
    exit_code = done;
  });
}

}  // namespace ccdt::tools
