#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/base/errors.h"
#include "engine/steps/mesh_options.h"

namespace ccdt::steps {

/// The options with all edge lengths times a factor. Largest volumes of regions stay, since they are limits.
MeshOptions scaled(MeshOptions options, double factor);

/// Scales the sizes of a mesh until it has a wanted number of tetrahedra, within four percent: by the secant method on
/// the logarithms of both.
///
/// \param mesh_with    mesh_with(factor) makes the mesh of sizes times a factor
/// \param count_of     count_of(mesh) is its number of tetrahedra
/// \param file         for the message
/// \return             what `mesh_with` has returned last
/// \throw LimitError   no factor was found: a kept surface or limits of volumes may need more tetrahedra
template <class MeshWith, class CountOf>
auto reach_count(double wanted, const MeshWith& mesh_with, const CountOf& count_of, const std::string& file) {
  constexpr int most_tries = 12;
  constexpr double tolerance = 0.04, farthest = 1.5;  // of logarithms
  double scale = 0, last_scale = 0, last_excess = 0, nearest = 0;
  for (int i = 0; i < most_tries; ++i) {
    auto mesh = mesh_with(std::exp(scale));
    const auto count = static_cast<double>(count_of(mesh));
    const double excess = std::log(count / wanted);
    if (std::fabs(excess) <= tolerance) return mesh;
    if (nearest == 0 || std::fabs(excess) < std::fabs(std::log(nearest / wanted))) nearest = count;
    const double slope = i > 0 && scale != last_scale ? (excess - last_excess) / (scale - last_scale) : -3;
    last_scale = scale, last_excess = excess;
    // Volumes have slope -3, surfaces -2; a kept surface stops all growth.
    scale += std::clamp(-excess / std::clamp(slope, -4.0, -0.5), -farthest, farthest);
  }
  throw LimitError("no sizes give about " + std::to_string(static_cast<std::uint64_t>(wanted)) +
                       " tetrahedra: the nearest mesh has " + std::to_string(static_cast<std::uint64_t>(nearest)),
                   {.file = file}, "ask for another number, or let the surface change with --surface refine or remesh");
}

}  // namespace ccdt::steps
