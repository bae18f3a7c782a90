#include "engine/improve/smoothing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/numbers/predicates.h"

namespace ccdt::improve {
namespace {

// Lengths are in units of the mean edge from the apex to its star.
constexpr int most_steps = 10;
constexpr double first_length = 0.1;  ///< of a step, per unit of the gradient
constexpr double longest_step = 0.4;
constexpr double reach = 0.3;        ///< functions that are greater than the least by more do not matter to a step
constexpr double least_gain = 1e-3;  ///< that is worth a step
constexpr double worthwhile = 1.05;  ///< times the worst: a gain for which good tetrahedra may become bad
constexpr double largest_coordinate = 0x1p51 + 0x1p20;

/// Takes the part of a vector out that leads off the plane or the line.
class Projection {
 public:
  explicit Projection(const Freedom& freedom) : dimensions_(freedom.dimensions) {
    if (dimensions_ == 1) direction_ = freedom.u;
    if (dimensions_ == 2) direction_ = cross(freedom.u, freedom.v);
    if (dimensions_ < 3) direction_ = (1 / std::sqrt(squared_length(direction_))) * direction_;
  }
  Point3 operator()(const Point3& x) const {
    if (dimensions_ == 3) return x;
    const Point3 along = dot(direction_, x) * direction_;
    return dimensions_ == 1 ? along : x - along;
  }
  void apply(LinearModels& models) const {
    if (dimensions_ == 3) return;
    for (std::size_t i = 0; i < models.size(); ++i) models.gradient.set(i, (*this)(models.gradient[i]));
  }

 private:
  int dimensions_;
  Point3 direction_;  // of the line, or the normal of the plane
};

double largest_of(const Point3& p) {
  return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

/// The nearest vector to `move` that the freedom allows.
std::optional<Point3> round_move(const Freedom& freedom, const Point3& move) {
  if (freedom.dimensions == 3) return Point3{std::round(move.x), std::round(move.y), std::round(move.z)};
  const Point3 &u = freedom.u, &v = freedom.v;
  const double uu = dot(u, u), um = dot(u, move);
  double i = std::round(um / uu), j = 0;
  if (freedom.dimensions == 2) {
    const double vv = dot(v, v), uv = dot(u, v), vm = dot(v, move);
    const double det = uu * vv - uv * uv;
    i = std::round((um * vv - vm * uv) / det), j = std::round((vm * uu - um * uv) / det);
  }
  // Beyond, the multiples would not be exact.
  if (std::fabs(i) * largest_of(u) > 0x1p52 || std::fabs(j) * largest_of(v) > 0x1p52) return std::nullopt;
  return i * u + j * v;
}

bool all_positive(std::span<const StarFace> faces, const Point3& apex) {
  return std::all_of(faces.begin(), faces.end(),
                     [&](const StarFace& f) { return numbers::orient3d(f.a, f.b, f.c, apex) > 0; });
}

std::size_t count_bad(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex) {
  return static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [&](const StarFace& f) {
    return cell_quality(goal, f.a, f.b, f.c, apex) < goal_quality(goal);
  }));
}

/// Where the search begins: the apex or the mean of the corners of the star.
Point3 find_start(const QualityGoal& goal, const Projection& project, ScaledStar& star, double& least) {
  const Point3 mean = project(star.mean);
  least = least_quality(goal, mean, star);
  if (least >= goal_quality(goal)) return mean;
  const double at_apex = least_quality(goal, {}, star);
  if (at_apex >= least) {
    least = at_apex;
    return {};
  }
  least = least_quality(goal, mean, star);
  return mean;
}

/// Proximal steps from `x`, each towards where the models of the functions around promise the greatest least quality; a
/// model is trusted as far as its last promise was kept.
Point3 climb(const QualityGoal& goal, const Projection& project, Point3 x, double least, MoveScratch& scratch) {
  auto& [star, models] = scratch;
  double length = first_length;
  bool moved = true;
  for (int i = 0; i < most_steps && least < goal_quality(goal); ++i) {
    if (moved) {
      model_star(goal, x, least, reach, star, models);
      project.apply(models);
    }
    ProximalStep next = proximal_step(models, length);
    double promised = next.least - least;
    if (promised < least_gain) break;
    if (const double squared = squared_length(next.step); squared > longest_step * longest_step) {
      const double shrink = longest_step / std::sqrt(squared);
      next.step = shrink * next.step, promised *= shrink, length *= shrink;
    }
    const double there = least_quality(goal, x + next.step, star);
    const double gain = there - least;
    moved = gain > 0;
    if (moved) x = x + next.step, least = there;
    length *= gain > 0.7 * promised ? 3 : gain > 0.3 * promised ? 1 : 0.25;
  }
  return x;
}

}  // namespace

void gather_cells(const CellComplex& x, std::uint32_t vertex, CellMarks& marks, std::vector<std::uint32_t>& cells) {
  cells.clear();
  marks.clear(x.cell_count());
  const std::uint32_t first = x.cell_at(vertex);
  marks.mark(first);
  cells.push_back(first);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const delaunay::Cell& cell = x.cell(cells[i]);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t next = cell.neighbors[f];
      if (cell.vertices[f] == vertex || next == delaunay::no_neighbor || marks.is_marked(delaunay::cell_of(next)))
        continue;
      marks.mark(delaunay::cell_of(next));
      cells.push_back(delaunay::cell_of(next));
    }
  }
}

void gather_star(const CellComplex& x, std::uint32_t vertex, CellMarks& marks, VertexStar& star) {
  gather_cells(x, vertex, marks, star.cells);
  star.faces.clear();
  for (const std::uint32_t c : star.cells) {
    const auto [a, b, d] = corners_of_face(x.cell(c).vertices, x.place(c, vertex));
    star.faces.push_back({x.point(a), x.point(b), x.point(d)});
  }
}

double worst_of_star(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex) {
  double least = 1;
  if (goal.objective == Objective::r) {
    for (const StarFace& f : faces) least = std::min(least, inverse_r(f.a, f.b, f.c, apex));
    if (least < goal.inverse_r) return least;
  }
  least = 1;
  for (const StarFace& f : faces) least = std::min(least, least_sine(f.a, f.b, f.c, apex));
  return goal.objective == Objective::r ? 1 + least : least;
}

double move_apex(std::span<const StarFace> faces, const QualityGoal& goal, const Freedom& freedom, double worst,
                 MoveScratch& scratch, Point3& apex) {
  if (freedom.dimensions == 0 || faces.empty() || worst >= goal_quality(goal)) return worst;
  ScaledStar& star = scratch.star;
  load_star(faces, apex, star);
  const Projection project(freedom);
  double least = 0;
  const Point3 start = find_start(goal, project, star, least);
  const Point3 found = climb(goal, project, start, least, scratch);
  const std::optional<Point3> move = round_move(freedom, star.scale * found);
  if (!move || *move == Point3{}) return worst;
  const Point3 place = apex + *move;
  if (largest_of(place) > largest_coordinate) return worst;
  const double there = worst_of_star(faces, goal, place);
  if (!(there > worst) || !all_positive(faces, place)) return worst;
  // A worst that can hardly be mended would else, step by step, draw all around it down to where it is.
  if (there < worthwhile * worst && count_bad(faces, goal, place) > count_bad(faces, goal, apex)) return worst;
  apex = place;
  return there;
}

}  // namespace ccdt::improve
