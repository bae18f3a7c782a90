#include "baselines/mesh_cleanup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <utility>

namespace ccdt::baselines {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr std::uint32_t none = 0xFFFFFFFFu;

double signed_volume(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  const auto& v = mesh.vertices;
  return dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6;
}

/// A face of a tetrahedron.
struct Side {
  Face sorted, face;  ///< its vertices sorted, and counterclockwise as seen from outside the tetrahedron
  std::uint32_t tetrahedron, opposite_corner;
};

Face sorted(Face face) {
  std::ranges::sort(face);
  return face;
}

/// All faces of all tetrahedra; the two sides of an inner face are consecutive.
std::vector<Side> sides_of(const TetMesh& mesh) {
  constexpr std::array<std::array<std::uint32_t, 4>, 4> corners = {
      {{0, 2, 1, 3}, {0, 1, 3, 2}, {1, 2, 3, 0}, {0, 3, 2, 1}}};
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const auto& [a, b, c, opposite] : corners) {
      const auto& v = mesh.tetrahedra[t];
      const Face face = {v[a], v[b], v[c]};
      sides.push_back({sorted(face), face, t, opposite});
    }
  std::ranges::sort(sides, {}, &Side::sorted);
  return sides;
}

/// The other side of a face of a tetrahedron.
struct Neighbor {
  std::uint32_t tetrahedron = none;
  bool is_across_facet = false;
};

/// The neighbors of each tetrahedron across its faces, by the opposite corner; `none` outside the mesh.
std::vector<std::array<Neighbor, 4>> neighbors_of(const TetMesh& mesh) {
  std::vector<Face> facets;
  facets.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) facets.push_back(sorted(face));
  std::ranges::sort(facets);

  const std::vector<Side> sides = sides_of(mesh);
  std::vector<std::array<Neighbor, 4>> neighbors(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& a = sides[i];
    const bool is_facet = std::ranges::binary_search(facets, a.sorted);
    neighbors[a.tetrahedron][a.opposite_corner].is_across_facet = is_facet;
    if (i + 1 == sides.size() || sides[i + 1].sorted != a.sorted) continue;
    const Side& b = sides[++i];
    neighbors[a.tetrahedron][a.opposite_corner] = {b.tetrahedron, is_facet};
    neighbors[b.tetrahedron][b.opposite_corner] = {a.tetrahedron, is_facet};
  }
  return neighbors;
}

/// For each tetrahedron: is an odd number of facets between it and infinity? Some programs fill the convex hull and
/// list only facets. Others omit the outer boundary, which then consists of facets.
std::vector<char> find_parities(const TetMesh& mesh) {
  const auto neighbors = neighbors_of(mesh);
  const auto is_outside = [](const Neighbor& next) { return next.tetrahedron == none; };
  const bool lists_outside = std::ranges::any_of(neighbors, [&](const auto& around) {
    return std::ranges::any_of(around, [&](const Neighbor& n) { return is_outside(n) && n.is_across_facet; });
  });
  std::vector<char> parity(mesh.tetrahedra.size(), -1);
  std::deque<std::uint32_t> open;  // a breadth-first fill from the hull inward
  const auto visit = [&](std::uint32_t t, int value) {
    if (parity[t] >= 0) return;
    parity[t] = static_cast<char>(value);
    open.push_back(t);
  };
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto outside = std::ranges::find_if(neighbors[t], is_outside);
    if (outside == neighbors[t].end()) continue;
    visit(t, static_cast<int>(!lists_outside || outside->is_across_facet));
    while (!open.empty()) {
      const std::uint32_t here = open.front();
      open.pop_front();
      for (const Neighbor& next : neighbors[here])
        if (next.tetrahedron != none) visit(next.tetrahedron, parity[here] ^ static_cast<int>(next.is_across_facet));
    }
  }
  return parity;
}

/// Keeps the entries of an array, and of its attributes if there are any, for which `keep` is true.
template <class Element, class Attribute, class Keep>
void filter(std::vector<Element>& elements, std::vector<Attribute>& attributes, Keep keep) {
  const bool with_attributes = attributes.size() == elements.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!keep(i)) continue;
    elements[kept] = elements[i];
    if (with_attributes) attributes[kept] = attributes[i];
    ++kept;
  }
  elements.resize(kept);
  if (with_attributes) attributes.resize(kept);
}

