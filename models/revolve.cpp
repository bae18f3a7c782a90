#include "models/revolve.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ccdt::models {
namespace {

constexpr double row_height = 0.8660254037844386;  // of a row of equilateral triangles with edges of length one

/// The wanted edge length at a place along a profile between two rings with given spacings.
double spacing_at(double along, double length, const Ring& from, const Ring& to, double edge_length) {
  double spacing = edge_length;
  if (from.radius > 0) spacing = std::min(spacing, from.spacing() + edge_length_growth * along);
  if (to.radius > 0) spacing = std::min(spacing, to.spacing() + edge_length_growth * (length - along));
  return spacing;
}

/// The places along the profile of the rows between the two rings. Their spacing follows the edge length.
std::vector<double> row_places(const Ring& from, const Ring& to, double length, double edge_length) {
  constexpr int samples = 512;
  std::vector<double> rows(samples + 1, 0.0);
  for (int i = 0; i < samples; ++i) {
    const double spacing = spacing_at(length * (i + 0.5) / samples, length, from, to, edge_length);
    rows[static_cast<std::size_t>(i) + 1] =
        rows[static_cast<std::size_t>(i)] + length / samples / (row_height * spacing);
  }
  const int count = std::max(1, static_cast<int>(std::lround(rows.back())));
  std::vector<double> places;
  for (int k = 1; k < count; ++k) {
    const double wanted = rows.back() * k / count;
    const auto above = std::upper_bound(rows.begin(), rows.end(), wanted);
    const double fraction = (wanted - above[-1]) / (above[0] - above[-1]);
    places.push_back(length * (static_cast<double>(above - rows.begin()) - 1 + fraction) / samples);
  }
  return places;
}

/// Joins two rings by one row of triangles, always along the shorter diagonal, beginning at the nearest pair of
/// vertices.
void join_rings(ModelSurface& surface, const Ring& lower, const Ring& upper, int marker) {
  const auto& a = lower.chain;
  const auto& b = upper.chain;
  const auto gap = [&](std::size_t i, std::size_t j) {
    return squared_length(surface.vertices[b[j % b.size()]] - surface.vertices[a[i % a.size()]]);
  };
  std::size_t start = 0;
  for (std::size_t j = 1; j < b.size(); ++j) {
    if (gap(0, j) < gap(0, start)) start = j;
  }
  std::size_t i = 0, j = 0;
  const std::size_t steps_a = a.size() == 1 ? 0 : a.size();
  const std::size_t steps_b = b.size() == 1 ? 0 : b.size();
  while (i < steps_a || j < steps_b) {
    const bool along_a = j == steps_b || (i < steps_a && gap(i + 1, start + j) <= gap(i, start + j + 1));
    const std::uint32_t here_a = a[i % a.size()], here_b = b[(start + j) % b.size()];
    if (along_a) {
      ++i;
      add_triangle(surface, here_a, a[i % a.size()], here_b, marker);
    } else {
      ++j;
      add_triangle(surface, here_a, b[(start + j) % b.size()], here_b, marker);
    }
  }
}

}  // namespace

Profile straight_profile(ProfilePoint from, ProfilePoint to) {
  const double length = std::hypot(to.radius - from.radius, to.height - from.height);
  return {
      length, [=](double s) {
        const double t = s / length;
        return ProfilePoint{from.radius + t * (to.radius - from.radius), from.height + t * (to.height - from.height)};
      }};
}

Profile round_profile(ProfilePoint center, double radius, double from, double to) {
  const double length = radius * std::fabs(to - from) * std::numbers::pi / 180;
  return {length, [=](double s) {
            const double angle = from + (to - from) * s / length;
            return ProfilePoint{center.radius + radius * cosine(angle), center.height + radius * sine(angle)};
          }};
}

Ring inner_ring(ModelSurface& surface, const Revolution& revolution, ProfilePoint at, double spacing, double phase) {
  const Point3 local = to_local(revolution.axis, revolution.center);
  const Point3 middle = to_model(revolution.axis, {local.x, local.y, at.height});
  const int count = std::max(3, static_cast<int>(std::lround(2 * std::numbers::pi * at.radius / spacing)));
  Ring result{{}, at.radius, at.height};
  for (int i = 0; i < count; ++i) {
    const double degrees = 360.0 * (i + phase) / count;
    result.chain.push_back(add_vertex(surface, on_circle(revolution.axis, middle, at.radius, degrees)));
  }
  return result;
}

void add_revolution(ModelSurface& surface, const Ring& from, const Ring& to, const Profile& profile,
                    const Revolution& revolution) {
  Ring before = from;
  double phase = 0;
  for (const double place : row_places(from, to, profile.length, revolution.edge_length)) {
    phase = phase == 0 ? 0.5 : 0;  // so that rows with the same number of vertices interlock
    const double spacing = spacing_at(place, profile.length, from, to, revolution.edge_length);
    Ring row = inner_ring(surface, revolution, profile.at(place), spacing, phase);
    join_rings(surface, before, row, revolution.marker);
    before = std::move(row);
  }
  join_rings(surface, before, to, revolution.marker);
}

void add_cone(ModelSurface& surface, const Ring& from, const Ring& to, const Revolution& revolution) {
  add_revolution(surface, from, to, straight_profile({from.radius, from.height}, {to.radius, to.height}), revolution);
}

void add_closed_rows(ModelSurface& surface, std::span<const Ring> rings, const Revolution& revolution) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    join_rings(surface, rings[i], rings[(i + 1) % rings.size()], revolution.marker);
  }
}

}  // namespace ccdt::models
