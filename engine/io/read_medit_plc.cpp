#include "engine/io/medit_parts.h"
#include "engine/io/plc_formats.h"

namespace ccdt::io {

namespace {

template <std::size_t Corners>
void add_facets(const MeditElements<Corners>& elements, InputPlc& plc) {
  for (std::size_t i = 0; i < elements.corners.size(); ++i)
    add_facet(plc, elements.corners[i], elements.references[i], static_cast<std::uint32_t>(elements.first_facet + i));
}

}  // namespace

InputPlc read_medit_plc(const FileBytes& file) {
  MeditFile mesh = read_medit(file, false);
  InputPlc plc;
  plc.inside = inside_claimed(file);
  plc.vertices = std::move(mesh.vertices);
  add_facets(mesh.triangles, plc);
  add_facets(mesh.quadrilaterals, plc);
  add_facets(mesh.edges, plc);
  finish_facets(plc);
  return plc;
}

}  // namespace ccdt::io