void drop_unused_vertices(TetMesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), none);
  for (const auto& t : mesh.tetrahedra)
    for (const auto v : t) renumbered[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (renumbered[v] == none) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    renumbered[v] = kept++;
  }
  mesh.vertices.resize(kept);
  const auto is_removed = [&](const auto& element) {
    return std::ranges::any_of(element, [&](std::uint32_t v) { return renumbered[v] == none; });
  };
  filter(mesh.faces, mesh.face_markers, [&](std::size_t i) { return !is_removed(mesh.faces[i]); });
  filter(mesh.edges, mesh.edge_markers, [&](std::size_t i) { return !is_removed(mesh.edges[i]); });
  for (auto& t : mesh.tetrahedra)
    for (auto& v : t) v = renumbered[v];
  for (auto& face : mesh.faces)
    for (auto& v : face) v = renumbered[v];
  for (auto& edge : mesh.edges)
    for (auto& v : edge) v = renumbered[v];
}

using Coordinates = std::array<double, 3>;
using Rounding = double (*)(double);

template <int Digits>
double in_digits(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", Digits, value);
  return std::strtod(text.data(), nullptr);
}

double in_single_precision(double value) {
  return static_cast<float>(value);
}

/// For coordinates that are read from a binary STL and written as text.
template <int Digits>
double in_digits_of_single_precision(double value) {
  return in_digits<Digits>(in_single_precision(value));
}

/// The ways in which programs and formats round, the finest first.
constexpr std::array<Rounding, 6> roundings = {in_digits<16>,
                                               in_digits<15>,
                                               in_digits<11>,
                                               in_single_precision,
                                               in_digits_of_single_precision<16>,
                                               in_digits_of_single_precision<9>};

/// Adding zero turns -0 into +0, so that equal coordinates also compare and sort as equal.
Coordinates key(const Point3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

Coordinates rounded(const Point3& p, Rounding rounding) {
  return key({rounding(p.x), rounding(p.y), rounding(p.z)});
}

/// A vertex of the mesh and its new coordinates.
struct Restored {
  std::size_t vertex = 0;
  Point3 before, after;
};

/// The vertices of the mesh whose coordinates are not in the input, by coordinates; and vice versa.
struct UnmatchedVertices {
  std::map<Coordinates, std::size_t> of_mesh;
  std::vector<Point3> of_input;
};

UnmatchedVertices find_unmatched(const std::vector<Point3>& input, const std::vector<Point3>& vertices) {
  UnmatchedVertices unmatched;
  for (std::size_t v = 0; v < vertices.size(); ++v) unmatched.of_mesh.try_emplace(key(vertices[v]), v);
  for (const Point3& p : input)
    if (!unmatched.of_mesh.contains(key(p))) unmatched.of_input.push_back(p);
  if (unmatched.of_input.empty()) return {};
  std::vector<Coordinates> known;
  for (const Point3& p : input) known.push_back(key(p));
  for (const Coordinates& coordinates : known) unmatched.of_mesh.erase(coordinates);
  return unmatched;
}

/// Matches vertices that are equal after rounding, and removes them from the unmatched ones. Input vertices that
/// rounding makes equal are not matched.
void match(UnmatchedVertices& unmatched, Rounding rounding, std::vector<Restored>& restored) {
  std::map<Coordinates, int> count;
  for (const Point3& p : unmatched.of_input) ++count[rounded(p, rounding)];
  std::erase_if(unmatched.of_input, [&](const Point3& p) {
    const Coordinates coordinates = rounded(p, rounding);
    const auto found = unmatched.of_mesh.find(coordinates);
    if (found == unmatched.of_mesh.end() || count[coordinates] != 1) return false;
    restored.push_back({found->second, {coordinates[0], coordinates[1], coordinates[2]}, p});
    unmatched.of_mesh.erase(found);
    return true;
  });
}

/// Is the volume greater than the largest rounding error of its computation?
bool is_surely_positive(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  constexpr double relative_error = 16 * 0x1p-53;
  const Point3& a = mesh.vertices[t[0]];
  const Point3 b = mesh.vertices[t[1]] - a, c = mesh.vertices[t[2]] - a, d = mesh.vertices[t[3]] - a;
  const auto abs = [](double x) { return std::fabs(x); };
  const double permanent = (abs(b.y * c.z) + abs(b.z * c.y)) * abs(d.x) + (abs(b.z * c.x) + abs(b.x * c.z)) * abs(d.y) +
                           (abs(b.x * c.y) + abs(b.y * c.x)) * abs(d.z);
  return dot(cross(b, c), d) > relative_error * permanent;
}

/// Reverts changes of vertices until all tetrahedra around them are certainly positive.
/// \return  the number of remaining changes
std::size_t revert_inversions(const std::vector<Restored>& restored, TetMesh& mesh) {
  std::map<std::uint32_t, const Restored*> changed;
  for (const Restored& r : restored) changed[static_cast<std::uint32_t>(r.vertex)] = &r;
  for (bool has_reverted = true; has_reverted;) {
    has_reverted = false;
    for (const auto& t : mesh.tetrahedra) {
      const auto is_changed = [&](std::uint32_t v) { return changed.contains(v); };
      if (std::ranges::none_of(t, is_changed) || is_surely_positive(mesh, t)) continue;
      has_reverted = true;
      for (const std::uint32_t v : t)
        if (const auto found = changed.find(v); found != changed.end()) {
          mesh.vertices[v] = found->second->before;
          changed.erase(found);
        }
    }
  }
  return changed.size();
}

}  // namespace

