#include <algorithm>
#include <cmath>
#include <map>

#include "tests/fuzz/scene.h"

namespace ccdt::fuzz {

namespace {

/// Whole points on a circle of radius 5.
constexpr std::array<std::array<double, 2>, 12> ring = {
    {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}, {-4, 3}, {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}}};

int count(Scene& scene, int least, int most) {
  return static_cast<int>(scene.random().between(least, most));
}

/// Two different levels, the smaller first.
std::array<double, 2> interval(Scene& scene, int axis) {
  double a = 0, b = 0;
  while (a == b) a = scene.level(axis), b = scene.level(axis);
  return {std::min(a, b), std::max(a, b)};
}

Point3 turned(int axis, const Point3& p) {
  return axis == 0 ? p : axis == 1 ? Point3{p.z, p.x, p.y} : Point3{p.y, p.z, p.x};
}

/// The outline of a comb in the plane: a back and teeth of different lengths.
std::vector<std::array<double, 2>> comb_outline(Scene& scene) {
  const int teeth = count(scene, 2, 6);
  const double gap = scene.chance(2) ? 1 : scene.tiny(1, 10);
  std::vector<std::array<double, 2>> outline = {{0, 0}, {16, 0}};
  const double pitch = 16.0 / teeth;
  for (int i = teeth; i-- > 0;) {
    const double tip = static_cast<double>(scene.random().between(8, 16)), left = i * pitch, right = left + pitch;
    const double valley = static_cast<double>(scene.random().between(2, 6));
    outline.push_back({i + 1 == teeth ? 16 : right - gap / 2, tip});
    outline.push_back({i == 0 ? 0 : left + gap / 2, tip});
    if (i == 0) break;
    outline.push_back({left + gap / 2, valley});
    outline.push_back({left - gap / 2, valley});
  }
  return outline;
}

/// Rings of vertices one above the other, each turned against the one below.
std::vector<std::vector<Point3>> turned_rings(Scene& scene, int corners, int stories, int turn) {
  const double height = scene.chance(2) ? 16.0 / stories : scene.tiny(-2, 6);
  const std::size_t step = 12 / static_cast<std::size_t>(corners);
  std::vector<std::vector<Point3>> rings;
  for (int s = 0; s <= stories; ++s) {
    rings.emplace_back();
    for (int k = 0; k < corners; ++k) {
      const auto& [x, y] = ring[(static_cast<std::size_t>(k) * step + static_cast<std::size_t>(s * turn)) % 12];
      rings.back().push_back({8 + x, 8 + y, s * height});
    }
  }
  return rings;
}

}  // namespace

// ---- Bodies ---------------------------------------------------------------------------------------------------------

void box_body(Scene& scene) {
  scene.box({0, 0, 0}, {16, 16, 16});
}

/// Cells of a grid, each outside or of one of two kinds; all squares between different kinds.
void voxel_body(Scene& scene) {
  std::array<std::vector<double>, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] = {0};
    const int cells = count(scene, 1, 4);
    for (int i = 0; i < cells; ++i)
      at[axis].push_back(at[axis].back() + (scene.chance(5) ? scene.tiny(1, 12) : count(scene, 1, 4)));
  }
  std::map<std::array<int, 3>, int> kind;
  const auto cells = [&](int axis) { return static_cast<int>(at[axis].size()) - 1; };
  for (int x = 0; x < cells(0); ++x)
    for (int y = 0; y < cells(1); ++y)
      for (int z = 0; z < cells(2); ++z) kind[{x, y, z}] = count(scene, 0, 2);
  kind[{0, 0, 0}] = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i <= cells(axis); ++i)
      for (int j = 0; j < cells(u); ++j)
        for (int k = 0; k < cells(v); ++k) {
          std::array<int, 3> cell{};
          cell[axis] = i, cell[u] = j, cell[v] = k;
          const int above = kind[cell];
          --cell[axis];
          if (above != kind[cell])
            scene.rectangle(axis, at[axis][i], {at[u][j], at[v][k], at[u][j + 1], at[v][k + 1]},
                            scene.chance(8) ? count(scene, 1, 2) : 0);
        }
  }
  // Voids are inside with seeds; some of them become holes.
  for (const auto& [cell, what] : kind) {
    const auto [x, y, z] = cell;
    if (x < 0 || y < 0 || z < 0 || x >= cells(0) || y >= cells(1) || z >= cells(2)) continue;
    const Point3 middle = {(at[0][x] + at[0][x + 1]) / 2, (at[1][y] + at[1][y + 1]) / 2, (at[2][z] + at[2][z + 1]) / 2};
    if (what == 0 && scene.chance(3)) scene.hole(middle);
    if (what == 2 && scene.chance(8)) scene.region(middle, 2);
  }
}

