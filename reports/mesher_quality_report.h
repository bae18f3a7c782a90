#pragma once

#include <string>

#include "bench/experiments/mesher_quality.h"

namespace ccdt {

/// Quality beside other meshers for a terminal: in what we are better than all of them, where an aim is missed and
/// which angle of the surface is to blame, and a table a surface.
std::string to_terminal(const MesherQuality& quality);

/// The same in Markdown, with histograms, the definitions and the machine.
std::string to_markdown(const MesherQuality& quality);

}  // namespace ccdt
