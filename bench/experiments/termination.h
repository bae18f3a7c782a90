#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bench/experiments/measured_case.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::experiments {

/// Segments or fins that meet at one point inside a cube, at a given angle: inputs that are hard to protect.
struct Star {
  std::string_view name;
  std::string_view what;      ///< one sentence
  double smallest_angle = 1;  ///< in degrees; below it there would be too many segments
  InputPlc (*make)(double degrees, std::uint64_t variant);
};

/// Variant 0 has lengths that alternate between 1 and 1 / sqrt 2; the other variants have random ones between 0.4 and
/// 1.6. A segment all around which shorter ones end is missing if these are shorter than its length times the cosine of
/// the angle. Halves of 1 and 1 / sqrt 2 stay in that proportion for ever, so below 45 degrees they can split each
/// other without end.
std::span<const Star> stars();

/// In degrees, of two segments that meet; 180 if there are none.
double smallest_angle(const plc::Plc& plc);

/// One input whose edges were protected in one way.
struct TerminationCase : CaseOutcome {
  std::string group;          ///< the star, "solid", or "file"
  std::string input;          ///< name of the solid or file; of a star: which variant
  double degrees = 0;         ///< asked for, of a star
  double smallest_angle = 0;  ///< that segments enclose, in degrees
  Protection protection = Protection::midpoint;
};

/// How protecting the edges of a case came out.
enum class Termination {
  ended,    ///< all grazeable edges are protected
  stopped,  ///< at the limit of the engine
  unknown   ///< the run failed for another reason
};
Termination termination_of(const TerminationCase& c);

/// Does the paper's way to protect edges, inserting middle points again and again (section 2), come to an end? Protects
/// our solids, stars of segments that meet at smaller and smaller angles, and the user's files, by midpoints and by our
/// shells.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the models that were asked for is part of it
results::ExperimentResult measure_termination(const ExperimentOptions& options, const Progress& progress = {});

/// The result without its circumstances, and without what every result of the experiment is called.
results::ExperimentResult termination_result(std::span<const TerminationCase> cases);

}  // namespace ccdt::experiments
