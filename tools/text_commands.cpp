#include <CLI/CLI.hpp>
#include <memory>

#include "bench/run/json.h"
#include "bench/run/run_record.h"
#include "engine/io/files.h"
#include "engine/options/option_table.h"
#include "engine/version.h"
#include "tools/commands.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/program_text.h"
#include "tools/terminal.h"

// The verbs that print what the command line says of itself.

namespace ccdt::tools {
namespace {

void write_man_pages(const ProgramText& program, const std::filesystem::path& folder) {
  const std::vector<ManPage> pages = man_pages(program, std::string(engine_version));
  if (folder.empty()) {
    for (const ManPage& page : pages) print_data(page.text);
    return;
  }
  std::filesystem::create_directories(folder);
  for (const ManPage& page : pages) {
    io::OutputFile file(folder / page.file);
    file << page.text;
    file.commit();
  }
}

/// The schema of the member of a report that holds the value of this option.
bench::Json schema_of(const options::MeshOption& option) {
  bench::Json schema = bench::Json::object();
  if (const auto* choice = std::get_if<options::ChoiceKind>(&option.kind); choice == nullptr)
    schema["type"] = std::holds_alternative<options::FileKind>(option.kind) ? "string" : "number";
  else if (choice->names.front().name == "on")
    schema["type"] = "boolean";
  else
    for (const auto& name : choice->names) schema["enum"].push_back(name.name);
  if (const auto* count = std::get_if<options::CountKind>(&option.kind)) schema["minimum"] = count->least;
  if (!option.in_report.empty()) schema["description"] = option.in_report;
  return schema;
}

bench::Json schemas_of_options() {
  bench::Json schemas = bench::Json::object();
  for (const options::MeshOption& option : options::mesh_options())
    schemas[bench::option_key(option.name)] = schema_of(option);
  return schemas;
}

}  // namespace

void add_completion_command(CLI::App& app, ExitCode& exit_code) {
  auto shell = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("completion", "print the completion script of a shell");
  verb->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(one_of({std::begin(known_shells), std::end(known_shells)}));
  verb->footer(
      "Example: complete verbs, options and their values in this shell\n"
      "  source <(ccdt completion bash)\n"
      "Example: the same in zsh and in fish\n"
      "  source <(ccdt completion zsh)\n"
      "  ccdt completion fish | source\n");
  verb->callback([shell, &app, &exit_code] {
    print_data(completion_script(text_of(app), *shell));
    exit_code = done;
  });
}

void add_man_command(CLI::App& app, ExitCode& exit_code) {
  struct ManCommand {
    std::string folder;
    bool markdown = false, schema = false;
  };
  auto command = std::make_shared<ManCommand>();
  CLI::App* verb = app.add_subcommand("man", "write the man pages");
  auto* folder =
      verb->add_option("-o,--output", command->folder, "folder of the pages, created if needed; default: print them");
  verb->add_flag("--markdown", command->markdown, "print all verbs and options as one page of Markdown")
      ->excludes(folder);
  verb->add_flag("--option-schema", command->schema,
                 "print the members of reports that have the options of `ccdt mesh`")
      ->excludes(folder);
  verb->footer(
      "Example: read the page of a verb\n"
      "  ccdt man -o man && man ./man/ccdt-mesh.1\n");
  verb->callback([command, &app, &exit_code] {
    with_stage_of_limits(command->folder, "write", [&] {
      const ProgramText program = text_of(app);
      if (command->schema)
        print_data(schemas_of_options().dump() + "\n");
      else if (command->markdown)
        print_data(markdown_reference(program));
      else
        write_man_pages(program, command->folder);
    });
    exit_code = done;
  });
}

void add_help_command(CLI::App& app, ExitCode& exit_code) {
  auto name = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("help", "print the help of a verb");
  std::vector<std::string> names;
  for (const CLI::App* other : app.get_subcommands({})) names.push_back(other->get_name());
  verb->add_option("VERB", *name, "verb; default: the list of all verbs")->check(one_of(names));
  verb->footer("Example: `ccdt help mesh` prints the same as `ccdt mesh --help`\n");
  verb->callback([name, &app, &exit_code] {
    const CLI::App* const helped = name->empty() ? &app : app.get_subcommand(*name);
    const std::string program = name->empty() ? "" : app.get_name() + " ";
    print_help(app.get_formatter()->make_help(helped, program + helped->get_name(), CLI::AppFormatMode::Normal));
    exit_code = done;
  });
}

void add_version_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* verb = app.add_subcommand("version", "print the version");
  verb->footer("Example: `ccdt version` prints the same as `ccdt --version`\n");
  verb->callback([&app, &exit_code] {
    print(app.version() + "\n");
    exit_code = done;
  });
}

}  // namespace ccdt::tools
