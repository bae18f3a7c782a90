#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/mesher.h"

namespace ccdt {

/// What a mesher made, and how it was asked to.
struct MesherRun {
  MeshResult result;
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the mesher's own words, e.g. {"switches", "pQ"}
  std::vector<std::string> notes;  ///< what a reader of the result has to know, one sentence each
};

/// One way to make a tetrahedral mesh: our engine or somebody else's program, behind one function.
struct Mesher {
  std::string name;     ///< as in `--mesher`: ccdt, tetgen, cgal-mesh3, cgal-delaunay, gmsh-hxt
  std::string version;  ///< of the library; of an external program the settings of a run say it
  std::string what;     ///< one line for people
  std::string licence;
  MesherRun (*run)(const InputPlc&, const MeshOptions&, const Progress&);  ///< throws as `mesh_plc`
};

/// All meshers that this build has, ours first.
std::span<const Mesher> meshers();

/// \throw Error  no such mesher in this build; names those that there are
const Mesher& mesher(std::string_view name);

}  // namespace ccdt
