#include "engine/delaunay/fourth_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/count_work.h"

namespace ccdt::delaunay {
namespace {

void add_block(VertexGrid& g, const UniformGrid::CellIndex& from) {
  GridBlock block;
  block.from = from;
  for (int i = 0; i < 3; ++i) block.to[i] = std::min(from[i] + GridBlock::side, g.grid.cells[i]) - 1;
  Box box = empty_box;
  g.for_each_vertex(block.from, block.to, [&](const Point3& p) { box = hull(box, box_of(p)); });
  if (box.low.x > box.high.x) return;
  const double margin = 1e-15 * std::max({g.extent.x, g.extent.y, g.extent.z});
  block.center = box.center();
  block.half = 0.5 * (box.high - box.low) + Point3{margin, margin, margin};
  g.blocks.push_back(block);
}

using Face = std::array<std::uint32_t, 3>;
using CellIndex = UniformGrid::CellIndex;

constexpr double huge = 100;  // in cells: the spheres of faces at the hull, and of those over narrow gaps

double sum_of_magnitudes(const Point3& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

/// A box of cells, both ends included.
struct CellBox {
  CellIndex from{0, 0, 0}, to{-1, -1, -1};

  bool contains(const CellBox& box) const {
    for (int i = 0; i < 3; ++i)
      if (box.from[i] < from[i] || box.to[i] > to[i]) return false;
    return true;
  }
};

CellBox meet(const CellBox& a, const CellBox& b) {
  CellBox box;
  for (int i = 0; i < 3; ++i) box.from[i] = std::max(a.from[i], b.from[i]), box.to[i] = std::min(a.to[i], b.to[i]);
  return box;
}

/// The search above one face.
class ApexSearch {
 public:
  ApexSearch(const VertexGrid& grid, BlockTops& tops, VertexBatch& batch, const Face& face)
      : g_(grid),
        tops_(tops),
        batch_(batch),
        cell_size_(grid.grid.cell_size),
        per_cell_(1 / cell_size_),
        half_((0.5 + 1e-6) * cell_size_),
        pencil_(grid.vertices, face),
        normal_(pencil_.normal()),
        per_normal_x_(1 / normal_.x) {
    const auto& v = grid.vertices;
    // The vertex is expected half a cell above the face.
    const double lift = 0.5 * cell_size_ / pencil_.normal_length();
    middle_ =
        cell_at((1.0 / 3) * (v[face[0]].point + v[face[1]].point + v[face[2]].point) + std::min(lift, 1e300) * normal_);
    reach_of_row_ = (1.5 * std::fabs(normal_.x) + 0.5 * (std::fabs(normal_.y) + std::fabs(normal_.z))) * cell_size_;
    plane_slack_ =
        1e-6 * cell_size_ * sum_of_magnitudes(normal_) + 2 * pencil_.normal_error() * sum_of_magnitudes(grid.extent);
    reach_of_row_ += plane_slack_;
  }

  std::uint32_t run(std::uint32_t candidate, Reach reach) {
    const std::uint32_t apex = search(candidate, reach);
    ++work_done.apex_searches;
    work_done.grid_cells += cells_;
    work_done.vertices_examined += vertices_;
    return apex;
  }

 private:
  std::uint32_t search(std::uint32_t candidate, Reach reach) {
    if (candidate != ghost_vertex) accept(candidate);
    const double size = 2 * pencil_.size() * per_cell_;
    const int near = size < 5 ? std::max(2, static_cast<int>(size) + 1) : 6;
    for (int width = 1;; width = std::min(near, 2 * width)) {
      const CellBox window = around(width);
      if (width == 1 && candidate == ghost_vertex && pencil_.circle().radius < infinity)
        visit_first(window);
      else
        visit(meet(window, box_of_cap()));
      if (window.contains(box_of_cap())) return pencil_.apex();
      seen_ = window;
      if (width < near) continue;
      if (reach == Reach::near && cap_.radius > huge * cell_size_) return ghost_vertex;
      visit_blocks();
      return pencil_.apex();
    }
  }

  void accept(std::uint32_t v) {
    pencil_.accept(v);
    cap_ = pencil_.cap();
  }

  int column(double offset, int axis) const {
    const double c = offset * per_cell_;
    const int last = g_.grid.cells[axis] - 1;
    return c <= 0 ? 0 : c >= last ? last : static_cast<int>(c);
  }

  CellIndex cell_at(const Point3& p) const {
    const Point3& low = g_.grid.low;
    return {column(p.x - low.x, 0), column(p.y - low.y, 1), column(p.z - low.z, 2)};
  }

  CellBox around(int width) const {
    CellBox box;
    for (int i = 0; i < 3; ++i) {
      box.from[i] = std::max(0, middle_[i] - width);
      box.to[i] = std::min(g_.grid.cells[i] - 1, middle_[i] + width);
    }
    return box;
  }

  CellBox box_of_cap() const {
    const double r = cap_.radius + 1e-6 * cell_size_;
    const Point3 reach{r, r, r};
    return {cell_at(cap_.center - reach), cell_at(cap_.center + reach)};
  }

  /// Considers all vertices of the first window together.
  void visit_first(const CellBox& window) {
    batch_.size = 0;
    const Point3& origin = pencil_.origin();
    for (int z = window.from[2]; z <= window.to[2]; ++z) {
      for (int y = window.from[1]; y <= window.to[1]; ++y) {
        if (is_below(y, z)) continue;
        const std::size_t row = g_.grid.number({0, y, z});
        const std::uint32_t end = g_.first[row + window.to[0] + 1];
        std::uint32_t v = g_.first[row + window.from[0]];
        cells_ += static_cast<std::uint64_t>(window.to[0] - window.from[0] + 1);
        if (batch_.size + (end - v) > VertexBatch::capacity) return visit(window);
        for (; v < end; ++v) {
          const Point3 e = g_.vertices[v].point - origin;
          batch_.x[batch_.size] = e.x, batch_.y[batch_.size] = e.y, batch_.z[batch_.size] = e.z;
          batch_.vertices[batch_.size++] = v;
        }
      }
    }
    pencil_.consider_first(batch_);
    vertices_ += batch_.size;
    cap_ = pencil_.cap();
  }

  /// Is the row of three cells around the middle below the face?
  bool is_below(int y, int z) const {
    const Point3 to_row = g_.grid.center({middle_[0], y, z}) - pencil_.origin();
    return dot(normal_, to_row) + reach_of_row_ < 0;
  }

  /// Considers the vertices of the cells of the box that have not been seen, within the ball and above the face.
  void visit(const CellBox& box) {
    for (int z = box.from[2]; z <= box.to[2]; ++z) {
      for (int y = box.from[1]; y <= box.to[1]; ++y) {
        int from = box.from[0], to = box.to[0];
        if (!shorten(y, z, from, to)) continue;
        const bool seen = z >= seen_.from[2] && z <= seen_.to[2] && y >= seen_.from[1] && y <= seen_.to[1];
        if (!seen) {
          visit_row(y, z, from, to);
        } else {
          visit_row(y, z, from, std::min(to, seen_.from[0] - 1));
          visit_row(y, z, std::max(from, seen_.to[0] + 1), to);
        }
      }
    }
  }

  void visit_row(int y, int z, int from, int to) {
    if (from > to) return;
    const std::size_t row = g_.grid.number({0, y, z});
    const std::uint32_t apex = pencil_.apex(), begin = g_.first[row + from], end = g_.first[row + to + 1];
    for (std::uint32_t v = begin; v < end; ++v) pencil_.consider(v);
    cells_ += static_cast<std::uint64_t>(to - from + 1);
    vertices_ += end - begin;
    if (pencil_.apex() != apex) cap_ = pencil_.cap();
  }

  /// Shortens a row of cells to the part within the ball and above the face. \return is anything left?
  bool shorten(int y, int z, int& from, int& to) const {
    const double row_y = g_.grid.low.y + (y + 0.5) * cell_size_, row_z = g_.grid.low.z + (z + 0.5) * cell_size_;
    double low = -infinity, high = infinity;
    if (cap_.radius < infinity) {
      const double dy = std::max(0.0, std::fabs(cap_.center.y - row_y) - half_);
      const double dz = std::max(0.0, std::fabs(cap_.center.z - row_z) - half_);
      const double square = cap_.radius * cap_.radius - dy * dy - dz * dz;
      if (square < 0) return false;
      const double reach = std::sqrt(square) + 1e-6 * cell_size_;
      low = cap_.center.x - reach, high = cap_.center.x + reach;
    }
    // The greatest height of the row's cross-section above the plane of the face, at x = origin.x.
    const Point3& origin = pencil_.origin();
    const double height = normal_.y * (row_y - origin.y) + normal_.z * (row_z - origin.z) +
                          (std::fabs(normal_.y) + std::fabs(normal_.z)) * half_ + plane_slack_;
    if (normal_.x > 0)
      low = std::max(low, origin.x - height * per_normal_x_);
    else if (normal_.x < 0)
      high = std::min(high, origin.x - height * per_normal_x_);
    else if (height < 0)
      return false;
    from = std::max(from, column(low - g_.grid.low.x, 0)), to = std::min(to, column(high - g_.grid.low.x, 0));
    return from <= to;
  }

  /// Considers the vertices of all blocks that may have one in the sphere above the face.
  void visit_blocks() {
    const double length = pencil_.normal_length();
    const Point3 up = (1 / length) * normal_;
    const double tilt = 1e-15 + 2 * pencil_.normal_error() / length;
    BlockTops::Direction* direction = nullptr;
    double turn = 0;  // from its normal to ours
    for (std::size_t i = 0; i < g_.blocks.size(); ++i) {
      const GridBlock& block = g_.blocks[i];
      const Point3 to_block = block.center - pencil_.origin();
      const double farthest = sum_of_magnitudes(to_block) + sum_of_magnitudes(block.half);
      const double slack = tilt * farthest;
      double top = dot(up, to_block) + std::fabs(up.x) * block.half.x + std::fabs(up.y) * block.half.y +
                   std::fabs(up.z) * block.half.z + slack;
      if (top < 0 || is_outside(block, top, farthest)) continue;
      if (cap_.lift > huge * cell_size_) {
        if (!direction) {
          direction = &tops_.direction(up);
          turn = std::sqrt(squared_length(direction->normal - up)) + 1e-15;
        }
        const double known =
            tops_.top(*direction, i) - dot(direction->normal, pencil_.origin()) + turn * farthest + slack;
        if (known < 0 || is_outside(block, std::min(known, top), farthest)) continue;
      }
      visit(meet({block.from, block.to}, box_of_cap()));
    }
  }

  /// Is the whole block, up to a height above the face, outside the sphere? With c the center of the circle of the face
  /// and r its radius, e is inside when |e - c|^2 < r^2 + 2 lift * (height of e): that is a narrow cap even if lift is
  /// large.
  bool is_outside(const GridBlock& block, double top, double farthest) const {
    const SpherePencil::Circle& circle = pencil_.circle();
    if (circle.radius == infinity || cap_.lift == infinity) return false;
    const Point3 from_c = block.center - circle.center;
    const double dx = std::max(0.0, std::fabs(from_c.x) - block.half.x),
                 dy = std::max(0.0, std::fabs(from_c.y) - block.half.y),
                 dz = std::max(0.0, std::fabs(from_c.z) - block.half.z);
    const double inside = circle.radius * circle.radius + 2 * cap_.lift * top;
    return dx * dx + dy * dy + dz * dz > inside * (1 + 1e-9) + 8 * circle.error * (farthest + circle.radius);
  }

  const VertexGrid& g_;
  BlockTops& tops_;
  VertexBatch& batch_;
  double cell_size_, per_cell_, half_, plane_slack_, reach_of_row_;
  SpherePencil pencil_;
  SpherePencil::Cap cap_;
  Point3 normal_;
  double per_normal_x_;
  CellIndex middle_;
  CellBox seen_;
  std::uint64_t cells_ = 0, vertices_ = 0;  ///< visited by the search
};

}  // namespace

VertexGrid make_vertex_grid(std::span<const DelaunayVertex> vertices, double scale) {
  VertexGrid g;
  if (vertices.empty()) return g;
  const auto [low, high] = bounding_box(vertices);
  g.extent = high - low;
  g.grid = make_uniform_grid({{}, g.extent}, vertices.size(), scale);
  IndexLists lists = make_index_lists(g.grid.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) emit(g.grid.number(g.grid.cell_at(vertices[v].point - low)), v);
  });
  g.first = std::move(lists.first);
  g.vertices.reserve(vertices.size());
  for (const std::uint32_t v : lists.items) g.vertices.push_back({vertices[v].point - low, vertices[v].rank, v});
  for (int z = 0; z < g.grid.cells[2]; z += GridBlock::side)
    for (int y = 0; y < g.grid.cells[1]; y += GridBlock::side)
      for (int x = 0; x < g.grid.cells[0]; x += GridBlock::side) add_block(g, {x, y, z});
  return g;
}

