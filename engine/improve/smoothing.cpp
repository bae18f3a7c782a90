#include "engine/improve/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"

namespace ccdt::improve {

// ---- The functions of a star

namespace {

/// The weight of a surplus of 1 / r above its goal, relative to the quality of the star.
constexpr double surplus_weight = 4;

// The following loops have no branches and no calls, so that compilers vectorize them.

void compute_inverse_r(const Point3& p, ScaledStar& star) {
  const double half_square = 0.5 * squared_length(p);
  for (std::size_t i = 0; i < star.size(); ++i) {
    const double det = dot(star.normal[i], p) - star.height[i];
    const double mean = half_square - dot(star.centroid[i], p) + star.mean_square[i];
    star.inverse_r[i] = tets::inverse_r_of(det, mean);
  }
}

inline double smaller(double a, double b) {
  return b < a ? b : a;
}

void compute_sines(const Point3& p, ScaledStar& star) {
  for (std::size_t i = 0; i < star.size(); ++i) {
    const Point3 a = star.a[i], b = star.b[i], c = star.c[i];
    const Point3 u = a - p, v = b - p, w = c - p;
    const double fa = 1 / squared_length(cross(v, w)), fb = 1 / squared_length(cross(w, u)),
                 fc = 1 / squared_length(cross(u, v)), fd = star.inverse_area[i];
    const double at_apex =
        smaller(squared_length(u) * fb * fc, smaller(squared_length(v) * fc * fa, squared_length(w) * fa * fb));
    const double at_face =
        smaller(squared_length(b - a) * fc, smaller(squared_length(c - b) * fa, squared_length(a - c) * fb));
    star.sine[i] = (dot(star.normal[i], p) - star.height[i]) * std::sqrt(smaller(at_apex, at_face * fd));
  }
}

/// 1 / r = sqrt(2) det / m^(3/2). The gradient of det is the normal, and that of m is the vector from the face's
/// centroid.
void add_inverse_r(const ScaledStar& star, std::size_t i, const Point3& p, double weight, double value,
                   LinearModels& models) {
  const Point3 normal = star.normal[i], from_centroid = p - star.centroid[i];
  const double mean = 0.5 * squared_length(p) - dot(star.centroid[i], p) + star.mean_square[i];
  const double by_det = tets::inverse_r_of(weight, mean);
  const double by_mean = -1.5 * weight * star.inverse_r[i] / mean;
  models.add(value, by_det * normal + by_mean * from_centroid);
}

/// The sine at an edge of length l between faces of doubled areas F and G is det l / (F G). So its gradient is the sine
/// times the sum of the gradients of the logarithms. Only for det, which may be zero, the logarithm is avoided.
void add_sines(const ScaledStar& star, std::size_t i, const Point3& p, double offset, double below,
               LinearModels& models) {
  const Point3 a = star.a[i], b = star.b[i], c = star.c[i], normal = star.normal[i];
  const Point3 u = a - p, v = b - p, w = c - p;
  const Point3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double fa = 1 / squared_length(vw), fb = 1 / squared_length(wu), fc = 1 / squared_length(uv),
               fd = star.inverse_area[i];
  const Point3 by_fa = fa * cross(c - b, vw), by_fb = fb * cross(a - c, wu), by_fc = fc * cross(b - a, uv);
  const double uu = squared_length(u), vv = squared_length(v), ww = squared_length(w);
  const double det = dot(normal, p) - star.height[i];
  const auto add = [&](double ratio, const auto& by_rest) {
    const double root = std::sqrt(ratio), sine = det * root;
    if (offset + sine < below) models.add(offset + sine, root * normal + sine * by_rest());
  };
  add(uu * fb * fc, [&] { return by_fb + by_fc - (1 / uu) * u; });
  add(vv * fc * fa, [&] { return by_fc + by_fa - (1 / vv) * v; });
  add(ww * fa * fb, [&] { return by_fa + by_fb - (1 / ww) * w; });
  add(squared_length(b - a) * fc * fd, [&] { return by_fc; });
  add(squared_length(c - b) * fa * fd, [&] { return by_fa; });
  add(squared_length(a - c) * fb * fd, [&] { return by_fb; });
}

/// The quality of a star, defined like that of a cell, from the least 1 / r, shape(), and the least sine, sine().
template <class Shape, class Sine>
double quality_by(const QualityGoal& goal, const Shape& shape, const Sine& sine) {
  if (goal.is_of_r())
    if (const double value = shape(); value < goal.inverse_r) return value;
  return goal.offset() + sine();
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

}  // namespace

void LinearModels::clear() {
  value.clear();
  gradient.resize(0);
}

void LinearModels::add(double v, const Point3& g) {
  value.push_back(v);
  gradient.x.push_back(g.x), gradient.y.push_back(g.y), gradient.z.push_back(g.z);
}

void load_star(std::span<const StarFace> faces, const Point3& apex, ScaledStar& star) {
  const std::size_t size = faces.size();
  for (Coordinates* const part : {&star.a, &star.b, &star.c, &star.normal, &star.centroid}) part->resize(size);
  for (std::vector<double>* const part :
       {&star.height, &star.mean_square, &star.inverse_area, &star.inverse_r, &star.sine})
    part->resize(size);
  double squares = 0;
  for (const StarFace& face : faces)
    squares += squared_length(face.a - apex) + squared_length(face.b - apex) + squared_length(face.c - apex);
  star.scale = std::sqrt(squares / static_cast<double>(3 * size));
  star.mean = {};
  const double inverse_scale = 1 / star.scale;
  for (std::size_t i = 0; i < size; ++i) {
    const Point3 a = inverse_scale * (faces[i].a - apex), b = inverse_scale * (faces[i].b - apex),
                 c = inverse_scale * (faces[i].c - apex);
    const Point3 normal = cross(b - a, c - a), centroid = (1.0 / 3) * (a + b + c);
    star.a.set(i, a), star.b.set(i, b), star.c.set(i, c);
    star.normal.set(i, normal), star.centroid.set(i, centroid);
    star.height[i] = dot(normal, a);
    star.mean_square[i] = (squared_length(a) + squared_length(b) + squared_length(c) + squared_length(b - a) +
                           squared_length(c - b) + squared_length(a - c)) /
                          6;
    star.inverse_area[i] = 1 / squared_length(normal);
    star.mean = star.mean + centroid;
  }
  star.mean = (1 / static_cast<double>(size)) * star.mean;
}

double least_quality(const QualityGoal& goal, const Point3& x, ScaledStar& star) {
  work_done.quality_evaluations += star.size();
  const auto shape = [&] { return compute_inverse_r(x, star), least(star.inverse_r); };
  return quality_by(goal, shape, [&] { return compute_sines(x, star), least(star.sine); });
}

void model_star(const QualityGoal& goal, const Point3& x, double least, double reach, const ScaledStar& star,
                LinearModels& models) {
  models.clear();
  const double below = least + reach;
  if (goal.is_of_r() && least < goal.inverse_r) {
    for (std::size_t i = 0; i < star.size(); ++i)
      if (star.inverse_r[i] < below) add_inverse_r(star, i, x, 1, star.inverse_r[i], models);
    return;
  }
  const double offset = goal.offset();
  for (std::size_t i = 0; i < star.size(); ++i)
    if (offset + star.sine[i] < below) add_sines(star, i, x, offset, below, models);
  if (!goal.is_of_r()) return;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const double surplus = surplus_weight * (star.inverse_r[i] - goal.inverse_r);
    if (surplus < reach) add_inverse_r(star, i, x, surplus_weight, least + surplus, models);
  }
}

namespace {

/// At most four gradients in space are affinely independent. A fifth is added before another is dropped.
constexpr int most_in_support = 5;

/// Models with their weights in the combination: the weights are positive, and their sum is 1.
struct Support {
  int size = 0;
  std::array<std::size_t, most_in_support> model;
  std::array<double, most_in_support> share, value;
  std::array<Point3, most_in_support> gradient;

