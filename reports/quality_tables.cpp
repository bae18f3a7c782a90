#include "reports/quality_tables.h"

#include <numeric>

#include "reports/experiment_parts.h"
#include "reports/numbers.h"

namespace ccdt {
namespace {

constexpr double degrees_a_row = 10;

std::string range_words(double from, double to) {
  return rounded(from) + " to " + rounded(to);
}

/// Four digits tell lattices apart whose mean differs by a hundredth.
std::string with_four_digits(double value) {
  return rounded(value, 4);
}

/// The heading of a histogram, and the columns of its rows.
TextTable histogram_heading(const QualityCase& c, const std::string& what) {
  TextTable cells = {{what}};
  for (const QualityRow& row : c.rows)
    if (row.ok()) cells.front().push_back(row.variant);
  return cells;
}

double share_between(const Histogram& h, double from, double to) {
  const auto total = std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0});
  std::uint64_t within = 0;
  for (std::size_t bin = 0; bin < h.counts.size(); ++bin)
    if (h.edges[bin] >= from && h.edges[bin] < to) within += h.counts[bin];
  return total == 0 ? 0 : static_cast<double>(within) / static_cast<double>(total);
}

std::string percent(double share) {
  return share == 0 ? "" : rounded(100 * share, share < 0.001 ? 1 : 3);
}

/// One row from each edge to the next.
template <class HistogramOf>
TextTable histogram_table(const QualityCase& c, const std::string& what, const std::vector<double>& edges,
                          HistogramOf histogram_of) {
  TextTable cells = histogram_heading(c, what);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    std::vector<std::string> line = {range_words(edges[i], edges[i + 1])};
    bool is_empty = true;
    for (const QualityRow& row : c.rows) {
      if (!row.ok()) continue;
      const double share = share_between(histogram_of(row.quality), edges[i], edges[i + 1]);
      line.push_back(percent(share));
      is_empty = is_empty && share == 0;
    }
    if (!is_empty) cells.push_back(line);
  }
  return cells;
}

std::string speed(const QualityRow& row) {
  const double seconds = row.seconds->value;
  return seconds > 0 ? rounded(static_cast<double>(row.counts.tetrahedra) / seconds / 1e6) : "";
}

}  // namespace

std::string title_of(const QualityCase& c) {
  return c.name + ", " + with_separators(c.wanted) + " tetrahedra";
}

std::string coordinates(const Point3& p) {
  return "(" + rounded(p.x, 5) + ", " + rounded(p.y, 5) + ", " + rounded(p.z, 5) + ")";
}

TextTable surfaces_table(const QualityStudy& study) {
  TextTable cells = {{"surface", "edge length", "triangles", "made", "smallest angle", "at", "between facets", "at"}};
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) continue;
    const EvenSurface& s = c.surface;
    cells.push_back({title_of(c), rounded(s.edge_length, 4), with_separators(s.triangles),
                     s.remeshed ? "remeshed" : "kept", rounded(s.angles.planar.degrees),
                     coordinates(s.angles.planar.at), rounded(s.angles.dihedral.degrees),
                     coordinates(s.angles.dihedral.at)});
  }
  return cells;
}

TextTable variants_table(const QualityCase& c) {
  TextTable cells = {{"variant", "tetrahedra", "seconds", "improve", "million/s", "mean r", "p99 r", "worst r",
                      "dihedral min", "max", "aspect mean", "worst", "radius-edge mean", "worst"}};
  for (const QualityRow& row : c.rows) {
    if (!row.ok()) {
      cells.push_back({row.variant, std::string(name_of(row.status))});
      continue;
    }
    const Quality& q = row.quality;
    cells.push_back({row.variant, with_separators(row.counts.tetrahedra) + (row.is_comparable ? "" : " !"),
                     rounded(row.seconds->value), row.improve_seconds > 0 ? rounded(row.improve_seconds) : "",
                     speed(row), with_four_digits(q.r.mean), with_four_digits(q.r.p99), with_four_digits(q.r.max),
                     rounded(q.dihedral_degrees.min), rounded(q.dihedral_degrees.max),
                     with_four_digits(q.aspect_ratio.mean), rounded(q.aspect_ratio.max),
                     with_four_digits(q.radius_edge_ratio.mean), rounded(q.radius_edge_ratio.max)});
  }
  return cells;
}

TextTable r_histogram(const QualityCase& c) {
  std::vector<double> edges;
  for (const QualityRow& row : c.rows)
    if (row.ok()) edges = row.quality.r.histogram.edges;
  return histogram_table(c, "r, % of tetrahedra", edges,
                         [](const Quality& q) -> const Histogram& { return q.r.histogram; });
}

TextTable dihedral_histogram(const QualityCase& c) {
  std::vector<double> edges;
  for (double angle = 0; angle <= 180; angle += degrees_a_row) edges.push_back(angle);
  return histogram_table(c, "degrees, % of dihedral angles", edges,
                         [](const Quality& q) -> const Histogram& { return q.dihedral_degrees.histogram; });
}

std::vector<std::string> complaints_of(const QualityStudy& study) {
  std::vector<std::string> lines;
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) lines.push_back(title_of(c) + ": " + c.reason);
    for (const QualityRow& row : c.rows) {
      if (!row.ok())
        lines.push_back(title_of(c) + ", " + row.variant + ": " + std::string(name_of(row.status)) + ": " + row.reason);
      else if (!row.is_comparable)
        lines.push_back(title_of(c) + ", " + row.variant + ": " + with_separators(row.counts.tetrahedra) +
                        " tetrahedra are not comparable (marked !): no edge length was found that makes about " +
                        with_separators(c.rows.front().counts.tetrahedra));
    }
  }
  return lines;
}

std::string how_studied(const QualityStudy& study) {
  return study.how.runs == 1 ? "One run of each; all but the seconds is the same in every run."
                             : how_measured(study.how);
}

std::string cases_to_terminal(const QualityStudy& study) {
  std::string text;
  for (const QualityCase& c : study.cases)
    if (!c.rows.empty()) text += title_of(c) + "\n\n" + to_terminal(variants_table(c)) + "\n";
  return text;
}

std::string cases_to_markdown(const QualityStudy& study) {
  std::string text;
  for (const QualityCase& c : study.cases)
    if (!c.rows.empty())
      text += "## " + title_of(c) + "\n\n" + to_markdown(variants_table(c)) + "\n" + to_markdown(r_histogram(c)) +
              "\n" + to_markdown(dihedral_histogram(c)) + "\n";
  return text;
}

}  // namespace ccdt
