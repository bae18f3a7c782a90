#include "reports/mesher_quality_report.h"

#include <map>

#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/quality_tables.h"

namespace ccdt {
namespace {

std::string verdict_words(const Verdict& v) {
  if (v.best_variant.empty()) return rounded(v.ours, 4) + ", nothing to compare with";
  return std::string(v.is_better() ? "yes" : "NO") + ": " + rounded(v.ours, 4) + ", " + v.best_variant + " " +
         rounded(v.best, 4);
}

TextTable verdicts(const MesherQuality& quality) {
  TextTable cells = {{"better than all others?", "ours"}};
  for (const Criterion criterion : judged_criteria) cells.front().emplace_back(name_of(criterion));
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows) {
      if (!is_ours(row) || !row.ok()) continue;
      cells.push_back({title_of(c), row.variant});
      for (const Verdict& verdict : judge(c, row)) cells.back().push_back(verdict_words(verdict));
    }
  return cells;
}

/// In how many cases a variant of ours is better, by each criterion.
std::vector<std::string> summary(const MesherQuality& quality) {
  struct Score {
    int better = 0, cases = 0;
  };
  std::map<std::string, std::map<Criterion, Score>> scores;
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows)
      for (const Verdict& verdict : is_ours(row) ? judge(c, row) : std::vector<Verdict>()) {
        Score& score = scores[row.variant][verdict.criterion];
        score.better += verdict.is_better();
        score.cases += !verdict.best_variant.empty();
      }
  std::vector<std::string> lines;
  for (const auto& [variant, by_criterion] : scores) {
    std::string line = variant + " is better than all others";
    const char* separator = " in ";
    for (const auto& [criterion, score] : by_criterion) {
      line += separator + std::string(name_of(criterion)) + " in " + std::to_string(score.better) + " of " +
              std::to_string(score.cases);
      separator = ", ";
    }
    lines.push_back(line + " cases");
  }
  return lines;
}

std::string angle_words(const SurfaceAngle& angle) {
  return rounded(angle.degrees) + " degrees at " + coordinates(angle.at);
}

/// Why a dihedral angle may be small: what the surface has.
std::string blame(const SurfaceAngles& angles, double reached) {
  if (forbids_dihedral(angles, wanted_dihedral))
    return "the surface forbids it: two facets meet at " + angle_words(angles.dihedral) +
           (reached >= angles.dihedral.degrees - 1e-6 ? ", which is reached" : "");
  return "the surface does not forbid it: its facets meet at " + angle_words(angles.dihedral) +
         " or more, and the smallest angle of its triangles is " + angle_words(angles.planar);
}

std::vector<std::string> missed_aims(const MesherQuality& quality) {
  std::vector<std::string> lines;
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows) {
      if (!is_ours(row) || !row.ok()) continue;
      const std::string who = title_of(c) + ", " + row.variant + ": ";
      const Quality& q = row.quality;
      if (q.r.mean > wanted_mean_r)
        lines.push_back(who + "mean r " + rounded(q.r.mean, 4) + " > " + rounded(wanted_mean_r));
      if (q.r.max > wanted_worst_r)
        lines.push_back(who + "worst r " + rounded(q.r.max, 4) + " > " + rounded(wanted_worst_r) +
                        "; the smallest angle of the surface's triangles is " + angle_words(c.surface.angles.planar));
      if (q.dihedral_degrees.min < wanted_dihedral)
        lines.push_back(who + "smallest dihedral angle " + rounded(q.dihedral_degrees.min) + " < " +
                        rounded(wanted_dihedral) + " degrees; " + blame(c.surface.angles, q.dihedral_degrees.min));
      const double speed = static_cast<double>(row.counts.tetrahedra) / row.seconds->value;
      if (speed < wanted_speed)
        lines.push_back(who + rounded(speed / 1e6) + " million tetrahedra a second < " + rounded(wanted_speed / 1e6));
      const double rest = row.seconds->value - row.improve_seconds;
      if (row.improve_seconds > rest)
        lines.push_back(who + "improvement takes " + rounded(row.improve_seconds) + " s, the rest " + rounded(rest) +
                        " s");
    }
  return lines;
}

constexpr const char* title = "Quality: are our tetrahedra better than those of others?";
constexpr const char* aims =
    "Aims that are missed (mean r 1.20, worst r 3, dihedral 18 degrees, 0.7 million/s, improvement half of the time)";

}  // namespace

std::string to_terminal(const MesherQuality& quality) {
  return std::string(title) + "\n\n" + cases_to_terminal(quality) + to_terminal(verdicts(quality)) + "\n" +
         terminal_section("In all", summary(quality)) + terminal_section(aims, missed_aims(quality)) +
         terminal_section("What went wrong", complaints_of(quality)) + how_studied(quality) + "\n";
}

std::string to_markdown(const MesherQuality& quality) {
  return "# " + std::string(title) + "\n\n" + how_studied(quality) + "\n\n" + to_markdown(verdicts(quality)) + "\n" +
         section("In all", summary(quality)) + section(aims, missed_aims(quality)) +
         section("What went wrong", complaints_of(quality)) + "## The surfaces\n\n" +
         to_markdown(surfaces_table(quality)) + "\n" + cases_to_markdown(quality) +
         closing_sections(mesher_quality_definitions(), quality.how);
}

}  // namespace ccdt
