#include "engine/improve/remove_faces.h"

#include <algorithm>

namespace ccdt {
namespace {

/// The most cells on one side of the faces that go.
constexpr std::uint32_t most_faces = 6;

/// The faces between two vertices, grown from one of them across its edges, and their edges at the rim.
class SandwichedFaces {
 public:
  SandwichedFaces(const CellComplex& x, const QualityGoal& goal, std::uint32_t above, std::uint32_t below,
                  Change& change)
      : x_(x), goal_(goal), above_(above), below_(below), change_(change) {}

  /// Adds a face by the cells on its two sides. Its edges are at the rim, or further faces go as well.
  /// \return the worth of the worst new cell
  double add_face(std::uint32_t upper, std::uint32_t lower, const std::array<std::uint32_t, 3>& corners, int edges) {
    change_.old_cells.push_back(upper);
    change_.old_cells.push_back(lower);
    double worst = add_edge(upper, lower, corners[0], corners[1], corners[2]);
    worst = std::min(worst, add_edge(upper, lower, corners[1], corners[2], corners[0]));
    if (edges == 3) worst = std::min(worst, add_edge(upper, lower, corners[2], corners[0], corners[1]));
    return worst;
  }

 private:
  /// The edge uv of a face whose third corner is w: at the rim, or crossed where that is better.
  double add_edge(std::uint32_t upper, std::uint32_t lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    const std::array<std::uint32_t, 4> rim = {below_, above_, u, v};
    const double at_rim = x_.worth_of(goal_, rim);
    const std::size_t olds = change_.old_cells.size(), news = change_.new_cells.size();
    if (at_rim < worth_of_goal(goal_) && !x_.is_segment(u, v)) {
      const double crossed = cross(upper, lower, u, v, w);
      if (crossed > at_rim) return crossed;
    }
    change_.old_cells.resize(olds);
    change_.new_cells.resize(news);
    change_.new_cells.push_back({rim, x_.regions[upper], at_rim});
    return at_rim;
  }

  /// \return what crossing the edge is worth; nothing if the next face is not between the same vertices
  double cross(std::uint32_t upper, std::uint32_t lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    if (change_.old_cells.size() >= std::size_t{2} * most_faces) return -1;
    const std::uint32_t up = face_code(upper, x_.place(upper, w)), down = face_code(lower, x_.place(lower, w));
    if (x_.is_wall(up) || x_.is_wall(down)) return -1;
    const std::uint32_t up_code = x_.cells[upper].neighbors[face_of(up)];
    const std::uint32_t down_code = x_.cells[lower].neighbors[face_of(down)];
    const std::uint32_t next_upper = cell_of(up_code), next_lower = cell_of(down_code);
    const std::uint32_t next = x_.cells[next_upper].vertices[face_of(up_code)];
    if (next == below_ || next != x_.cells[next_lower].vertices[face_of(down_code)]) return -1;
    if (x_.is_wall(face_code(next_upper, x_.place(next_upper, above_)))) return -1;
    if (std::ranges::find(change_.old_cells, next_upper) != change_.old_cells.end()) return -1;
    // The corner across the edge comes first: its two edges are those that are not the one we came by.
    return add_face(next_upper, next_lower, {u, next, v}, 2);
  }

  const CellComplex& x_;
  const QualityGoal& goal_;
  std::uint32_t above_, below_;
  Change& change_;
};

}  // namespace

bool plan_face_removal(const CellComplex& x, const QualityGoal& goal, std::uint32_t cell, std::uint32_t face,
                       double least, Change& change) {
  change.clear();
  const std::uint32_t code = face_code(cell, face);
  if (x.is_wall(code)) return false;
  const std::uint32_t beyond = x.cells[cell].neighbors[face];
  const auto& v = x.cells[cell].vertices;
  const std::uint32_t above = v[face], below = x.cells[cell_of(beyond)].vertices[face_of(beyond)];
  SandwichedFaces faces(x, goal, above, below, change);
  const auto& corner = face_corners[face];
  return faces.add_face(cell, cell_of(beyond), {v[corner[0]], v[corner[1]], v[corner[2]]}, 3) > least;
}

}  // namespace ccdt
