#include "engine/front/find_delaunay_faces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/simplex_map.h"

namespace ccdt::front {
namespace {

using delaunay::no_neighbor;

/// A filter in front of a set of triangles (Bloom 1970), which rejects most of those that are not in the set. It is
/// fast because it is small, and because the order of the corners does not matter.
class FaceFilter {
 public:
  FaceFilter() = default;
  explicit FaceFilter(std::span<const std::array<VertexId, 3>> triangles)
      : bits_(std::bit_ceil(triangles.size() / 4 + 1)), shift_(58 - std::countr_zero(bits_.size())) {
    for (const auto& [a, b, c] : triangles) {
      const std::uint64_t place = place_of(odd(a) * odd(b) * odd(c));
      bits_[place / 64] |= std::uint64_t{1} << place % 64;
    }
  }

  /// A bit for each face of a cell that may be in the set.
  unsigned may_have_faces(const std::array<std::uint32_t, 4>& v) const {
    const std::uint64_t a = odd(v[0]), b = odd(v[1]), c = odd(v[2]), d = odd(v[3]);
    return bit_of(b * c * d) | bit_of(a * c * d) << 1 | bit_of(a * b * d) << 2 | bit_of(a * b * c) << 3;
  }

 private:
  static std::uint64_t odd(std::uint32_t v) { return 2 * std::uint64_t{v} + 1; }
  std::uint64_t place_of(std::uint64_t product) const { return product * 0x9E3779B97F4A7C15u >> shift_; }
  unsigned bit_of(std::uint64_t product) const {
    const std::uint64_t place = place_of(product);
    return static_cast<unsigned>(bits_[place / 64] >> place % 64 & 1);
  }

  std::vector<std::uint64_t> bits_;  ///< a power of two of words, about 16 bits for each triangle
  int shift_ = 0;
};

/// A bit for each face of a cell that this cell tests, not its neighbor.
///
/// \param vertices  ids from here on belong to vertices without faces
unsigned faces_to_test(std::uint32_t c, std::uint32_t vertices, const delaunay::Delaunay& delaunay) {
  const auto& [v, neighbors] = delaunay.cells[c];
  unsigned inner = 0;  // a bit for each corner without faces
  for (std::uint32_t k = 0; k < 4; ++k) inner |= unsigned{v[k] >= vertices} << k;
  if ((inner & (inner - 1)) != 0 || delaunay.is_dead(c)) return 0;
  unsigned tested = 0;
  for (std::uint32_t f = 0; f < 4; ++f) tested |= unsigned{delaunay::face_code(c, f) < neighbors[f]} << f;
  return inner != 0 ? tested & inner : tested;
}

/// The corners of a face as a cell sees them. Are they those of the triangle in its order, so that the cell is above
/// it?
bool sees_in_order(const std::array<std::uint32_t, 3>& face, const std::array<VertexId, 3>& t) {
  const auto& [p, q, r] = face;
  return (p == t[0] && q == t[1] && r == t[2]) || (q == t[0] && r == t[1] && p == t[2]) ||
         (r == t[0] && p == t[1] && q == t[2]);
}

/// The code of the triangle in the cell above it if it is still the face with this code; `no_neighbor` if it is not.
std::uint32_t confirm(std::uint32_t code, const std::array<VertexId, 3>& triangle, const delaunay::Delaunay& delaunay) {
  const std::uint32_t c = delaunay::cell_of(code);
  if (c >= delaunay.cells.size() || delaunay.is_dead(c)) return no_neighbor;
  const auto [p, q, r] = delaunay::corners_of_face(delaunay.cells[c].vertices, delaunay::face_of(code));
  if (sees_in_order({p, q, r}, triangle)) return code;
  return sees_in_order({q, p, r}, triangle) ? delaunay.across(code) : no_neighbor;
}

/// The same as `find_delaunay_faces`, but few triangles are looked for one by one, not in all cells.
std::vector<std::uint32_t> find_others(const std::vector<std::array<VertexId, 3>>& triangles,
                                       const delaunay::Delaunay& delaunay) {
  constexpr std::size_t cells_a_triangle = 64;  // that could be looked at instead
  if (triangles.size() > delaunay.cells.size() / cells_a_triangle) return find_delaunay_faces(triangles, delaunay);
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

/// Of the triangles with this code, or that of its other side, only the first keeps it.
void keep_first(std::uint32_t code, const delaunay::Delaunay& delaunay, std::vector<std::uint32_t>& codes) {
  const std::uint32_t other_side = delaunay.across(code);
  bool is_first = true;
  for (std::uint32_t& its : codes)
    if ((its == code || its == other_side) && !std::exchange(is_first, false)) its = no_neighbor;
}

}  // namespace

std::vector<std::uint32_t> find_delaunay_faces(const std::vector<std::array<VertexId, 3>>& triangles,
                                               const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(triangles.size(), no_neighbor);
  std::uint32_t vertices = 0;
  for (const auto& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  FaceMap faces;
  FaceFilter filter;
  parallel_both([&] { faces = FaceMap(triangles, vertices); }, [&] { filter = FaceFilter(triangles); });
  const auto look_up = [&](std::uint32_t code) {
    const delaunay::Cell& cell = delaunay.cells[delaunay::cell_of(code)];
    const auto [p, q, r] = delaunay::corners_of_face(cell.vertices, delaunay::face_of(code));
    const auto [face, is_below] = faces.find(p, q, r);
    if (face != FaceMap::none) codes[face] = is_below ? cell.neighbors[delaunay::face_of(code)] : code;
  };
  // One pass over the cells, most of which are inside and skipped at once. (The ghosts' faces are theirs too.)
  parallel_ranges(delaunay.cells.size(), 4096, [&](std::size_t begin, std::size_t end) {
    std::array<std::uint32_t, 256> candidates;
    std::size_t count = 0;
    const auto look_up_candidates = [&] {
      for (std::size_t i = 0; i < count; ++i) look_up(candidates[i]);
      count = 0;
    };
    for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c) {
      const unsigned tested = faces_to_test(c, vertices, delaunay);
      if (tested == 0) continue;
      const unsigned chosen = tested & filter.may_have_faces(delaunay.cells[c].vertices);
      for (std::uint32_t f = 0; f < 4; ++f) {  // no branch for each face: it would be mispredicted
        work_done.faces_tested += tested >> f & 1;
        candidates[count] = delaunay::face_code(c, f);
        count += chosen >> f & 1;
      }
      if (count + 4 > candidates.size()) look_up_candidates();
    }
    look_up_candidates();
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
  const auto others = parallel_collect<std::uint32_t>(
      codes.size(), 4096, [&](std::size_t i, std::size_t end, std::vector<std::uint32_t>& found) {
        for (; i < end; ++i)
          if (codes[i] == no_neighbor) found.push_back(static_cast<std::uint32_t>(i));
      });
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
