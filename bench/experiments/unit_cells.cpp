#include "bench/experiments/unit_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/experiments/bravais/bravais_lattices.h"

namespace ccdt::experiments {
namespace {

using bravais::BravaisLattice, bravais::Choice, bravais::Fraction, bravais::Gram, bravais::UnitCellQuality;

constexpr const char* face_centered_cubic = "face-centered cubic";

/// A lattice with its best free parameters.
struct BestUnitCell {
  const BravaisLattice* lattice;
  bravais::ParameterValues values;
  std::string similar_to;              ///< the cubic lattice that it is for these values; empty if it is none
  std::vector<std::size_t> polytopes;  ///< the numbers of their vertices
  UnitCellQuality quality;
  UnitCellQuality worst;  ///< with the worst triangulations of its Delaunay polytopes
};

std::string name_of_symbol(std::string_view symbol) {
  if (symbol.empty()) return {};
  return std::string(std::ranges::find(bravais::bravais_lattices(), symbol, &BravaisLattice::symbol)->name);
}

BestUnitCell best_unit_cell(const BravaisLattice& lattice, bravais::KnownTriangulations& known) {
  BestUnitCell best{&lattice, bravais::best_parameters(lattice, known), {}, {}, {}, {}};
  const Gram gram = lattice.gram(best.values);
  if (!lattice.parameters.empty()) best.similar_to = name_of_symbol(bravais::cubic_symbol(gram));
  for (const bravais::Polytope& polytope : bravais::delaunay_polytopes(gram).polytopes)
    best.polytopes.push_back(polytope.size());
  best.quality = bravais::quality_of(bravais::unit_cell(gram, Choice::best, known));
  best.worst = bravais::quality_of(bravais::unit_cell(gram, Choice::worst, known));
  return best;
}

std::string in_words(const Fraction& fraction) {
  const std::string above = std::to_string(fraction.numerator());
  return fraction.denominator() == 1 ? above : above + "/" + std::to_string(fraction.denominator());
}

/// "(b/a)^2 = 2, (c/a)^2 = 3/4"
std::string values_in_words(const BestUnitCell& cell) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < cell.lattice->parameters.size(); ++i)
    values.push_back(std::string(cell.lattice->parameters[i].name) + " = " +
                     in_words({cell.values.numerators[i], cell.values.denominator}));
  return joined(values);
}

/// "2 of 4 vertices, 1 of 6 vertices"
std::string polytopes_in_words(const BestUnitCell& cell) {
  std::map<std::size_t, int> numbers;
  for (const std::size_t vertices : cell.polytopes) ++numbers[vertices];
  std::vector<std::string> words;
  for (const auto& [vertices, number] : numbers)
    words.push_back(std::to_string(number) + " of " + std::to_string(vertices) + " vertices");
  return joined(words);
}

const std::vector<BestUnitCell>& best_unit_cells() {
  static const std::vector<BestUnitCell> all = [] {
    bravais::KnownTriangulations known;
    std::vector<BestUnitCell> cells;
    for (const BravaisLattice& lattice : bravais::bravais_lattices()) cells.push_back(best_unit_cell(lattice, known));
    return cells;
  }();
  return all;
}

RowColumn<BestUnitCell> quality_column(Column column, double UnitCellQuality::*value) {
  return {std::move(column), [value](const BestUnitCell& cell) { return cell.quality.*value; }};
}

const RowColumns<BestUnitCell>& unit_cell_columns() {
  using Quality = UnitCellQuality;
  static const RowColumns<BestUnitCell> columns = {
      {label_column("lattice"), [](const BestUnitCell& cell) { return std::string(cell.lattice->name); }},
      {figure_column("parameters", "best free parameters"), values_in_words},
      {figure_column("similar_to", "which make it"), &BestUnitCell::similar_to},
      {figure_column("polytopes", "Delaunay polytopes"), polytopes_in_words},
      {figure_column("cells", "tetrahedra"), [](const BestUnitCell& c) { return std::uint64_t{c.quality.cells}; }},
      {figure_column("regular", "of these regular", "%"),
       [](const BestUnitCell& c) {
         return 100 * static_cast<double>(c.quality.regular) / static_cast<double>(c.quality.cells);
       }},
      quality_column(figure_column("mean_r"), &Quality::mean_r),
      quality_column(figure_column("mean_r_by_volume"), &Quality::mean_r_by_volume),
      quality_column(figure_column("best_r"), &Quality::best_r),
      quality_column(figure_column("worst_r"), &Quality::worst_r),
      {figure_column("worst_squared_r", "its square, exactly"),
       [](const BestUnitCell& cell) { return in_words(cell.quality.worst_squared_r); }},
      quality_column(figure_column("smallest_dihedral", "", "degrees"), &Quality::smallest_dihedral),
      quality_column(figure_column("largest_dihedral", "", "degrees"), &Quality::largest_dihedral),
      quality_column(figure_column("worst_aspect", "worst aspect ratio"), &Quality::worst_aspect),
      quality_column(figure_column("worst_radius_edge", "worst radius-edge ratio"), &Quality::worst_radius_edge),
      {figure_column("worst_r_otherwise", "worst r, worst triangulation"),
       [](const BestUnitCell& cell) { return cell.worst.worst_r; }}};
  return columns;
}

