#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/cases/identity.h"
#include "engine/base/enum_names.h"

namespace ccdt::gate {

/// What kind of figure it is, and so what it may be compared with.
enum class Layer {
  exact,         ///< counts, quality and work: the same on every machine
  instructions,  ///< the same on machines with one CPU model and one set of libraries
  time           ///< only within one measurement, in turns
};

constexpr auto names_of(Layer) {
  return std::to_array<NamedValue<Layer>>({{Layer::exact, "exact", "counts, quality and work"},
                                           {Layer::instructions, "instructions", "what callgrind counts in each stage"},
                                           {Layer::time, "time", "base and head in turns on this host"}});
}

/// One quantity of a case.
struct Figure {
  std::string name;  ///< path in the JSON that it is from: "work.delaunay.walk_steps", "seconds.mesh"
  Layer layer = Layer::exact;
  std::vector<double> samples;  ///< one of each run; seconds for times
  std::string text = {};  ///< instead of samples, where equality is all that matters: "mesh_fingerprint", "status"
};

/// What is known of one case.
struct CaseFigures {
  std::string name;     ///< by which base and head find each other
  std::string command;  ///< that repeats it
  std::vector<Figure> figures;
};

/// What was measured of one program.
struct Recording {
  std::filesystem::path source;
  cases::Identity identity;  ///< field and value, such as "machine.cpu"; what instructions depend on
  std::vector<CaseFigures> cases;
};

}  // namespace ccdt::gate