void orient_positively(TetMesh& mesh) {
  double total = 0;  // sign of the sum, because rounding may flip the sign of a single sliver
  for (const auto& t : mesh.tetrahedra) total += signed_volume(mesh, t);
  if (total >= 0) return;
  for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
}

std::size_t restore_coordinates(const std::vector<Point3>& input, TetMesh& mesh) {
  UnmatchedVertices unmatched = find_unmatched(input, mesh.vertices);
  std::vector<Restored> restored;
  for (const Rounding rounding : roundings)
    if (!unmatched.of_input.empty()) match(unmatched, rounding, restored);
  for (const Restored& r : restored) mesh.vertices[r.vertex] = r.after;
  return revert_inversions(restored, mesh);
}

void add_boundary_faces(TetMesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  const auto region = [&](std::size_t side) { return mesh.regions[sides[side].tetrahedron]; };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool has_neighbor = i + 1 < sides.size() && sides[i + 1].sorted == sides[i].sorted;
    if (!has_neighbor || region(i) != region(i + 1)) mesh.faces.push_back(sides[i].face);
    if (has_neighbor) ++i;
  }
  mesh.face_markers.clear();
}

void keep_odd_regions(TetMesh& mesh) {
  const std::vector<char> parity = find_parities(mesh);
  if (std::ranges::all_of(parity, [](char p) { return p == 1; })) return;
  filter(mesh.tetrahedra, mesh.regions, [&](std::size_t t) { return parity[t] == 1; });
  drop_unused_vertices(mesh);
}

MeshCounts count_elements(const InputPlc& input, const TetMesh& mesh) {
  std::vector<Coordinates> known;
  known.reserve(input.vertices.size());
  for (const Point3& p : input.vertices) known.push_back(key(p));
  std::ranges::sort(known);

  std::vector<char> on_facet(mesh.vertices.size(), 0);
  for (const auto& face : mesh.faces)
    for (const auto v : face) on_facet[v] = 1;
  for (const auto& edge : mesh.edges)
    for (const auto v : edge) on_facet[v] = 1;

  MeshCounts counts;
  counts.vertices = mesh.vertices.size();
  counts.tetrahedra = mesh.tetrahedra.size();
  counts.faces = mesh.faces.size();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (std::ranges::binary_search(known, key(mesh.vertices[v]))) continue;
    ++(on_facet[v] ? counts.steiner_vertices : counts.interior_vertices);
  }
  return counts;
}

}  // namespace ccdt::baselines
