#include "engine/delaunay/fourth_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/numbers/filters.h"
#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

using Face = std::array<std::uint32_t, 3>;
using CellIndex = UniformGrid::CellIndex;

constexpr double unit = 0x1p-53;  // of roundings
constexpr double infinity = std::numeric_limits<double>::infinity();

double sum(const Point3& p) {
  return p.x + p.y + p.z;
}

Point3 magnitudes(const Point3& p) {
  return {std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)};
}

double largest(const Point3& p) {
  return std::max({p.x, p.y, p.z});
}

/// The sums of magnitudes whose differences a cross product is.
Point3 cross_magnitudes(const Point3& p, const Point3& q) {
  return {std::fabs(p.y * q.z) + std::fabs(p.z * q.y), std::fabs(p.z * q.x) + std::fabs(p.x * q.z),
          std::fabs(p.x * q.y) + std::fabs(p.y * q.x)};
}

/// The spheres through the corners of a face, of which the current candidate picks one; with floating-point tests of
/// certified error in front of the exact ones. For a vertex e relative to corner a (an exact difference):
///   normal . e > 0                      e is above the face
///   weight . e - volume * e^2 > 0       e is inside the sphere
class Pencil {
 public:
  Pencil(std::span<const GridVertex> vertices, const Face& face)
      : v_(vertices),
        face_(face),
        origin_(vertices[face[0]].point),
        b_(vertices[face[1]].point - origin_),
        c_(vertices[face[2]].point - origin_),
        normal_(cross(b_, c_)),
        normal_terms_(cross_magnitudes(b_, c_)),
        normal_error_(8 * unit * largest(normal_terms_)) {}

  std::uint32_t apex() const { return apex_; }
  const Point3& origin() const { return origin_; }
  const Point3& normal() const { return normal_; }
  /// Error of normal . e for an e whose coordinates' magnitudes sum to 1.
  double normal_error() const { return normal_error_; }
  /// Of the largest distance of a corner from the first, in an axis.
  double size() const { return std::max(largest(magnitudes(b_)), largest(magnitudes(c_))); }

  /// The sphere; the part of it above the face is in the ball of this centre and radius (infinite: not known).
  const Point3& centre() const { return centre_; }
  double radius() const { return radius_; }

  /// Makes the vertex the candidate if there is none yet that is better.
  CCDT_ALWAYS_INLINE void consider(std::uint32_t v) {
    const Point3 e = v_[v].point - origin_;
    const double length = std::fabs(e.x) + std::fabs(e.y) + std::fabs(e.z), square = squared_length(e);
    if (dot(weight_, e) - volume_ * square < -(weight_error_ * length + volume_error_ * square)) return;
    if (dot(normal_, e) < -normal_error_ * length) return;
    if (is_better(v)) accept(v);
  }

  /// Makes a vertex strictly above the face the candidate.
  void accept(std::uint32_t v) {
    apex_ = v;
    const Point3 d = v_[v].point - origin_;
    const double bb = squared_length(b_), cc = squared_length(c_), dd = squared_length(d);
    weight_ = bb * cross(c_, d) + cc * cross(d, b_) + dd * normal_;
    volume_ = dot(normal_, d);
    // Each product has at most eleven roundings.
    weight_error_ =
        16 * unit * largest(bb * cross_magnitudes(c_, d) + cc * cross_magnitudes(d, b_) + dd * normal_terms_);
    volume_error_ = 16 * unit * dot(normal_terms_, magnitudes(d));
    find_ball();
  }

 private:
  bool is_better(std::uint32_t v) const {
    if (v == apex_ || v == face_[0] || v == face_[1] || v == face_[2]) return false;
    const GridVertex &a = v_[face_[0]], &b = v_[face_[1]], &c = v_[face_[2]], &e = v_[v];
    if (orient3d(a.point, b.point, c.point, e.point) <= 0) return false;
    if (apex_ == ghost_vertex) return true;
    const GridVertex& d = v_[apex_];
    return insphere_perturbed(a.point, b.point, c.point, d.point, e.point, {a.rank, b.rank, c.rank, d.rank, e.rank}) >
           0;
  }

  void find_ball() {
    radius_ = infinity;
    if (!(volume_ > 64 * volume_error_)) return;
    const double half = 0.5 / volume_;
    const Point3 to_centre = half * weight_;
    const double error = 1.1 * half * (weight_error_ + largest(magnitudes(weight_)) * volume_error_ / volume_);
    const double radius = std::sqrt(squared_length(to_centre));
    if (!(error < radius)) return;
    centre_ = origin_ + to_centre;
    // The error of the centre, in each of three axes, acts on where the ball is and on its radius.
    radius_ = radius * (1 + 1e-12) + 4 * error;
  }

  std::span<const GridVertex> v_;
  Face face_;
  Point3 origin_, b_, c_, normal_, normal_terms_;
  double normal_error_;
  std::uint32_t apex_ = ghost_vertex;
  // Without a candidate all vertices are inside.
  Point3 weight_, centre_;
  double volume_ = 0, weight_error_ = 0, volume_error_ = 0, radius_ = infinity;
};

/// A box of cells, both ends included.
struct CellBox {
  CellIndex from{0, 0, 0}, to{-1, -1, -1};

