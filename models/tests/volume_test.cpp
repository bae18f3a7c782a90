#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/solids.h"
#include "models/tests/surface_checks.h"

namespace ccdt::testing {
namespace {

constexpr double pi = std::numbers::pi;

double cylinder(double radius, double height) {
  return pi * radius * radius * height;
}

double frustum(double a, double b, double height) {
  return pi * height * (a * a + a * b + b * b) / 3;
}

/// The volume of the part of a horizontal cylinder (radius r, along x) between the plane x = `from` and a vertical
/// cylinder of radius R.
double up_to_cylinder(double r, double from, double R) {
  constexpr int steps = 200000;  // midpoint rule over y = r sin t, smooth and periodic in t
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = pi * ((i + 0.5) / steps - 0.5), y = r * std::sin(t);
    const double chord = 2 * r * std::cos(t), dy = r * std::cos(t) * pi / steps;
    sum += (std::sqrt(R * R - y * y) - from) * chord * dy;
  }
  return sum;
}

double piston_volume() {
  const double grooves = 3 * (cylinder(40, 4) - cylinder(36, 4));
  const double bowl = pi * 5 * (3 * 24 * 24 + 5 * 5) / 6;
  const double fillet =
      pi * (26.0 * 26 * 6 + 2 * 26 * (pi * 36 / 4) + (36.0 * 6 - 6.0 * 6 * 6 / 3));  // its layer of the hollow
  const double hollow = cylinder(32, 52) + fillet;
  const double bosses = 2 * up_to_cylinder(15, 14, 32);
  const double bores = 2 * up_to_cylinder(9, 14, 40);
  return cylinder(40, 70) - grooves - bowl - hollow + bosses - bores;
}

double bracket_volume() {
  const double leg = 8 * (64 * 60 - 2 * (1 - pi / 4) * 144 - 2 * pi * 25);
  const double bend = 60 * pi / 4 * (256 - 64);
  const double gusset = 8 * (36.0 * 36 / 2 - (1 - pi / 4) * 64);
  return 2 * leg + bend + gusset;
}

double stepping_pole_volume() {
  const double stub = 14 * frustum(5.5, 7, 1.75) + cylinder(5.5, 5.5);
  const double hexagon = 1.5 * std::sqrt(3.0) * 17 * 17 * 8;
  const double degree = pi / 180;
  const double tooth = (18 * 18 + 15 * 15) * 10 * degree / 2 + 18 * 15 * std::sin(5 * degree);
  const double fillet = pi * (18.0 * 18 * 4 + 2 * 18 * (pi * 16 / 4) + (16.0 * 4 - 64.0 / 3));
  const double cap = cylinder(22, 5) + fillet;
  const double bore = frustum(9, 7.5, 1.5) + cylinder(7.5, 85.5 - 45) + cylinder(7.5, 4) / 3;
  return stub + hexagon + cylinder(22, 5) + 12 * tooth * 65 + cap - bore;
}

/// The prismatoid formula; the section half way up is a hexagon with vertices at cos 15 and cos 75 degrees from the
/// axis.
double schoenhardt_volume() {
  const double middle = 3 * std::cos(pi / 12) * std::cos(5 * pi / 12) * std::sin(pi / 3);
  return (2 * 3 * std::sqrt(3.0) / 4 + 4 * middle) / 6;
}

double volume_of(std::string_view name, double edge_length) {
  const plc::InputPlc input = models::make_solid(name, edge_length);
  return enclosed_volume(input.vertices, boundary_triangles(input));
}

/// Chords of curves are off by the square of the edge length, so the error falls by nine for a third of it.
void expect_quadratic_convergence(std::string_view name, double edge_length, double exact, double tolerance) {
  const double coarse = std::fabs(volume_of(name, edge_length) - exact);
  const double fine = std::fabs(volume_of(name, edge_length / 3) - exact);
  EXPECT_LT(fine, coarse / 5) << name << ": " << coarse / exact << " then " << fine / exact;
  EXPECT_LT(fine, tolerance * exact) << name << ": " << fine / exact;
}

TEST(Volume, OfThePistonConvergesToThatOfItsDesign) {
  expect_quadratic_convergence("piston", 3, piston_volume(), 3e-4);
}

TEST(Volume, OfTheBracketConvergesToThatOfItsDesign) {
  expect_quadratic_convergence("bracket", 2.4, bracket_volume(), 2e-4);
}

TEST(Volume, OfTheSteppingPoleConvergesToThatOfItsDesign) {
  expect_quadratic_convergence("stepping-pole", 1.5, stepping_pole_volume(), 4e-4);
}

TEST(Volume, OfTheSphereConverges) {
  expect_quadratic_convergence("sphere", 0.1, 4 * pi / 3, 5e-4);
}

TEST(Volume, OfTheTorusConverges) {
  expect_quadratic_convergence("torus", 0.1, 2 * pi * pi * 0.4 * 0.4, 1e-3);
}

TEST(Volume, OfTheCubeIsExact) {
  EXPECT_DOUBLE_EQ(volume_of("cube", 1), 1);
  EXPECT_NEAR(volume_of("cube", 0.05), 1, 1e-12);
}

TEST(Volume, OfSchoenhardtsPolyhedronIsThatOfThePrismatoid) {
  EXPECT_NEAR(volume_of("schoenhardt", 0), schoenhardt_volume(), 1e-12);
}

}  // namespace
}  // namespace ccdt::testing
