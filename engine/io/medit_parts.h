#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/io/file_bytes.h"
#include "engine/io/output_file.h"

/// Medit's ASCII format, which holds surfaces and tetrahedral meshes alike.
namespace ccdt::io {

/// The elements of one kind, with Medit's "reference" of each.
template <std::size_t Corners>
struct MeditElements {
  std::vector<std::array<std::uint32_t, Corners>> corners;
  std::vector<int> references;
  std::size_t first_facet = 0;  ///< of triangles and quadrilaterals: how many facets came before them in the file
};

struct MeditFile {
  std::vector<Point3> vertices;
  MeditElements<2> edges;
  MeditElements<3> triangles;
  MeditElements<4> quadrilaterals, tetrahedra;
};

/// \param with_tetrahedra  false: they are skipped as everything else that is not listed above
MeditFile read_medit(const FileBytes& file, bool with_tetrahedra);

/// \param comment  a line "# ...", or empty; it comes second because other readers want the version in the first line
void write_medit_head(std::string_view comment, const std::vector<Point3>& vertices, OutputFile& out);

/// Writes a section, or nothing if there are no elements. `references` is empty (all 0) or has one an element.
template <std::size_t Corners>
void write_medit_elements(const char* keyword, std::span<const std::array<std::uint32_t, Corners>> elements,
                          std::span<const int> references, OutputFile& out) {
  if (elements.empty()) return;
  out << '\n' << keyword << '\n' << elements.size() << '\n';
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (const std::uint32_t v : elements[i]) out << v + 1 << ' ';
    out << (references.empty() ? 0 : references[i]) << '\n';
  }
}

}  // namespace ccdt::io
