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

/// How a mesher is asked, in its own words: {"switches", "pQ"}.
using MesherSettings = std::vector<std::pair<std::string, std::string>>;

/// What a mesher made, and how it was asked to.
struct MesherRun {
  MeshResult result;
  MesherSettings settings;
  std::vector<std::string> notes;  ///< what a reader of the result has to know, one sentence each
};

/// An option of `ccdt mesh` that changes what a mesher does.
struct OptionUse {
  std::string name;          ///< as on the command line, without dashes: "edge-length"
  bool only_none = false;    ///< it matters only whether the value is "none"
  bool only_inside = false;  ///< it does not matter with `--lattice none`
};

/// One way to make a tetrahedral mesh: our engine or somebody else's program, behind one function.
struct Mesher {
  std::string name;  ///< as in `--mesher`: ccdt, tetgen, cgal-mesh3, cgal-delaunay, gmsh-hxt; of a description its own
  std::string version;  ///< of a library; empty for a program, which is asked by `version_of`
  std::string what;     ///< one line for people
  std::string license;
  std::function<MesherRun(const InputPlc&, const MeshOptions&, const Progress&)> run;  ///< throws as `mesh_plc`
  /// What `run` will ask for; so that it is known of a run that crashes. Null: the options say it all.
  std::function<MesherSettings(const InputPlc&, const MeshOptions&)> settings = {};
  std::function<std::string()> ask_version = {};  ///< of a program; null for a library
  /// Does its mesh have the facets, segments and vertices of the input? Else it has a surface of its own.
  bool keeps_surface = true;
  std::vector<OptionUse> options = {};     ///< what it takes from `ccdt mesh`; see `effective_options`
  std::filesystem::path program = {};      ///< that is run; empty for what is linked in, or if it is not there
  std::filesystem::path description = {};  ///< the file that describes it; empty for a mesher of this build
};

/// All meshers that this build has, ours first.
std::span<const Mesher> meshers();

/// Is this the name of a file that describes a mesher, and not that of a mesher of this build?
bool is_mesher_description(std::string_view name_or_file);

/// A mesher of this build, or the one that a file describes (baselines/mesher_description.h), whose name ends in
/// ".json"; it is read once.
///
/// \throw Error       no such mesher in this build; names those that there are
/// \throw InputError  the description cannot be read, is wrong, or names a mesher of this build
const Mesher& mesher(std::string_view name_or_file);

/// The version that is used here; "unknown" if a program does not say it or is not there.
std::string version_of(const Mesher& mesher);

/// What the mesher will ask for; empty if the options say it all.
MesherSettings settings_of(const Mesher& mesher, const InputPlc& input, const MeshOptions& options);

}  // namespace ccdt::baselines