/// A box with a cavity or an inner region.
void hollow_body(Scene& scene) {
  box_body(scene);
  const double size = static_cast<double>(scene.random().between(1, 6)), gap = scene.chance(2) ? 4 : scene.tiny(0, 10);
  scene.box({gap, 8 - size, 8 - size}, {16 - gap, 8 + size, 8 + size});
  if (scene.chance(2))
    scene.hole({8, 8, 8});
  else
    scene.region({8, 8, 8}, 5);
}

void comb_body(Scene& scene) {
  const auto outline = comb_outline(scene);
  const double depth = scene.chance(2) ? 16 : scene.tiny(-3, 6);
  std::vector<Point3> bottom, top;
  for (const auto& [x, y] : outline) {
    bottom.push_back({x, y, 0});
    top.push_back({x, y, depth});
  }
  scene.facet(bottom);
  scene.facet(top);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t j = (i + 1) % outline.size();
    scene.facet({bottom[i], bottom[j], top[j], top[i]});
  }
}

/// A tower of twisted prisms: those of Schoenhardt and of Bagemihl are among them.
void screw_body(Scene& scene) {
  const int corners = std::array{3, 4, 6}[scene.random().below(3)], stories = count(scene, 1, 5);
  const auto rings = turned_rings(scene, corners, stories, count(scene, 1, 2));
  const bool reflex = scene.chance(2);
  scene.facet(rings.front());
  scene.facet(rings.back());
  for (std::size_t s = 0; s + 1 < rings.size(); ++s)
    for (std::size_t k = 0; k < rings[s].size(); ++k) {
      const std::size_t l = (k + 1) % rings[s].size();
      const auto& low = rings[s];
      const auto& high = rings[s + 1];
      if (reflex) {
        scene.facet({low[k], low[l], high[k]});
        scene.facet({low[l], high[l], high[k]});
      } else {
        scene.facet({low[k], low[l], high[l]});
        scene.facet({low[k], high[l], high[k]});
      }
    }
}

/// A stack of boxes, some of them very thin, with a region each.
void plates_body(Scene& scene) {
  double z = 0;
  const int plates = count(scene, 2, 6);
  for (int i = 0; i <= plates; ++i) {
    scene.rectangle(2, z, {0, 0, 16, 16});
    const double next = z + (scene.chance(3) ? 4 : scene.tiny(0, 14));
    if (i == plates) break;
    for (const double side : {0.0, 16.0}) {
      scene.rectangle(0, side, {0, z, 16, next});
      scene.rectangle(1, side, {z, 0, next, 16});
    }
    z = next;
  }
}

void bipyramid_body(Scene& scene) {
  const std::size_t step = std::array{1, 2, 3, 4}[scene.random().below(4)];
  const double up = scene.tiny(-4, 8), down = scene.tiny(-4, 8);
  std::vector<Point3> rim;
  for (std::size_t k = 0; k < 12; k += step) rim.push_back({8 + ring[k][0], 8 + ring[k][1], 8});
  for (std::size_t k = 0; k < rim.size(); ++k)
    for (const double z : {8 + up, 8 - down}) scene.facet({rim[k], rim[(k + 1) % rim.size()], {8, 8, z}});
  if (scene.chance(3)) scene.facet(rim, 3);
}

// ---- Things within a body -------------------------------------------------------------------------------------------

void loose_rectangle(Scene& scene) {
  const int axis = count(scene, 0, 2);
  const auto [u, x] = interval(scene, (axis + 1) % 3);
  const auto [v, y] = interval(scene, (axis + 2) % 3);
  scene.rectangle(axis, scene.level(axis), {u, v, x, y}, count(scene, 0, 1));
}

