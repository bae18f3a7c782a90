#include "tests/fuzz/near_duplicates.h"

#include <array>
#include <span>
#include <utility>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt::fuzz {

namespace {

using small_plcs::Random;
using Corners = std::vector<std::uint32_t>;

/// 10^-k. The powers of the standard library differ between machines in the last bit.
double power(std::int64_t k) {
  double result = 1;
  for (; k > 0; --k) result /= 10;
  return result;
}

class Clusters {
 public:
  explicit Clusters(std::uint64_t seed) : random_(seed) {
    plc_.inside = chance(2) ? plc::InputPlc::Inside::even_odd : plc::InputPlc::Inside::seeds;
    for (std::int64_t n = random_.between(2, 4); n > 0; --n)
      levels_.push_back(pick(std::array{0., 0.25, 1. / 3, 0.5, 0.75, 1.}));
    distances_.push_back(0);
    for (std::int64_t n = random_.between(1, 3); n > 0; --n) distances_.push_back(power(random_.between(5, 17)));
    scale_ = pick(std::array{1., 4., 1e-3, 1e3, 0x1p-20});
    if (chance(3)) offset_ = pick(std::array{1., -7., 1e3, 1e6});
  }

  plc::InputPlc make() {
    for (std::int64_t n = random_.between(1, 3); n > 0; --n) chance(3) ? add_tetrahedron() : add_box();
    const std::size_t of_bodies = plc_.vertices.size();
    for (std::int64_t n = random_.between(0, 3); n > 0; --n) add_facet({any(), any(), any()});
    if (chance(4)) add_facet({near(of_bodies), near(of_bodies), near(of_bodies)});
    if (plc_.inside == plc::InputPlc::Inside::seeds)
      for (std::int64_t n = random_.between(0, 2); n > 0; --n) add_segment(any(), any());
    return std::move(plc_);
  }

 private:
  bool chance(std::uint64_t one_in) { return random_.below(one_in) == 0; }

  double pick(std::span<const double> values) { return values[random_.below(values.size())]; }

  double coordinate() {
    const double level = chance(6) ? static_cast<double>(random_.between(-8, 8)) / 8 : pick(levels_);
    return scale_ * (offset_ + level + static_cast<double>(random_.between(-1, 1)) * pick(distances_));
  }

  std::uint32_t add_vertex(const Point3& p) {
    plc_.vertices.push_back(p);
    return static_cast<std::uint32_t>(plc_.vertices.size() - 1);
  }

  std::uint32_t new_vertex() { return add_vertex({coordinate(), coordinate(), coordinate()}); }

  std::uint32_t any() { return chance(2) ? new_vertex() : near(plc_.vertices.size()); }

  /// One of the first vertices, or one of its cluster.
  std::uint32_t near(std::size_t first) {
    const auto there = static_cast<std::uint32_t>(random_.below(first));
    if (chance(2)) return there;
    Point3 p = plc_.vertices[there];
    for (double* x : {&p.x, &p.y, &p.z}) *x += scale_ * static_cast<double>(random_.between(-1, 1)) * pick(distances_);
    return add_vertex(p);
  }

  void add_facet(const Corners& corners) {
    const auto number = static_cast<std::uint32_t>(plc_.polygon_facets.size());
    plc_.polygon_facets.push_back({{corners}, {}, 0, number});
  }

  void add_segment(std::uint32_t a, std::uint32_t b) {
    if (a != b) plc_.segments.push_back({a, b});
  }

  void add_box() {
    const std::array<double, 2> x = {coordinate(), coordinate()}, y = {coordinate(), coordinate()},
                                z = {coordinate(), coordinate()};
    std::array<std::uint32_t, 8> v{};
    for (std::uint32_t i = 0; i < 8; ++i) v[i] = add_vertex({x[i & 1], y[i >> 1 & 1], z[i >> 2]});
    if (chance(4)) v[random_.below(8)] = near(plc_.vertices.size());
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    const bool in_triangles = chance(2);
    for (const auto& [a, b, c, d] : sides)
      if (in_triangles)
        add_facet({v[a], v[b], v[c]}), add_facet({v[a], v[c], v[d]});
      else
        add_facet({v[a], v[b], v[c], v[d]});
  }

  void add_tetrahedron() {
    const std::uint32_t a = new_vertex(), b = new_vertex(), c = new_vertex(), d = any();
    for (const Corners& corners : {Corners{a, b, c}, Corners{a, d, b}, Corners{b, d, c}, Corners{c, d, a}})
      add_facet(corners);
  }

  Random random_;
  std::vector<double> levels_, distances_;  // as parts of the whole
  double scale_ = 1, offset_ = 0;
  plc::InputPlc plc_;
};

}  // namespace

plc::InputPlc near_duplicates(std::uint64_t seed) {
  return Clusters(seed).make();
}

}  // namespace ccdt::fuzz
