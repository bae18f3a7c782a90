#pragma once

#include <string>
#include <vector>

#include "bench/experiments/quality_study.h"
#include "reports/text_table.h"

namespace ccdt {

/// "piston, 50,000 tetrahedra".
std::string title_of(const QualityCase& c);

/// "(1, 2.5, -3)", rounded.
std::string coordinates(const Point3& p);

/// The surfaces of a study and their smallest angles.
TextTable surfaces_table(const QualityStudy& study);

/// One row a variant: count, seconds, speed and quality.
TextTable variants_table(const QualityCase& c);

/// How many per cent of the tetrahedra have an r within each bin, one column a variant that went well (the paper's
/// Figs. 9 to 11).
TextTable r_histogram(const QualityCase& c);

/// The same of dihedral angles, in steps of ten degrees.
TextTable dihedral_histogram(const QualityCase& c);

/// What went wrong, a line each.
std::vector<std::string> complaints_of(const QualityStudy& study);

/// How the numbers came to be, in one sentence.
std::string how_studied(const QualityStudy& study);

/// All cases with their tables, for a terminal and in Markdown (there with histograms).
std::string cases_to_terminal(const QualityStudy& study);
std::string cases_to_markdown(const QualityStudy& study);

}  // namespace ccdt