void loose_triangle(Scene& scene) {
  scene.facet({scene.point(), scene.point(), scene.point()}, count(scene, 0, 2));
}

/// Triangles around one segment.
void fan(Scene& scene) {
  const Point3 a = scene.point(), b = scene.point();
  const int triangles = count(scene, 2, 7);
  for (int i = 0; i < triangles; ++i) scene.facet({a, b, scene.point()});
}

/// Segments side by side, a little skew.
void bundle_of_segments(Scene& scene) {
  const Point3 a = scene.point(), b = scene.point();
  const int segments = count(scene, 2, 8);
  const double spacing = scene.tiny(0, 10);
  const auto offset = [&] {
    return Point3{spacing * count(scene, 0, 7) / 8, spacing * count(scene, 0, 7) / 8, spacing * count(scene, 0, 7) / 8};
  };
  const double inward = 0.25;  // away from the ends of a common segment, which are often on the body
  for (int i = 0; i < segments; ++i) scene.segment(a + inward * (b - a) + offset(), b + inward * (a - b) + offset());
}

/// A comb in one plane, or teeth that are facets side by side.
void comb(Scene& scene) {
  const int axis = count(scene, 0, 2);
  const double at = static_cast<double>(count(scene, 1, 15));
  if (scene.chance(2)) {
    std::vector<Point3> corners;
    for (const auto& [x, y] : comb_outline(scene)) corners.push_back(turned(axis, {at, 1 + 0.875 * x, 1 + 0.875 * y}));
    return scene.facet(corners, 1);
  }
  const int teeth = count(scene, 2, 6);
  const double spacing = scene.chance(2) ? 1 : scene.tiny(1, 8);
  for (int i = 0; i < teeth; ++i)
    scene.rectangle(axis, at + i * spacing, {2, 2, static_cast<double>(count(scene, 4, 14)), 14});
}

/// A strip that winds around an axis.
void screw(Scene& scene) {
  const int steps = count(scene, 3, 14), axis = count(scene, 0, 2);
  const double pitch = scene.chance(2) ? 1 : scene.tiny(1, 8), from = count(scene, 0, 2);
  const auto on_axis = [&](int i) { return turned(axis, {from + i * pitch, 8, 8}); };
  const auto on_rim = [&](int i) {
    const auto& [x, y] = ring[static_cast<std::size_t>(i) % 12];
    return turned(axis, {from + i * pitch, 8 + x, 8 + y});
  };
  for (int i = 0; i < steps; ++i) {
    scene.facet({on_axis(i), on_rim(i), on_rim(i + 1)});
    if (pitch > 0) scene.facet({on_axis(i), on_rim(i + 1), on_axis(i + 1)});
  }
}

/// Thin plates one above the other, with their sides or without.
void stacked_plates(Scene& scene) {
  const int axis = count(scene, 0, 2), plates = count(scene, 2, 5);
  const auto [u, x] = interval(scene, (axis + 1) % 3);
  const auto [v, y] = interval(scene, (axis + 2) % 3);
  double at = scene.level(axis);
  for (int i = 0; i < plates; ++i) {
    scene.rectangle(axis, at, {u, v, x, y});
    at += scene.tiny(0, 14);
  }
}

void star_of_segments(Scene& scene) {
  const Point3 center = scene.point();
  const int rays = count(scene, 3, 12);
  for (int i = 0; i < rays; ++i) {
    const auto& [x, y] = ring[scene.random().below(12)];
    scene.segment(center, scene.chance(2) ? scene.point() : center + Point3{x / 4, y / 4, scene.tiny(0, 6)});
  }
}

void loose_vertices(Scene& scene) {
  const int vertices = count(scene, 1, 8);
  for (int i = 0; i < vertices; ++i) {
    const Point3 p = scene.point();
    scene.vertex(scene.chance(2) ? p : p + Point3{scene.tiny(0, 12), scene.tiny(0, 12), scene.tiny(0, 12)});
  }
}

void chain_of_segments(Scene& scene) {
  Point3 a = scene.point();
  const int links = count(scene, 1, 5);
  for (int i = 0; i < links; ++i) {
    const Point3 b = scene.point();
    scene.segment(a, b);
    a = b;
  }
}

}  // namespace ccdt::fuzz
