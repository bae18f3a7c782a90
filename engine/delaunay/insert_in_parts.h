#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "engine/base/shared_progress.h"
#include "engine/delaunay/cut_space.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"

namespace ccdt::delaunay {

/// Inserts vertices on several threads, without locks (after Marot, Pellerin and Remacle 2019, "One machine, one
/// minute, three billion tetrahedra", who cut along a space-filling curve).
///
/// Planes cut space into parts. A cell belongs to a part if all its finite vertices do; otherwise it is shared. A
/// thread inserts the vertices of one part. It removes only cells of its part, and all cells that it makes belong to
/// its part too, because the border of its cavities has no other vertices. Shared cells stay: all threads may read
/// their vertices, and each of their neighbor codes is written only by the one part that has the face. So a thread may
/// walk through them, and back into its part. A vertex whose cavity would contain a shared cell waits, and is tried
/// again with other parts.
///
/// The Delaunay tetrahedralization is unique, so its cells do not depend on the parts or the threads. The order of the
/// cells does.
class PartedInsertion {
 public:
  /// \param d  with a list of all vertices; must outlive this, and so must the marks
  PartedInsertion(Delaunay& d, InsertionMarks& marks);

  /// \param vertices     in order of rank; all ranks are greater than those of the vertices that have cells
  /// \param waiting      what the previous call returned; these vertices are tried again after the others
  /// \param done, total  what to report of the whole stage
  /// \return  the vertices that still wait, too few for several threads; in the order of their ranks
  std::vector<std::uint32_t> insert(std::span<const std::uint32_t> vertices, std::vector<std::uint32_t> waiting,
                                    std::size_t done, std::size_t total, const Progress& progress);

  /// How many new cells there should be room for, so that cells need not be moved to a larger array on the way.
  static std::size_t most_cells(std::size_t vertices);

 private:
  using Part = InsertionParts::Part;

  void add_marks();
  void cut(std::span<const std::uint32_t> vertices, std::uint32_t parts, const Basis& basis);
  /// \param number  of the pass, from 0
  std::vector<std::uint32_t> pass(std::span<const std::uint32_t> vertices, std::size_t number,
                                  SharedProgress& progress);
  /// \return  the vertices that wait
  std::vector<std::uint32_t> insert_part(Part part, std::span<const std::uint32_t> vertices, std::size_t number,
                                         CellPool& pool, std::span<const std::uint32_t> free, SharedProgress& progress);
  std::vector<std::uint32_t> insert_in_order(Insertion& insertion, Part part, std::span<const std::uint32_t> vertices,
                                             std::size_t number, SharedProgress& progress);

  Delaunay& d_;
  std::vector<Part> part_;                         ///< by vertex
  std::vector<std::atomic<std::uint32_t>> start_;  ///< by part: a cell with one of its vertices, or `none`
  InsertionMarks& marks_;
  std::atomic<std::size_t> done_parts_ = 0;  ///< of this pass
  std::mutex mutex_;                         ///< guards the list of dead cells during a pass
};

}  // namespace ccdt::delaunay
