#include "engine/locate/octree_locator.h"

#include <algorithm>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/index_lists.h"
#include "engine/base/morton.h"

namespace ccdt::locate {
namespace {

/// The Morton codes of the boxes' centers in a cube around all of them.
RawVector<KeyedIndex> morton_codes(std::span<const Box> boxes, unsigned bits) {
  Box all = box_of(boxes[0].center());
  for (const Box& box : boxes) all = hull(all, box_of(box.center()));
  const Point3 extent = all.high - all.low;
  const double steps = static_cast<double>(1u << bits);
  const double scale = (1 - 1e-9) * steps / std::max({extent.x, extent.y, extent.z, 1.0});
  RawVector<KeyedIndex> numbers(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    numbers[i] = {morton_code_at(scale * (boxes[i].center() - all.low)), i};
  return numbers;
}

// Measured: with 8 to 32 vertices and 2 to 8 faces, times differ by at most a fifth.
constexpr std::uint32_t vertices_per_leaf = 16, faces_per_leaf = 4;

std::vector<Box> boxes_of_vertices(std::span<const delaunay::DelaunayVertex> vertices,
                                   std::span<const std::uint32_t> some_vertices) {
  std::vector<Box> boxes;
  boxes.reserve(some_vertices.size());
  for (const std::uint32_t v : some_vertices) boxes.push_back(box_of(vertices[v].point));
  return boxes;
}

std::vector<Box> boxes_of_faces(std::span<const delaunay::DelaunayVertex> vertices,
                                std::span<const std::array<VertexId, 3>> faces,
                                std::span<const std::uint32_t> some_faces) {
  std::vector<Box> boxes;
  boxes.reserve(some_faces.size());
  for (const std::uint32_t f : some_faces) {
    const auto& [a, b, c] = faces[f];
    boxes.push_back(bounding_box(std::array{vertices[a].point, vertices[b].point, vertices[c].point}));
  }
  return boxes;
}

/// Facets with this many faces become layers.
constexpr std::size_t faces_of_layer = 64;

/// Turns the facets with many faces into layers.
///
/// \return  the other faces
std::vector<std::uint32_t> take_layers(std::span<const delaunay::DelaunayVertex> vertices,
                                       std::span<const std::array<VertexId, 3>> faces, std::span<const FacetId> facets,
                                       std::span<const std::uint32_t> some_faces, std::vector<FacetLayer>& layers) {
  std::vector<std::uint32_t> others(some_faces.begin(), some_faces.end());
  if (facets.empty() || some_faces.size() < faces_of_layer) return others;
  std::vector<std::uint32_t> by_facet = std::exchange(others, {});
  std::ranges::sort(by_facet, {}, [&](std::uint32_t f) { return std::pair(facets[f], f); });
  for (auto first = by_facet.begin(); first != by_facet.end();) {
    const auto last = std::find_if(first, by_facet.end(), [&](std::uint32_t f) { return facets[f] != facets[*first]; });
    if (static_cast<std::size_t>(last - first) >= faces_of_layer)
      layers.emplace_back(vertices, faces, std::span(first, last));
    else
      others.insert(others.end(), first, last);
    first = last;
  }
  return others;
}

}  // namespace

BoxOctree::BoxOctree(std::span<const Box> boxes, std::uint32_t leaf_size) {
  if (boxes.empty()) return;
  std::vector<std::uint64_t> keys;
  order_ = all_indices(boxes.size());
  if (boxes.size() > leaf_size) {
    const RawVector<KeyedIndex> numbered = morton_codes(boxes, deepest);
    order_ = sorted_by_key(numbered);
    keys.reserve(order_.size());
    for (const std::uint32_t i : order_) keys.push_back(numbered[i].key);
  }
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size()), 0, 0});
  std::vector<unsigned> levels = {0};
  for (std::uint32_t node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].last - nodes_[node].first > leaf_size) split(node, keys, levels);
  work_done.octree_nodes_created += nodes_.size();
  // Children come after their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.child_count == 0) {
      node.box = boxes[order_[node.first]];
      for (std::uint32_t j = node.first + 1; j < node.last; ++j) node.box = hull(node.box, boxes[order_[j]]);
    } else {
      node.box = nodes_[node.children].box;
      for (std::uint32_t j = 1; j < node.child_count; ++j) node.box = hull(node.box, nodes_[node.children + j].box);
    }
  }
}

