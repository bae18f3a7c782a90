#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/geometry/integer_points.h"
#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// Finds the vertex at a point, or makes it.
class VertexFinder {
 public:
  explicit VertexFinder(plc::Plc& plc) : plc_(plc) {
    known_.reserve(plc.vertices.size());
    for (std::uint32_t v = 0; v < plc.vertices.size(); ++v) known_.insert(to_integers(plc.vertices[v]), v);
  }

  VertexId at(const Point3& p) {
    const auto [vertex, is_new] = known_.insert(to_integers(p), static_cast<std::uint32_t>(plc_.vertices.size()));
    if (is_new) {
      plc_.vertices.push_back(p);
      plc_.world.push_back(plc_.grid.to_world(p));
    }
    return VertexId(*vertex);
  }

 private:
  plc::Plc& plc_;
  HashTable<IntegerPoint, std::uint32_t> known_;
};

/// Finds the vertex that is nearest to a point, if it is within reach, or makes one.
class NearVertexFinder {
 public:
  NearVertexFinder(plc::UncheckedPlc& soup, double reach) : plc_(soup.plc), reach_(reach) {
    std::vector<char> is_known(soup.plc.vertices.size(), 0);
    for (const plc::VertexTriple& t : soup.triangles.corners)
      for (const VertexId v : t)
        if (std::exchange(is_known[v], 1) == 0) add(v);
  }

  VertexId at(const Point3& p) {
    const IntegerPoint cell = cell_of(p);
    VertexId nearest;
    double least = reach_ * reach_;
    for (std::int64_t x = cell[0] - 1; x <= cell[0] + 1; ++x)
      for (std::int64_t y = cell[1] - 1; y <= cell[1] + 1; ++y)
        for (std::int64_t z = cell[2] - 1; z <= cell[2] + 1; ++z) {
          const IntegerPoint other = {x, y, z};
          for (VertexId v = last_in_cell_.get(other, {}); !v.is_none(); v = before_[v]) {
            const double distance = squared_length(plc_.vertices[v] - p);
            if (distance > least || (distance == least && v > nearest)) continue;
            least = distance;
            nearest = v;
          }
        }
    if (!nearest.is_none()) return nearest;
    const VertexId made(plc_.vertices.size());
    plc_.vertices.push_back(p);
    plc_.world.push_back(plc_.grid.to_world(p));
    add(made);
    return made;
  }

 private:
  IntegerPoint cell_of(const Point3& p) const {
    const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / reach_)); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }

  void add(VertexId v) {
    VertexId& last = *last_in_cell_.insert(cell_of(plc_.vertices[v])).first;
    if (before_.size() <= v) before_.resize(v + std::size_t{1});
    before_[v] = std::exchange(last, v);
  }

  plc::Plc& plc_;
  double reach_;
  HashTable<IntegerPoint, VertexId> last_in_cell_;
  std::vector<VertexId> before_;  // by vertex: the one before it in its cell
};

}  // namespace ccdt::repair