BlockTops::Direction& BlockTops::direction(const Point3& normal) {
  // Directions that differ by more than a millionth have different keys.
  const auto part = [](double x) { return static_cast<std::uint64_t>(std::llround(x * 0x1p19) + 0x100000); };
  const std::uint64_t key = (part(normal.x) << 42 | part(normal.y) << 21 | part(normal.z)) + 1;
  Direction& slot = slots_[(key * 0x9E3779B97F4A7C15u >> 32) % slot_count];
  if (slot.key != key) {
    slot.key = key;
    slot.normal = normal;
    slot.tops.assign(grid_.blocks.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return slot;
}

double BlockTops::top(Direction& direction, std::size_t block) const {
  double& top = direction.tops[block];
  if (!std::isnan(top)) return top;
  const GridBlock& b = grid_.blocks[block];
  double highest = -infinity;
  work_done.grid_cells += static_cast<std::uint64_t>(b.to[0] - b.from[0] + 1) *
                          static_cast<std::uint64_t>(b.to[1] - b.from[1] + 1) *
                          static_cast<std::uint64_t>(b.to[2] - b.from[2] + 1);
  grid_.for_each_vertex(b.from, b.to, [&](const Point3& p) { highest = std::max(highest, dot(direction.normal, p)); });
  top = highest + 1e-15 * (grid_.extent.x + grid_.extent.y + grid_.extent.z);
  return top;
}

std::uint32_t FourthVertexSearch::find(const Face& face, std::uint32_t candidate, Reach reach) {
  return ApexSearch(grid_, tops_, batch_, face).run(candidate, reach);
}

}  // namespace ccdt::delaunay