/// Appends the octants of a node as its children; `levels` are those of the nodes.
void BoxOctree::split(std::uint32_t node, const std::vector<std::uint64_t>& keys, std::vector<unsigned>& levels) {
  const std::uint32_t first = nodes_[node].first, last = nodes_[node].last;
  // Octants that contain everything are skipped.
  unsigned level = levels[node];
  const auto octant = [&](std::uint32_t i) { return keys[i] >> 3 * (deepest - 1 - level) & 7u; };
  while (level < deepest && octant(first) == octant(last - 1)) ++level;
  if (level == deepest) return;
  nodes_[node].children = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t begin = first; begin < last;) {
    const std::uint64_t here = octant(begin);
    const auto end = std::partition_point(keys.begin() + begin, keys.begin() + last, [&](std::uint64_t key) {
      return (key >> 3 * (deepest - 1 - level) & 7u) == here;
    });
    const auto next = static_cast<std::uint32_t>(end - keys.begin());
    nodes_.push_back({{}, begin, next, 0, 0});
    levels.push_back(level + 1);
    ++nodes_[node].child_count;
    begin = next;
  }
}

FaceOctree::FaceOctree(std::span<const delaunay::DelaunayVertex> vertices,
                       std::span<const std::array<VertexId, 3>> faces, std::span<const std::uint32_t> some_faces)
    : tree_(boxes_of_faces(vertices, faces, some_faces), faces_per_leaf) {
  faces_.reserve(some_faces.size());
  for (const std::uint32_t i : tree_.order()) faces_.push_back(some_faces[i]);
  boxes_ = boxes_of_faces(vertices, faces, faces_);
}

FacetLayer::FacetLayer(std::span<const delaunay::DelaunayVertex> vertices,
                       std::span<const std::array<VertexId, 3>> faces, std::span<const std::uint32_t> some_faces)
    : octree_(vertices, faces, some_faces), origin_(vertices[faces[some_faces[0]][0]].point) {
  Point3 normal{0, 0, 0};
  for (const std::uint32_t f : some_faces) {
    const Point3& a = vertices[faces[f][0]].point;
    normal = normal + cross(vertices[faces[f][1]].point - a, vertices[faces[f][2]].point - a);
  }
  normal_ = (1 / std::sqrt(squared_length(normal))) * normal;
  for (const std::uint32_t f : some_faces)
    for (const std::uint32_t v : faces[f]) {
      low_ = std::min(low_, height(vertices[v].point));
      high_ = std::max(high_, height(vertices[v].point));
    }
  // Covers the rounding of coordinates below 2^53, in three heights and in a moved end.
  constexpr double margin = 64;
  low_ -= margin, high_ += margin;
}

OctreeLocator::OctreeLocator(std::span<const delaunay::DelaunayVertex> vertices,
                             std::span<const std::array<VertexId, 3>> faces)
    : OctreeLocator(vertices, all_indices(vertices.size()), faces, {}, all_indices(faces.size())) {}

OctreeLocator::OctreeLocator(std::span<const delaunay::DelaunayVertex> vertices,
                             std::span<const std::uint32_t> some_vertices,
                             std::span<const std::array<VertexId, 3>> faces, std::span<const FacetId> facets,
                             std::span<const std::uint32_t> some_faces)
    : vertex_tree_(boxes_of_vertices(vertices, some_vertices), vertices_per_leaf),
      other_faces_(vertices, faces, take_layers(vertices, faces, facets, some_faces, layers_)) {
  vertices_.reserve(some_vertices.size());
  for (const std::uint32_t i : vertex_tree_.order()) {
    const std::uint32_t v = some_vertices[i];
    vertices_.push_back({vertices[v].point, vertices[v].rank, v});
  }
}

}  // namespace ccdt::locate
