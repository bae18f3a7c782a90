#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/identity.h"
#include "engine/base/enum_names.h"

namespace ccdt::gate {

/// The kind of a figure. It decides which other figures it may be compared with.
enum class Layer {
  exact,         ///< counts, quality and work: the same on every machine
  instructions,  ///< the same on machines with the same CPU model and libraries
  time           ///< comparable only within one measurement, in which base and head take turns
};

constexpr auto names_of(Layer) {
  return std::to_array<NamedValue<Layer>>({{Layer::exact, "exact", "counts, quality and work"},
                                           {Layer::instructions, "instructions", "what callgrind counts in each stage"},
                                           {Layer::time, "time", "base and head in turns on this host"}});
}

/// One quantity of a case.
struct Figure {
  std::string name;  ///< path in its JSON: "work.delaunay.walk_steps", "seconds.mesh"
  Layer layer = Layer::exact;
  std::vector<double> samples;  ///< one sample per run; seconds for times
  std::string text = {};        ///< instead of samples if only equality matters: "mesh_fingerprint", "status"
};

/// The figures of one case.
struct CaseFigures {
  std::string name;     ///< by which base and head are matched
  std::string command;  ///< that repeats it
  std::vector<Figure> figures;
  double timed_seconds = 0;  ///< the shortest span of time that the clock measured; 0 if unknown
};

/// Begins the names of the counters that the author of a benchmark defined.
inline constexpr const char* counter_prefix = "counters.";

/// The source of a recording.
enum class Source { runs, google_benchmark, hyperfine, baseline };

/// The figure that says whether a case is there at all.
inline constexpr const char* case_figure = "case";

/// The measurements of one program.
struct Recording {
  std::filesystem::path source;
  Source kind = Source::runs;
  bench::Identity identity = {};  ///< conditions of instruction counts, as field and value, such as "machine.cpu"
  std::vector<CaseFigures> cases = {};
  bool in_turns = false;  ///< the n-th samples of this recording and of the other one were measured together
  std::vector<std::string> notes = {};  ///< which parts of the source are not in the figures, and why
};

/// The figure of this name; null if the case has none.
const Figure* find_figure(const CaseFigures& one, const std::string& name);
/// The case of this name; null if the recording has none.
const CaseFigures* find_case(const Recording& recording, const std::string& name);

/// \name Limits of a recording, whose figures and cases are looked up one after the other.
/// @{
inline constexpr std::size_t most_figures = 10'000;  ///< of a case
inline constexpr std::size_t most_cases = 20'000;
/// @}

/// The case of this name, a new one if the recording has none.
/// \throw std::invalid_argument  there are more than `most_cases`
CaseFigures& case_named(const std::string& name, Recording& recording);

/// \throw std::invalid_argument  there are too many cases or figures
CaseFigures& add_case(CaseFigures one, Recording& recording);

/// The figure of this name, a new one without samples if the case has none.
/// \throw std::invalid_argument  there are more than `most_figures`
Figure& figure_named(const std::string& name, Layer layer, CaseFigures& one);

/// Reads a recording: the folder of a sweep, a folder or a file of ccdt.run/1, the JSON of Google Benchmark or of
/// hyperfine, or a ccdt.baseline/1.
///
/// Several runs of a case are the samples of its figures. Their names are the paths in the JSON; those of a Google
/// Benchmark are "seconds.real_time", "seconds.cpu_time" and "counters.NAME", those of hyperfine "seconds.elapsed"
/// and "exit_codes".
///
/// \throw InputError  it cannot be read, is none of these, or has no cases; names the file and the place in it
Recording read_recording(const std::filesystem::path& path);

}  // namespace ccdt::gate
