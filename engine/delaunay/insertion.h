#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/delaunay/delaunay.h"
#include "engine/geometry/filters.h"

namespace ccdt::delaunay {

/// A face between a cell that a new vertex destroys and one that stays.
struct CavityFace {
  std::array<std::uint32_t, 3> vertices;  ///< the new vertex is above them
  std::uint32_t outside;                  ///< code of the face in the cell that stays
};

/// How to decide whether a new vertex on a sphere is inside.
enum class Ties {
  greatest_rank,  ///< it is outside: no vertex in the tetrahedralization has a greater rank
  any_rank        ///< by comparing all ranks
};

/// Marks of an insertion at the cells and vertices that it visits; between two insertions, all have their initial
/// values.
struct InsertionMarks {
  static constexpr std::uint8_t no_local = 0xFF;

  RawVector<std::uint8_t> in_cavity;  ///< by cell
  std::vector<std::uint8_t> local;    ///< by vertex: its number on the cavity's border, or `no_local`
};

/// The parts of space in which several threads insert at the same time.
struct InsertionParts {
  using Part = std::uint16_t;

  std::span<const Part> of_vertex;
  Part own;

  /// Are finite vertices of a cell in different parts?
  bool is_shared(const Cell& cell) const {
    const auto& v = cell.vertices;
    const Part part = of_vertex[v[0]];
    return of_vertex[v[1]] != part || of_vertex[v[2]] != part || (v[3] != ghost_vertex && of_vertex[v[3]] != part);
  }
  /// Is the cell behind a face of a cell of this part shared?
  ///
  /// \param code  of the face in that cell
  bool is_shared_behind_own(const Cell& cell, std::uint32_t code) const {
    const std::uint32_t apex = cell.vertices[face_of(code)];
    return apex != ghost_vertex && of_vertex[apex] != own;
  }
  /// Is the cell behind this face of a shared cell certain to be shared or of this part? If not, another thread may be
  /// replacing it.
  bool may_cross(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Part part = of_vertex[a];
    return part == own || of_vertex[b] != part || of_vertex[c] != part;
  }
};

/// New places for cells, for several insertions at the same time.
struct CellPool {
  std::uint32_t chunk;              ///< how many places are taken at a time
  std::uint32_t end;                ///< of all places
  std::atomic<std::uint32_t> next;  ///< the first place that is not taken
};

/// Inserts vertices into a tetrahedralization one by one, in three separate steps: find the cavity, examine it, fill
/// it. It owns the working memory and keeps it between insertions.
class Insertion {
 public:
  explicit Insertion(Delaunay& delaunay);
  /// \param marks  working memory to use instead of its own
  Insertion(Delaunay& delaunay, InsertionMarks& marks);
  /// One of several insertions at the same time, each in its own part. It changes no shared cell, except for the codes
  /// of its own faces.
  ///
  /// \param marks  of all cells and vertices, places of the pool included
  /// \param parts  of the vertices in the tetrahedralization
  /// \param free   places of dead cells, to take before those of the pool
  Insertion(Delaunay& delaunay, InsertionMarks& marks, const InsertionParts& parts, CellPool& pool,
            std::span<const std::uint32_t> free);

  /// Finds the cells whose (perturbed) circumsphere contains the vertex `v`, which is already in `delaunay.vertices`.
  /// \param start  a cell where the walk starts; the nearer, the faster
  /// \param ties   the rank of the vertex relative to those in the tetrahedralization
  /// \return false if the tetrahedralization has a vertex at this point (`twin()` returns it), or if a shared
  ///         cell is in the way (`twin()` is none)
  bool find_cavity(std::uint32_t v, std::uint32_t start, Ties ties = Ties::greatest_rank);

  /// Where the walk to a vertex starts: at the vertex before it, which is next to it on the Hilbert curve.
  ///
  /// \param other  the start if the vertex before it has no cells or is in another part
  std::uint32_t cell_near(std::uint32_t v, std::uint32_t other) const;

