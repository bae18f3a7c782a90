#pragma once

#include <ctime>
#include <optional>
#include <string>

#include "bench/verify/verify.h"
#include "engine/mesher.h"
#include "engine/plc/warped_facets.h"
#include "tests/fuzz/targets/target.h"

namespace ccdt::fuzz {

/// Is thrown where a stage reports progress after its time. Stages that report nothing for long are found by libFuzzer.
struct TooLong : LimitError {
  TooLong() : LimitError("too long", {}, "") {}
};

inline Progress limited_to(double seconds) {
  const auto end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
  return [end](std::string_view, std::uint64_t, std::uint64_t) {
    if (std::clock() > end) throw TooLong();
  };
}

/// Meshes an input. The mesh must be right. Only a limit may prevent it.
/// \throw InputError  the input is not valid
inline void require_right_mesh(const InputPlc& input, const MeshOptions& options, double seconds) {
  MeshResult result;
  try {
    result = mesh_plc(input, options, limited_to(seconds));
  } catch (const LimitError&) {
    return;
  } catch (const MeshError& error) {
    throw std::logic_error(std::string("no mesh: ") + error.what());
  }
  const std::optional<InputPlc> flat = plc::triangulate_warped_facets(input);
  verify::VerifyOptions wanted;
  if (options.improve.boundary == BoundaryRule::slide) wanted.boundary = verify::VerifyOptions::Boundary::slide;
  for (const verify::Check& check : verify::verify(flat ? *flat : input, result.mesh, wanted).checks)
    require(!check.required || check.failed == 0,
            "a wrong mesh: " + check.name + ": " + (check.examples.empty() ? "" : check.examples.front()));
}

}  // namespace ccdt::fuzz
