#include <CLI/CLI.hpp>
#include <memory>

#include "engine/io/files.h"
#include "engine/version.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/program_text.h"
#include "tools/terminal.h"

// The verbs that print what the command line says of itself.

namespace ccdt::tools {
namespace {

void write_man_pages(const ProgramText& program, const std::filesystem::path& folder) {
  const std::vector<ManPage> pages = man_pages(program, std::string(engine_version));
  if (folder.empty()) {
    for (const ManPage& page : pages) print(page.text);
    return;
  }
  std::filesystem::create_directories(folder);
  for (const ManPage& page : pages) {
    io::OutputFile file(folder / page.file);
    file << page.text;
    file.commit();
  }
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
    print(completion_script(text_of(app), *shell));
    exit_code = done;
  });
}

void add_man_command(CLI::App& app, ExitCode& exit_code) {
  struct ManCommand {
    std::string folder;
    bool markdown = false;
  };
  auto command = std::make_shared<ManCommand>();
  CLI::App* verb = app.add_subcommand("man", "write the man pages");
  auto* folder =
      verb->add_option("-o,--output", command->folder, "folder of the pages, created if needed; default: print them");
  verb->add_flag("--markdown", command->markdown, "print all verbs and options as one page of Markdown")
      ->excludes(folder);
  verb->footer(
      "Example: read the page of a verb\n"
      "  ccdt man -o man && man ./man/ccdt-mesh.1\n");
  verb->callback([command, &app, &exit_code] {
    const ProgramText program = text_of(app);
    if (command->markdown)
      print(markdown_reference(program));
    else
      write_man_pages(program, command->folder);
    exit_code = done;
  });
}

}  // namespace ccdt::tools
