#pragma once

#include <array>
#include <string_view>

#include "bench/quality.h"

namespace ccdt {

/// What a comparison of quality goes by.
enum class Criterion { mean_r, p99_r, worst_r, smallest_dihedral, largest_dihedral };
std::string_view name_of(Criterion criterion);
double value_of(const Quality& quality, Criterion criterion);
/// Is a strictly better than b?
bool is_better(Criterion criterion, double a, double b);

/// What every mesher is compared by.
inline constexpr std::array judged_criteria = {Criterion::mean_r, Criterion::p99_r, Criterion::worst_r,
                                               Criterion::smallest_dihedral};

}  // namespace ccdt
