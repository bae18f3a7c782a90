#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/options/mesh_options.h"

namespace ccdt::options {

/// One of several names. "on" and "off" stand for true and false.
struct ChoiceKind {
  struct Name {
    std::string_view name, what;
  };
  std::vector<Name> names;
  std::function<std::string_view(const MeshOptions&)> get;
  std::function<void(MeshOptions&, std::string_view)> set;  ///< nothing happens for other names
};

/// A finite number within bounds. The default may be outside of them.
struct NumberKind {
  double& (*member)(MeshOptions&);
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool excludes_least = false;
};

/// A whole number within bounds. The default may be outside of them.
struct CountKind {
  unsigned& (*member)(MeshOptions&);
  int least = 1, most = 1;
};

/// The name of a file.
struct FileKind {
  std::string& (*member)(MeshOptions&);
};

/// An option has an effect only if another one has this value, or does not have it.
struct Need {
  std::string_view option;
  bool is = true;
  std::string_view value;
};

/// An option of `ccdt mesh` that controls meshing: everything that the command line, the libraries, sweeps, reports and
/// the reference know about it.
struct MeshOption {
  std::string_view name;  ///< without dashes: "edge-length"; in JSON with underscores
  std::variant<ChoiceKind, NumberKind, CountKind, FileKind> kind;
  std::string_view what;            ///< its help text
  std::string_view in_report = {};  ///< what a reader of reports must know: the unit, or the meaning of 0
  std::vector<Need> needs = {};
  bool of_inside = false;      ///< our engine uses it only for interior points
  bool of_refinement = false;  ///< and for `--surface refine`
  bool of_remeshing = false;   ///< has an effect with `--surface remesh`, before any mesher runs
  bool of_any_mesher = false;  ///< the program obeys it, whatever the mesher
  /// The default, if `MeshOptions` does not give it; empty: it depends on the input.
  std::optional<std::string_view> usual = {};
};

/// The one table of options, in the order of --help.
const std::vector<MeshOption>& mesh_options();

/// The option of this name; null if there is none.
const MeshOption* find_mesh_option(std::string_view name);

/// A value as it is in reports.
using OptionValue = std::variant<bool, double, std::string>;

OptionValue recorded_value(const MeshOption& option, const MeshOptions& options);

/// Sets an option to a value as on the command line. A value that the command line refuses may do nothing; see
/// `set_option`.
void set_value(const MeshOption& option, std::string_view value, MeshOptions& options);

/// The value as on the command line.
std::string text_of(const OptionValue& value);

}  // namespace ccdt::options
