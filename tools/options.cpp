#include "tools/options.h"

#include <unistd.h>

#include <cmath>

#include "baselines/mesher.h"
#include "engine/io/files.h"

namespace ccdt::tools {
namespace {

/// \return  what CLI11 prints if the text is not such a number, else nothing
std::string complaint(const std::string& text, double least, bool least_itself) {
  double value = 0;
  const std::string kind = least_itself ? "a number from 0" : "a number greater than 0";
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value)) return text + " is not " + kind;
  return value > least || (least_itself && value == least) ? "" : text + " is not " + kind;
}

}  // namespace

CLI::Validator positive_number() {
  return CLI::Validator([](std::string& text) { return complaint(text, 0, false); }, "> 0");
}

CLI::Validator non_negative_number() {
  return CLI::Validator([](std::string& text) { return complaint(text, 0, true); }, ">= 0");
}

CLI::Validator known_mesher() {
  return CLI::Validator(
      [](std::string& text) {
        if (baselines::is_mesher_description(text)) return std::string();  // its errors are those of an input
        std::vector<std::string> names;
        for (const baselines::Mesher& m : baselines::meshers()) names.push_back(m.name);
        return CLI::IsMember(names)(text);
      },
      "");
}

std::string list_line(std::string name, const std::string& what) {
  constexpr std::size_t width = 17;
  name.resize(std::max(width, name.size() + 1), ' ');
  return "  " + name + what + "\n";
}

void check_can_be_written(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (std::filesystem::is_directory(file, ignored))
    throw OutputError("this is a folder", io::place_in(file.string()), "give the name of a file in it");
  if (!std::filesystem::is_directory(folder, ignored))
    throw OutputError("there is no folder " + folder.string(), io::place_in(file.string()), "make it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError("the folder " + folder.string() + " cannot be written to", io::place_in(file.string()),
                      "choose another");
}

void check_are_different(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code error;
  if (std::filesystem::equivalent(input, output, error) && !error)
    throw OutputError("this would overwrite the input", io::place_in(output.string()), "give the output another name");
}

}  // namespace ccdt::tools
