#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/mesher.h"

namespace ccdt::baselines {

/// A setting in the mesher's own terms, such as {"switches", "pQ"}.
using MesherSettings = std::vector<std::pair<std::string, std::string>>;

/// The result of a mesher, and its settings.
struct MesherRun {
  MeshResult result;
  MesherSettings settings;
  std::vector<std::string> notes;  ///< what a reader of the result must know, one sentence each
};

/// An option of `ccdt mesh` that changes what a mesher does.
struct OptionUse {
  std::string name;          ///< as on the command line, without dashes: "edge-length"
  bool only_none = false;    ///< only the difference between "none" and other values matters
  bool only_inside = false;  ///< has no effect with `--lattice none`
};

/// A mesher: our engine or another program, behind one function.
struct Mesher {
  std::string
      name;  ///< as in `--mesher`: ccdt, tetgen, cgal-mesh3, cgal-delaunay, gmsh-hxt; or the name in a description
  std::string version;  ///< version of a library; empty for a program (see `version_of`)
  std::string what;     ///< one line for people
  std::string license;
  std::function<MesherRun(const InputPlc&, const MeshOptions&, const Progress&)> run;  ///< throws like `mesh_plc`
  /// The settings that `run` will use, so that they are known even if it crashes. Null: the options say everything.
  std::function<MesherSettings(const InputPlc&, const MeshOptions&)> settings = {};
  std::function<std::string()> ask_version = {};  ///< of a program; null for a library
  /// Does its mesh have the facets, segments and vertices of the input? If not, it makes its own surface.
  bool keeps_surface = true;
  std::vector<OptionUse> options = {};  ///< the options of `ccdt mesh` that it uses; see `effective_options`
  std::filesystem::path program = {};  ///< the program to run; empty for a linked library, or if the program is missing
  std::filesystem::path description = {};  ///< the file that describes it; empty for a mesher of this build
};

/// All meshers that this build has, ours first.
std::span<const Mesher> meshers();

/// Does the name denote a file that describes a mesher, not a mesher of this build?
bool is_mesher_description(std::string_view name_or_file);

/// A mesher of this build, or one described by a file whose name ends in ".json" (baselines/mesher_description.h). The
/// file is read once.
///
/// \throw Error       no such mesher in this build; lists those that exist
/// \throw InputError  the description cannot be read, is wrong, or names a mesher of this build
const Mesher& mesher(std::string_view name_or_file);

/// The installed version; "unknown" if the program does not state it or is missing.
std::string version_of(const Mesher& mesher);

/// The settings that the mesher will use; empty if the options say everything.
MesherSettings settings_of(const Mesher& mesher, const InputPlc& input, const MeshOptions& options);

}  // namespace ccdt::baselines
