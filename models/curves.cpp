#include "models/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace ccdt::models {
namespace {

int parts_of(double length, double spacing) {
  return std::max(1, static_cast<int>(std::lround(length / spacing)));
}

Point3 mix(const Point3& a, const Point3& b, double t) {
  return a + t * (b - a);
}

/// Arc length from the start of the curve at equally spaced parameters.
std::vector<double> arc_lengths(const std::function<Point3(double)>& position, int samples) {
  std::vector<double> length(static_cast<std::size_t>(samples) + 1, 0.0);
  Point3 before = position(0);
  for (int i = 1; i <= samples; ++i) {
    const Point3 here = position(static_cast<double>(i) / samples);
    length[static_cast<std::size_t>(i)] = length[static_cast<std::size_t>(i) - 1] + distance(before, here);
    before = here;
  }
  return length;
}

}  // namespace

Point3 to_model(Axis axis, const Point3& local) {
  if (axis == Axis::x) return {local.z, local.x, local.y};
  if (axis == Axis::y) return {local.y, local.z, local.x};
  return local;
}

Point3 to_local(Axis axis, const Point3& model) {
  if (axis == Axis::x) return {model.y, model.z, model.x};
  if (axis == Axis::y) return {model.z, model.x, model.y};
  return model;
}

double cosine(double degrees) {
  const double turn = std::fmod(std::fabs(degrees), 360.0);
  if (turn == 0) return 1;
  if (turn == 90 || turn == 270) return 0;
  if (turn == 180) return -1;
  return std::cos(turn * std::numbers::pi / 180);
}

double sine(double degrees) {
  const double turn = std::fmod(std::fabs(degrees), 360.0);
  const double sign = degrees < 0 ? -1 : 1;
  if (turn == 0 || turn == 180) return 0;
  if (turn == 90) return sign;
  if (turn == 270) return -sign;
  return sign * std::sin(turn * std::numbers::pi / 180);
}

Point3 on_circle(Axis axis, const Point3& center, double radius, double degrees) {
  const Point3 local = to_local(axis, center);
  return to_model(axis, {local.x + radius * cosine(degrees), local.y + radius * sine(degrees), local.z});
}

double spacing_beside(double edge_length, double width) {
  return std::min(edge_length, 1.75 * width);
}

Chain line(ModelSurface& surface, const Point3& from, const Point3& to, double spacing) {
  const int parts = parts_of(distance(from, to), spacing);
  Chain chain{corner(surface, from)};
  for (int i = 1; i < parts; ++i) chain.push_back(add_vertex(surface, mix(from, to, static_cast<double>(i) / parts)));
  chain.push_back(corner(surface, to));
  return chain;
}

Chain curve(ModelSurface& surface, const Point3& from, const Point3& to, const std::function<Point3(double)>& position,
            double spacing, int least_parts) {
  const int rough = parts_of(distance(from, to), spacing);
  const int samples = 64 * std::max(rough, least_parts);
  const std::vector<double> length = arc_lengths(position, samples);
  const int parts = std::max(least_parts, parts_of(length.back(), spacing));
  Chain chain{corner(surface, from)};
  for (int i = 1; i < parts; ++i) {
    const double wanted = length.back() * i / parts;
    const auto above = std::upper_bound(length.begin(), length.end(), wanted);
    const double fraction = (wanted - above[-1]) / (above[0] - above[-1]);
    const double parameter = (static_cast<double>(above - length.begin()) - 1 + fraction) / samples;
    chain.push_back(add_vertex(surface, position(parameter)));
  }
  chain.push_back(corner(surface, to));
  return chain;
}

Chain arc(ModelSurface& surface, Axis axis, const Point3& center, double radius, double from, double to,
          double spacing) {
  const double turn = std::fabs(to - from);
  const int least = static_cast<int>(std::ceil(turn * least_edges_of_circle / 360 - 1e-9));
  const int parts = std::max(least, parts_of(radius * turn * std::numbers::pi / 180, spacing));
  Chain chain{corner(surface, on_circle(axis, center, radius, from))};
  for (int i = 1; i < parts; ++i) {
    chain.push_back(add_vertex(surface, on_circle(axis, center, radius, from + (to - from) * i / parts)));
  }
  chain.push_back(corner(surface, on_circle(axis, center, radius, to)));
  return chain;
}

double Ring::spacing() const {
  if (chain.size() < 2) return 0;
  return 2 * radius * std::sin(std::numbers::pi / static_cast<double>(chain.size()));
}

Ring ring(ModelSurface& surface, Axis axis, const Point3& center, double radius, double height, double spacing) {
  const Point3 local = to_local(axis, center);
  const Point3 middle = to_model(axis, {local.x, local.y, height});
  if (radius == 0) return {{corner(surface, middle)}, 0, height};
  const int quarter = std::max(least_edges_of_circle / 4, parts_of(radius * std::numbers::pi / 2, spacing));
  Ring result{{}, radius, height};
  for (int i = 0; i < 4 * quarter; ++i) {
    const Point3 point = on_circle(axis, middle, radius, 90.0 * i / quarter);
    result.chain.push_back(i % quarter == 0 ? corner(surface, point) : add_vertex(surface, point));
  }
  return result;
}

Chain part_of(const Ring& ring, int from_quarter, int to_quarter) {
  const int count = static_cast<int>(ring.chain.size());
  Chain part;
  for (int i = from_quarter * count / 4; i <= to_quarter * count / 4; ++i) {
    part.push_back(ring.chain[static_cast<std::size_t>(i % count)]);
  }
  return part;
}

}  // namespace ccdt::models
