#include "models/tests/surface_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace ccdt::testing {

Triangles boundary_triangles(const plc::InputPlc& input) {
  const bool has_interior = input.name == "bracket";
  Triangles result;
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    if (!has_interior || input.triangle_markers[i] < interior_face_marker) result.push_back(input.triangles[i]);
  }
  return result;
}

Triangles triangles_with_marker(const plc::InputPlc& input, int marker) {
  Triangles result;
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    if (input.triangle_markers[i] == marker) result.push_back(input.triangles[i]);
  }
  return result;
}

std::vector<EdgeUse> edges_of(const Triangles& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      if (from < to) {
        uses.push_back({{from, to}, 1, 0});
      } else {
        uses.push_back({{to, from}, 0, 1});
      }
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.ends < b.ends; });
  std::vector<EdgeUse> edges;
  for (const EdgeUse& use : uses) {
    if (edges.empty() || edges.back().ends != use.ends) {
      edges.push_back(use);
    } else {
      edges.back().forwards += use.forwards;
      edges.back().backwards += use.backwards;
    }
  }
  return edges;
}

double enclosed_volume(const std::vector<Point3>& vertices, const Triangles& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += dot(vertices[a], cross(vertices[b], vertices[c]));
  return sum / 6;
}

double winding_number(const std::vector<Point3>& vertices, const Triangles& triangles, const Point3& point) {
  double angle = 0;  // van Oosterom & Strackee 1983
  for (const auto& t : triangles) {
    const Point3 a = vertices[t[0]] - point, b = vertices[t[1]] - point, c = vertices[t[2]] - point;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    angle += 2 * std::atan2(dot(a, cross(b, c)), denominator);
  }
  return angle / (4 * std::numbers::pi);
}

long euler_characteristic(const Triangles& triangles) {
  std::set<std::uint32_t> used;
  for (const auto& t : triangles) used.insert(t.begin(), t.end());
  return static_cast<long>(used.size()) - static_cast<long>(edges_of(triangles).size()) +
         static_cast<long>(triangles.size());
}

double quantile(std::vector<double> values, double fraction) {
  const auto rank = static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

std::vector<double> smallest_angles(const plc::InputPlc& input) {
  std::vector<double> angles;
  for (const auto& t : input.triangles) {
    double smallest = 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3& corner = input.vertices[t[k]];
      const Point3 u = input.vertices[t[(k + 1) % 3]] - corner, v = input.vertices[t[(k + 2) % 3]] - corner;
      const double radians = std::atan2(std::sqrt(squared_length(cross(u, v))), dot(u, v));
      smallest = std::min(smallest, radians * 180 / std::numbers::pi);
    }
    angles.push_back(smallest);
  }
  return angles;
}

std::vector<double> edge_lengths(const plc::InputPlc& input) {
  std::vector<double> lengths;
  for (const EdgeUse& edge : edges_of(input.triangles)) {
    lengths.push_back(std::sqrt(squared_length(input.vertices[edge.ends[1]] - input.vertices[edge.ends[0]])));
  }
  return lengths;
}

}  // namespace ccdt::testing
