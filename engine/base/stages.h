#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/base/enum_names.h"
#include "engine/base/work.h"

namespace ccdt {

/// A stage of meshing. The stages are in order.
enum class Stage : std::uint8_t {
  remesh,
  plc,
  refine,
  protect,
  facets,
  lattice,
  delaunay,
  face_check,
  front,
  label,
  finish,
  improve
};

/// Names as in the `ccdt.run/1` schema.
constexpr auto names_of(Stage) {
  return std::to_array<NamedValue<Stage>>(
      {{Stage::remesh, "remesh", "makes new triangles for the surface, before any mesher gets it"},
       {Stage::plc, "plc", "puts the input on the grid and checks it"},
       {Stage::refine, "refine", "gives facets and segments new vertices"},
       {Stage::protect, "protect", "splits missing segments"},
       {Stage::facets, "facets", "triangulates every facet"},
       {Stage::lattice, "lattice", "places interior points"},
       {Stage::delaunay, "delaunay", "tetrahedralizes all vertices"},
       {Stage::face_check, "face_check", "finds the faces that are not Delaunay"},
       {Stage::front, "front", "makes the tetrahedra beside them"},
       {Stage::label, "label", "finds the region of each tetrahedron"},
       {Stage::finish, "finish", "checks the mesh and restores its units"},
       {Stage::improve, "improve", "removes Steiner vertices and bad tetrahedra"}});
}

/// What a stage costs; all zero if it was skipped.
struct StageCost {
  double seconds = 0;      ///< wall-clock
  double cpu_seconds = 0;  ///< of all threads of the process together
  unsigned threads = 0;    ///< the largest number at work at the same time
  Work work = {};
};

/// The costs of a run, by stage.
struct StageCosts {
  std::array<StageCost, names_of(Stage{}).size()> stages = {};
  double mesh_seconds = 0;  ///< wall-clock, of meshing alone: all stages but `remesh`

  StageCost& operator[](Stage stage) { return stages[static_cast<std::size_t>(stage)]; }
  const StageCost& operator[](Stage stage) const { return stages[static_cast<std::size_t>(stage)]; }
};

}  // namespace ccdt
