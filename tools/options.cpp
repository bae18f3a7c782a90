#include "tools/options.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>

#include "baselines/mesher.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"
#include "tools/streams.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

/// \return  the message for CLI11 if the text is not such a number; empty if it is
std::string complaint(const std::string& text, double least, bool least_itself) {
  double value = 0;
  const std::string kind = least_itself ? "a number of at least 0" : "a number greater than 0";
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value)) return text + " is not " + kind;
  return value > least || (least_itself && value == least) ? "" : text + " is not " + kind;
}

constexpr const char* choices_prefix = "one of:";

/// The choices are stored in the name of the validator. Anywhere else, --help would print them.
std::string validator_name(const std::vector<std::string>& choices) {
  std::string name = choices_prefix;
  for (const std::string& choice : choices) name += " " + choice;
  return name;
}

CLI::Validator within_bounds_of(const options::NumberKind& number) {
  if (std::isfinite(number.most)) return number_between(number.least, number.most);
  return number.excludes_least ? positive_number() : non_negative_number();
}

/// Adds an option of a kind.
struct OptionAdder {
  CLI::App& verb;
  const options::MeshOption& option;
  MeshOptions& options;
  std::string name = "--" + std::string(option.name), what = std::string(option.what);

  void operator()(const options::ChoiceKind& kind) const {
    add_choice(
        verb, name, kind.names, [set = kind.set, &options = options](const std::string& value) { set(options, value); },
        kind.get(options), what);
  }
  void operator()(const options::NumberKind& kind) const {
    CLI::Option* const added = verb.add_option(name, kind.member(options), what)->check(within_bounds_of(kind));
    if (!option.usual) added->capture_default_str();
  }
  void operator()(const options::CountKind& kind) const {
    verb.add_option(name, kind.member(options), what)->check(whole_number(kind.least, kind.most));
  }
  void operator()(const options::FileKind& kind) const { verb.add_option(name, kind.member(options), what); }
};

}  // namespace

CLI::Validator positive_number() {
  return CLI::Validator([](std::string& text) { return complaint(text, 0, false); }, "> 0");
}

CLI::Validator non_negative_number() {
  return CLI::Validator([](std::string& text) { return complaint(text, 0, true); }, ">= 0");
}

CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        double value = 0;
        const bool is_in = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return is_in ? "" : text + " is not a number from " + digits(least) + " to " + digits(most);
      },
      "from " + digits(least) + " to " + digits(most));
}

CLI::Validator whole_number(int least, int most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        int value = 0;
        const bool is_in = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return is_in ? ""
                     : text + " is not a whole number from " + std::to_string(least) + " to " + std::to_string(most);
      },
      "from " + std::to_string(least) + " to " + std::to_string(most));
}

CLI::Validator one_of(const std::vector<std::string>& names, bool ignore_case) {
  const CLI::Validator member = ignore_case ? CLI::IsMember(names, CLI::ignore_case) : CLI::IsMember(names);
  return CLI::Validator(
      [member, names](std::string& text) {
        return member(text).empty() ? "" : text + " is not one of " + CLI::detail::join(names, ", ");
      },
      "", validator_name(names));
}

std::vector<std::string> choices_of(CLI::Option& option) {
  for (int i = 0;; ++i) {
    std::string name;
    try {
      name = option.get_validator(i)->get_name();
    } catch (const CLI::OptionNotFound&) {  // that was the last one
      return {};
    }
    if (!name.starts_with(choices_prefix)) continue;
    std::istringstream words(name.substr(std::string_view(choices_prefix).size()));
    return {std::istream_iterator<std::string>(words), {}};
  }
}

CLI::Validator known_mesher() {
  std::vector<std::string> names;
  for (const baselines::Mesher& m : baselines::meshers()) names.push_back(m.name);
  return CLI::Validator(
      [names](std::string& text) {
        if (baselines::is_mesher_description(text)) return std::string();  // reading it reports its errors
        return one_of(names)(text);
      },
      "", validator_name(names));
}

void add_choice(CLI::App& verb, const std::string& option, const std::vector<options::ChoiceKind::Name>& names,
                const std::function<void(const std::string&)>& set, std::string_view standard, std::string what) {
  std::vector<std::string> words;
  for (const auto& [name, meaning] : names) {
    words.emplace_back(name);
    what += "\n  " + words.back() + ": " + std::string(meaning);
  }
  verb.add_option_function<std::string>(option, set, what)
      ->transform(one_of(words, true))
      ->default_str(std::string(standard));
}

void add_mesh_option(CLI::App& verb, const options::MeshOption& option, MeshOptions& options) {
  std::visit(OptionAdder{verb, option, options}, option.kind);
}

void add_threads(CLI::App& verb, unsigned& threads) {
  const options::MeshOption& option = *options::find_mesh_option("threads");
  const auto& bounds = std::get<options::CountKind>(option.kind);
  verb.add_option("--threads", threads, std::string(option.what))
      ->check(whole_number(bounds.least, bounds.most))
      ->default_str("all cores");
}

void add_quiet(CLI::App& verb) {
  verb.add_flag_callback(
      "-q,--quiet", [] { send_words(Words::on_failure); }, "print nothing unless something is wrong");
}

std::string list_line(std::string name, const std::string& what) {
  constexpr std::size_t width = 17;
  name.resize(std::max(width, name.size() + 1), ' ');
  return "  " + name + what + "\n";
}

void check_can_be_written(const std::filesystem::path& file) {
  if (is_stream(file)) return;
  io::check_is_no_folder(file);
  check_folder_can_be_written(file);
}

void check_folder_can_be_written(const std::filesystem::path& file) {
  if (is_stream(file)) return;
  std::error_code ignored;
  const auto place = file.has_filename() ? file : file.parent_path();  // without the slash of a folder
  const auto folder = place.has_parent_path() ? place.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored))
    throw OutputError("there is no folder " + folder.string(), io::place_in(file.string()), "create it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError("the folder " + folder.string() + " cannot be written to", io::place_in(file.string()),
                      "choose another");
}

void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code error;
  if (is_stream(input) || is_stream(output)) return;
  if (std::filesystem::equivalent(input, output, error) && !error)
    throw OutputError("this would overwrite the input", io::place_in(output.string()), "give the output another name");
}

void add_report(CLI::App& verb, const std::string& what, std::string& report) {
  CLI::Option* const option = verb.add_option("--report", report, what + "; - is standard output");
  verb.add_flag_callback(
          "--json", [&report] { report = "-"; }, "write the report to standard output, and nothing else there")
      ->excludes(option);
}

}  // namespace ccdt::tools
