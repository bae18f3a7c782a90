#include <algorithm>
#include <utility>

#include "bench/verify/point_hash.h"
#include "bench/verify/surface.h"
#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"

namespace ccdt::verify {

namespace {

/// Matches each input vertex without a site to the nearest mesh vertex within `tolerances.place` that is in use, if
/// any.
void match_nearest(const plc::InputPlc& input, const Topology& topology, const Tolerances& tolerances, Sites& sites) {
  const auto& vertices = topology.mesh.vertices;
  const Box bounds = expanded(bounding_box(input.vertices), tolerances.place);
  std::vector<std::uint32_t> near_input;
  RawVector<Box> places;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (!topology.used(v) || !bounds.meets(box_of(vertices[v]))) continue;
    near_input.push_back(v);
    places.push_back(box_of(vertices[v]));
  }
  const ScaledBoxTree tree(std::move(places), tolerances);
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    std::uint32_t& site = sites.of_input[i];
    if (site != none) continue;
    const Point3& p = input.vertices[i];
    double best = tolerances.place * tolerances.place;
    tree.for_each_meeting(expanded(box_of(p), tolerances.place), [&](std::uint32_t k) {
      const double distance = squared_length(vertices[near_input[k]] - p);
      if (distance > best) return;
      best = distance;
      site = near_input[k];
    });
    // If several input vertices share a site, the site takes the position of the first.
    if (site != none && sites.position[site] == vertices[site]) sites.position[site] = p;
  }
}

/// Gives the other input vertices sites of their own; those within `tolerances.place` of an earlier one its site.
void add_sites(const plc::InputPlc& input, const Tolerances& tolerances, Sites& sites) {
  std::vector<std::uint32_t> left;
  RawVector<Box> places;
  for (std::uint32_t i = 0; i < input.vertices.size(); ++i) {
    if (sites.of_input[i] != none) continue;
    left.push_back(i);
    places.push_back(box_of(input.vertices[i]));
  }
  const ScaledBoxTree tree(std::move(places), tolerances);
  for (const std::uint32_t i : left) {
    if (sites.of_input[i] != none) continue;
    const auto site = static_cast<std::uint32_t>(sites.position.size());
    const Point3& p = input.vertices[i];
    sites.position.push_back(p);
    sites.of_input[i] = site;
    tree.for_each_meeting(expanded(box_of(p), tolerances.place), [&](std::uint32_t k) {
      std::uint32_t& other = sites.of_input[left[k]];
      const double most = tolerances.place * tolerances.place;
      if (other == none && squared_length(input.vertices[left[k]] - p) <= most) other = site;
    });
  }
}

/// A vertex of the mesh that is exactly where a vertex of the input is.
struct SamePlace {
  std::uint32_t of_mesh, of_input;
};

}  // namespace

Sites match_sites(const plc::InputPlc& input, const Topology& topology, const Tolerances& tolerances) {
  const auto& vertices = topology.mesh.vertices;
  Sites sites;
  sites.mesh_vertices = static_cast<std::uint32_t>(vertices.size());
  sites.position = vertices;
  HashTable<Point3, std::uint32_t, PointHash> places;  // the first vertex of the input there
  places.reserve(input.vertices.size());
  std::vector<std::uint32_t> first(input.vertices.size());  // with the same position
  for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = *places.insert(input.vertices[i], i).first;
  const auto find_same = [&](std::size_t begin, std::size_t end, std::vector<SamePlace>& found) {
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v)
      if (const std::uint32_t* i = places.find(vertices[v]); i != nullptr && topology.used(v)) found.push_back({v, *i});
  };
  sites.of_input.assign(first.size(), none);
  for (const auto& [v, i] : parallel_collect<SamePlace>(vertices.size(), chunk_length, find_same))
    if (sites.of_input[i] == none) sites.of_input[i] = v;
  for (std::size_t i = 0; i < first.size(); ++i) sites.of_input[i] = sites.of_input[first[i]];
  if (std::ranges::count(sites.of_input, none) > 0) {
    match_nearest(input, topology, tolerances, sites);
    add_sites(input, tolerances, sites);
  }
  sites.is_given.assign(sites.position.size(), false);
  for (const std::uint32_t site : sites.of_input) sites.is_given[site] = true;
  return sites;
}

}  // namespace ccdt::verify
