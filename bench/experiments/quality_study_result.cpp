#include <numeric>

#include "bench/experiments/quality_study.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

/// The columns that tell whose a row is.
std::vector<Column> label_columns(const QualityStudy& study) {
  std::vector<Column> columns = {{"model", "model", ColumnKind::label}};
  columns.insert(columns.end(), study.labels.begin(), study.labels.end());
  return columns;
}

std::vector<Cell> label_cells(const QualityCase& c, const QualityRow& row) {
  std::vector<Cell> cells = {cell_of(c.name)};
  for (const std::string& label : row.labels) cells.push_back(cell_of(label));
  return cells;
}

template <class Items>
void append(std::vector<typename Items::value_type>& to, const Items& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<Cell> figures_of(const QualityRow& row) {
  const Quality& q = row.quality;
  return {cell_of(row.counts.tetrahedra),
          q.r.mean,
          q.r.median,
          q.r.p99,
          q.r.max,
          q.dihedral_degrees.min,
          q.dihedral_degrees.max,
          q.aspect_ratio.mean,
          q.aspect_ratio.max,
          q.radius_edge_ratio.mean,
          q.radius_edge_ratio.max,
          row.edge_length,
          cell_of(row.is_comparable)};
}

/// A single run has no interval.
Cell seconds_of(const QualityRow& row) {
  return row.samples.size() > 1 ? Cell(*row.seconds) : Cell(row.seconds->value);
}

/// Million tetrahedra a second, where the clock could tell.
Cell speed_of(const QualityRow& row) {
  const double millions = static_cast<double>(row.counts.tetrahedra) / 1e6;
  return row.seconds->value > 0 ? Cell(millions / row.seconds->value) : Cell();
}

ResultTable quality_table(const QualityStudy& study) {
  ResultTable table{"quality", "Quality", label_columns(study)};
  append(table.columns, std::vector<Column>{{"status", "status", ColumnKind::label},
                                            {"tetrahedra", "tetrahedra"},
                                            {"mean_r", "mean r"},
                                            {"median_r", "median r"},
                                            {"p99_r", "99% of r below"},
                                            {"worst_r", "worst r"},
                                            {"smallest_dihedral", "smallest dihedral", ColumnKind::figure, "degrees"},
                                            {"largest_dihedral", "largest dihedral", ColumnKind::figure, "degrees"},
                                            {"mean_aspect", "mean aspect ratio"},
                                            {"worst_aspect", "worst aspect ratio"},
                                            {"mean_radius_edge", "mean radius-edge ratio"},
                                            {"worst_radius_edge", "worst radius-edge ratio"},
                                            {"edge_length", "edge length asked for"},
                                            {"comparable", "comparable number of tetrahedra"},
                                            {"seconds", "seconds", ColumnKind::time, "s"},
                                            {"improve_seconds", "of these improvement", ColumnKind::time, "s"},
                                            {"speed", "million tetrahedra a second", ColumnKind::time},
                                            {"reason", "reason", ColumnKind::note}});
  for (const QualityCase& c : study.cases)
    for (const QualityRow& row : c.rows) {
      std::vector<Cell> cells = label_cells(c, row);
      cells.push_back(cell_of(name_of(row.status)));
      if (row.ok()) {
        append(cells, figures_of(row));
        cells.insert(cells.end(), {seconds_of(row), Cell(row.improve_seconds), speed_of(row)});
      }
      cells.resize(table.columns.size());
      cells.back() = row.reason;
      table.rows.push_back({std::move(cells), row.runs});
    }
  return table;
}

/// A row a bin. The histograms have as many bins as the quality's.
template <class HistogramOf>
ResultTable histogram_table(const QualityStudy& study, std::string name, std::string title, const std::string& unit,
                            HistogramOf histogram_of) {
  ResultTable table{std::move(name), std::move(title), label_columns(study), {}, true};
  append(table.columns, std::vector<Column>{{"low", "from", ColumnKind::figure, unit},
                                            {"high", "to", ColumnKind::figure, unit},
                                            {"count", "count"},
                                            {"percent", "percent"}});
  for (const QualityCase& c : study.cases)
    for (const QualityRow& row : c.rows) {
      if (!row.ok()) continue;
      const Histogram& h = histogram_of(row.quality);
      const auto total = static_cast<double>(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}));
      for (std::size_t bin = 0; bin < h.counts.size(); ++bin) {
        std::vector<Cell> cells = label_cells(c, row);
        const double percent = total > 0 ? 100 * static_cast<double>(h.counts[bin]) / total : 0;
        for (const double value : {h.edges[bin], h.edges[bin + 1], static_cast<double>(h.counts[bin]), percent})
          cells.emplace_back(value);
        table.rows.push_back({std::move(cells), {row.runs.front()}});
      }
    }
  return table;
}

