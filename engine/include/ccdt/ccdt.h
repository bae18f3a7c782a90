#pragma once

/// \file
/// All that the library offers: reading, checking, repairing, meshing, improving and writing.
///
/// All functions check their arguments: what no reader would make, such as an index out of range, is an `InputError`.
/// All functions may be called from several threads at once, with the same arguments too, as long as no two of them
/// write the same file. Those that work on several threads themselves call `Progress` from the calling thread, one call
/// at a time, and a `SizeFunction` from any thread, several at once.

#include "engine/base/errors.h"
#include "engine/improver.h"
#include "engine/io/plc_files.h"
#include "engine/io/read_sizes.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/mesher.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "engine/surface/remesh_surface.h"
#include "engine/version.h"

namespace ccdt {

using io::read_plc;
using io::read_sizes;
using io::read_tet_mesh;
using io::write_plc;
using io::write_tet_mesh;
using repair::find_faults;
using repair::repair_input;
using surface::remesh_surface;
using surface::RemeshOptions;

}  // namespace ccdt
