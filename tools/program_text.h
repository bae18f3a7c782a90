#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ccdt::tools {

/// An option or a positional argument as --help shows it.
struct OptionText {
  std::vector<std::string> names;         ///< "-o" and "--output"; a positional argument has only its name, "INPUT"
  std::string what;                       ///< one sentence; if the values are names, a line for each follows
  std::string standard = {};              ///< the default; empty: none
  std::vector<std::string> choices = {};  ///< the values; empty: numbers, names of files and others
  bool is_positional = false, is_flag = false, is_required = false;
};

/// A verb with its options.
struct VerbText {
  std::string name, what, usage;
  std::string footer;  ///< lists and examples, except those that depend on the build
  std::vector<OptionText> options;
};

/// The program as its command line describes it. Completions, man pages and the reference are all made from this.
struct ProgramText {
  std::string name, what, footer;
  std::vector<VerbText> verbs;
};

/// \param app  loses the parts of its help that depend on the build
ProgramText text_of(CLI::App& app);

/// The shells with completion.
inline constexpr const char* known_shells[] = {"bash", "zsh", "fish"};

/// The script that completes verbs, options, and values that are names.
/// \param shell  one of `known_shells`
std::string completion_script(const ProgramText& program, const std::string& shell);

/// A page for `man`.
struct ManPage {
  std::string file;  ///< "ccdt-mesh.1"
  std::string text;  ///< in roff
};

/// A page for the program and one for each verb.
std::vector<ManPage> man_pages(const ProgramText& program, const std::string& version);

/// All verbs and options as one page of Markdown.
std::string markdown_reference(const ProgramText& program);

}  // namespace ccdt::tools
