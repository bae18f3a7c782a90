#pragma once

#include <string>

#include "bench/experiments/experiment.h"
#include "bench/experiments/surface_measures.h"
#include "engine/plc/input.h"

namespace ccdt {

/// Where surfaces of any edge length come from: one of our solids, or a file of the user's.
struct SurfaceSource {
  std::string name;  ///< of the solid, or the path of the file
  bool is_solid = false;
  double shortest = 0, longest = 1e300;  ///< edge lengths that it can have
  double volume = 0;                     ///< of what is inside
  InputPlc input;                        ///< a file's content
};

/// \throw InputError  the file cannot be read or is no valid PLC
SurfaceSource solid_source(const std::string& name);
SurfaceSource file_source(const std::filesystem::path& file);

/// A surface of triangles of nearly one size, in a file.
struct EvenSurface {
  std::filesystem::path file;
  double edge_length = 0;
  bool remeshed = false;  ///< else its triangles are as they came, because they were even enough
  std::uint64_t vertices = 0, triangles = 0;
  SurfaceAngles angles;
};

/// Makes a solid of an edge length, or takes the user's file; remeshes it where its triangles are not even and of about
/// that length; and writes it.
///
/// \throw InputError, MeshError  as `remesh_surface`
EvenSurface make_even_surface(const SurfaceSource& source, double edge_length, const std::filesystem::path& file);

}  // namespace ccdt
