// The walk. Tetrahedra and vertices are numbered in the order in which they are met. A tetrahedron that is met first of
// all (of its part of the mesh) is a seed: its four vertices are written down. All others are met across a face of one
// that was met before. For each tetrahedron, in the order in which they were met, one step is written for each face
// that it was not met across:
//   0  nothing new is there: no tetrahedron, or one that was met already;
//   1  a new tetrahedron with a new vertex;
//   2  a new tetrahedron with a vertex that was met already, which follows among the codes.
// A new tetrahedron has the corners of that face, counterclockwise from outside, and then its fourth vertex.
//
// A known vertex is most often joined already to the corners of the face. So what is written is its rank among all
// vertices that are joined to a corner: first those joined to more corners, then those met later. Where it is not among
// the first 255, the code is 255, followed by its number in three bytes.
#include "bench/results/compact_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <unordered_map>
#include <utility>

#include "bench/results/kept_mesh.h"

namespace ccdt::results {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr int bits = 20;  ///< of a coordinate
constexpr std::uint32_t no_rank = 255;

/// The faces of a positively oriented cell, each opposite the corner of its number, normals outward.
constexpr std::array<std::array<std::uint32_t, 3>, 4> faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

enum Step : std::uint8_t { nothing_new, new_vertex, known_vertex };

using Tetrahedron = std::array<std::uint32_t, 4>;

/// The output.
struct Walk {
  std::vector<std::uint8_t> steps, codes;
  std::vector<std::uint32_t> vertices, cells;  ///< their numbers in the mesh, in the order in which they were met
};

/// Across each face of each cell, the cell beyond it; `none` on the boundary.
std::vector<std::uint32_t> neighbors_of(std::span<const Tetrahedron> cells) {
  struct Hash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& f) const {
      return (f[0] * std::size_t{0x9e3779b97f4a7c15} + f[1]) * std::size_t{0xff51afd7ed558ccd} + f[2];
    }
  };
  std::vector<std::uint32_t> neighbors(4 * cells.size(), none);
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, Hash> open;
  for (std::uint32_t face = 0; face < neighbors.size(); ++face) {
    const Tetrahedron& cell = cells[face / 4];
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = cell[faces[face % 4][i]];
    std::ranges::sort(corners);
    const auto [found, is_first] = open.emplace(corners, face);
    if (is_first) continue;
    neighbors[face] = found->second / 4;
    neighbors[found->second] = face / 4;
    open.erase(found);
  }
  return neighbors;
}

/// The vertices, in the order in which they were met, that are joined by an edge so far.
class Edges {
 public:
  explicit Edges(std::size_t vertices) : joined_(vertices), corners_(vertices, 0) {}

  void join_all(const Tetrahedron& cell) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (std::ranges::find(joined_[cell[i]], cell[j]) != joined_[cell[i]].end()) continue;
        joined_[cell[i]].push_back(cell[j]);
        joined_[cell[j]].push_back(cell[i]);
      }
  }

  /// The rank of a vertex beyond a face whose cell has the apex.
  std::uint32_t rank_of(std::uint32_t vertex, std::span<const std::uint32_t, 3> face, std::uint32_t apex) {
    candidates_.clear();
    for (const std::uint32_t corner : face)
      for (const std::uint32_t v : joined_[corner])
        if (corners_[v]++ == 0) candidates_.push_back(v);
    const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
      return corners_[a] != corners_[b] ? corners_[a] > corners_[b] : a > b;
    };
    std::uint32_t rank = corners_[vertex] == 0 ? no_rank : 0;
    if (rank != no_rank)
      for (const std::uint32_t v : candidates_)
        if (v != apex && std::ranges::find(face, v) == face.end()) rank += is_before(v, vertex);
    for (const std::uint32_t v : candidates_) corners_[v] = 0;
    return std::min(rank, no_rank);
  }

 private:
  std::vector<std::vector<std::uint32_t>> joined_;
  std::vector<std::uint8_t> corners_;  ///< how many corners of the face a candidate is joined to
  std::vector<std::uint32_t> candidates_;
};

/// Walks over the mesh; see above.
class Walker {
 public:
  Walker(std::span<const Tetrahedron> cells, std::size_t vertices)
      : cells_(cells),
        neighbors_(neighbors_of(cells)),
        numbers_(vertices, none),
        is_met_(cells.size()),
        edges_(vertices) {}

  Walk walk() {
    for (std::uint32_t seed = 0; seed < cells_.size(); ++seed) {
      if (is_met_[seed]) continue;
      for (const std::uint32_t v : cells_[seed]) {
        meet_vertex(v);
        write_number(numbers_[v]);
      }
      meet(seed, cells_[seed], none);
      for (; next_ < met_.size(); ++next_) leave(met_[next_]);
    }
    return std::move(walk_);
  }

 private:
  struct Met {
    std::uint32_t cell, from;
    Tetrahedron corners;  ///< their numbers in the mesh, in our order
  };

  bool meet_vertex(std::uint32_t vertex) {
    if (numbers_[vertex] != none) return false;
    numbers_[vertex] = static_cast<std::uint32_t>(walk_.vertices.size());
    walk_.vertices.push_back(vertex);
    return true;
  }

  void meet(std::uint32_t cell, const Tetrahedron& corners, std::uint32_t from) {
    is_met_[cell] = true;
    met_.push_back({cell, from, corners});
    walk_.cells.push_back(cell);
    Tetrahedron numbers{};
    for (std::size_t i = 0; i < 4; ++i) numbers[i] = numbers_[corners[i]];
    edges_.join_all(numbers);
  }

  void write_number(std::uint32_t number) {
    for (const int shift : {0, 8, 16}) walk_.codes.push_back(static_cast<std::uint8_t>(number >> shift));
  }

