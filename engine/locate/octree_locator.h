#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"
#include "engine/locate/box_octree.h"
#include "engine/locate/cap.h"

namespace ccdt {

/// Finds vertices near a face and PLC faces near an edge by two octrees, which adapt to graded density. Few vertices
/// and faces are plain lists: a single leaf.
class OctreeLocator {
 public:
  /// Of all vertices and all faces.
  OctreeLocator(std::span<const DelaunayVertex> vertices, std::span<const std::array<VertexId, 3>> faces);

  /// Of some vertices and some faces, by their numbers.
  OctreeLocator(std::span<const DelaunayVertex> vertices, std::span<const std::uint32_t> some_vertices,
                std::span<const std::array<VertexId, 3>> faces, std::span<const std::uint32_t> some_faces);

  /// Calls visit(vertex) once for every vertex that the cap may hold, and for some others, roughly in growing distance
  /// from `start`. The cap may shrink meanwhile.
  template <class Visit>
  void spiral(const Point3& start, const Cap& cap, const Visit& visit) const {
    vertex_tree_.visit_nearest_first(
        start, [&](const Box& box) { return cap.misses(box); },
        [&](std::uint32_t first, std::uint32_t last) {
          for (std::uint32_t i = first; i < last; ++i) visit(vertices_[i]);
        });
  }

  /// Calls visit(face) once for every face that the straight edge from p to q may meet until it returns true.
  /// \return did some call?
  template <class Visit>
  bool any_near_edge(const Point3& p, const Point3& q, const Visit& visit) const {
    const EdgeProbe probe(p, q);
    return face_tree_.any_leaf_at(probe, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i)
        if (!probe.misses(face_boxes_[i]) && visit(faces_[i])) return true;
      return false;
    });
  }

 private:
  BoxOctree vertex_tree_, face_tree_;
  // In the order of the trees.
  std::vector<LocatedVertex> vertices_;
  std::vector<std::uint32_t> faces_;
  std::vector<Box> face_boxes_;
};

}  // namespace ccdt
