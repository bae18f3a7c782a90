#pragma once

#include <array>

#include "engine/base/enum_names.h"
#include "engine/base/flatness.h"
#include "engine/sizes/background_sizes.h"
#include "engine/sizes/local_sizes.h"

namespace ccdt::surface {

/// Which triangles bound the mesh.
enum class SurfaceRule {
  keep,
  remesh,     ///< new triangles that follow the surface; see `remesh_surface`
  automatic,  ///< new triangles that keep to a small distance from the surface; see `usual_deviation`
  refine      ///< facets and segments stay, and get vertices for even triangles; see `refine::refine_plc`
};

constexpr auto names_of(SurfaceRule) {
  return std::to_array<NamedValue<SurfaceRule>>(
      {{SurfaceRule::keep, "keep", "keep the triangles of the input"},
       {SurfaceRule::remesh, "remesh", "make new triangles of --edge-length; sharp edges stay"},
       {SurfaceRule::automatic, "auto",
        "make new triangles of --edge-length within --deviation of the old ones, by default a ten-thousandth\n"
        "of the diagonal of the bounding box; needles of fillets are merged"},
       {SurfaceRule::refine, "refine",
        "make new triangles of --edge-length on the same flat facets and straight segments"}});
}

/// Does the rule replace the triangles of the input?
constexpr bool makes_new_surface(SurfaceRule rule) {
  return rule == SurfaceRule::remesh || rule == SurfaceRule::automatic;
}

/// From the surface, with `SurfaceRule::automatic`: a share of the diagonal of the bounding box.
inline constexpr double usual_deviation = 1e-4;

/// At 30 degrees, a circle of twelve or more edges counts as round (CAD programs draw none coarser), and a 45-degree
/// chamfer is still kept.
inline constexpr double usual_sharp_angle = 30, least_sharp_angle = 1, most_sharp_angle = 179;

struct RemeshOptions {
  double edge_length = 0;  ///< target, in the units of the input; must be positive

  /// In degrees: an edge between two facets whose normals differ by more is kept as an edge.
  double sharp_angle = usual_sharp_angle;

  double flatness = usual_flatness;  ///< see PlcOptions

  double deviation = 0;  ///< no point of either surface is farther from the other, in the units of the input; 0: any

  // Where edges should be shorter; null or empty: nowhere.
  const sizes::LocalSizes* local = nullptr;
  const sizes::BackgroundSizes* background = nullptr;

  double most_tetrahedra = 0;  ///< refuse a new surface that alone has more triangles; 0: any number
  double usual_factor = 1;     ///< of the default edge length, see `prepare_surface`

  bool has_sizes() const {
    return (local != nullptr && !local->empty()) || (background != nullptr && !background->empty());
  }
};

}  // namespace ccdt::surface
