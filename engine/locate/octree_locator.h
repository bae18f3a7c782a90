#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"
#include "engine/locate/cap.h"

namespace ccdt::locate {

/// Tests whether the straight edge between two points meets boxes: projects both onto the coordinate axes and onto the
/// cross products of these with the edge. It may report a box that the edge just misses, but overlooks none.
class EdgeProbe {
 public:
  EdgeProbe(const Point3& p, const Point3& q) : middle_(0.5 * (p + q)) {
    const Point3 w = 0.5 * (q - p);
    half_ = {std::fabs(w.x), std::fabs(w.y), std::fabs(w.z)};
    along_ = w;
  }

  bool misses(const Box& box) const {
    const Point3 d = 0.5 * (box.low + box.high) - middle_;
    // Covers rounding: of coordinates below 2^53, and of products with d.
    const double slack = 16 + 1e-13 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
    const Point3 h = 0.5 * (box.high - box.low) + Point3{slack, slack, slack};
    if (std::fabs(d.x) > half_.x + h.x || std::fabs(d.y) > half_.y + h.y || std::fabs(d.z) > half_.z + h.z) return true;
    const Point3 turn = cross(along_, d);
    return std::fabs(turn.x) > half_.y * h.z + half_.z * h.y || std::fabs(turn.y) > half_.z * h.x + half_.x * h.z ||
           std::fabs(turn.z) > half_.x * h.y + half_.y * h.x;
  }

 private:
  Point3 middle_, along_, half_;
};

/// Tests whether a box meets boxes.
struct BoxProbe {
  Box box;

  bool misses(const Box& other) const { return !box.meets(other); }
};

/// An octree over items with boxes, in flat arrays. Items are in Morton order of the middles of their boxes, and every
/// node is a run of items with the box around them. So an item is in one leaf only, whatever its size. Nodes adapt to
/// graded density: octants without items have no node, and a node with a single octant is that octant.
class BoxOctree {
 public:
  struct Node {
    Box box;
    std::uint32_t first = 0, last = 0;  ///< its items
    std::uint32_t children = 0;         ///< the first child; the others follow
    std::uint32_t child_count = 0;      ///< 0 in a leaf
  };

  /// \param leaf_size  largest number of items in a leaf, unless more are at one place
  BoxOctree(std::span<const Box> boxes, std::uint32_t leaf_size);

  std::size_t bytes() const { return bytes_of(order_, nodes_); }

  /// The items, in the order in which nodes refer to them.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls visit(first, last) for the leaves. Among the children of a node, the nearest to `start` comes first. Skips
  /// nodes whose box is missed (`misses` returns true) when they are reached.
  template <class Misses, class Visit>
  void visit_nearest_first(const Point3& start, const Misses& misses, const Visit& visit) const;

  /// Calls visit(first, last) for the leaves whose box the probe does not miss, until it returns true. \return did it?
  template <class Probe, class Visit>
  bool any_leaf_at(const Probe& probe, const Visit& visit) const;

 private:
  static constexpr unsigned deepest = 21;                  // levels of 63-bit Morton codes
  static constexpr unsigned stack_room = 7 * deepest + 8;  // of a depth-first walk

  void split(std::uint32_t node, const std::vector<std::uint64_t>& keys, std::vector<unsigned>& levels);

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

template <class Misses, class Visit>
void BoxOctree::visit_nearest_first(const Point3& start, const Misses& misses, const Visit& visit) const {
  std::array<std::uint32_t, stack_room> stack;
  unsigned height = 0;
  if (!nodes_.empty()) stack[height++] = 0;
  while (height > 0) {
    ++work_done.octree_nodes;
    const Node& node = nodes_[stack[--height]];
    if (misses(node.box)) continue;
    if (node.child_count == 0) {
      visit(node.first, node.last);
      continue;
    }
    // Sorted into the stack, the nearest on top.
    std::array<double, 8> distances;
    const unsigned base = height;
    for (std::uint32_t child = node.children; child < node.children + node.child_count; ++child) {
      const double distance = squared_distance(nodes_[child].box, start);
      unsigned i = height++ - base;
      for (; i > 0 && distances[i - 1] < distance; --i) {
        distances[i] = distances[i - 1];
        stack[base + i] = stack[base + i - 1];
      }
      distances[i] = distance;
      stack[base + i] = child;
    }
  }
}

template <class Probe, class Visit>
bool BoxOctree::any_leaf_at(const Probe& probe, const Visit& visit) const {
  std::array<std::uint32_t, stack_room> stack;
  unsigned height = 0;
  if (!nodes_.empty()) stack[height++] = 0;
  while (height > 0) {
    ++work_done.octree_nodes;
    const Node& node = nodes_[stack[--height]];
    if (probe.misses(node.box)) continue;
    if (node.child_count == 0) {
      if (visit(node.first, node.last)) return true;
      continue;
    }
    for (std::uint32_t i = 0; i < node.child_count; ++i) stack[height++] = node.children + i;
  }
  return false;
}

/// An octree over faces.
class FaceOctree {
 public:
  FaceOctree(std::span<const delaunay::DelaunayVertex> vertices, std::span<const std::array<VertexId, 3>> faces,
             std::span<const std::uint32_t> some_faces);

