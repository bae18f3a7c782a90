#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/index.h"
#include "engine/base/index_lists.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt::front {

/// The vertices near a face: those joined to its corners by Delaunay edges or by edges of missing faces of the PLC. The
/// apex above a face is nearly always one of them, because few edges of a constrained Delaunay tetrahedralization are
/// of neither kind.
class NearVertices {
 public:
  /// \param codes  the Delaunay faces of the PLC by their codes; the others are `no_neighbor`
  NearVertices(const facets::FacetMesh& facets, const std::vector<std::uint32_t>& codes,
               const delaunay::Delaunay& delaunay)
      : star_(delaunay), d_(delaunay), last_seen_(delaunay.vertices.size(), 0) {
    joined_by_missing_ = make_index_lists(delaunay.vertices.size(), [&](const auto& emit) {
      for (std::size_t i = 0; i < codes.size(); ++i) {
        if (codes[i] != delaunay::no_neighbor) continue;
        const auto& [a, b, c] = facets.triangles[i];
        emit(a, b), emit(b, c), emit(c, a);
        emit(b, a), emit(c, b), emit(a, c);
      }
    });
  }

  /// The vertices near a face, without its corners; valid until the next call of any function.
  std::span<const std::uint32_t> of_face(const std::array<std::uint32_t, 3>& corners) {
    ++search_;
    vertices_.clear();
    for (const std::uint32_t v : corners) last_seen_[v] = search_;
    for (const std::uint32_t v : corners) add(v);
    return vertices_;
  }

  /// The vertices near one more vertex, without those returned since the last face; valid until the next call.
  std::span<const std::uint32_t> more(std::uint32_t vertex) {
    vertices_.clear();
    add(vertex);
    return vertices_;
  }

  std::size_t bytes() const { return bytes_of(last_seen_, joined_by_missing_.first, joined_by_missing_.items); }

 private:
  void add(std::uint32_t vertex) {
    for (const std::uint32_t cell : star_.around(vertex))
      for (const std::uint32_t v : d_.cells[cell].vertices) name(v);
    for (const std::uint32_t v : joined_by_missing_.of(vertex)) name(v);
  }

  void name(std::uint32_t v) {
    if (v == delaunay::ghost_vertex || last_seen_[v] == search_) return;
    last_seen_[v] = search_;
    vertices_.push_back(v);
  }

  delaunay::CellStar star_;
  const delaunay::Delaunay& d_;
  IndexLists joined_by_missing_;
  std::vector<std::uint32_t> last_seen_;  // the number of the last search that returned the vertex
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace ccdt::front
