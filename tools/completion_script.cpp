#include <utility>

#include "tools/program_text.h"

namespace ccdt::tools {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// The first line of a description.
std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// A text between single quotes.
/// \param quote  what stands for a single quote within them: by default as in bash and zsh
std::string shell_quoted(const std::string& text, const char* quote = "'\\''") {
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string(quote) : std::string(1, c);
  return "'" + safe + "'";
}

std::vector<std::string> names_of_verbs(const ProgramText& program) {
  std::vector<std::string> names;
  for (const VerbText& verb : program.verbs) names.push_back(verb.name);
  return names;
}

/// The names of all options of a verb, and the values of its positional arguments.
std::pair<std::vector<std::string>, std::vector<std::string>> words_of(const VerbText& verb) {
  std::vector<std::string> options, values;
  for (const OptionText& option : verb.options) {
    std::vector<std::string>& words = option.is_positional ? values : options;
    const std::vector<std::string>& more = option.is_positional ? option.choices : option.names;
    words.insert(words.end(), more.begin(), more.end());
  }
  return {options, values};
}

// For any other word, the shell completes names of files.
std::string bash_script(const ProgramText& program) {
  std::string values, options, arguments;
  for (const VerbText& verb : program.verbs) {
    for (const OptionText& option : verb.options)
      if (!option.is_positional && !option.choices.empty())
        for (const std::string& name : option.names)
          values += "    " + shell_quoted(verb.name + " " + name) + ") words=" + shell_quoted(joined(option.choices)) +
                    " ;;\n";
    const auto [names, choices] = words_of(verb);
    options += "    " + verb.name + ") words=" + shell_quoted(joined(names)) + " ;;\n";
    arguments += "    " + verb.name + ") words=" + shell_quoted(joined(choices)) + " ;;\n";
  }
  const std::string& name = program.name;
  return "# Completion of " + name + " for bash, as `" + name + " completion bash` prints it.\n_" + name +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} words=\n"
         "  COMPREPLY=()\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    words=" +
         shell_quoted(joined(names_of_verbs(program)) + " --help --version") +
         "\n"
         "  else\n"
         "    case \"$verb $before\" in\n" +
         values +
         "    esac\n"
         "    [[ -n $words || $current != -* ]] || case $verb in\n" +
         options +
         "    esac\n"
         "    [[ -n $words || $current == -* || $before == -* ]] || case $verb in\n" +
         arguments +
         "    esac\n"
         "  fi\n"
         "  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _" +
         name + " " + name + "\n";
}

/// A text of an argument of zsh's `_arguments`, where brackets and colons mean something.
std::string for_zsh(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += std::string(c == '[' || c == ']' || c == ':' || c == '\\' ? "\\" : "") + c;
  return safe;
}

std::string zsh_values(const OptionText& option) {
  return option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")";
}

std::string zsh_option(const OptionText& option) {
  const std::string what = for_zsh(first_line(option.what));
  if (option.is_positional)
    return "      " + shell_quoted("*:" + for_zsh(option.names.front()) + ":" + zsh_values(option));
  std::string lines;
  for (const std::string& name : option.names) {
    std::string line = name;
    line.append("[").append(what).append("]");
    if (!option.is_flag) line += ":value:" + zsh_values(option);
    lines += (lines.empty() ? "      " : " \\\n      ") + shell_quoted(line);
  }
  return lines;
}

std::string zsh_script(const ProgramText& program) {
  const std::string& name = program.name;
  std::string verbs, cases;
  for (const VerbText& verb : program.verbs) {
    verbs += "    " + shell_quoted(for_zsh(verb.name) + ":" + verb.what) + "\n";
    cases += "    " + verb.name + ") _arguments";
    bool has_positional = false;
    for (const OptionText& option : verb.options) {
      if (option.is_positional && has_positional) continue;  // one rule completes all of them
      has_positional = has_positional || option.is_positional;
      cases += " \\\n" + zsh_option(option);
    }
    cases += " ;;\n";
  }
  return "#compdef " + name + "\n# Completion of " + name + " for zsh, as `" + name + " completion zsh` prints it.\n_" +
         name + "() {\n  local -a verbs=(\n" + verbs +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe verb verbs\n"
         "    return\n"
         "  fi\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $words[1] in\n" +
         cases +
         "  esac\n}\n# In a folder of $fpath, this file is the function; a shell that sources it has to be told.\n" +
         "if [[ $funcstack[1] == _" + name + " ]]; then\n  _" + name + " \"$@\"\nelse\n" +
         "  (($+functions[compdef])) || { autoload -Uz compinit && compinit }\n  compdef _" + name + " " + name +
         "\nfi\n";
}

std::string fish_script(const ProgramText& program) {
  const std::string start = "complete -c " + program.name + " -n ";
  std::string text =
      "# Completion of " + program.name + " for fish, as `" + program.name + " completion fish` prints it.\n";
  for (const VerbText& verb : program.verbs)
    text += start + "__fish_use_subcommand -f -a " + verb.name + " -d " + shell_quoted(verb.what, "\\'") + "\n";
  for (const VerbText& verb : program.verbs) {
    const std::string within = start + shell_quoted("__fish_seen_subcommand_from " + verb.name, "\\'");
    for (const OptionText& option : verb.options) {
      if (option.is_positional) {
        if (!option.choices.empty()) text += within + " -f -a " + shell_quoted(joined(option.choices), "\\'") + "\n";
        continue;
      }
      text += within;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.is_flag)
        text += option.choices.empty() ? " -r" : " -x -a " + shell_quoted(joined(option.choices), "\\'");
      text += " -d " + shell_quoted(first_line(option.what), "\\'") + "\n";
    }
  }
  return text;
}

}  // namespace

std::string completion_script(const ProgramText& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  return shell == "zsh" ? zsh_script(program) : fish_script(program);
}

}  // namespace ccdt::tools
