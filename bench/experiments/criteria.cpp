#include "bench/experiments/criteria.h"

namespace ccdt {

std::string_view name_of(Criterion criterion) {
  switch (criterion) {
    case Criterion::mean_r:
      return "mean r";
    case Criterion::p99_r:
      return "p99 r";
    case Criterion::worst_r:
      return "worst r";
    case Criterion::smallest_dihedral:
      return "smallest dihedral";
    case Criterion::largest_dihedral:
      return "largest dihedral";
  }
  return "";
}

double value_of(const Quality& quality, Criterion criterion) {
  switch (criterion) {
    case Criterion::mean_r:
      return quality.r.mean;
    case Criterion::p99_r:
      return quality.r.p99;
    case Criterion::worst_r:
      return quality.r.max;
    case Criterion::smallest_dihedral:
      return quality.dihedral_degrees.min;
    case Criterion::largest_dihedral:
      return quality.dihedral_degrees.max;
  }
  return 0;
}

bool is_better(Criterion criterion, double a, double b) {
  return criterion == Criterion::smallest_dihedral ? a > b : a < b;
}

}  // namespace ccdt
