#include "models/model_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ccdt::models {

std::uint32_t add_vertex(ModelSurface& surface, const Point3& point) {
  surface.vertices.push_back(point);
  return static_cast<std::uint32_t>(surface.vertices.size() - 1);
}

std::uint32_t corner(ModelSurface& surface, const Point3& point) {
  const auto found = surface.corners.find(as_array(point));
  if (found != surface.corners.end()) return found->second;
  const std::uint32_t id = add_vertex(surface, point);
  surface.corners.emplace(as_array(point), id);
  return id;
}

void add_triangle(ModelSurface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c, int marker) {
  surface.triangles.push_back({a, b, c});
  surface.markers.push_back(marker);
}

double distance(const Point3& a, const Point3& b) {
  return std::sqrt(squared_length(b - a));
}

Chain reversed(const Chain& chain) {
  return Chain(chain.rbegin(), chain.rend());
}

Chain closed_loop(std::span<const Chain> chains) {
  Chain loop;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const Chain& next = chains[(i + 1) % chains.size()];
    if (chains[i].back() != next.front()) throw std::logic_error("the chains of a loop do not meet");
    loop.insert(loop.end(), chains[i].begin(), chains[i].end() - 1);
  }
  return loop;
}

plc::InputPlc to_input(ModelSurface&& surface, plc::InputPlc::Inside inside) {
  plc::InputPlc input;
  input.inside = inside;
  input.vertices = std::move(surface.vertices);
  input.triangles = std::move(surface.triangles);
  input.triangle_markers = std::move(surface.markers);
  return input;
}

}  // namespace ccdt::models
