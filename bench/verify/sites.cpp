#include "bench/verify/sites.h"

#include <cmath>
#include <cstring>
#include <unordered_map>

namespace ccdt::verification {

namespace {

/// Three integers that name a point, or a cell of a grid.
using Key = std::array<std::int64_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0;
    for (const std::int64_t k : key) {
      h = (h ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }
};

Key bits(const Point3& p) {
  Key key;
  for (int i = 0; i < 3; ++i) {
    const double c = as_array(p)[static_cast<std::size_t>(i)] + 0.0;  // -0 is 0
    std::memcpy(&key[static_cast<std::size_t>(i)], &c, sizeof c);
  }
  return key;
}

/// Finds the nearest of a set of points within a fixed distance: a grid of cells of twice that size.
class NearestVertex {
 public:
  explicit NearestVertex(double tolerance) : tolerance_(tolerance) {}

  void add(const Point3& p, std::uint32_t vertex) { cells_.emplace(cell(p), std::pair{p, vertex}); }

  std::uint32_t find(const Point3& p) const {
    double best = tolerance_ * tolerance_;
    std::uint32_t nearest = none;
    const Key low = cell({p.x - tolerance_, p.y - tolerance_, p.z - tolerance_});
    const Key high = cell({p.x + tolerance_, p.y + tolerance_, p.z + tolerance_});
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto [begin, end] = cells_.equal_range({x, y, z});
          for (auto i = begin; i != end; ++i) {
            const double distance = squared_length(i->second.first - p);
            if (distance > best) continue;
            best = distance;
            nearest = i->second.second;
          }
        }
    return nearest;
  }

 private:
  /// Clamped, so that a vertex far away, which is near nothing, does not overflow the integers.
  Key cell(const Point3& p) const {
    const auto index = [&](double c) {
      return static_cast<std::int64_t>(std::fmin(std::fmax(std::floor(c / (2 * tolerance_)), -9e17), 9e17));
    };
    return {index(p.x), index(p.y), index(p.z)};
  }

  double tolerance_;
  std::unordered_multimap<Key, std::pair<Point3, std::uint32_t>, KeyHash> cells_;
};

using ExactVertices = std::unordered_map<Key, std::uint32_t, KeyHash>;

}  // namespace

Sites match_sites(const InputPlc& input, const TetMesh& mesh, const Topology& topology, double tolerance) {
  Sites sites;
  sites.mesh_vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  sites.position = mesh.vertices;
  sites.of_input.assign(input.vertices.size(), none);
  ExactVertices exact;
  exact.reserve(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (topology.used(v)) exact.emplace(bits(mesh.vertices[v]), v);
  bool all_exact = true;
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    const auto found = exact.find(bits(input.vertices[i]));
    if (found != exact.end()) sites.of_input[i] = found->second;
    all_exact = all_exact && found != exact.end();
  }
  if (all_exact) return sites;

  NearestVertex near(tolerance);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (topology.used(v)) near.add(mesh.vertices[v], v);
  std::vector<bool> moved(mesh.vertices.size(), false);
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    std::uint32_t& site = sites.of_input[i];
    if (site != none) continue;
    site = near.find(input.vertices[i]);
    if (site != none && !moved[site]) {
      moved[site] = true;
      sites.position[site] = input.vertices[i];
    }
    if (site != none) continue;
    site = exact.emplace(bits(input.vertices[i]), static_cast<std::uint32_t>(sites.position.size())).first->second;
    if (site == sites.position.size()) sites.position.push_back(input.vertices[i]);
  }
  return sites;
}

}  // namespace ccdt::verification
