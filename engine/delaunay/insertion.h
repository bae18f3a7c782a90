#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::delaunay {

/// The order in which points are inserted: a few rounds of growing size (a biased randomized insertion order, Amenta,
/// Choi and Rote 2003), each along a Hilbert curve, so that a point is near the one before it.
///
/// \return  the indices of the points, each once; depends on the points alone
std::vector<std::uint32_t> hilbert_order(std::span<const Point3> points);

/// A face between a cell that a new vertex destroys and one that it leaves.
struct CavityFace {
  std::array<std::uint32_t, 3> vertices;  ///< the new vertex is above them
  std::uint32_t outside;                  ///< code of the face in the cell that stays
};

/// How it is decided whether a new vertex that is on a sphere is in it.
enum class Ties {
  greatest_rank,  ///< it is not: no vertex in the tetrahedralization has a greater rank
  any_rank        ///< by comparing all ranks
};

/// Inserts vertices into a tetrahedralization one by one, in three steps that may be taken apart: find the cavity, look
/// at it, fill it. It owns the working memory, which is kept from one insertion to the next.
class Insertion {
 public:
  explicit Insertion(Delaunay& delaunay);

  /// Finds the cells whose (perturbed) circumsphere the vertex `v`, already in `delaunay.vertices`, is in.
  /// \param start  a cell to walk from; the nearer the quicker
  /// \param ties   what the rank of the vertex is among those that are in the tetrahedralization
  /// \return false if a vertex with this very point is in the tetrahedralization (`twin()` tells which)
  bool find_cavity(std::uint32_t v, std::uint32_t start, Ties ties = Ties::greatest_rank);

  std::span<const std::uint32_t> cavity_cells() const { return cavity_.items(); }
  std::span<const CavityFace> cavity_faces() const { return border_.items(); }
  std::uint32_t twin() const { return twin_; }
  bool in_cavity(std::uint32_t cell) const { return mark_[cell] == Mark::conflict; }
  /// Of the marks of cells and vertices; the rest of the working memory is small.
  std::size_t bytes() const { return bytes_of(mark_) + d_.vertices.size() * sizeof(local_[0]); }

  /// Forgets the cavity and leaves all as it was.
  void discard_cavity();
  /// Joins the new vertex to the border of the cavity.
  /// \return one of the new cells
  std::uint32_t fill_cavity();

 private:
  enum class Mark : std::uint8_t { unknown, conflict, outside };

  /// A list that is checked for space before several additions, not at each of them.
  template <class T>
  struct List {
    std::vector<T> slots = std::vector<T>(256);
    std::size_t size = 0;

    void reserve_more(std::size_t more) {
      if (size + more > slots.size()) slots.resize(2 * (size + more));
    }
    void add(const T& item) { slots[size++] = item; }
    std::span<const T> items() const { return {slots.data(), size}; }
  };

  std::uint32_t walk(const Point3& p, std::uint32_t start);
  void spread(std::uint32_t first);
  bool conflicts(const Cell& cell) const;
  bool conflicts_exactly(const Cell& cell) const;
  bool ghost_conflicts(const Cell& ghost) const;
  void number_border_vertices();
  void choose_places();
  std::uint32_t make_cell(const CavityFace& face, std::uint32_t place) const;
  void connect_by_table();
  void connect_by_search();

  Delaunay& d_;
  std::uint32_t v_ = 0, twin_ = 0;
  Ties ties_ = Ties::greatest_rank;
  Point3 p_;
  unsigned turn_ = 0;
  std::vector<Mark> mark_;
  List<std::uint32_t> cavity_, outside_;
  List<CavityFace> border_;
  std::vector<std::uint32_t> places_;  ///< of the new cells, one for each face of the border
  // Vertices of the border get small local numbers, so that its directed edges are places in a small table. An entry
  // holds the number of the insertion that wrote it, above a face code.
  static constexpr std::uint32_t table_side = 64;
  std::vector<std::uint8_t> local_;  // by vertex + 1 (the ghost wraps round to 0); no_local: none
  std::vector<std::uint32_t> border_vertices_;
  std::vector<std::uint64_t> table_;
  std::uint64_t insertions_ = 0;
};

}  // namespace ccdt::delaunay