  /// The cell across the face opposite a corner.
  std::uint32_t beyond(const Met& met, std::uint32_t corner) const {
    const auto at = std::ranges::find(cells_[met.cell], corner) - cells_[met.cell].begin();
    return neighbors_[4 * met.cell + static_cast<std::size_t>(at)];
  }

  void leave(const Met met) {  // a copy: more are met
    // A cell that is not a seed was met across the face opposite its last corner.
    for (std::size_t i = 0; i < (met.from == none ? 4 : 3); ++i) {
      const std::uint32_t cell = beyond(met, met.corners[i]);
      if (cell == none || is_met_[cell]) {
        walk_.steps.push_back(nothing_new);
        continue;
      }
      Tetrahedron corners = {met.corners[faces[i][0]], met.corners[faces[i][1]], met.corners[faces[i][2]], none};
      const std::span<const std::uint32_t, 3> face(corners.data(), 3);
      corners[3] =
          *std::ranges::find_if(cells_[cell], [&](auto v) { return std::ranges::find(face, v) == face.end(); });
      write_apex(corners, met.corners[i]);
      meet(cell, corners, met.cell);
    }
  }

  void write_apex(const Tetrahedron& corners, std::uint32_t apex_before) {
    if (meet_vertex(corners[3])) {
      walk_.steps.push_back(new_vertex);
      return;
    }
    walk_.steps.push_back(known_vertex);
    const std::array<std::uint32_t, 3> face = {numbers_[corners[0]], numbers_[corners[1]], numbers_[corners[2]]};
    const std::uint32_t rank = edges_.rank_of(numbers_[corners[3]], face, numbers_[apex_before]);
    walk_.codes.push_back(static_cast<std::uint8_t>(rank));
    if (rank == no_rank) write_number(numbers_[corners[3]]);
  }

  std::span<const Tetrahedron> cells_;
  std::vector<std::uint32_t> neighbors_, numbers_;
  std::vector<bool> is_met_;
  Edges edges_;
  std::vector<Met> met_;
  std::size_t next_ = 0;
  Walk walk_;
};

std::string packed_bytes(const std::vector<std::uint8_t>& bytes) {
  return packed(bytes.data(), bytes.size());
}

/// The differences between consecutive numbers, with the sign in the lowest bit. Bytes of the same place are stored
/// together: they are similar, so they compress well.
std::string packed_differences(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t places = 4;
  std::vector<std::uint8_t> bytes(places * numbers.size());
  std::int64_t before = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t difference = numbers[i] - before;
    before = numbers[i];
    const std::uint64_t code =
        difference < 0 ? 2 * static_cast<std::uint64_t>(-difference) - 1 : 2 * static_cast<std::uint64_t>(difference);
    for (std::size_t place = 0; place < places; ++place)
      bytes[place * numbers.size() + i] = static_cast<std::uint8_t>(code >> (8 * place));
  }
  return packed_bytes(bytes);
}

/// Five steps per byte.
std::string packed_steps(const std::vector<std::uint8_t>& steps) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < steps.size(); i += 5) {
    unsigned byte = 0;
    for (std::size_t j = std::min(i + 5, steps.size()); j-- > i;) byte = 3 * byte + steps[j];
    bytes.push_back(static_cast<std::uint8_t>(byte));
  }
  return packed_bytes(bytes);
}

template <class Number>
std::vector<Number> numbers_of(const bench::Json& packed_array) {
  const std::string bytes = unpacked(packed_array.get<std::string>());
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::copy_n(bytes.data(), numbers.size() * sizeof(Number), reinterpret_cast<char*>(numbers.data()));
  return numbers;
}

/// The smallest cube around the points, with its least corner.
struct Box {
  std::array<float, 3> low{};
  double size = 0;
};

Box box_of(const std::vector<float>& points) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (std::size_t i = axis; i < points.size(); i += 3) {
      low = std::min(low, points[i]);
      high = std::max(high, points[i]);
    }
    box.low[axis] = points.empty() ? 0 : low;
    box.size = std::max(box.size, points.empty() ? 0.0 : static_cast<double>(high) - static_cast<double>(low));
  }
  return box;
}

}  // namespace

bench::Json compact_mesh(const bench::Json& kept) {
  const auto points = numbers_of<float>(kept.at("points"));
  const auto corners = numbers_of<std::uint32_t>(kept.at("cells"));
  const auto regions = numbers_of<std::int32_t>(kept.at("regions"));
  std::vector<Tetrahedron> cells(corners.size() / 4);
  for (std::size_t i = 0; i < corners.size(); ++i) cells[i / 4][i % 4] = corners[i];
  const Walk walk = Walker(cells, points.size() / 3).walk();

  const Box box = box_of(points);
  const double steps = box.size > 0 ? ((1 << bits) - 1) / box.size : 0;
  bench::Json axes = bench::Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::int64_t> places;
    for (const std::uint32_t v : walk.vertices)
      places.push_back(std::llround((static_cast<double>(points[3 * v + axis]) - box.low[axis]) * steps));
    axes.push_back(packed_differences(places));
  }
  std::vector<std::int64_t> met_regions;
  for (const std::uint32_t cell : walk.cells) met_regions.push_back(regions.at(cell));
  return {{"schema", "ccdt.pagemesh/1"},
          {"title", kept.at("title")},
          {"vertices", walk.vertices.size()},
          {"tetrahedra", cells.size()},
          {"low", box.low},
          {"step", steps > 0 ? 1 / steps : 0},
          {"coordinates", axes},
          {"numbers", packed_differences({walk.vertices.begin(), walk.vertices.end()})},
          {"steps", packed_steps(walk.steps)},
          {"codes", packed_bytes(walk.codes)},
          {"regions", packed_differences(met_regions)}};
}

}  // namespace ccdt::results
