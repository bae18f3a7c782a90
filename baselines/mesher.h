#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesher.h"

namespace ccdt {

/// One way to make a tetrahedral mesh: our engine or somebody else's program, behind one function.
struct Mesher {
  std::string name;                                                       ///< as in `--mesher`: ccdt, tetgen, cgal-mesh3, cgal-delaunay
  std::string version;                                                    ///< of the library
  std::string what;                                                       ///< one line for people
  std::string licence;
  MeshResult (*run)(const InputPlc&, const MeshOptions&, const Progress&);  ///< throws as `mesh_plc`
};

/// All meshers that this build has, ours first.
std::span<const Mesher> meshers();

/// \throw Error  no such mesher in this build; names those that there are
const Mesher& mesher(std::string_view name);

}  // namespace ccdt
