#include "tools/program_text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <utility>

#include "tools/options.h"
#include "tools/wrapped_lines.h"

namespace ccdt::tools {
namespace {

OptionText text_of(CLI::Option& option) {
  OptionText text{.names = {},
                  .what = option.get_description(),
                  .standard = option.get_default_str(),
                  .choices = choices_of(option),
                  .is_positional = option.get_positional() && !option.nonpositional(),
                  .is_flag = option.get_items_expected_max() == 0,
                  .is_required = option.get_required()};
  if (text.is_positional) {
    text.names = {option.get_name(true)};
    return text;
  }
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  return text;
}

std::string usage_of(const std::string& name, const VerbText& verb) {
  std::string usage = name + " " + verb.name + " [OPTIONS]";
  for (const OptionText& option : verb.options) {
    if (!option.is_positional) continue;
    usage += option.is_required ? " " + option.names.front() : " [" + option.names.front() + "]";
  }
  return usage;
}

}  // namespace

ProgramText text_of(CLI::App& app) {
  constexpr int width = 78;  // of pages for `man`, which does not wrap examples
  ProgramText program{app.get_name(), app.get_description(), wrapped(app.get_footer(), width), {}};
  for (CLI::App* one : app.get_subcommands([](CLI::App*) { return true; })) {
    one->footer(std::function<std::string()>());  // the lists that depend on the build
    VerbText verb{one->get_name(), one->get_description(), "", wrapped(one->get_footer(), width), {}};
    for (CLI::Option* option : one->get_options([](CLI::Option*) { return true; }))
      verb.options.push_back(text_of(*option));
    std::ranges::stable_partition(verb.options, &OptionText::is_positional);
    verb.usage = usage_of(program.name, verb);
    program.verbs.push_back(std::move(verb));
  }
  return program;
}

}  // namespace ccdt::tools
