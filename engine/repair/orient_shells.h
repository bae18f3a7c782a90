#pragma once

#include <vector>

#include "engine/plc/build_plc.h"
#include "engine/plc/plc.h"
#include "engine/repair/winding_number.h"

namespace ccdt::repair {

/// Turns triangles so that neighbors across edges of two triangles face the same way. In each connected part, those
/// facing the way with less total area are turned.
void orient_shells(plc::UncheckedPlc& soup);

/// Turns closed parts whose normals point inward, unless they are voids: those that stick out of all others, and all
/// parts if together they are inside out.
void turn_parts_outward(OrientedSurface& surface);

/// The triangles between the domain and the rest, with normals that point out of the domain.
std::vector<plc::VertexTriple> outward_triangles(const plc::Plc& plc);

}  // namespace ccdt::repair
