#include "bench/experiments/measured_case.h"

namespace ccdt {

void run_once(const ExperimentOptions& options, MeasuredCase& measured, int number) {
  if (measured.failed()) return;
  const auto report = options.folder / "runs" / (measured.stem + "-" + std::to_string(number) + ".json");
  RunRecord record = run_case(options.program, measured.what, report, options.limits);
  if (number > 0 && record.status == RunStatus::ok) {
    measured.counted.push_back(record);
  } else {
    // A failure counts even if it went well before: a row of fewer samples than the others would not be fair.
    measured.first = record;
  }
}

double cdt_seconds(const StageSeconds& s) {
  return s.delaunay + s.face_check + s.front + s.label;
}

}  // namespace ccdt
