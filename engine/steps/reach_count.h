#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "engine/base/errors.h"
#include "engine/options/mesh_options.h"

namespace ccdt::steps {

/// The options with all edge lengths times a factor. Largest volumes of regions stay, since they are limits.
MeshOptions scaled(MeshOptions options, double factor);

/// Finds the logarithm of the factor at which a mesh has a wanted number of tetrahedra: by the secant method until
/// there are a larger and a smaller mesh, then between them, every other time in the middle. Where all edges of a curve
/// are divided at once, the number jumps.
class FactorSearch {
 public:
  /// \param excess  the logarithm of the number at the current factor over the wanted one
  /// \return        is there another factor to try?
  bool note(double excess);

  double logarithm() const { return current_; }

 private:
  struct Try {
    double scale, excess;
  };
  double current_ = 0;
  int tries_ = 0;
  std::optional<Try> last_, more_, less_;  // the last one, and the nearest ones with more and with fewer tetrahedra
};

/// Scales the sizes of a mesh until it has a wanted number of tetrahedra, within five percent.
///
/// \param mesh_with   mesh_with(factor) makes the mesh of sizes times a factor
/// \param count_of    count_of(mesh) is its number of tetrahedra
/// \param file        for the message
/// \return            what `mesh_with` has returned last
/// \throw LimitError  no factor was found: a kept surface or limits of volumes may need more tetrahedra
template <class MeshWith, class CountOf>
auto reach_count(double wanted, const MeshWith& mesh_with, const CountOf& count_of, const std::string& file) {
  constexpr double tolerance = 0.048;
  FactorSearch search;
  double nearest = HUGE_VAL;
  for (;;) {
    auto mesh = mesh_with(std::exp(search.logarithm()));
    const double excess = std::log(static_cast<double>(count_of(mesh)) / wanted);
    if (std::fabs(excess) <= tolerance) return mesh;
    if (std::fabs(excess) < std::fabs(nearest)) nearest = excess;
    if (!search.note(excess)) break;
  }
  throw LimitError("no sizes give about " + std::to_string(std::llround(wanted)) +
                       " tetrahedra: the nearest mesh has " + std::to_string(std::llround(wanted * std::exp(nearest))),
                   {.file = file},
                   "ask for another number, or let the surface change with --surface refine, auto or remesh");
}

}  // namespace ccdt::steps
