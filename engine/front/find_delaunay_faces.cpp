#include "engine/front/find_delaunay_faces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/filters.h"

namespace ccdt::front {
namespace {

using delaunay::no_neighbor;

// Four numbers, one for each corner or face of a cell. The compiler keeps them in one register of the processor.
using FourNumbers = std::uint32_t __attribute__((vector_size(16)));

CCDT_ALWAYS_INLINE void load(const std::array<std::uint32_t, 4>& numbers, FourNumbers& result) {
  std::memcpy(&result, &numbers, sizeof result);
}

/// A filter in front of a set of triangles (Bloom 1970), which rejects most of those that are not in the set. It is
/// fast because it is small, and because it hashes a triangle by the sum of its corners' hashes. So their order does
/// not matter, and the faces of a cell share these hashes.
class FaceFilter {
 public:
  FaceFilter() = default;
  explicit FaceFilter(std::span<const std::array<VertexId, 3>> triangles)
      : bits_(std::min(most_words, std::bit_ceil(triangles.size() / 2 + 1))),
        shift_(std::countr_zero(most_words) - std::countr_zero(bits_.size())) {
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t place = (mix(a.value) + mix(b.value) + mix(c.value)) >> shift_;
      bits_[place / 32] |= 1u << place % 32;
    }
  }

  /// For each face of a cell: one if it may be in the set, or zero.
  CCDT_ALWAYS_INLINE void may_have_faces(const std::array<std::uint32_t, 4>& v, FourNumbers& result) const {
    FourNumbers corners;
    load(v, corners);
    const FourNumbers mixed = mix(corners);
    const FourNumbers places = ((mixed[0] + mixed[1] + mixed[2] + mixed[3]) - mixed) >> shift_;
    const FourNumbers words = places / 32;
    result = FourNumbers{bits_[words[0]], bits_[words[1]], bits_[words[2]], bits_[words[3]]} >> places % 32 & 1;
  }

 private:
  template <class Number>
  static CCDT_ALWAYS_INLINE Number mix(Number v) {
    v *= 0x9E3779B1u;
    v ^= v >> 15;
    return v * 0x85EBCA77u;
  }

  static constexpr std::size_t most_words = std::size_t{1} << 27;  ///< as many bits as there are hashes

  std::vector<std::uint32_t> bits_;  ///< a power of two of words, about 16 bits for each triangle
  int shift_ = 0;
};

/// Given the corners of a face as seen from a cell: are they in the order of the triangle, so that the cell is above
/// it?
bool sees_in_order(const std::array<std::uint32_t, 3>& face, const std::array<VertexId, 3>& t) {
  const auto& [p, q, r] = face;
  return (p == t[0] && q == t[1] && r == t[2]) || (q == t[0] && r == t[1] && p == t[2]) ||
         (r == t[0] && p == t[1] && q == t[2]);
}

/// The code of the triangle in the cell above it, if it is still the face with this code; otherwise `no_neighbor`.
std::uint32_t confirm(std::uint32_t code, const std::array<VertexId, 3>& triangle, const delaunay::Delaunay& delaunay) {
  const std::uint32_t c = delaunay::cell_of(code);
  if (c >= delaunay.cells.size() || delaunay.is_dead(c)) return no_neighbor;
  const auto [p, q, r] = delaunay::corners_of_face(delaunay.cells[c].vertices, delaunay::face_of(code));
  if (sees_in_order({p, q, r}, triangle)) return code;
  return sees_in_order({q, p, r}, triangle) ? delaunay.across(code) : no_neighbor;
}

/// The same as `find_delaunay_faces`, but if there are few triangles, they are looked for one by one, not in all cells.
std::vector<std::uint32_t> find_others(const std::vector<std::array<VertexId, 3>>& triangles,
                                       const delaunay::Delaunay& delaunay) {
  constexpr std::size_t cells_per_triangle = 64;  // that could be visited instead
  if (triangles.size() > delaunay.cells.size() / cells_per_triangle) return find_delaunay_faces(triangles, delaunay);
  const FaceMap first(triangles, delaunay.vertices.size());
  std::vector<std::uint32_t> codes(triangles.size(), no_neighbor);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    if (first.find(a, b, c).index == i) codes[i] = delaunay::find_face(delaunay, a, b, c);
  }
  work_done.faces_tested += triangles.size();
  return codes;
}

/// Marks for faces of cells.
class FaceMarks {
 public:
  explicit FaceMarks(const delaunay::Delaunay& delaunay) : d_(delaunay), marks_(delaunay.cells.size()) {
    parallel_fill(std::span(marks_), std::uint8_t{0});
  }
  /// May be called on several threads.
  ///
  /// \return  was it set before?
  bool set(std::uint32_t code) {
    const std::uint32_t place = place_of(code);
    return (set_bits_(marks_[delaunay::cell_of(place)], bit_of(place)) & bit_of(place)) != 0;
  }
  bool has(std::uint32_t code) const {
    const std::uint32_t place = place_of(code);
    return (marks_[delaunay::cell_of(place)] & bit_of(place)) != 0;
  }

 private:
  std::uint32_t place_of(std::uint32_t code) const { return std::min(code, d_.across(code)); }
  static std::uint8_t bit_of(std::uint32_t code) { return static_cast<std::uint8_t>(1u << delaunay::face_of(code)); }

