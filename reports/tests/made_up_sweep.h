#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ccdt {

/// What a made-up sweep is like.
struct MadeUpSweep {
  int models = 3, sizes = 4;  ///< inputs: each model with this many edge lengths, over two decades of tetrahedra
  int files = 0;              ///< more inputs, of a user
  std::vector<std::string> lattices = {"fcc", "bcc"}, locators = {"cavity", "octree"};  ///< options of ccdt
  std::vector<std::string> others = {"tetgen", "gmsh"};                                 ///< meshers without options
  int runs = 6;           ///< counted runs per case, after one warm-up run
  double failing = 0.05;  ///< the share of cases that fail; 0: none
  double slowness = 1;    ///< factor of all times
};

/// Writes sweep.json and the records of all runs, as `ccdt sweep` does. The same description gives the same folder.
void write_made_up_sweep(const MadeUpSweep& sweep, const std::filesystem::path& folder);

}  // namespace ccdt