  void add(const LinearModels& models, std::size_t i, double its_share) {
    model[size] = i, share[size] = its_share, value[size] = models.value[i], gradient[size] = models.gradient[i];
    ++size;
  }
  void remove(int k) {
    --size;
    for (int i = k; i < size; ++i)
      model[i] = model[i + 1], share[i] = share[i + 1], value[i] = value[i + 1], gradient[i] = gradient[i + 1];
  }
  Point3 combination() const {
    Point3 sum;
    for (int i = 0; i < size; ++i) sum = sum + share[i] * gradient[i];
    return sum;
  }
};

/// The shares, of any sign, with the sum 1, that minimize sum of share * value + length / 2 * |combination|^2. By
/// Cholesky decomposition of the matrix of the differences from the first gradient. The right-hand side is its last
/// row.
std::array<double, most_in_support> free_shares(const Support& support, double length) {
  constexpr double regularization = 1e-12;
  const int n = support.size - 1;
  std::array<Point3, most_in_support - 1> difference;
  std::array<std::array<double, most_in_support - 1>, most_in_support> matrix;
  std::array<double, most_in_support - 1>& x = matrix[n];
  double trace = 0;
  for (int i = 0; i < n; ++i) {
    difference[i] = support.gradient[i + 1] - support.gradient[0];
    x[i] = support.value[0] - support.value[i + 1] - length * dot(difference[i], support.gradient[0]);
    for (int j = 0; j <= i; ++j) matrix[i][j] = length * dot(difference[i], difference[j]);
    trace += matrix[i][i];
  }
  for (int i = 0; i < n; ++i) matrix[i][i] += regularization * (trace + 1e-100);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < std::min(i + 1, n); ++j) {
      double sum = matrix[i][j];
      for (int k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      matrix[i][j] =
          i == j ? std::sqrt(std::max(sum, regularization * regularization * trace + 1e-200)) : sum / matrix[j][j];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= matrix[k][i] * x[k];
    x[i] /= matrix[i][i];
  }
  std::array<double, most_in_support> shares;
  shares[0] = 1;
  for (int i = 0; i < n; ++i) shares[i + 1] = x[i], shares[0] -= x[i];
  return shares;
}

/// Moves from the weights toward the free ones until one becomes zero, drops it, and continues until all are positive.
void settle(double length, Support& support) {
  while (support.size > 1) {
    const std::array<double, most_in_support> target = free_shares(support, length);
    int first = -1;
    double way = 1;
    for (int i = 0; i < support.size; ++i) {
      if (target[i] > 0) continue;
      const double until = support.share[i] / (support.share[i] - target[i]);
      if (first < 0 || until < way) first = i, way = until;
    }
    for (int i = 0; i < support.size; ++i) support.share[i] += way * (target[i] - support.share[i]);
    if (first < 0) return;
    support.remove(first);
  }
  support.share[0] = 1;
}

struct Lowest {
  std::size_t model = 0;
  double value = 0;
};

Lowest find_lowest(const LinearModels& models, const Point3& step) {
  const double *value = models.value.data(), *x = models.gradient.x.data(), *y = models.gradient.y.data(),
               *z = models.gradient.z.data();
  Lowest lowest{0, value[0] + x[0] * step.x + y[0] * step.y + z[0] * step.z};
  for (std::size_t i = 1; i < models.size(); ++i) {
    const double there = value[i] + x[i] * step.x + y[i] * step.y + z[i] * step.z;
    if (there < lowest.value) lowest = {i, there};
  }
  return lowest;
}

}  // namespace

ProximalStep proximal_step(const LinearModels& models, double length) {
  constexpr int most_rounds = 16;
  constexpr double enough = 0.02;  // share of the gain that may be missed
  Lowest lowest = find_lowest(models, {});
  const double now = lowest.value;
  Support support;
  support.add(models, lowest.model, 1);
  ProximalStep found{{}, now};
  for (int round = 0; round < most_rounds; ++round) {
    found.step = length * support.combination();
    lowest = find_lowest(models, found.step);
    found.least = lowest.value;
    // All models of the support agree there, and no combination can predict more.
    const double promised = support.value[0] + dot(support.gradient[0], found.step);
    if (promised - lowest.value <= enough * (promised - now)) break;
    const auto end = support.model.begin() + support.size;
    if (support.size == most_in_support || std::find(support.model.begin(), end, lowest.model) != end) break;
    support.add(models, lowest.model, 0);
    settle(length, support);
  }
  return found;
}

// ---- The ascent

namespace {

// Lengths are in units of the mean edge from the apex to its star.
constexpr int most_steps = 10;
constexpr double first_length = 0.1;  ///< of a step, per unit of the gradient
constexpr double longest_step = 0.4;
constexpr double reach = 0.3;        ///< functions that exceed the least one by more do not affect a step
constexpr double least_gain = 1e-3;  ///< smallest gain that is worth a step
constexpr double worthwhile = 1.05;  ///< factor of the worst quality: for such a gain, good tetrahedra may become bad
constexpr double largest_coordinate = 0x1p51 + 0x1p20;

/// Removes the component of a vector that leads off the plane or the line.
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

/// The allowed vector nearest to `move`.
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
  // Larger multiples would not be exact.
  if (std::fabs(i) * largest_of(u) > 0x1p52 || std::fabs(j) * largest_of(v) > 0x1p52) return std::nullopt;
  return i * u + j * v;
}

bool all_positive(std::span<const StarFace> faces, const Point3& apex) {
  return std::all_of(faces.begin(), faces.end(), [&](const StarFace& f) { return orient3d(f.a, f.b, f.c, apex) > 0; });
}

std::size_t count_bad(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex) {
  return static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [&](const StarFace& f) {
    return tets::cell_quality(goal, f.a, f.b, f.c, apex) < goal.good();
  }));
}