  const delaunay::Delaunay& d_;
  const SetBits set_bits_;
  RawVector<std::uint8_t> marks_;
};

/// Of the triangles with this code or its other side's, only the first keeps it.
void keep_first(std::uint32_t code, const delaunay::Delaunay& delaunay, std::vector<std::uint32_t>& codes) {
  const std::uint32_t other_side = delaunay.across(code);
  bool is_first = true;
  for (std::uint32_t& its : codes)
    if ((its == code || its == other_side) && !std::exchange(is_first, false)) its = no_neighbor;
}

/// Codes of faces that may be in the set: those of cells from `begin` on, until the list is full.
struct Candidates {
  std::array<std::uint32_t, 256> codes;
  std::size_t count = 0;
};

/// \return the first cell that was not looked at
CCDT_WIDE_LANES std::uint32_t choose_candidates(const delaunay::Delaunay& delaunay, const FaceFilter& filter,
                                                std::uint32_t begin, std::uint32_t end, Candidates& candidates) {
  std::uint32_t c = begin;
  std::size_t count = 0, tested = 0;
  for (; c < end && count + 4 <= candidates.codes.size(); ++c) {
    if (delaunay.is_dead(c)) continue;
    const delaunay::Cell& cell = delaunay.cells[c];
    FourNumbers neighbors, chosen;
    load(cell.neighbors, neighbors);
    const FourNumbers codes = FourNumbers{0, 1, 2, 3} + delaunay::face_code(c, 0);
    // Of two cells, one tests the face between them.
    const FourNumbers is_tested = (codes < neighbors) & 1;
    filter.may_have_faces(cell.vertices, chosen);
    chosen &= is_tested;
    for (int f = 0; f < 4; ++f) {  // no branch for each face: it would be mispredicted
      candidates.codes[count] = codes[f];
      count += chosen[f];
      tested += is_tested[f];
    }
  }
  candidates.count = count;
  work_done.faces_tested += tested;
  return c;
}

}  // namespace

std::vector<std::uint32_t> find_delaunay_faces(const std::vector<std::array<VertexId, 3>>& triangles,
                                               const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(triangles.size(), no_neighbor);
  FaceMap faces;
  FaceFilter filter;
  parallel_both([&] { faces = FaceMap(triangles, delaunay.vertices.size()); }, [&] { filter = FaceFilter(triangles); });
  // One pass over the cells. (Faces of ghosts are also faces of cells.)
  parallel_ranges(delaunay.cells.size(), 4096, [&](std::size_t begin, std::size_t end) {
    Candidates candidates;
    for (auto c = static_cast<std::uint32_t>(begin); c < end;) {
      c = choose_candidates(delaunay, filter, c, static_cast<std::uint32_t>(end), candidates);
      for (const std::uint32_t code : std::span(candidates.codes).first(candidates.count)) {
        const delaunay::Cell& cell = delaunay.cells[delaunay::cell_of(code)];
        const auto [p, q, r] = delaunay::corners_of_face(cell.vertices, delaunay::face_of(code));
        const auto [face, is_below] = faces.find(p, q, r);
        if (face != none) codes[face] = is_below ? cell.neighbors[delaunay::face_of(code)] : code;
      }
    }
  });
  work_done.cells_visited += delaunay.cells.size() - delaunay.free_cells.size();
  note_bytes(bytes_of(codes, triangles));
  return codes;
}

std::vector<std::uint32_t> find_delaunay_faces_again(const std::vector<std::array<VertexId, 3>>& triangles,
                                                     const std::vector<std::uint32_t>& earlier,
                                                     const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(triangles.size(), no_neighbor);
  FaceMarks is_confirmed(delaunay);
  auto repeated = parallel_collect<std::uint32_t>(
      triangles.size(), 4096, [&](std::size_t i, std::size_t end, std::vector<std::uint32_t>& again) {
        for (; i < end; ++i) {
          delaunay.prefetch_after(i, earlier);
          if (earlier[i] == no_neighbor) continue;
          ++work_done.faces_tested;
          codes[i] = confirm(earlier[i], triangles[i], delaunay);
          if (codes[i] != no_neighbor && is_confirmed.set(codes[i])) again.push_back(codes[i]);
        }
      });
  const auto others = parallel_select(codes.size(), 4096, [&](std::size_t i) { return codes[i] == no_neighbor; });
  std::vector<std::array<VertexId, 3>> their_corners(others.size());
  parallel_for(others.size(), 4096, [&](std::size_t i) { their_corners[i] = triangles[others[i]]; });
  const std::vector<std::uint32_t> found = find_others(their_corners, delaunay);
  parallel_for(others.size(), 4096, [&](std::size_t i) { codes[others[i]] = found[i]; });
  const auto known = parallel_collect<std::uint32_t>(
      found.size(), 4096, [&](std::size_t i, std::size_t end, std::vector<std::uint32_t>& again) {
        for (; i < end; ++i)
          if (found[i] != no_neighbor && is_confirmed.has(found[i])) again.push_back(found[i]);
      });
  repeated.insert(repeated.end(), known.begin(), known.end());
  for (const std::uint32_t code : repeated) keep_first(code, delaunay, codes);
  note_bytes(bytes_of(codes, earlier, others, their_corners, found));
  return codes;
}

}  // namespace ccdt::front
