// Products of a small dense matrix, and of a sparse one.

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "studies/gate/layouts/kernels/work.h"

namespace kernels {
namespace {

constexpr std::size_t size = 20;
using Matrix = std::array<std::array<double, size>, size>;

[[gnu::noinline]] void add_product(const Matrix& a, const Matrix& b, Matrix& result) {
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) {
      double sum = result[i][j];
      for (std::size_t k = 0; k < size; ++k) sum += a[i][k] * b[k][j];
      result[i][j] = sum;
    }
}

void matrix(benchmark::State& state) {
  Random random(8);
  Matrix a = {}, b = {};
  for (Matrix* m : {&a, &b})
    for (auto& row : *m)
      for (double& value : row) value = random.below(1000) / 1000.0;
  const int passes = passes_of("matrix");
  for (auto _ : state) {
    Matrix sum = {};
    for (int pass = 0; pass < passes; ++pass) {
      add_product(a, b, sum);
      benchmark::ClobberMemory();
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(matrix);

/// Compressed rows.
struct SparseMatrix {
  std::vector<int> row_begins, columns;
  std::vector<double> values;
};

[[gnu::noinline]] void multiply(const SparseMatrix& m, const std::vector<double>& vector, std::vector<double>& result) {
  for (std::size_t row = 0; row < result.size(); ++row) {
    double sum = 0;
    for (int at = m.row_begins[row]; at < m.row_begins[row + 1]; ++at)
      sum += m.values[static_cast<std::size_t>(at)] *
             vector[static_cast<std::size_t>(m.columns[static_cast<std::size_t>(at)])];
    result[row] = sum;
  }
}

/// Five points of a grid: each place, and its neighbors.
SparseMatrix grid_matrix(int width, int height) {
  SparseMatrix m;
  m.row_begins.push_back(0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto add = [&](int dx, int dy) {
        if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) return;
        m.columns.push_back((y + dy) * width + x + dx);
        m.values.push_back(dx == 0 && dy == 0 ? 4 : -1);
      };
      add(0, -1);
      add(-1, 0);
      add(0, 0);
      add(1, 0);
      add(0, 1);
      m.row_begins.push_back(static_cast<int>(m.columns.size()));
    }
  return m;
}

void sparse(benchmark::State& state) {
  constexpr int width = 30, height = 20;
  const SparseMatrix m = grid_matrix(width, height);
  Random random(9);
  std::vector<double> vector(width * height), result(vector.size());
  for (double& value : vector) value = random.below(1000);
  const int passes = passes_of("sparse");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) {
      multiply(m, vector, result);
      benchmark::DoNotOptimize(result.data());
      benchmark::ClobberMemory();
    }
}
BENCHMARK(sparse);

}  // namespace
}  // namespace kernels