  std::size_t bytes() const { return tree_.bytes() + bytes_of(faces_, boxes_); }

  /// Calls visit(face) for the faces whose box the probe does not miss until it returns true. \return did some call?
  template <class Probe, class Visit>
  bool any_at(const Probe& probe, const Visit& visit) const {
    return tree_.any_leaf_at(probe, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i)
        if (!probe.misses(boxes_[i]) && visit(faces_[i])) return true;
      return false;
    });
  }

 private:
  BoxOctree tree_;
  // In the order of the tree.
  std::vector<std::uint32_t> faces_;
  std::vector<Box> boxes_;
};

/// The many faces of one facet, and the space between two planes that encloses them tightly. An edge nearly parallel to
/// the facet meets the boxes of very many faces if the facet is oblique, but is between the planes only for a short
/// piece, if at all. Without this, stacks of thin plates would take forever if such edges run through them.
class FacetLayer {
 public:
  FacetLayer(std::span<const delaunay::DelaunayVertex> vertices, std::span<const std::array<VertexId, 3>> faces,
             std::span<const std::uint32_t> some_faces);

  std::size_t bytes() const { return octree_.bytes(); }

  /// Like that of `OctreeLocator`.
  template <class Visit>
  bool any_near_edge(const Point3& p, const Point3& q, const Visit& visit) const {
    const double from = height(p), to = height(q);
    if ((from < low_ && to < low_) || (from > high_ && to > high_)) return false;
    return octree_.any_at(EdgeProbe(clipped(p, from, q, to), clipped(q, to, p, from)), visit);
  }

  /// Like that of `OctreeLocator`.
  template <class Visit>
  bool any_near_box(const Box& box, const Visit& visit) const {
    return octree_.any_at(BoxProbe{box}, visit);
  }

 private:
  double height(const Point3& p) const { return dot(normal_, p - origin_); }

  /// The end p of the edge pq, moved to where the edge enters the layer.
  Point3 clipped(const Point3& p, double from, const Point3& q, double to) const {
    if (from >= low_ && from <= high_) return p;
    return p + ((from < low_ ? low_ : high_) - from) / (to - from) * (q - p);
  }

  FaceOctree octree_;
  Point3 origin_, normal_;
  double low_ = 0, high_ = 0;  // heights, with a margin
};

/// Finds vertices near a face and PLC faces near an edge by octrees, which adapt to graded density. A few vertices and
/// faces form a single leaf.
class OctreeLocator {
 public:
  /// With all vertices and all faces.
  OctreeLocator(std::span<const delaunay::DelaunayVertex> vertices, std::span<const std::array<VertexId, 3>> faces);

  /// With some vertices and some faces, given by their numbers. Facets with many of the faces become layers.
  ///
  /// \param facets  of all faces
  OctreeLocator(std::span<const delaunay::DelaunayVertex> vertices, std::span<const std::uint32_t> some_vertices,
                std::span<const std::array<VertexId, 3>> faces, std::span<const FacetId> facets,
                std::span<const std::uint32_t> some_faces);

  std::size_t bytes() const {
    std::size_t bytes = vertex_tree_.bytes() + bytes_of(vertices_) + other_faces_.bytes();
    for (const FacetLayer& layer : layers_) bytes += layer.bytes();
    return bytes;
  }

  std::size_t vertex_count() const { return vertices_.size(); }

  /// Calls visit(vertex) once for every vertex that the cap may contain, and for some others, roughly by increasing
  /// distance from `start`. The cap may shrink during the search.
  template <class Visit>
  void visit_nearest_first(const Point3& start, const Cap& cap, const Visit& visit) const {
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
    return other_faces_.any_at(EdgeProbe(p, q), visit) ||
           std::ranges::any_of(layers_, [&](const FacetLayer& layer) { return layer.any_near_edge(p, q, visit); });
  }

  /// The same for every face that may meet the box.
  template <class Visit>
  bool any_near_box(const Box& box, const Visit& visit) const {
    return other_faces_.any_at(BoxProbe{box}, visit) ||
           std::ranges::any_of(layers_, [&](const FacetLayer& layer) { return layer.any_near_box(box, visit); });
  }

 private:
  BoxOctree vertex_tree_;
  std::vector<LocatedVertex> vertices_;  // in the order of the tree
  std::vector<FacetLayer> layers_;
  FaceOctree other_faces_;  // those not in layers, so it comes after them
};

}  // namespace ccdt::locate
