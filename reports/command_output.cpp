#include "reports/command_output.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/json.h"
#include "bench/results/numbers.h"

namespace ccdt::reports {
namespace {

std::string stages(const StageSeconds& s) {
  const std::array<std::pair<const char*, double>, 10> all = {{{"plc", s.plc},
                                                               {"protect", s.protect},
                                                               {"facets", s.facets},
                                                               {"lattice", s.lattice},
                                                               {"delaunay", s.delaunay},
                                                               {"face check", s.face_check},
                                                               {"front", s.front},
                                                               {"label", s.label},
                                                               {"finish", s.finish},
                                                               {"improve", s.improve}}};
  std::string text;
  for (const auto& [name, seconds] : all)
    if (seconds > 0) text += (text.empty() ? "" : ", ") + (name + (" " + results::rounded(seconds)));
  return text.empty() ? "" : " (" + text + ")";
}

/// Nothing if no edge was in danger.
std::string protection(const MeshCounts& c) {
  std::string text;
  for (const std::uint64_t splits : c.splits_by_level)
    text += (text.empty() ? "splits by level " : ", ") + results::with_separators(splits);
  if (c.dropped_interior_vertices > 0)
    text += (text.empty() ? "" : "; ") + results::with_separators(c.dropped_interior_vertices) +
            " interior dropped for the sake of edges";
  return text.empty() ? "" : "protection  " + text + "\n";
}

std::string measure_words(const bench::Quality::Measure& m) {
  return "mean " + results::rounded(m.mean) + ", 99% below " + results::rounded(m.p99) + ", worst " +
         results::rounded(m.max);
}

std::string quality_lines(const bench::Quality& q) {
  return "quality     r: " + measure_words(q.r) + "; dihedral angles " + results::rounded(q.dihedral_degrees.min) +
         " to " + results::rounded(q.dihedral_degrees.max) +
         " degrees\n            aspect ratio: " + measure_words(q.aspect_ratio) +
         "\n            radius-edge ratio: " + measure_words(q.radius_edge_ratio) + "\n";
}

/// Nothing if none was asked for.
std::string improvement(const ImproveCounts& c) {
  if (c.stop == ImproveStop::none) return "";
  std::string text = "improvement " + results::with_separators(c.bad_cells) +
                     " tetrahedra to improve: " + results::with_separators(c.removed_edges) + " edges and " +
                     results::with_separators(c.removed_faces) + " faces removed, " +
                     results::with_separators(c.moved_vertices) + " vertices moved, " +
                     results::with_separators(c.inserted_vertices) + " inserted, " +
                     results::with_separators(c.collapsed_edges) + " collapsed; ";
  if (c.stop == ImproveStop::target) return text + "all reach the target\n";
  return text + results::with_separators(c.bad_cells_left) + " are left, " +
         (c.stop == ImproveStop::time ? "the time was up" : "which nothing makes better") + "\n";
}

std::string check_word(const verify::Check& check) {
  if (check.failed == 0) return "ok";
  return check.required ? "FAILED" : "differs";
}

}  // namespace

std::string summarize(const bench::RunRecord& r) {
  const MeshCounts& c = r.counts;
  std::string text = "vertices    " + results::with_separators(c.vertices) + " (" +
                     results::with_separators(c.steiner_vertices) + " Steiner, " +
                     results::with_separators(c.interior_vertices) + " interior)\n";
  text += protection(c);
  text += "tetrahedra  " + results::with_separators(c.tetrahedra) + ", volume " +
          results::rounded(r.quality.volume, 6) + "\n";
  text += "seconds     " + results::rounded(r.seconds.mesh) + stages(r.seconds) + ", peak memory " +
          results::mebibytes(r.peak_rss_bytes) + "\n";
  text += quality_lines(r.quality);
  text += improvement(c.improve);
  for (const std::string& note : r.notes) text += "note        " + note + "\n";
  return text;
}

std::string to_terminal(const verify::Verification& verification) {
  std::size_t width = 0;
  for (const verify::Check& check : verification.checks) width = std::max(width, check.name.size());
  std::string text;
  for (const verify::Check& check : verification.checks) {
    const std::string word = check_word(check);
    text += word + std::string(9 - word.size(), ' ') + check.name + std::string(width + 2 - check.name.size(), ' ');
    text += check.failed == 0
                ? results::with_separators(check.checked)
                : results::with_separators(check.failed) + " of " + results::with_separators(check.checked);
    text += "\n";
    for (const std::string& example : check.examples) text += "           " + example + "\n";
  }
  return text + "volume   " + results::rounded(verification.mesh_volume, 12) + ", of the input " +
         results::rounded(verification.input_volume, 12) + "\n";
}

std::string to_json(const verify::Verification& verification, const std::string& input, const std::string& mesh) {
  bench::Json checks = bench::Json::array();
  for (const verify::Check& check : verification.checks)
    checks.push_back({{"name", check.name},
                      {"checked", check.checked},
                      {"failed", check.failed},
                      {"required", check.required},
                      {"examples", check.examples}});
  return bench::to_text({{"schema", "ccdt.verify/1"},
                         {"input", input},
                         {"mesh", mesh},
                         {"ok", verification.ok()},
                         {"mesh_volume", verification.mesh_volume},
                         {"input_volume", verification.input_volume},
                         {"checks", checks}});
}

}  // namespace ccdt::reports
