#include "bench/verify/check_domain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_set>

#include "bench/verify/findings.h"
#include "engine/base/union_find.h"

namespace ccdt::verify {

namespace {

/// A sum that compensates rounding errors (Neumaier 1974).
class Sum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  void add(const Sum& other) {
    add(other.sum_);
    add(other.lost_);
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

/// The attributes that tetrahedra of each region may have; without a seed, that of the first tetrahedron. (A region
/// that consists only of tetrahedra within facets has none.)
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

/// Empties a queue of tetrahedra. Calls enter(neighbor, tetrahedron) for each neighbor across a face that `is_open`
/// accepts. The call may add tetrahedra to the queue.
template <class IsOpen, class Enter>
void flood(const Topology& topology, std::vector<std::uint32_t>& queue, const IsOpen& is_open, const Enter& enter) {
  while (!queue.empty()) {
    const std::uint32_t t = queue.back();
    queue.pop_back();
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t f = face_of(topology, 4 * t + corner);
      if (!topology.on_boundary(f) && is_open(f)) enter(topology.across(f, t), t);
    }
  }
}

/// Calls enter(tetrahedron, region) for the tetrahedra at the faces that stand for facets.
template <class Enter>
void visit_matched_sides(const Regions& regions, const FacetMatches& matches, const Enter& enter) {
  for (const MatchedFace& f : matches.faces) {
    if (f.tet_above != none) enter(f.tet_above, regions.of_side[2 * f.piece]);
    if (f.tet_below != none) enter(f.tet_below, regions.of_side[2 * f.piece + 1]);
  }
}

/// Assigns one region to all tetrahedra that are connected without crossing a facet. Faces that stand for facets say
/// which region it is.
///
/// \return  false if these faces do not agree: then some tetrahedra are reached from two regions
bool assign_to_components(const Topology& topology, const Regions& regions, const FacetMatches& matches,
                          RegionsOfTetrahedra& assigned) {
  const std::size_t size = topology.mesh.tetrahedra.size();
  UnionFind components(size);
  parallel_for(topology.face_count(), chunk_length, [&](std::size_t f) {
    const auto [one, other] = topology.half_faces[f];
    if (other != none && !matches.is_matched[f]) components.join(one / 4, other / 4);
  });
  assigned.region.assign(size, none);  // first of the representatives
  bool agree = true;
  visit_matched_sides(regions, matches, [&](std::uint32_t tet, std::uint32_t region) {
    std::uint32_t& its_region = assigned.region[components.find(tet)];
    if (its_region == none) its_region = region;
    agree = agree && its_region == region;
  });
  if (!agree) return false;
  parallel_for(size, chunk_length, [&](std::size_t t) {
    const std::uint32_t first = components.find(static_cast<std::uint32_t>(t));
    if (first != t) assigned.region[t] = assigned.region[first];
  });
  return true;
}

/// The same if regions do not agree: floods the mesh from all faces that stand for facets.
void assign_by_flood(const Topology& topology, const Regions& regions, const FacetMatches& matches,
                     RegionsOfTetrahedra& assigned) {
  assigned.region.assign(topology.mesh.tetrahedra.size(), none);
  std::vector<std::uint32_t> queue;
  const auto enter = [&](std::uint32_t tet, std::uint32_t region) {
    if (assigned.region[tet] == none) {
      assigned.region[tet] = region;
      queue.push_back(tet);
    } else if (assigned.region[tet] != region) {
      assigned.conflicts.push_back(tet);
    }
  };
  visit_matched_sides(regions, matches, enter);
  flood(
      topology, queue, [&](std::uint32_t face) { return !matches.is_matched[face]; },
      [&](std::uint32_t tet, std::uint32_t from) { enter(tet, assigned.region[from]); });
  sort_and_unique(assigned.conflicts);
}

/// Finds the tetrahedra between two sheets of faces that both span an interior facet. Such a tetrahedron has all four
/// vertices on the chosen sheet and near its plane, and is connected with the sheet through others of this kind.
void find_flat_tetrahedra(const Topology& topology, const Regions& regions, std::span<const MatchedFace> sheet,
                          const Plane& plane, double flat, RegionsOfTetrahedra& assigned) {
  const std::uint32_t a = regions.of_side[2 * sheet[0].piece], b = regions.of_side[2 * sheet[0].piece + 1];
  if (a == b) return;
  std::unordered_set<std::uint32_t> on_sheet;
  for (const MatchedFace& f : sheet)
    for (const std::uint32_t v : vertices_of_face(topology, f.face)) on_sheet.insert(v);
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

/// Every tetrahedron is in one region, which is inside.
Check check_inside(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = "tetrahedra in the domain"};
  for (const std::uint32_t t : assigned.conflicts)
    fail(check, [&] { return text_of_tetrahedron(mesh, t) + " leaks through a facet"; });
  const auto is_inside = [&](std::size_t t) {
    const std::uint32_t c = assigned.region[t];
    return c != none && regions.inside[c] == Inside::yes;
  };
  check_each(check, mesh.tetrahedra.size(), is_inside, [&](std::size_t t) {
    return text_of_tetrahedron(mesh, t) +
           (assigned.region[t] == none ? " is not connected to any facet of the input" : " is outside");
  });
  return check;
}

/// A tetrahedron has the attribute of its region's seed; without a seed, all tetrahedra of a region have the same one.
/// One that lies within an interior facet may have the attribute of either side.
Check check_regions(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = regions_check};
  const auto wanted = wanted_regions(mesh, regions, assigned);
  const auto is_wanted = [&](int region, std::uint32_t c) {
    return wanted[c].empty() || std::find(wanted[c].begin(), wanted[c].end(), region) != wanted[c].end();
  };
  const auto is_right = [&](std::size_t t) {
    const std::uint32_t c = assigned.region[t];
    const int region = attribute_of(mesh, t);
    if (c == none || is_wanted(region, c)) return true;
    const auto other_region = assigned.other_region.find(static_cast<std::uint32_t>(t));
    return other_region != assigned.other_region.end() && is_wanted(region, other_region->second);
  };
  check_each(check, mesh.tetrahedra.size(), is_right, [&](std::size_t t) {
    return text_of_tetrahedron(mesh, t) + " has region " + std::to_string(attribute_of(mesh, t)) + " instead of " +
           std::to_string(wanted[assigned.region[t]][0]);
  });
  return check;
}

/// No tetrahedron is in a region with a hole seed.
Check check_holes(const plc::InputPlc& input, const Regions& regions, const RegionsOfTetrahedra& assigned) {
  Check check{.name = "holes", .checked = input.holes.size()};
  if (input.holes.empty()) return check;
  std::vector<std::uint64_t> tetrahedra(regions.count(), 0);
  for (const std::uint32_t c : assigned.region)
    if (c != none) ++tetrahedra[c];
  for (std::uint32_t c = 0; c < regions.count(); ++c) {
    if (regions.hole_seeds[c] == 0 || tetrahedra[c] == 0) continue;
    fail(check, [&] { return "there are " + std::to_string(tetrahedra[c]) + " tetrahedra in a hole"; });
  }
  return check;
}

/// The volumes agree within 1e-9, plus the change from moving the surface within the tolerance.
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
  const auto add_some = [&](std::size_t begin, std::size_t end) {
    Sum sum;
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c, d] = mesh.tetrahedra[t];
      const Point3& o = mesh.vertices[a];
      sum.add(dot(cross(mesh.vertices[b] - o, mesh.vertices[c] - o), mesh.vertices[d] - o) / 6);
    }
    return sum;
  };
  Sum sum;
  for (const Sum& part : parallel_chunks(mesh.tetrahedra.size(), chunk_length, add_some)) sum.add(part);
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
  if (!assign_to_components(topology, regions, matches, assigned))
    assign_by_flood(topology, regions, matches, assigned);
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
  if (std::ranges::count(regions.inside, Inside::unknown) == 0) return;
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
