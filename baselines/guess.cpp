#include "baselines/guess.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace ccdt::baselines {
namespace {

/// The number of letters to change, add or remove to turn one word into the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string guess(std::string_view unknown, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& name) { return edit_distance(unknown, name); };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (nearest == known.end()) return "";
  const std::size_t edits = distance(*nearest), most = std::max<std::size_t>(2, unknown.size() / 3);
  return edits <= most && edits < nearest->size() ? "did you mean '" + *nearest + "'? " : "";
}

}  // namespace ccdt::baselines
