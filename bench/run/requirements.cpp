#include "bench/run/requirements.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/run/numbers.h"
#include "bench/run/quality.h"
#include "engine/base/box.h"
#include "engine/base/digits.h"
#include "engine/base/parallel.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt::bench {
namespace {

using Spot = MissedRequirement::Spot;

/// A tetrahedron that misses a requirement. The greater the badness, the worse it is.
struct BadTetrahedron {
  double badness, value;
  std::size_t number;

  bool is_worse_than(const BadTetrahedron& other) const {
    return badness != other.badness ? badness > other.badness : number < other.number;
  }
};

/// How bad a tetrahedron is, and the value that a reader gets.
struct Badness {
  double badness, value;
};

Badness of_angles(const std::array<Point3, 4>& t) {
  const std::array<double, 6> angles = dihedral_angles(t);
  const auto [least, most] = std::ranges::minmax(angles);
  return least <= 180 - most ? Badness{-least, least} : Badness{most - 180, most};
}

Badness of_r(const std::array<Point3, 4>& t) {
  const double r = shape_measure(t);
  return {r, r};
}

/// \param limit  a greater badness misses the requirement
MissedRequirement find_bad(const mesh::TetMesh& mesh, Badness (*measure)(const std::array<Point3, 4>&), double limit) {
  constexpr std::size_t chunk_length = 8192, most_spots = 5;
  // A power of two changes no digit, and products of lengths neither overflow nor vanish.
  const double extent = largest_extent(mesh.vertices);
  const double scale = extent > 0 ? std::ldexp(1, -std::ilogb(extent)) : 1;
  std::vector<BadTetrahedron> bad;
  const auto look = [&](std::size_t begin, std::size_t end, std::vector<BadTetrahedron>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      std::array<Point3, 4> t;
      for (std::size_t k = 0; k < 4; ++k) t[k] = scale * mesh.vertices[mesh.tetrahedra[i][k]];
      if (const auto [badness, value] = measure(t); badness > limit) found.push_back({badness, value, i});
    }
  };
  bad = parallel_collect<BadTetrahedron>(mesh.tetrahedra.size(), chunk_length, look);
  MissedRequirement missed;
  missed.count = bad.size();
  const std::size_t spots = std::min(most_spots, bad.size());
  std::ranges::partial_sort(bad, bad.begin() + static_cast<std::ptrdiff_t>(spots),
                            [](const auto& a, const auto& b) { return a.is_worse_than(b); });
  for (std::size_t i = 0; i < spots; ++i) {
    Point3 center;
    for (const std::uint32_t v : mesh.tetrahedra[bad[i].number]) center = center + 0.25 * mesh.vertices[v];
    missed.worst.push_back({as_array(center), bad[i].value});
  }
  return missed;
}

std::string text_of(const Spot& spot) {
  const auto& [x, y, z] = spot.at;
  return rounded(spot.value) + " at (" + rounded(x, 6) + ", " + rounded(y, 6) + ", " + rounded(z, 6) + ")";
}

}  // namespace

std::vector<MissedRequirement> find_missed(const Requirements& required, const mesh::TetMesh& mesh,
                                           const std::optional<surface::SurfaceChange>& change) {
  std::vector<MissedRequirement> all;
  const auto add = [&](const char* name, double limit, MissedRequirement missed) {
    if (missed.count == 0) return;
    missed.name = name, missed.limit = limit;
    all.push_back(std::move(missed));
  };
  if (required.dihedral_degrees)
    add("dihedral_degrees", *required.dihedral_degrees, find_bad(mesh, of_angles, -*required.dihedral_degrees));
  if (required.r) add("r", *required.r, find_bad(mesh, of_r, *required.r));
  if (const auto& limit = required.deviation; limit && change && change->distance > *limit)
    all.push_back({"deviation", *limit, 1, {{change->farthest, change->distance}}});
  return all;
}

std::string words_of(const MissedRequirement& missed, std::uint64_t tetrahedra) {
  std::string text;
  if (missed.name == "deviation") {
    text = "the new surface may be farther than " + digits(missed.limit) + " from the old one: ";
  } else {
    text = with_separators(missed.count) + " of " + with_separators(tetrahedra) + " tetrahedra have ";
    text += missed.name == "r" ? "an r above " + digits(missed.limit)
                               : "a dihedral angle below " + digits(missed.limit) + " or above " +
                                     digits(180 - missed.limit) + " degrees";
    text += "; the worst: ";
  }
  for (std::size_t i = 0; i < missed.worst.size(); ++i) text += (i > 0 ? ", " : "") + text_of(missed.worst[i]);
  return text;
}

}  // namespace ccdt::bench
