#include <sstream>

#include "tools/program_text.h"

namespace ccdt::tools {
namespace {

/// A text escaped for roff, so that no character acts as a command.
std::string roff(const std::string& text) {
  std::string safe;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
    begins_line = c == '\n';
  }
  return safe;
}

std::string verbatim(const std::string& text) {
  return text.empty() ? "" : ".nf\n" + roff(text) + (text.back() == '\n' ? "" : "\n") + ".fi\n";
}

std::string in_upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string head(const std::string& page, const std::string& version, const std::string& what,
                 const std::string& usage) {
  return ".TH \"" + in_upper_case(roff(page)) + "\" 1 \"\" \"ccdt " + roff(version) +
         "\" \"User Commands\"\n.SH NAME\n" + roff(page) + " \\- " + roff(what) + "\n.SH SYNOPSIS\n.B " + roff(usage) +
         "\n";
}

std::string names_of(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// The names, followed by a placeholder for the value unless it is a flag.
std::string label_of(const OptionText& option) {
  return names_of(option) + (option.is_positional || option.is_flag ? "" : " VALUE");
}

/// Lines of a text, as paragraphs of their own in roff.
std::string roff_lines(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) all += (all.empty() ? "" : ".br\n") + roff(line) + "\n";
  return all;
}

std::string verb_page(const std::string& page, const VerbText& verb, const std::string& version) {
  std::string text = head(page, version, verb.what, verb.usage) + ".SH OPTIONS\n";
  for (const OptionText& option : verb.options) {
    text += ".TP\n.B " + roff(label_of(option)) + "\n" + roff_lines(option.what);
    if (!option.standard.empty()) text += ".br\nDefault: " + roff(option.standard) + "\n";
  }
  return text + ".SH NOTES\n" + verbatim(verb.footer) + ".SH SEE ALSO\n.BR ccdt (1)\n";
}

/// A text within a cell of a table in Markdown.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text)
    if (c == '\n')
      safe += "<br>";
    else if (c == '<' || c == '>')
      safe += c == '<' ? "&lt;" : "&gt;";
    else
      safe += (c == '|' ? "\\" : "") + std::string(1, c);
  return safe;
}

std::string verb_section(const std::string& program, const VerbText& verb) {
  std::string text = "\n## " + program + " " + verb.name + "\n\n" + verb.what + "\n\n```text\n" + verb.usage +
                     "\n```\n\n| argument or option | default | meaning |\n|---|---|---|\n";
  for (const OptionText& option : verb.options)
    text += "| `" + names_of(option) + "` | " + cell(option.standard) + " | " + cell(option.what) +
            (option.is_required ? " (required)" : "") + " |\n";
  if (verb.footer.empty()) return text;
  return text + "\n```text\n" + verb.footer + (verb.footer.back() == '\n' ? "" : "\n") + "```\n";
}

}  // namespace

std::vector<ManPage> man_pages(const ProgramText& program, const std::string& version) {
  std::string text = head(program.name, version, program.what, program.name + " VERB [OPTIONS]") + ".SH VERBS\n";
  std::vector<ManPage> pages(1);
  for (const VerbText& verb : program.verbs) {
    const std::string page = program.name + "-" + verb.name;
    text += ".TP\n.BR " + roff(page) + " (1)\n" + roff(verb.what) + "\n";
    pages.push_back({page + ".1", verb_page(page, verb, version)});
  }
  pages[0] = {program.name + ".1", text + ".SH NOTES\n" + verbatim(program.footer)};
  return pages;
}

std::string markdown_reference(const ProgramText& program) {
  std::string text = "# Verbs and options\n\n<!-- made by tools/make-reference: do not edit -->\n\n" + program.what +
                     "\n\n```text\n" + program.footer + "```\n";
  for (const VerbText& verb : program.verbs) text += verb_section(program.name, verb);
  return text;
}

}  // namespace ccdt::tools