  bool contains(const CellBox& box) const {
    for (int i = 0; i < 3; ++i)
      if (box.from[i] < from[i] || box.to[i] > to[i]) return false;
    return true;
  }
};

class Search {
 public:
  Search(const VertexGrid& grid, const Face& face)
      : g_(grid),
        cell_size_(grid.grid.cell_size),
        half_((0.5 + 1e-6) * cell_size_),
        pencil_(grid.vertices, face),
        normal_(pencil_.normal()) {
    const auto& v = grid.vertices;
    middle_ = grid.grid.cell_at((1.0 / 3) * (v[face[0]].point + v[face[1]].point + v[face[2]].point));
    plane_slack_ = 1e-6 * cell_size_ * sum(magnitudes(normal_)) + 2 * pencil_.normal_error() * sum(grid.extent);
  }

  std::uint32_t run(std::uint32_t candidate, Reach reach) {
    if (candidate != ghost_vertex) pencil_.accept(candidate);
    const double size = 2 * pencil_.size() / cell_size_;
    const int near = std::max(2, size < 1e9 ? static_cast<int>(size) + 1 : 1000000000);
    const CellBox all{{0, 0, 0}, {g_.grid.cells[0] - 1, g_.grid.cells[1] - 1, g_.grid.cells[2] - 1}};
    for (int width = 1;; width = next_width(width)) {
      const CellBox window = around(width);
      visit(meet(window, box_of_ball()));
      seen_ = window;
      if (window.contains(pencil_.apex() == ghost_vertex ? all : box_of_ball())) return pencil_.apex();
      if (pencil_.apex() == ghost_vertex && reach == Reach::near && width >= near) return ghost_vertex;
    }
  }

 private:
  CellBox around(int width) const {
    CellBox box;
    for (int i = 0; i < 3; ++i) {
      box.from[i] = std::max(0, middle_[i] - width);
      box.to[i] = std::min(g_.grid.cells[i] - 1, middle_[i] + width);
    }
    return box;
  }

  static CellBox meet(const CellBox& a, const CellBox& b) {
    CellBox box;
    for (int i = 0; i < 3; ++i) box.from[i] = std::max(a.from[i], b.from[i]), box.to[i] = std::min(a.to[i], b.to[i]);
    return box;
  }

  CellBox box_of_ball() const {
    const double r = pencil_.radius() + 1e-6 * cell_size_;
    const Point3 reach{r, r, r};
    return {g_.grid.cell_at(pencil_.centre() - reach), g_.grid.cell_at(pencil_.centre() + reach)};
  }

  /// As wide as the ball needs, but not much wider than now: what is found on the way makes it smaller.
  int next_width(int width) const {
    if (pencil_.apex() == ghost_vertex) return 2 * width;
    const CellBox ball = box_of_ball();
    int needed = 0;
    for (int i = 0; i < 3; ++i) needed = std::max({needed, middle_[i] - ball.from[i], ball.to[i] - middle_[i]});
    return std::min(needed, 2 * width);
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
    const std::uint32_t end = g_.first[row + to + 1];
    for (std::uint32_t v = g_.first[row + from]; v < end; ++v) pencil_.consider(v);
  }

  /// Leaves of a row of cells what is within the ball and above the face. \return is there anything left?
  bool shorten(int y, int z, int& from, int& to) const {
    const double row_y = g_.grid.low.y + (y + 0.5) * cell_size_, row_z = g_.grid.low.z + (z + 0.5) * cell_size_;
    double low = -infinity, high = infinity;
    if (pencil_.radius() < infinity) {
      const Point3& centre = pencil_.centre();
      const double dy = std::max(0.0, std::fabs(centre.y - row_y) - half_);
      const double dz = std::max(0.0, std::fabs(centre.z - row_z) - half_);
      const double square = pencil_.radius() * pencil_.radius() - dy * dy - dz * dz;
      if (square < 0) return false;
      const double reach = std::sqrt(square) + 1e-6 * cell_size_;
      low = centre.x - reach, high = centre.x + reach;
    }
    // The highest that the row's cross-section reaches above the plane of the face, at x = origin.x.
    const Point3& origin = pencil_.origin();
    const double height = normal_.y * (row_y - origin.y) + normal_.z * (row_z - origin.z) +
                          (std::fabs(normal_.y) + std::fabs(normal_.z)) * half_ + plane_slack_;
    if (normal_.x > 0)
      low = std::max(low, origin.x - height / normal_.x);
    else if (normal_.x < 0)
      high = std::min(high, origin.x - height / normal_.x);
    else if (height < 0)
      return false;
    from = std::max(from, column(low)), to = std::min(to, column(high));
    return from <= to;
  }

  int column(double x) const {
    const double c = (x - g_.grid.low.x) / cell_size_;
    return c <= 0 ? 0 : c >= g_.grid.cells[0] - 1 ? g_.grid.cells[0] - 1 : static_cast<int>(c);
  }

  const VertexGrid& g_;
  double cell_size_, half_, plane_slack_;
  Pencil pencil_;
  Point3 normal_;
  CellIndex middle_;
  CellBox seen_;
};

}  // namespace

std::uint32_t find_fourth_vertex(const VertexGrid& grid, const Face& face, std::uint32_t candidate, Reach reach) {
  return Search(grid, face).run(candidate, reach);
}

}  // namespace ccdt
