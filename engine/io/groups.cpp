#include "engine/io/groups.h"

#include <optional>
#include <set>

#include "engine/io/text_scanner.h"

namespace ccdt::io {

void Groups::enter(std::string_view name) {
  const auto [entry, is_new] = numbers_.try_emplace(std::string(name), static_cast<int>(names_.size()));
  if (is_new) names_.emplace_back(name);
  current_ = entry->second;
}

/// By the numbers that `current` gave.
std::vector<int> Groups::markers() const {
  std::set<int> used = {0};
  for (const std::string& name : names_)
    if (const auto marker = parse_whole<int>(name)) used.insert(*marker);
  std::vector<int> markers;
  int next = 0;
  for (const std::string& name : names_) {
    const auto marker = parse_whole<int>(name);
    while (!marker && used.contains(++next)) {
    }
    markers.push_back(marker ? *marker : next);
  }
  return markers;
}

void Groups::give_markers(plc::InputPlc& plc) const {
  const std::vector<int> markers = this->markers();
  std::set<int> there;
  const auto give = [&](int& group) {
    group = markers[static_cast<std::size_t>(group)];
    there.insert(group);
  };
  for (int& group : plc.triangle_markers) give(group);
  for (plc::PolygonFacet& facet : plc.polygon_facets) give(facet.marker);
  for (std::size_t i = 1; i < names_.size(); ++i)
    if (there.contains(markers[i]) && !parse_whole<int>(names_[i])) plc.marker_names[markers[i]] = names_[i];
}

}  // namespace ccdt::io
