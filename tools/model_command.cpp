#include <memory>

#include "bench/run/numbers.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"
#include "tools/commands.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/streams.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct ModelCommand {
  std::string name;
  double edge_length = 0;
  std::string output, format;
};

std::string model_footer() {
  std::string text = "Solids:\n";
  for (const models::Solid& solid : models::solids())
    text += list_line(std::string(solid.name), std::string(solid.what));
  return text +
         "\nExample: write a stepping pole with edges of about 2 mm\n"
         "  ccdt model stepping-pole --edge-length 2 -o pole.poly\n";
}

void run(const ModelCommand& command) {
  give_standard_output({command.output});
  check_surface_stream(command.output, command.format);
  check_can_be_written(command.output);
  with_stage_of_limits(command.output, "model", [&] {
    const plc::InputPlc plc = models::make_solid(command.name, command.edge_length);
    write_output(command.output, command.format, [&](const std::filesystem::path& file) { io::write_plc(plc, file); });
    print(name_of_output(command.output) + ": " + bench::with_separators(plc.vertices.size()) + " vertices, " +
          bench::with_separators(plc.facet_count()) + " facets\n");
  });
}

}  // namespace

void add_model_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ModelCommand>();
  CLI::App* verb =
      app.add_subcommand("model", "write one of our models of the paper's parts, or a primitive, at a given density");
  std::vector<std::string> names;
  for (const models::Solid& solid : models::solids()) names.emplace_back(solid.name);
  verb->add_option("NAME", command->name, "solid (listed below)")->required()->check(one_of(names));
  verb->add_option("--edge-length", command->edge_length,
                   "edge length of the triangles, in units of the solid; default: that of the solid")
      ->check(positive_number());
  verb->add_option("-o,--output", command->output,
                   "surface or PLC: .stl .off .obj .ply .poly .smesh .mesh .meshb; - is standard output, with --format")
      ->required();
  add_surface_format(*verb, command->format);
  verb->footer(model_footer());
  verb->callback([command, &exit_code] {
    run(*command);
    exit_code = done;
  });
}

}  // namespace ccdt::tools
