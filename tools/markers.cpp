#include "tools/markers.h"

#include "tools/options.h"

namespace ccdt::tools {

void add_markers(CLI::App& verb, surface::MarkerSource& source) {
  add_choice(verb, "--markers", source, "markers of facets; those by angle are numbered from 1");
}

void add_markers(CLI::App& verb, MarkerOptions& options) {
  add_markers(verb, options.source);
  verb.add_option("--sharp-angle", options.sharp_angle,
                  "with --markers by-angle: edges between facets whose normals differ by more than this, in degrees, "
                  "are sharp")
      ->check(number_between(1, 179))
      ->needs("--markers")
      ->capture_default_str();
}

void mark(plc::InputPlc& input, const MarkerOptions& options, double flatness) {
  if (options.source == surface::MarkerSource::by_angle) surface::mark_by_angle(input, options.sharp_angle, flatness);
}

}  // namespace ccdt::tools
