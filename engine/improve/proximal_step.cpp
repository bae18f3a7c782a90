#include "engine/improve/proximal_step.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ccdt {
namespace {

/// Gradients in space have four that are affinely independent; one more joins before another leaves.
constexpr int most_in_support = 5;

/// Models with their shares in the combination: the shares are positive, their sum is 1.
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

/// The shares, of any sign, with the sum 1, that minimise sum of share * value + length / 2 * |combination|^2.
/// By Cholesky's decomposition of the matrix of the differences to the first gradient.
std::array<double, most_in_support> free_shares(const Support& support, double length) {
  constexpr double regularisation = 1e-12;
  const int n = support.size - 1;
  std::array<Point3, most_in_support - 1> difference;
  std::array<std::array<double, most_in_support - 1>, most_in_support - 1> matrix;
  std::array<double, most_in_support - 1> x;
  double trace = 0;
  for (int i = 0; i < n; ++i) {
    difference[i] = support.gradient[i + 1] - support.gradient[0];
    x[i] = support.value[0] - support.value[i + 1] - length * dot(difference[i], support.gradient[0]);
    for (int j = 0; j <= i; ++j) matrix[i][j] = length * dot(difference[i], difference[j]);
    trace += matrix[i][i];
  }
  for (int i = 0; i < n; ++i) {
    matrix[i][i] += regularisation * (trace + 1e-100);
    for (int j = 0; j <= i; ++j) {
      double sum = matrix[i][j];
      for (int k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      matrix[i][j] =
          i == j ? std::sqrt(std::max(sum, regularisation * regularisation * trace + 1e-200)) : sum / matrix[j][j];
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= matrix[i][k] * x[k];
    x[i] /= matrix[i][i];
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

/// Goes from the shares towards the free ones until one becomes zero, and on without that, until all are positive.
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
  constexpr double enough = 0.02;  // of the gain may be missing
  Lowest lowest = find_lowest(models, {});
  const double now = lowest.value;
  Support support;
  support.add(models, lowest.model, 1);
  ProximalStep found{{}, now};
  for (int round = 0; round < most_rounds; ++round) {
    found.step = length * support.combination();
    lowest = find_lowest(models, found.step);
    found.least = lowest.value;
    // All models of the support agree there, and no combination can promise more.
    const double promised = support.value[0] + dot(support.gradient[0], found.step);
    if (promised - lowest.value <= enough * (promised - now)) break;
    const auto end = support.model.begin() + support.size;
    if (support.size == most_in_support || std::find(support.model.begin(), end, lowest.model) != end) break;
    support.add(models, lowest.model, 0);
    settle(length, support);
  }
  return found;
}

}  // namespace ccdt
