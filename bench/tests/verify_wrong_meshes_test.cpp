#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "bench/tests/verify_cases.h"
#include "engine/mesher.h"

// Ways in which a mesh of a whole input can be wrong, each tried at several random places. All must be found.

namespace ccdt {
namespace {

using mesh::TetMesh;
using Random = std::mt19937;
using Edge = std::array<std::uint32_t, 2>;
using Face = std::array<std::uint32_t, 3>;

constexpr int outer_marker = 1, wall_marker = 7, slit_marker = 8, hole_marker = 9, segment_marker = 5;

/// Adds a quadrilateral.
void add_facet(const std::array<Point3, 4>& corners, int marker, InputPlc& plc) {
  PolygonFacet facet;
  facet.marker = marker;
  facet.number = static_cast<std::uint32_t>(plc.polygon_facets.size());
  facet.polygons.emplace_back();
  for (const Point3& p : corners) {
    const auto found = std::ranges::find(plc.vertices, p);
    facet.polygons[0].push_back(static_cast<std::uint32_t>(found - plc.vertices.begin()));
    if (found == plc.vertices.end()) plc.vertices.push_back(p);
  }
  plc.polygon_facets.push_back(facet);
}

/// The sides of a box between two corners.
void add_box(const Point3& low, const Point3& high, int marker, InputPlc& plc) {
  const auto at = [&](int i) { return Point3{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; };
  for (const auto& [a, b, c, d] : std::to_array<std::array<int, 4>>(
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}))
    add_facet({at(a), at(b), at(c), at(d)}, marker, plc);
}

/// What the input has beside its two rooms.
struct Furniture {
  bool wall = true, slit = true, hole = true, segment = true, vertex = true;
};

/// Two rooms with a wall between them. One has a slit in it, the other a hole, a segment and a vertex.
InputPlc two_rooms(const Furniture& with = {}) {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  add_box({0, 0, 0}, {2, 2, 2}, outer_marker, plc);
  add_box({2, 0, 0}, {4, 2, 2}, outer_marker, plc);
  std::erase_if(plc.polygon_facets, [&](const PolygonFacet& facet) {
    return std::ranges::all_of(facet.polygons[0], [&](std::uint32_t v) { return plc.vertices[v].x == 2; });
  });
  if (with.wall) add_facet({Point3{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}}, wall_marker, plc);
  if (with.slit) add_facet({Point3{0.5, 0.5, 1}, {1.5, 0.5, 1}, {1.5, 1.5, 1}, {0.5, 1.5, 1}}, slit_marker, plc);
  if (with.hole) add_box({2.5, 0.5, 0.5}, {3, 1, 1}, hole_marker, plc), plc.holes = {{2.75, 0.75, 0.75}};
  const auto n = static_cast<std::uint32_t>(plc.vertices.size());
  if (with.segment) {
    plc.vertices.insert(plc.vertices.end(), {{3.3, 0.4, 0.5}, {3.6, 1.6, 1.4}});
    plc.segments = {{n, n + 1}}, plc.segment_markers = {segment_marker};
  }
  if (with.vertex) plc.vertices.push_back({2.75, 1.5, 1.5});
  plc.regions = {{{0.1, 0.1, 0.1}, 10, 0}, {{3.9, 0.1, 0.1}, 20, 0}};
  if (!with.wall) plc.regions.pop_back();
  return plc;
}

TetMesh meshed(const InputPlc& input, Improvement improvement = Improvement::none) {
  MeshOptions options;
  options.edge_length = 0.6;
  options.improve.improvement = improvement;
  return mesh_plc(input, options).mesh;
}

/// A random index.
std::size_t any(std::size_t size, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, size - 1)(random);
}

template <class List>
auto& any_of(List& list, Random& random) {
  return list[any(list.size(), random)];
}

void add_tetrahedron(const std::array<std::uint32_t, 4>& tetrahedron, int region, TetMesh& m) {
  m.tetrahedra.push_back(tetrahedron);
  m.regions.push_back(region);
}

void remove_tetrahedron(std::size_t t, TetMesh& m) {
  m.tetrahedra.erase(m.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
  m.regions.erase(m.regions.begin() + static_cast<std::ptrdiff_t>(t));
}

template <class List, class Markers, class IsRemoved>
void remove_if(List& list, Markers& markers, const IsRemoved& is_removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!is_removed(i)) list[kept] = list[i], markers[kept++] = markers[i];
  list.resize(kept);
  markers.resize(kept);
}

/// A random one of the faces with a marker.
std::size_t face_with(int marker, const TetMesh& m, Random& random) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < m.faces.size(); ++i)
    if (m.face_markers[i] == marker) found.push_back(i);
  return any_of(found, random);
}

