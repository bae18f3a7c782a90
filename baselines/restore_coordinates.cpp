#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "baselines/common.h"

namespace ccdt {
namespace {

using Coordinates = std::array<double, 3>;
using Rounding = double (*)(double);

template <int Digits>
double in_digits(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", Digits, value);
  return std::strtod(text.data(), nullptr);
}

double in_single_precision(double value) {
  return static_cast<float>(value);
}

/// Read from a binary STL, for one, and written as text.
template <int Digits>
double in_digits_of_single_precision(double value) {
  return in_digits<Digits>(in_single_precision(value));
}

/// How programs and formats round, the finest first.
constexpr std::array<Rounding, 5> roundings = {in_digits<16>, in_digits<15>, in_single_precision,
                                               in_digits_of_single_precision<16>, in_digits_of_single_precision<9>};

/// Adding zero turns -0 into +0.
Coordinates key(const Point3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

Coordinates rounded(const Point3& p, Rounding rounding) {
  return key({rounding(p.x), rounding(p.y), rounding(p.z)});
}

/// A vertex of the mesh and the coordinates that it is to have instead.
struct Restored {
  std::size_t vertex = 0;
  Point3 before, after;
};

/// Vertices of the mesh by their coordinates that are none of the input's, and of the input that the mesh has not.
struct Strangers {
  std::map<Coordinates, std::size_t> of_mesh;
  std::vector<Point3> of_input;
};

Strangers find_strangers(const std::vector<Point3>& input, const std::vector<Point3>& vertices) {
  Strangers strangers;
  for (std::size_t v = 0; v < vertices.size(); ++v) strangers.of_mesh.try_emplace(key(vertices[v]), v);
  for (const Point3& p : input)
    if (!strangers.of_mesh.contains(key(p))) strangers.of_input.push_back(p);
  if (strangers.of_input.empty()) return {};
  std::vector<Coordinates> known;
  for (const Point3& p : input) known.push_back(key(p));
  for (const Coordinates& coordinates : known) strangers.of_mesh.erase(coordinates);
  return strangers;
}

/// Matches what is equal after rounding, and takes it out of the strangers. Of input vertices that rounding makes equal
/// none is matched.
void match(Strangers& strangers, Rounding rounding, std::vector<Restored>& restored) {
  std::map<Coordinates, int> count;
  for (const Point3& p : strangers.of_input) ++count[rounded(p, rounding)];
  std::erase_if(strangers.of_input, [&](const Point3& p) {
    const Coordinates coordinates = rounded(p, rounding);
    const auto found = strangers.of_mesh.find(coordinates);
    if (found == strangers.of_mesh.end() || count[coordinates] != 1) return false;
    restored.push_back({found->second, {coordinates[0], coordinates[1], coordinates[2]}, p});
    strangers.of_mesh.erase(found);
    return true;
  });
}

/// Is the volume greater than all errors of rounding that its computation can have?
bool is_surely_positive(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  constexpr double relative_error = 16 * 0x1p-53;
  const Point3& a = mesh.vertices[t[0]];
  const Point3 b = mesh.vertices[t[1]] - a, c = mesh.vertices[t[2]] - a, d = mesh.vertices[t[3]] - a;
  const auto abs = [](double x) { return std::fabs(x); };
  const double permanent = (abs(b.y * c.z) + abs(b.z * c.y)) * abs(d.x) + (abs(b.z * c.x) + abs(b.x * c.z)) * abs(d.y) +
                           (abs(b.x * c.y) + abs(b.y * c.x)) * abs(d.z);
  return dot(cross(b, c), d) > relative_error * permanent;
}

/// Takes back what has spoilt a tetrahedron, until none is spoilt.
std::size_t take_back_spoilers(const std::vector<Restored>& restored, TetMesh& mesh) {
  std::map<std::uint32_t, const Restored*> changed;
  for (const Restored& r : restored) changed[static_cast<std::uint32_t>(r.vertex)] = &r;
  for (bool is_spoilt = true; is_spoilt;) {
    is_spoilt = false;
    for (const auto& t : mesh.tetrahedra) {
      const auto is_changed = [&](std::uint32_t v) { return changed.contains(v); };
      if (std::ranges::none_of(t, is_changed) || is_surely_positive(mesh, t)) continue;
      is_spoilt = true;
      for (const std::uint32_t v : t)
        if (const auto found = changed.find(v); found != changed.end()) {
          mesh.vertices[v] = found->second->before;
          changed.erase(found);
        }
    }
  }
  return changed.size();
}

}  // namespace

std::size_t restore_coordinates(const std::vector<Point3>& input, TetMesh& mesh) {
  Strangers strangers = find_strangers(input, mesh.vertices);
  std::vector<Restored> restored;
  for (const Rounding rounding : roundings)
    if (!strangers.of_input.empty()) match(strangers, rounding, restored);
  for (const Restored& r : restored) mesh.vertices[r.vertex] = r.after;
  return take_back_spoilers(restored, mesh);
}

}  // namespace ccdt
