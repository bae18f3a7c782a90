#include "bench/verify/check_domain.h"

#include <cmath>
#include <cstdio>
#include <unordered_set>

#include "bench/verify/findings.h"

namespace ccdt::verify {

namespace {

/// A sum that keeps what rounding would lose (Neumaier 1974).
class Sum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

std::string text_of_tetrahedron(const mesh::TetMesh& mesh, std::size_t t) {
  Point3 center;
  for (const std::uint32_t v : mesh.tetrahedra[t]) center = center + 0.25 * mesh.vertices[v];
  return "tetrahedron " + std::to_string(t) + " around " + text(center);
}

int attribute_of(const mesh::TetMesh& mesh, std::size_t t) {
  return mesh.regions.empty() ? 0 : mesh.regions[t];
}

/// The attributes that tetrahedra of each region may have: where there is no seed, that of the first one. (A region
/// of tetrahedra within facets alone has none.)
std::vector<std::vector<int>> wanted_regions(const mesh::TetMesh& mesh, const Regions& regions,
                                             const RegionsOfTetrahedra& assigned) {
  auto wanted = regions.attributes;
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::uint32_t c = assigned.region[t];
    if (c != none && wanted[c].empty() && assigned.other_region.count(t) == 0)
      wanted[c].push_back(attribute_of(mesh, t));
  }
  return wanted;
}

/// Empties a queue of tetrahedra. Calls enter(neighbor, tetrahedron) for those behind the faces that `is_open` names,
/// which may put more into the queue.
template <class IsOpen, class Enter>
void flood(const Topology& topology, std::vector<std::uint32_t>& queue, const IsOpen& is_open, const Enter& enter) {
  while (!queue.empty()) {
    const std::uint32_t t = queue.back();
    queue.pop_back();
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t f = topology.face_of[4 * t + corner];
      if (!topology.on_boundary(f) && is_open(f)) enter(topology.across(f, t), t);
    }
  }
}

/// Finds the tetrahedra between two sheets of faces that both span an interior facet: those with all four vertices on
/// the sheet that was taken and near its plane, that a way through such connects with it.
void find_flat_tetrahedra(const Topology& topology, const Regions& regions, std::span<const MatchedFace> sheet,
                          const Plane& plane, double flat, RegionsOfTetrahedra& assigned) {
  const std::uint32_t a = regions.of_side[2 * sheet[0].piece], b = regions.of_side[2 * sheet[0].piece + 1];
  if (a == b) return;
  std::unordered_set<std::uint32_t> on_sheet;
  for (const MatchedFace& f : sheet) on_sheet.insert(topology.faces[f.face].begin(), topology.faces[f.face].end());
  const auto is_on_sheet = [&](std::uint32_t v) {
    return std::fabs(dot(plane.normal, topology.mesh.vertices[v] - plane.point)) <= flat && on_sheet.count(v) > 0;
  };
  std::vector<std::uint32_t> queue;
  const auto enter = [&](std::uint32_t tet, std::uint32_t) {
    const std::uint32_t c = assigned.region[tet];
    if ((c != a && c != b) || !std::ranges::all_of(topology.mesh.tetrahedra[tet], is_on_sheet)) return;
    if (assigned.other_region.try_emplace(tet, c == a ? b : a).second) queue.push_back(tet);
  };
  for (const MatchedFace& f : sheet)
    for (const std::uint32_t tet : {f.tet_above, f.tet_below}) enter(tet, none);
  flood(
      topology, queue, [](std::uint32_t) { return true; }, enter);
}

/// Every tetrahedron is in one region, and that is inside.
Check check_inside(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = "tetrahedra in the domain", .checked = mesh.tetrahedra.size()};
  for (const std::uint32_t t : assigned.conflicts)
    fail(check, [&] { return text_of_tetrahedron(mesh, t) + " leaks through a facet"; });
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::uint32_t c = assigned.region[t];
    if (c == none)
      fail(check, [&] { return text_of_tetrahedron(mesh, t) + " is connected with no facet of the input"; });
    else if (regions.inside[c] != Inside::yes)
      fail(check, [&] { return text_of_tetrahedron(mesh, t) + " is outside"; });
  }
  return check;
}

/// A tetrahedron has the attribute of the region seed in its region; without a seed, the same as all in the region.
/// One that lies within an interior facet may have the attribute of either side.
Check check_regions(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = regions_check, .checked = mesh.tetrahedra.size()};
  const auto wanted = wanted_regions(mesh, regions, assigned);
  const auto is_wanted = [&](int region, std::uint32_t c) {
    return wanted[c].empty() || std::find(wanted[c].begin(), wanted[c].end(), region) != wanted[c].end();
  };
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::uint32_t c = assigned.region[t];
    const int region = attribute_of(mesh, t);
    if (c == none || is_wanted(region, c)) continue;
    const auto other_region = assigned.other_region.find(t);
    if (other_region != assigned.other_region.end() && is_wanted(region, other_region->second)) continue;
    fail(check, [&] {
      return text_of_tetrahedron(mesh, t) + " has region " + std::to_string(region) + " instead of " +
             std::to_string(wanted[c][0]);
    });
  }
  return check;
}

