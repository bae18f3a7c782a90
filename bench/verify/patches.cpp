#include "bench/verify/patches.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/verify/findings.h"
#include "bench/verify/union_find.h"

namespace ccdt::verification {

namespace {

void join_pieces(const Surface& surface, const std::vector<bool>& joined, Patches& patches) {
  UnionFind sets(surface.pieces());
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (!joined[e]) continue;
    const std::uint32_t a = surface.uses[surface.use_begin[e]], b = surface.uses[surface.use_begin[e] + 1];
    sets.join(surface.piece_of[a], surface.piece_of[b], surface.is_forward(a) == surface.is_forward(b));
  }
  std::vector<std::uint32_t> number(surface.pieces(), none);
  std::uint32_t count = 0;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const auto [root, flip] = sets.find(p);
    if (number[root] == none) number[root] = count++;
    patches.of_piece.push_back(number[root]);
    patches.flipped.push_back(flip);
  }
  patches.open.assign(count, false);
  patches.piece_begin.assign(count + 1, 0);
  for (const std::uint32_t n : patches.of_piece) ++patches.piece_begin[n + 1];
  for (std::uint32_t n = 0; n < count; ++n) patches.piece_begin[n + 1] += patches.piece_begin[n];
  std::vector<std::uint32_t> next(patches.piece_begin.begin(), patches.piece_begin.end() - 1);
  patches.pieces.resize(surface.pieces());
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) patches.pieces[next[patches.of_piece[p]]++] = p;
}

void find_links(const Surface& surface, const Chains& chains, const std::vector<bool>& joined, Patches& patches) {
  patches.link_begin.push_back(0);
  for (std::uint32_t n = 0; n < patches.count(); ++n) {
    for (const std::uint32_t p : patches.pieces_of(n))
      for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) {
        const std::uint32_t e = surface.edge_of[i];
        if (joined[e]) continue;
        if (chains.missing(e)) patches.open[n] = true;
        const auto chain = chains.of(e);
        const bool backward = surface.is_forward(i) == patches.flipped[p];
        for (std::size_t k = 1; k < chain.size(); ++k)
          patches.links.push_back({chain[backward ? k : k - 1], chain[backward ? k - 1 : k]});
      }
    std::sort(patches.links.begin() + patches.link_begin[n], patches.links.end());
    patches.link_begin.push_back(static_cast<std::uint32_t>(patches.links.size()));
  }
}

void find_planes(const Surface& surface, Patches& patches) {
  for (std::uint32_t n = 0; n < patches.count(); ++n) {
    Point3 sum, centre;
    double corners = 0, thickness = 0, perimeter = 0;
    for (const std::uint32_t p : patches.pieces_of(n)) {
      sum = sum + (patches.flipped[p] ? -1.0 : 1.0) * surface.area_vector[p];
      for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i, ++corners)
        centre = centre + (surface.at(surface.directed[i][0]) - surface.origin(p)) + surface.origin(p);
    }
    const double area = std::sqrt(squared_length(sum));
    const Point3 normal = area > 0 ? (1 / area) * sum : Point3{};
    centre = (1 / corners) * centre;
    for (const std::uint32_t p : patches.pieces_of(n))
      for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i)
        thickness = std::max(thickness, std::fabs(dot(normal, surface.at(surface.directed[i][0]) - centre)));
    for (const auto& [a, b] : patches.links_of(n))
      perimeter += std::sqrt(squared_length(surface.at(a) - surface.at(b)));
    patches.normal.push_back(normal);
    patches.centre.push_back(centre);
    patches.area.push_back(area);
    patches.thickness.push_back(thickness);
    patches.perimeter.push_back(perimeter);
  }
}

}  // namespace

Patches group_pieces(const Surface& surface, const Chains& chains, const std::vector<bool>& joined) {
  Patches patches;
  join_pieces(surface, joined, patches);
  find_links(surface, chains, joined, patches);
  find_planes(surface, patches);
  return patches;
}

std::string compare_with_patch(const TetMesh& mesh, const Surface& surface, const Patches& patches, std::uint32_t patch,
                               std::span<const std::array<std::uint32_t, 3>> faces) {
  const auto pieces = patches.pieces_of(patch);
  if (pieces.size() == 1 && surface.is_triangle(pieces[0]) && faces.size() == 1)
    return {};  // the links are the whole triangle
  const double flat = surface.tolerances.flat;
  if (patches.thickness[patch] > flat)
    return "edges of facets that are not in one plane are missing; the patch is " +
           std::to_string(patches.thickness[patch] / flat) + " tolerances thick";
  const Point3 normal = patches.normal[patch];
  const double slack = surface.tolerances.place * patches.perimeter[patch];
  double area = 0;
  std::vector<std::uint32_t> vertices;
  for (const auto& [a, b, c] : faces) {
    for (const std::uint32_t v : {a, b, c}) {
      vertices.push_back(v);
      if (std::fabs(dot(normal, mesh.vertices[v] - patches.centre[patch])) > flat)
        return "the vertex " + text(mesh.vertices[v]) + " is off the facet's plane";
    }
    const Point3 ab = mesh.vertices[b] - mesh.vertices[a], ac = mesh.vertices[c] - mesh.vertices[a];
    const double face_area = 0.5 * dot(normal, cross(ab, ac));
    const double longest = std::sqrt(std::max({squared_length(ab), squared_length(ac), squared_length(ac - ab)}));
    if (face_area < -surface.tolerances.flat * longest)
      return "a face of the mesh at " + text(mesh.vertices[a]) + " is turned over";
    area += face_area;
  }
  if (std::fabs(area - patches.area[patch]) > 1e-9 * patches.area[patch] + slack)
    return "the area is " + std::to_string(area) + " instead of " + std::to_string(patches.area[patch]);
  std::sort(vertices.begin(), vertices.end());
  for (const std::uint32_t p : pieces)
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i)
      if (!std::binary_search(vertices.begin(), vertices.end(), surface.directed[i][0]))
        return "no face of the mesh there has the facet's vertex " + text(surface.at(surface.directed[i][0]));
  return {};
}

}  // namespace ccdt::verification
