#pragma once

#include <optional>

#include "bench/verify/patches.h"

namespace ccdt::verify {

/// Inner faces of the mesh that span a patch.
struct Sheet {
  std::vector<Face> faces;           ///< seen from above
  std::vector<std::uint32_t> above;  ///< the tetrahedron above each face
};

/// The faces allowed in a sheet: all faces in the plane of the patch within the tolerance; or only those that the mesh
/// lists; or only those with another such face, or a link, at each edge.
enum class SheetFaces { listed, all, without_dead_ends };

/// Spreads a sheet of inner faces of the mesh over a patch, inward from the links around it.
///
/// A facet that is flat only within the tolerance may carry flat tetrahedra, so that more than one sheet spans it. The
/// sheet taken is the topmost: its faces have tetrahedra above that are not flat, wherever the links are edges of that
/// sheet. A mesh that lists the faces on facets determines the sheet itself. If a vertex of another facet is within the
/// tolerance of the plane, the topmost faces may lead to an edge without a next face. `without_dead_ends` prevents
/// this.
///
/// \return  none if no sheet was found
std::optional<Sheet> spread_sheet(const Topology& topology, const Surface& surface, const Patches& patches,
                                  std::uint32_t patch, SheetFaces which);

}  // namespace ccdt::verify