/// No tetrahedron is in a region with a hole's point.
Check check_holes(const plc::InputPlc& input, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = "holes", .checked = input.holes.size()};
  std::vector<std::uint64_t> tetrahedra(regions.count(), 0);
  for (const std::uint32_t c : assigned.region)
    if (c != none) ++tetrahedra[c];
  for (std::uint32_t c = 0; c < regions.count(); ++c) {
    if (regions.hole_seeds[c] == 0 || tetrahedra[c] == 0) continue;
    fail(check, [&] { return "there are " + std::to_string(tetrahedra[c]) + " tetrahedra in a hole"; });
  }
  return check;
}

/// The volumes are equal to 1e-9, and what moving the surface within the tolerance can change.
Check check_volume(const Surface& surface, const Regions& regions, double of_mesh, double of_input) {
  Check check{.name = "volume", .checked = 1};
  double area = 0;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    if (regions.touches_inside(p)) area += length(surface.area_vector[p]);
  if (std::fabs(of_mesh - of_input) <= 1e-9 * std::fabs(of_input) + surface.tolerances.flat * area) return check;
  fail(check, [&] {
    char buffer[128];
    std::snprintf(buffer, sizeof buffer, "the mesh has the volume %.17g, the input %.17g", of_mesh, of_input);
    return std::string(buffer);
  });
  return check;
}

}  // namespace

double mesh_volume(const mesh::TetMesh& mesh) {
  Sum sum;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const Point3& o = mesh.vertices[a];
    sum.add(dot(cross(mesh.vertices[b] - o, mesh.vertices[c] - o), mesh.vertices[d] - o) / 6);
  }
  return sum.value();
}

double input_volume(const Surface& surface, const Regions& regions) {
  Sum sum;
  if (surface.pieces() == 0) return 0;
  const Point3 apex = surface.origin(0);
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const bool above = regions.inside[regions.of_side[2 * p]] == Inside::yes;
    const bool below = regions.inside[regions.of_side[2 * p + 1]] == Inside::yes;
    const double cone = dot(surface.area_vector[p], surface.origin(p) - apex) / 3;
    if (above != below) sum.add(below ? cone : -cone);
  }
  return sum.value();
}

RegionsOfTetrahedra assign_regions(const Topology& topology, const Regions& regions, const FacetMatches& matches,
                                   double flat) {
  RegionsOfTetrahedra assigned;
  assigned.region.assign(topology.mesh.tetrahedra.size(), none);
  std::vector<std::uint32_t> queue;
  const auto enter = [&](std::uint32_t tet, std::uint32_t region) {
    if (tet == none) return;
    if (assigned.region[tet] == none) {
      assigned.region[tet] = region;
      queue.push_back(tet);
    } else if (assigned.region[tet] != region) {
      assigned.conflicts.push_back(tet);
    }
  };
  for (const MatchedFace& f : matches.faces) {
    enter(f.tet_above, regions.of_side[2 * f.piece]);
    enter(f.tet_below, regions.of_side[2 * f.piece + 1]);
  }
  flood(
      topology, queue, [&](std::uint32_t face) { return !matches.is_matched[face]; },
      [&](std::uint32_t tet, std::uint32_t from) { enter(tet, assigned.region[from]); });
  sort_and_unique(assigned.conflicts);
  for (auto begin = matches.faces.begin(); begin != matches.faces.end();) {
    const auto end =
        std::find_if(begin, matches.faces.end(), [&](const MatchedFace& f) { return f.plane != begin->plane; });
    if (begin->plane != none)
      find_flat_tetrahedra(topology, regions, {begin, end}, matches.planes[begin->plane], flat, assigned);
    begin = end;
  }
  return assigned;
}

void resolve_unknown(const RegionsOfTetrahedra& assigned, Regions& regions) {
  std::vector<bool> filled(regions.count(), false);
  for (const std::uint32_t c : assigned.region)
    if (c != none) filled[c] = true;
  for (std::uint32_t c = 0; c < regions.count(); ++c)
    if (regions.inside[c] == Inside::unknown) regions.inside[c] = filled[c] ? Inside::yes : Inside::no;
}

void check_domain(const plc::InputPlc& input, const mesh::TetMesh& mesh, const Surface& surface, const Regions& regions,
                  const RegionsOfTetrahedra& assigned, Verification& result) {
  result.checks.push_back(check_inside(mesh, regions, assigned));
  result.checks.push_back(check_holes(input, regions, assigned));
  result.checks.push_back(check_regions(mesh, regions, assigned));
  result.mesh_volume = mesh_volume(mesh);
  result.input_volume = input_volume(surface, regions);
  result.checks.push_back(check_volume(surface, regions, result.mesh_volume, result.input_volume));
}

}  // namespace ccdt::verify