/// A column of the unit cells by which lattices are compared.
struct Criterion {
  const char* column;
  const char* words;
  bool larger_is_better;
};
constexpr std::array<Criterion, 9> criteria = {{{"mean_r", "mean r", false},
                                                {"worst_r", "worst r", false},
                                                {"mean_r_by_volume", "mean r by volume", false},
                                                {"best_r", "best r", false},
                                                {"regular", "share of regular tetrahedra", true},
                                                {"smallest_dihedral", "smallest dihedral", true},
                                                {"largest_dihedral", "largest dihedral", false},
                                                {"worst_aspect", "worst aspect ratio", false},
                                                {"worst_radius_edge", "worst radius-edge ratio", false}}};

/// How much better a value is than another; equal values may differ by rounding.
double lead_of(const Criterion& criterion, double value, double over) {
  constexpr double rounding = 1e-9;
  const double lead = criterion.larger_is_better ? value - over : over - value;
  return std::abs(lead) <= rounding * std::abs(over) ? 0 : lead;
}

}  // namespace

ResultTable unit_cells_table() {
  return table_of_rows("unit_cells", "The unit cells of the Bravais lattices", unit_cell_columns(), best_unit_cells());
}

ResultTable unit_cell_criteria_table(const ResultTable& unit_cells) {
  ResultTable table = table_of("unit_cell_criteria", "The best unit cell",
                               {label_column("criterion", "by"), figure_column("confirmed", "FCC alone is the best"),
                                figure_column("fcc", "FCC"), figure_column("best_other", "best of the others"),
                                figure_column("best_other_lattices", "of")});
  const RowView fcc = rows_with(unit_cells, {{"lattice", face_centered_cubic}}).front();
  for (const Criterion& criterion : criteria) {
    const double ours = fcc.number(criterion.column);
    std::vector<std::string> names;
    double best = 0;
    for (const RowView& other : rows_with(unit_cells)) {
      const std::string special = other.text("similar_to");
      const std::string name = special.empty() ? other.text("lattice") : special;
      if (name == face_centered_cubic) continue;
      const double value = other.number(criterion.column), lead = lead_of(criterion, value, best);
      if (names.empty() || lead > 0) {
        names = {name};
        best = value;
      } else if (lead == 0 && std::ranges::find(names, name) == names.end()) {
        names.push_back(name);
      }
    }
    add_row(table, {}, criterion.words, lead_of(criterion, ours, best) > 0, ours, best, joined(names));
  }
  return table;
}

std::vector<std::string> unit_cell_findings(const ResultTable& table) {
  std::vector<std::string> findings;
  std::vector<std::string> best;
  std::map<std::string, std::vector<std::string>> others;
  for (const RowView& row : rows_with(table)) {
    if (row.text("confirmed") == "yes")
      best.push_back(row.text("criterion"));
    else
      others[row.text("best_other_lattices")].push_back(row.text("criterion"));
  }
  if (!best.empty()) findings.push_back("In the unit cell, FCC alone is the best by: " + joined(best));
  for (const auto& [lattices, by] : others)
    findings.push_back("In the unit cell, " + lattices + " is at least as good as FCC by: " + joined(by));
  return findings;
}

std::vector<std::string> unit_cell_definitions() {
  return {
      "The paper, section 3: in a unit cell, the tetrahedra of FCC are better than those of the 13 other lattices.",
      "It cites Radovitzky and Ortiz (2000), who have an aspect ratio of their own; here r and other measures decide.",
      "Unit cells: the Delaunay tetrahedra of one period, computed in whole numbers; they fill its volume.",
      "Free parameters have the values that minimize the worst r; a lattice includes those of higher symmetry.",
      "So seven lattices become body-centered cubic, which is the optimum of all lattices, and others simple cubic.",
      "Points on one empty sphere: each Delaunay polytope gets the triangulation with the least worst r.",
      "That is five tetrahedra for a cube. The octahedron of FCC has the same tetrahedra for every diagonal.",
      "The claim is confirmed if FCC alone is the best by every criterion of the table of the best unit cell.",
      "In its weaker form, it is confirmed if FCC alone is the best by the mean or by the worst r.",
      "A single best tetrahedron, or many regular ones, do not decide it: the others are as much part of a mesh.",
  };
}

}  // namespace ccdt::experiments
