#pragma once

#include <array>
#include <cmath>
#include <cstdint>

/// Functions whose last bits differ between libraries, and even between processors. These use only operations that IEEE
/// 754 rounds alike everywhere, so results are the same on every machine. They are accurate to about 1e-15.
namespace ccdt::portable {

inline constexpr double pi = 3.14159265358979323846;

/// The cube root of a positive number, by Newton's method.
inline double cube_root(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const int third = exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);  // rounded down
  const double a = std::ldexp(fraction, exponent - 3 * third);             // from 0.5 to 4
  double root = 0.65 + 0.25 * a;
  for (int i = 0; i < 7; ++i) root = (2 * root + a / (root * root)) / 3;
  return std::ldexp(root, third);
}

/// The angle from 0 to pi between the x axis and (x, y) with y >= 0, in radians; 0 for (0, 0).
inline double angle_of(double x, double y) {
  if (y == 0) return x < 0 ? pi : 0;
  const double size = std::fabs(x);
  // The tangents of 0, pi / 16, ... up to pi / 4: the rest of the angle, from the nearest of them, is at most pi / 32.
  constexpr std::array<double, 5> tangents = {0, 0.19891236737965800691, 0.41421356237309504880, 0.66817863791929891999,
                                              1};
  const bool steep = y > size;
  const double tangent = steep ? size / y : y / size;
  const auto nearest = static_cast<std::size_t>(tangent < 0.0985   ? 0
                                                : tangent < 0.3033 ? 1
                                                : tangent < 0.5345 ? 2
                                                : tangent < 0.8206 ? 3
                                                                   : 4);
  const double rest = (tangent - tangents[nearest]) / (1 + tangent * tangents[nearest]), square = rest * rest;
  double sum = 0;
  for (int n = 15; n >= 3; n -= 2) sum = square * (1.0 / n - sum);
  const double angle = static_cast<double>(nearest) * (pi / 16) + rest * (1 - sum);
  const double upright = steep ? pi / 2 - angle : angle;
  return x < 0 ? pi - upright : upright;
}

/// The angle from 0 to pi whose cosine is x. \pre -1 <= x <= 1
inline double arc_cosine(double x) {
  return angle_of(x, std::sqrt((1 - x) * (1 + x)));
}

/// \pre  0 <= angle <= 2 pi
inline double sine(double angle) {
  if (angle > pi) return -sine(angle - pi);
  const double x = angle > pi / 2 ? pi - angle : angle, square = x * x;
  double sum = 0;
  for (int n = 25; n >= 3; n -= 2) sum = square / (n * (n - 1)) * (1 - sum);
  return x * (1 - sum);
}

/// \pre  0 <= angle <= 3/2 pi
inline double cosine(double angle) {
  return sine(angle + pi / 2);
}

}  // namespace ccdt::portable
