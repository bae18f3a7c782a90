#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/point.h"

/// Small sets of points in grid units: general ones, and the ones that are hard for a Delaunay tetrahedralization.
namespace ccdt::test {

std::vector<Point3> random_points(int n, std::uint64_t seed);

/// Lattices of n^3 unit cells, a unit cell being `step` wide.
std::vector<Point3> simple_cubic(int n, double step = 1048576);
std::vector<Point3> body_centered(int n, double step = 1048576);
std::vector<Point3> face_centered(int n, double step = 1048576);

/// At least n points (all of the integer points, a multiple of 8) exactly on one sphere around `center`.
std::vector<Point3> points_on_sphere(std::size_t n, const Point3& center = {});

/// Most points on the faces of a box, some of them on a grid, and few inside.
std::vector<Point3> points_on_box(int n, std::uint64_t seed);
/// Most points on three lines that meet in one of them.
std::vector<Point3> points_on_lines(int n, std::uint64_t seed);
/// All points but the first in a plane, on a grid.
std::vector<Point3> plane_and_apex(int n);
/// Two circles of integer points in parallel planes.
std::vector<Point3> two_circles();

std::vector<Point3> shuffled(std::vector<Point3> points, std::uint64_t seed);

/// A set with a name, for tests that run on all of them. The first halves of sets of 16 points and more are not flat.
struct NamedPoints {
  const char* name;
  std::vector<Point3> points;
};

/// Sets of up to 35 points, small enough to look at all quadruples.
std::vector<NamedPoints> tiny_sets();
/// Sets of several hundred points, small enough to look at all pairs of a cell and a point.
std::vector<NamedPoints> small_sets();

}  // namespace ccdt::test