/// The start of the search: the apex or the mean of the corners of the star.
Point3 find_start(const QualityGoal& goal, const Projection& project, ScaledStar& star, double& least) {
  const Point3 mean = project(star.mean);
  least = least_quality(goal, mean, star);
  if (least >= goal.good()) return mean;
  const double at_apex = least_quality(goal, {}, star);
  if (at_apex >= least) {
    least = at_apex;
    return {};
  }
  least = least_quality(goal, mean, star);
  return mean;
}

/// Proximal steps from `x`, each toward the greatest least quality that the models of nearby functions predict. The
/// step length depends on how well the last prediction was met.
Point3 climb(const QualityGoal& goal, const Projection& project, Point3 x, double least, MoveScratch& scratch) {
  auto& [star, models] = scratch;
  double length = first_length;
  bool moved = true;
  for (int i = 0; i < most_steps && least < goal.good(); ++i) {
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
    ++work_done.ascent_steps;
    const double gain = there - least;
    moved = gain > 0;
    if (moved) x = x + next.step, least = there;
    length *= gain > 0.7 * promised ? 3 : gain > 0.3 * promised ? 1 : 0.25;
  }
  return x;
}

}  // namespace

double worst_of_star(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex) {
  work_done.quality_evaluations += faces.size();
  const auto least_of = [&](const auto& measure) {
    double least = 1;
    for (const StarFace& f : faces) least = std::min(least, measure(f.a, f.b, f.c, apex));
    return least;
  };
  return quality_by(
      goal, [&] { return least_of(tets::inverse_r); }, [&] { return least_of(tets::least_sine); });
}

double move_apex(std::span<const StarFace> faces, const QualityGoal& goal, const Freedom& freedom, double worst,
                 MoveScratch& scratch, Point3& apex) {
  if (freedom.dimensions == 0 || faces.empty() || worst >= goal.good()) return worst;
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
  // Otherwise a bad tetrahedron that can hardly be improved would, step by step, drag all tetrahedra around it down to
  // its level.
  if (there < worthwhile * worst && count_bad(faces, goal, place) > count_bad(faces, goal, apex)) return worst;
  apex = place;
  return there;
}

}  // namespace ccdt::improve
