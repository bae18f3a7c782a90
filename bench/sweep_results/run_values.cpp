#include "bench/sweep_results/run_values.h"

#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::sweep_results {
namespace {

constexpr std::string_view path_of_command = "command";
constexpr std::string_view path_of_settings = "options/mesher_settings/";
constexpr std::string_view schema = "ccdt.run/1";

/// The column of each path.
const std::unordered_map<std::string_view, std::size_t>& columns_by_path() {
  static const auto columns = [] {
    std::unordered_map<std::string_view, std::size_t> made;
    for (std::size_t i = 0; i < run_columns.size(); ++i) made.emplace(run_columns[i].path, i);
    return made;
  }();
  return columns;
}

/// Takes the wanted values from the events of a parser, without building a document.
class RunReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  RunValues run;
  bool is_record = false;

  bool null() override { return true; }
  bool boolean(bool value) override { return take(std::string(value ? "yes" : "no")); }
  bool number_integer(number_integer_t value) override { return take(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return take(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return take(value); }
  bool binary(binary_t&) override { return true; }

  bool string(string_t& value) override {
    if (arrays_ > 0) {
      if (path_ == path_of_command) run.command.push_back(std::move(value));
      return true;
    }
    if (path_ == "schema") is_record = value == schema;
    if (path_.starts_with(path_of_settings)) run.settings.emplace_back(path_.substr(path_of_settings.size()), value);
    return take(std::move(value));
  }

  bool key(string_t& name) override {
    if (arrays_ > 0) return true;
    path_.resize(lengths_.back());
    if (!path_.empty()) path_ += '/';
    path_ += name;
    return true;
  }
  bool start_object(std::size_t) override {
    if (arrays_ == 0) lengths_.push_back(path_.size());
    return true;
  }
  bool end_object() override {
    if (arrays_ > 0) return true;
    path_.resize(lengths_.back());
    lengths_.pop_back();
    return true;
  }
  bool start_array(std::size_t) override {
    ++arrays_;
    return true;
  }
  bool end_array() override {
    --arrays_;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

 private:
  bool take(results::Cell value) {
    if (arrays_ > 0) return true;
    const auto found = columns_by_path().find(path_);
    if (found != columns_by_path().end()) run.cells[found->second] = std::move(value);
    return true;
  }

  std::string path_;                  ///< of the value that comes next
  std::vector<std::size_t> lengths_;  ///< lengths of the paths of open objects
  int arrays_ = 0;                    ///< that are open: histograms, and the command
};

}  // namespace

std::optional<double> number_of(const RunValues& run, RunField field) {
  const auto* number = std::get_if<double>(&run.cells[field.index]);
  return number == nullptr ? std::nullopt : std::optional(*number);
}

std::string_view text_of(const RunValues& run, RunField field) {
  const auto* text = std::get_if<std::string>(&run.cells[field.index]);
  return text == nullptr ? std::string_view() : *text;
}

std::optional<RunValues> read_run_values(const std::filesystem::path& file) {
  RunReader reader;
  try {
    const std::string text = io::read_whole_file(file).bytes;
    if (!nlohmann::json::sax_parse(text, &reader) || !reader.is_record) return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  return std::move(reader.run);
}

}  // namespace ccdt::sweep_results
