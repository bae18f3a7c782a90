#include "engine/options/check_options.h"

#include "engine/base/check_arguments.h"
#include "engine/base/errors.h"
#include "engine/options/set_option.h"
#include "engine/sizes/interpolated_sizes.h"
#include "engine/sizes/wanted_places.h"

namespace ccdt::options {
namespace {

void check_numbers(const MeshOptions& options) {
  for (const MeshOption& option : mesh_options()) check_bounds(option, options);
  check_number("least core", options.least_core);
  check_number("number of thin tetrahedra", options.thin_tetrahedra, 1);
  check_number("factor of the surface's edge lengths", options.surface_factor, 1e-6, 1e6);
}

/// A program may turn any number into a value of an enumeration.
void check_strategies(const MeshOptions& options) {
  const auto check = [](auto... values) {
    if ((name_of(values).empty() || ...))
      throw InputError("a strategy is not one of its enumeration", {}, "use the named values");
  };
  check(options.lattice, options.protection, options.locator, options.delaunay, options.visibility, options.surface,
        options.periodic, improvement_of(options), options.improve.objective, options.improve.boundary,
        options.improve.steiner);
}

}  // namespace

void check_options(const MeshOptions& options) {
  check_numbers(options);
  check_strategies(options);
  if (options.periodic != Periodicity::none && makes_new_surface(options.surface))
    throw InputError("a new surface is not periodic", {}, "use --surface keep or refine with --periodic");
  sizes::check_background(options.background);
  sizes::check_local_sizes(options.local);
  if (!options.local.empty() && options.grading == 0)
    throw InputError("local edge lengths need a grading: without one, they would hold everywhere",
                     {.file = options.local.name}, "give a grading, such as 0.5, the default");
}

}  // namespace ccdt::options
