#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/claims.h"

/// What the rules of claims read from the tables of experiments.
namespace ccdt::reports {

using Results = std::span<const ExperimentResult>;

/// A row of an experiment's table.
struct ClaimRow {
  std::string experiment;
  const ResultTable* table;
  const ResultRow* row;

  std::string text(std::string_view column) const { return results::text_in(*table, *row, column); }
  double number(std::string_view column) const { return results::number_in(*table, *row, column); }
  /// Null if the cell holds no estimate.
  const bench::Estimate* estimate(std::string_view column) const {
    return std::get_if<bench::Estimate>(&results::cell(*table, *row, column));
  }
};

/// Was the experiment run?
bool was_measured(Results results, const std::string& experiment);

/// The rows with these texts in these columns; none if the experiment or its table is missing.
std::vector<ClaimRow> rows_of(Results results, const std::string& experiment, std::string_view table,
                              const std::map<std::string, std::string>& texts = {});

/// A measure from a row of a table.
ClaimMeasure measure_of(const ClaimRow& row, std::string what, Cell value, std::string bound, BoundTest strong,
                        BoundTest weak);

/// Something that the claim needs and that was not measured, or not well enough: it leaves the claim undecided.
ClaimMeasure missing_measure(std::string what, std::string bound, std::string experiment, std::string table);

BoundTest yes_or_no(bool holds);

}  // namespace ccdt::reports
