#include "reports/verification_report.h"

#include <nlohmann/json.hpp>

#include "bench/json.h"
#include "bench/results/numbers.h"
#include "reports/text_table.h"

namespace ccdt {
namespace {

std::string verdict(const Check& check) {
  if (check.failed == 0) return "ok";
  return check.required ? "FAILED" : "differs";
}

}  // namespace

std::string to_terminal(const Verification& verification) {
  std::size_t width = 0;
  for (const Check& check : verification.checks) width = std::max(width, check.name.size());
  std::string text;
  for (const Check& check : verification.checks) {
    const std::string word = verdict(check);
    text += word + std::string(9 - word.size(), ' ') + check.name + std::string(width + 2 - check.name.size(), ' ');
    text += check.failed == 0 ? with_separators(check.checked)
                              : with_separators(check.failed) + " of " + with_separators(check.checked);
    text += "\n";
    for (const std::string& example : check.examples) text += "           " + example + "\n";
  }
  return text + "volume   " + rounded(verification.mesh_volume, 12) + ", of the input " +
         rounded(verification.input_volume, 12) + "\n";
}

std::string to_json(const Verification& verification, const std::string& input, const std::string& mesh) {
  Json checks = Json::array();
  for (const Check& check : verification.checks)
    checks.push_back({{"name", check.name},
                      {"checked", check.checked},
                      {"failed", check.failed},
                      {"required", check.required},
                      {"examples", check.examples}});
  return to_text({{"schema", "ccdt.verify/1"},
                  {"input", input},
                  {"mesh", mesh},
                  {"ok", verification.ok()},
                  {"mesh_volume", verification.mesh_volume},
                  {"input_volume", verification.input_volume},
                  {"checks", checks}});
}

}  // namespace ccdt