std::string coordinates(const Point3& p) {
  return "(" + rounded(p.x, 5) + ", " + rounded(p.y, 5) + ", " + rounded(p.z, 5) + ")";
}

ResultTable surfaces_table(const QualityStudy& study) {
  ResultTable table{"surfaces",
                    "The surfaces",
                    {{"model", "model", ColumnKind::label},
                     {"edge_length", "edge length"},
                     {"vertices", "vertices"},
                     {"triangles", "triangles"},
                     {"made", "made"},
                     {"smallest_angle", "smallest angle of a triangle", ColumnKind::figure, "degrees"},
                     {"smallest_angle_at", "at"},
                     {"smallest_facet_angle", "smallest angle between facets", ColumnKind::figure, "degrees"},
                     {"smallest_facet_angle_at", "at"}}};
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) continue;
    const EvenSurface& s = c.surface;
    table.rows.push_back({{cell_of(c.name), s.edge_length, cell_of(s.vertices), cell_of(s.triangles),
                           cell_of(s.remeshed ? std::string_view("remeshed") : "kept"), s.angles.planar.degrees,
                           cell_of(coordinates(s.angles.planar.at)), s.angles.dihedral.degrees,
                           cell_of(coordinates(s.angles.dihedral.at))},
                          {}});
  }
  return table;
}

std::vector<std::string> problems_of(const QualityStudy& study) {
  std::vector<std::string> lines;
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) lines.push_back(title_of(c) + ": " + c.reason);
    for (const QualityRow& row : c.rows) {
      const std::string who = title_of(c) + ", " + row.variant + ": ";
      if (!row.ok())
        lines.push_back(who + std::string(name_of(row.status)) + ": " + row.reason);
      else if (!row.is_comparable)
        lines.push_back(who + with_separators(row.counts.tetrahedra) +
                        " tetrahedra are not comparable: no edge length was found that makes about " +
                        with_separators(c.rows.front().counts.tetrahedra));
    }
  }
  return lines;
}

}  // namespace

std::string title_of(const QualityCase& c) {
  return c.name + ", " + with_separators(c.wanted) + " tetrahedra";
}

ExperimentResult study_result(const QualityStudy& study) {
  ExperimentResult result;
  result.how = study.how;
  result.tables = {quality_table(study),
                   histogram_table(study, "r_histogram", "Histogram of r", "",
                                   [](const Quality& q) -> const Histogram& { return q.r.histogram; }),
                   histogram_table(study, "dihedral_histogram", "Histogram of the dihedral angles", "degrees",
                                   [](const Quality& q) -> const Histogram& { return q.dihedral_degrees.histogram; }),
                   surfaces_table(study)};
  result.problems = problems_of(study);
  result.meshes = study.meshes;
  for (const QualityCase& c : study.cases) {
    result.is_good = result.is_good && c.reason.empty();
    for (const QualityRow& row : c.rows) result.is_good = result.is_good && (row.ok() || !row.is_ours);
  }
  return result;
}

}  // namespace ccdt