void remove_face(std::size_t face, TetMesh& m) {
  remove_if(m.faces, m.face_markers, [&](std::size_t i) { return i == face; });
}

void remove_faces_with(int marker, TetMesh& m) {
  remove_if(m.faces, m.face_markers, [&](std::size_t i) { return m.face_markers[i] == marker; });
}

template <std::size_t n>
std::array<std::uint32_t, n> sorted(std::array<std::uint32_t, n> vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

/// A random face of a tetrahedron that is not listed.
Face inner_face(const TetMesh& m, Random& random) {
  std::set<Face> listed;
  for (const Face& face : m.faces) listed.insert(sorted(face));
  for (;;) {
    const auto& [a, b, c, d] = any_of(m.tetrahedra, random);
    if (!listed.contains(sorted(Face{a, b, c}))) return {a, b, c};
  }
}

/// A random edge of a tetrahedron that is not listed. It may be within a facet.
Edge unlisted_edge(const TetMesh& m, Random& random) {
  std::set<Edge> listed;
  for (const Edge& edge : m.edges) listed.insert(sorted(edge));
  for (;;) {
    const auto& t = any_of(m.tetrahedra, random);
    if (!listed.contains(sorted(Edge{t[0], t[1]}))) return {t[0], t[1]};
  }
}

/// Two random vertices that no edge joins.
Edge no_edge(const TetMesh& m, Random& random) {
  for (;;) {
    const auto a = static_cast<std::uint32_t>(any(m.vertices.size(), random));
    const auto b = static_cast<std::uint32_t>(any(m.vertices.size(), random));
    if (a != b && std::ranges::none_of(m.tetrahedra, [&](const auto& t) {
          return std::ranges::count(t, a) > 0 && std::ranges::count(t, b) > 0;
        }))
      return {a, b};
  }
}

/// A random vertex of the input's first ones, the corners of facets.
Point3& any_corner(TetMesh& m, Random& random) {
  return m.vertices[any(12, random)];
}

/// A random vertex inside.
Point3& any_inner(TetMesh& m, Random& random) {
  std::set<std::uint32_t> outer;
  for (const Face& face : m.faces) outer.insert(face.begin(), face.end());
  for (const Edge& edge : m.edges) outer.insert(edge.begin(), edge.end());
  for (;;) {
    const auto v = any(m.vertices.size(), random);
    if (!outer.contains(static_cast<std::uint32_t>(v))) return m.vertices[v];
  }
}

void move_all(const std::function<Point3(const Point3&)>& to, TetMesh& m) {
  for (Point3& p : m.vertices) p = to(p);
}

struct Mistake {
  const char* name;
  std::function<void(TetMesh&, Random&)> make;
};

const std::vector<Mistake> mistakes_in_tetrahedra = {
    {"no tetrahedra", [](TetMesh& m, Random&) { m.tetrahedra.clear(), m.regions.clear(); }},
    {"a missing one", [](TetMesh& m, Random& r) { remove_tetrahedron(any(m.tetrahedra.size(), r), m); }},
    {"a missing region",
     [](TetMesh& m, Random&) {
       remove_if(m.tetrahedra, m.regions, [&](std::size_t t) { return m.regions[t] == 20; });
     }},
    {"one twice",
     [](TetMesh& m, Random& r) {
       const std::size_t t = any(m.tetrahedra.size(), r);
       add_tetrahedron(m.tetrahedra[t], m.regions[t], m);
     }},
    {"one twice, turned",
     [](TetMesh& m, Random& r) {
       const auto [a, b, c, d] = any_of(m.tetrahedra, r);
       add_tetrahedron({b, c, a, d}, 10, m);
     }},
    {"all twice",
     [](TetMesh& m, Random&) {
       for (std::size_t t = 0, n = m.tetrahedra.size(); t < n; ++t) add_tetrahedron(m.tetrahedra[t], m.regions[t], m);
     }},
    {"an inverted one",
     [](TetMesh& m, Random& r) {
       auto& t = any_of(m.tetrahedra, r);
       std::swap(t[0], t[1]);
     }},
    {"all inverted",
     [](TetMesh& m, Random&) {
       for (auto& t : m.tetrahedra) std::swap(t[0], t[1]);
     }},
    {"a vertex twice",
     [](TetMesh& m, Random& r) {
       auto& t = any_of(m.tetrahedra, r);
       t[0] = t[3];
     }},
    {"a vertex that does not exist",
     [](TetMesh& m, Random& r) { any_of(m.tetrahedra, r)[2] = static_cast<std::uint32_t>(m.vertices.size()); }},
    {"another vertex",
     [](TetMesh& m, Random& r) {
       auto& t = any_of(m.tetrahedra, r);
       const auto v = static_cast<std::uint32_t>(any(m.vertices.size(), r));
       if (std::ranges::count(t, v) > 0) return remove_tetrahedron(0, m);
       t[1] = v;
     }},
    {"the vertex of another one",
     [](TetMesh& m, Random& r) {
       auto& one = any_of(m.tetrahedra, r);
       auto& other = any_of(m.tetrahedra, r);
       if (one == other) return remove_tetrahedron(0, m);
       std::swap(one[0], other[3]);
     }},
    {"one without volume in a face",
     [](TetMesh& m, Random& r) {
       const auto [a, b, c] = any_of(m.faces, r);
       m.vertices.push_back(1.0 / 2 * m.vertices[a] + 1.0 / 4 * (m.vertices[b] + m.vertices[c]));
       add_tetrahedron({a, b, c, static_cast<std::uint32_t>(m.vertices.size() - 1)}, 10, m);
     }},
    {"one outside",
     [](TetMesh& m, Random& r) {
       const auto [a, b, c] = m.faces[face_with(outer_marker, m, r)];
       const Point3 middle = 1.0 / 3 * (m.vertices[a] + m.vertices[b] + m.vertices[c]);
       const Point3 normal = cross(m.vertices[b] - m.vertices[a], m.vertices[c] - m.vertices[a]);
       const double out = dot(normal, middle - Point3{2, 1, 1}) > 0 ? 1 : -1;
       m.vertices.push_back(middle + out * 0.1 * normal);
       const auto apex = static_cast<std::uint32_t>(m.vertices.size() - 1);
       out > 0 ? add_tetrahedron({a, b, c, apex}, 10, m) : add_tetrahedron({a, c, b, apex}, 10, m);
     }},
    {"one in the hole",
     [](TetMesh& m, Random& r) {
       auto [a, b, c] = m.faces[face_with(hole_marker, m, r)];
       m.vertices.push_back({2.75, 0.75, 0.75});
       const auto apex = static_cast<std::uint32_t>(m.vertices.size() - 1);
       const Point3 normal = cross(m.vertices[b] - m.vertices[a], m.vertices[c] - m.vertices[a]);
       if (dot(normal, m.vertices[apex] - m.vertices[a]) < 0) std::swap(a, b);
       add_tetrahedron({a, b, c, apex}, 20, m);
     }},
};

const std::vector<Mistake> mistakes_in_vertices = {
    {"a moved corner", [](TetMesh& m, Random& r) { any_corner(m, r).y += 1e-6; }},
    {"a vertex that left its facet",
     [](TetMesh& m, Random& r) { m.vertices[m.faces[face_with(outer_marker, m, r)][0]].x += 1e-6; }},
    {"a vertex that left its segment",
     [](TetMesh& m, Random&) {
       const Point3 end = {3.3, 0.4, 0.5};
       *std::ranges::find(m.vertices, end) = end + Point3{0, 1e-6, 0};
     }},
    {"an isolated vertex that moved",
     [](TetMesh& m, Random&) {
       const Point3 given = {2.75, 1.5, 1.5};
       *std::ranges::find(m.vertices, given) = given + Point3{0, 0, 1e-6};
     }},
    {"an inner vertex far away", [](TetMesh& m, Random& r) { any_inner(m, r).z += 10; }},
    {"a coordinate that is no number",
     [](TetMesh& m, Random& r) { any_of(m.vertices, r).x = std::numeric_limits<double>::quiet_NaN(); }},
    {"an infinite coordinate",
     [](TetMesh& m, Random& r) { any_of(m.vertices, r).y = std::numeric_limits<double>::infinity(); }},
    {"a vertex at the place of another",
     [](TetMesh& m, Random& r) {
       const auto& t = any_of(m.tetrahedra, r);
       m.vertices[t[0]] = m.vertices[t[1]];
     }},
    {"two vertices in one place",
     [](TetMesh& m, Random& r) {
       auto& t = any_of(m.tetrahedra, r);
       m.vertices.push_back(m.vertices[t[0]]);
       t[0] = static_cast<std::uint32_t>(m.vertices.size() - 1);
     }},
    {"exchanged vertices",
     [](TetMesh& m, Random& r) {
       const auto& t = any_of(m.tetrahedra, r);
       std::swap(m.vertices[t[0]], m.vertices[t[1]]);
     }},
    {"a scaled mesh", [](TetMesh& m, Random&) { move_all([](const Point3& p) { return 1.000001 * p; }, m); }},
    {"a shifted mesh",
     [](TetMesh& m, Random&) {
       move_all([](const Point3& p) { return p + Point3{0, 0, 1e-6}; }, m);
     }},
    {"a mirrored mesh",
     [](TetMesh& m, Random&) {
       move_all([](const Point3& p) { return Point3{p.x, p.y, 2 - p.z}; }, m);
     }},
    {"a flat mesh",
     [](TetMesh& m, Random&) {
       move_all([](const Point3& p) { return Point3{p.x, p.y, 0}; }, m);
     }},
};

const std::vector<Mistake> mistakes_in_regions = {
    {"one in another region",
     [](TetMesh& m, Random& r) {
       int& region = any_of(m.regions, r);
       region = 30 - region;
     }},
    {"exchanged regions",
     [](TetMesh& m, Random&) {
       for (int& region : m.regions) region = 30 - region;
     }},
    {"one region", [](TetMesh& m, Random&) { std::ranges::fill(m.regions, 10); }},
    {"regions without a number", [](TetMesh& m, Random&) { std::ranges::fill(m.regions, 0); }},
    {"no regions", [](TetMesh& m, Random&) { m.regions.clear(); }},
    {"too few regions", [](TetMesh& m, Random&) { m.regions.pop_back(); }},
};

const std::vector<Mistake> mistakes_in_faces = {
    {"a missing one outside", [](TetMesh& m, Random& r) { remove_face(face_with(outer_marker, m, r), m); }},
    {"a missing one at the hole", [](TetMesh& m, Random& r) { remove_face(face_with(hole_marker, m, r), m); }},
    {"a missing one of the wall", [](TetMesh& m, Random& r) { remove_face(face_with(wall_marker, m, r), m); }},
    {"a missing one of the slit", [](TetMesh& m, Random& r) { remove_face(face_with(slit_marker, m, r), m); }},
    {"a missing outside", [](TetMesh& m, Random&) { remove_faces_with(outer_marker, m); }},
    {"a missing wall", [](TetMesh& m, Random&) { remove_faces_with(wall_marker, m); }},
    {"a missing slit", [](TetMesh& m, Random&) { remove_faces_with(slit_marker, m); }},
    {"no faces", [](TetMesh& m, Random&) { m.faces.clear(), m.face_markers.clear(); }},
    {"one twice",
     [](TetMesh& m, Random& r) {
       const std::size_t i = any(m.faces.size(), r);
       m.faces.push_back(m.faces[i]), m.face_markers.push_back(m.face_markers[i]);
     }},
    {"one twice, turned",
     [](TetMesh& m, Random& r) {
       const std::size_t i = any(m.faces.size(), r);
       const auto [a, b, c] = m.faces[i];
       m.faces.push_back({b, a, c}), m.face_markers.push_back(m.face_markers[i]);
     }},
    {"three vertices that are no face",
     [](TetMesh& m, Random& r) {
       const auto [a, b] = no_edge(m, r);
       any_of(m.faces, r) = {a, b, a == 0 || b == 0 ? static_cast<std::uint32_t>(m.vertices.size() - 1) : 0};
     }},
    {"one inside, as a part of the slit",
     [](TetMesh& m, Random& r) {
       const Face face = inner_face(m, r);
       m.faces.push_back(face), m.face_markers.push_back(slit_marker);
     }},
    {"one inside, without a marker",
     [](TetMesh& m, Random& r) {
       const Face face = inner_face(m, r);
       m.faces.push_back(face), m.face_markers.push_back(0);
     }},
    {"one inside for one of the wall",
     [](TetMesh& m, Random& r) {
       const Face face = inner_face(m, r);
       m.faces[face_with(wall_marker, m, r)] = face;
     }},
    {"a wrong marker", [](TetMesh& m, Random& r) { any_of(m.face_markers, r) += 1; }},
    {"a wrong marker in the slit", [](TetMesh& m, Random& r) { m.face_markers[face_with(slit_marker, m, r)] = 0; }},
    {"exchanged markers",
     [](TetMesh& m, Random&) {
       for (int& marker : m.face_markers)
         marker = marker == wall_marker ? hole_marker : marker == hole_marker ? wall_marker : marker;
     }},
    {"all markers 0", [](TetMesh& m, Random&) { std::ranges::fill(m.face_markers, 0); }},
    {"too few markers", [](TetMesh& m, Random&) { m.face_markers.pop_back(); }},
    {"the markers of others",
     [](TetMesh& m, Random&) { std::ranges::rotate(m.face_markers, m.face_markers.begin() + 1); }},
    {"a vertex that does not exist",
     [](TetMesh& m, Random& r) { any_of(m.faces, r)[0] = static_cast<std::uint32_t>(m.vertices.size()); }},
    {"a vertex twice",
     [](TetMesh& m, Random& r) {
       Face& face = any_of(m.faces, r);
       face[0] = face[2];
     }},
};

const std::vector<Mistake> mistakes_in_edges = {
    {"a missing one",
     [](TetMesh& m, Random& r) {
       const std::size_t edge = any(m.edges.size(), r);
       remove_if(m.edges, m.edge_markers, [&](std::size_t i) { return i == edge; });
     }},
    {"a missing segment",
     [](TetMesh& m, Random&) {
       remove_if(m.edges, m.edge_markers, [&](std::size_t i) { return m.edge_markers[i] == segment_marker; });
     }},
    {"no edges", [](TetMesh& m, Random&) { m.edges.clear(), m.edge_markers.clear(); }},
    {"two vertices that no edge joins", [](TetMesh& m, Random& r) { any_of(m.edges, r) = no_edge(m, r); }},
    {"random vertices",
     [](TetMesh& m, Random& r) {
       for (Edge& edge : m.edges) edge = no_edge(m, r);
     }},
    {"one twice",
     [](TetMesh& m, Random& r) {
       const std::size_t i = any(m.edges.size(), r);
       m.edges.push_back({m.edges[i][1], m.edges[i][0]}), m.edge_markers.push_back(m.edge_markers[i]);
     }},
    {"one inside",
     [](TetMesh& m, Random& r) { m.edges.push_back(unlisted_edge(m, r)), m.edge_markers.push_back(segment_marker); }},
    {"a wrong marker",
     [](TetMesh& m, Random&) { *std::ranges::find(m.edge_markers, segment_marker) = segment_marker + 1; }},
    {"all markers 0", [](TetMesh& m, Random&) { std::ranges::fill(m.edge_markers, 0); }},
    {"too few markers", [](TetMesh& m, Random&) { m.edge_markers.pop_back(); }},
    {"a vertex that does not exist",
     [](TetMesh& m, Random& r) { any_of(m.edges, r)[0] = static_cast<std::uint32_t>(m.vertices.size()); }},
    {"a vertex twice",
     [](TetMesh& m, Random& r) {
       Edge& edge = any_of(m.edges, r);
       edge[0] = edge[1];
     }},
};

class WrongMesh : public testing::TestWithParam<std::pair<const char*, const std::vector<Mistake>*>> {};

TEST_P(WrongMesh, IsFoundWhereverItIsWrong) {
  const InputPlc input = two_rooms();
  Random random(1);
  for (const Improvement improvement : {Improvement::none, Improvement::all}) {
    const TetMesh right = meshed(input, improvement);
    const verify::Verification verification = verify::verify(input, right);
    ASSERT_TRUE(verification.ok()) << all_lines(verification);
    for (const Mistake& mistake : *GetParam().second)
      for (int i = 0; i < 10; ++i) {
        TetMesh wrong = right;
        mistake.make(wrong, random);
        EXPECT_FALSE(verify::verify(input, wrong).ok()) << mistake.name << ", " << i;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, WrongMesh,
                         testing::Values(std::pair{"Tetrahedra", &mistakes_in_tetrahedra},
                                         std::pair{"Vertices", &mistakes_in_vertices},
                                         std::pair{"Regions", &mistakes_in_regions},
                                         std::pair{"Faces", &mistakes_in_faces},
                                         std::pair{"Edges", &mistakes_in_edges}),
                         [](const auto& list) { return list.param.first; });

TEST(WrongMesh, IsFoundIfItIsThatOfAnotherInput) {
  const InputPlc input = two_rooms();
  for (const Furniture& missing : {Furniture{.wall = false}, Furniture{.slit = false}, Furniture{.hole = false},
                                   Furniture{.segment = false}, Furniture{.vertex = false}}) {
    const InputPlc other = two_rooms(missing);
    EXPECT_FALSE(verify::verify(input, meshed(other)).ok());
  }
}

TEST(WrongMesh, IsFoundIfItClaimsToBeConstrainedDelaunay) {
  const InputPlc input = two_rooms();
  TetMesh improved = meshed(input, Improvement::all);
  improved.constrained_delaunay = true;
  EXPECT_FALSE(verify::verify(input, improved).ok());
}

TEST(WrongMesh, MayListTetrahedraAlone) {
  const InputPlc input = two_rooms();
  TetMesh alone = meshed(input);
  alone.faces.clear(), alone.face_markers.clear(), alone.edges.clear(), alone.edge_markers.clear();
  EXPECT_FALSE(verify::verify(input, alone).ok());
  EXPECT_TRUE(verify::verify(input, alone, tetrahedra_alone).ok());
}

TEST(WrongMesh, MayListAllItsEdges) {
  const InputPlc input = two_rooms();
  TetMesh m = meshed(input);
  std::set<Edge> edges;
  for (const auto& [a, b, c, d] : m.tetrahedra)
    for (const Edge& edge : {Edge{a, b}, Edge{a, c}, Edge{a, d}, Edge{b, c}, Edge{b, d}, Edge{c, d}})
      edges.insert(sorted(edge));
  for (const Edge& edge : m.edges) edges.erase(sorted(edge));
  m.edges.insert(m.edges.end(), edges.begin(), edges.end());
  m.edge_markers.resize(m.edges.size(), 0);
  EXPECT_TRUE(verify::verify(input, m).ok());
}

}  // namespace
}  // namespace ccdt