  std::span<const std::uint32_t> cavity_cells() const { return cavity_.items(); }
  std::span<const CavityFace> cavity_faces() const { return border_.items(); }
  std::uint32_t twin() const { return twin_; }
  /// The cell where the walk ended.
  std::uint32_t reached() const { return reached_; }
  bool in_cavity(std::uint32_t cell) const { return marks_.in_cavity[cell] != 0; }
  /// The bytes of the marks of cells and vertices; the rest of the working memory is small.
  std::size_t bytes() const { return bytes_of(marks_.in_cavity) + d_.vertices.size() * sizeof(marks_.local[0]); }

  /// Discards the cavity and changes nothing.
  void discard_cavity();
  /// Places that one of several insertions has left over.
  std::span<const std::uint32_t> free_places() const { return free_places_; }
  /// Is there room for the cells that will fill the cavity?
  bool has_room();
  /// Joins the new vertex to the border of the cavity. There must be room for the cells.
  /// \return one of the new cells
  std::uint32_t fill_cavity();
  /// The cells that filled the last cavity, in its order of faces; valid until the next one is filled.
  std::span<const std::uint32_t> new_cells() const { return places_; }

 private:
  /// A list with room for more items.
  template <class T>
  struct List {
    std::vector<T> slots = std::vector<T>(256);
    std::size_t size = 0;

    std::span<const T> items() const { return {slots.data(), size}; }
  };
  template <class T>
  static void make_room(std::vector<T>& slots, std::size_t count) {
    if (count > slots.size()) slots.resize(2 * count);
  }

  bool is_shared(std::uint32_t cell) const { return pool_ != nullptr && parts_.is_shared(d_.cells[cell]); }
  template <bool in_part>
  std::uint32_t walk(std::uint32_t start);
  unsigned first_face(unsigned faces) const;
  unsigned faces_to_cross(const Cell& cell) const;
  template <bool in_part>
  bool grow_cavity(std::uint32_t first);
  unsigned conflicting_neighbors(const Cell& cell, unsigned open) const;
  bool conflicts(const Cell& cell) const;
  bool conflicts_in_doubt(const Cell& cell, Sign sign) const;
  bool ghost_conflicts(const Cell& ghost) const;
  void choose_places();
  std::uint32_t make_cell(const CavityFace& face, std::uint32_t place) const;
  template <std::size_t side>
  void connect_by_table(RawVector<std::uint32_t>& codes);
  void connect_by_search();

  std::vector<std::uint32_t>& free_cells() { return pool_ == nullptr ? d_.free_cells : free_places_; }
  std::uint8_t& local_of(std::uint32_t v) { return v == ghost_vertex ? local_of_ghost_ : marks_.local[v]; }

  Delaunay& d_;
  InsertionMarks own_marks_;
  InsertionMarks& marks_;
  const InsertionParts parts_ = {};
  CellPool* const pool_ = nullptr;
  std::vector<std::uint32_t> free_places_;  ///< with a pool
  std::uint32_t v_ = 0, twin_ = 0, reached_ = 0;
  Ties ties_ = Ties::greatest_rank;
  Point3 p_;
  unsigned turn_ = 0;
  List<std::uint32_t> cavity_;
  List<CavityFace> border_;
  std::vector<std::uint32_t> places_;  ///< of the new cells, one for each face of the border
  // Vertices of the border get small local numbers, so that its directed edges are places in a small table of face
  // codes. Few cavities need the large table, which exceeds the fastest cache.
  static constexpr std::size_t table_side = 64, large_table_side = 254;
  std::uint8_t local_of_ghost_ = InsertionMarks::no_local;
  RawVector<std::uint32_t> table_, large_table_;
  HashTable<std::uint64_t, std::uint32_t>
      waiting_;  ///< the same for the largest cavities: by directed edge, a face code
};

}  // namespace ccdt::delaunay
