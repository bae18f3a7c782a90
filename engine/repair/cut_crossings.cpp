#include "engine/repair/cut_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/union_find.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/connect_parts.h"
#include "engine/plc/gather_parts.h"
#include "engine/repair/arrange_cuts.h"
#include "engine/repair/cut_along.h"
#include "engine/repair/equal_triangles.h"
#include "engine/repair/find_cuts.h"
#include "engine/repair/find_welds.h"
#include "engine/repair/vertex_finders.h"

namespace ccdt::repair {
namespace {

using plc::TrianglePair;
using plc::TriangleSet;

constexpr std::string_view stage = "cut crossings";

/// Leaves distinct triangles that have an area and no vertices on them. Returns the pairs that may cross.
std::vector<TrianglePair> clean(std::span<const Point3> vertices, TriangleSet& triangles, Fins fins) {
  plc::drop_triangles_without_area(vertices, triangles);
  drop_equal_triangles(triangles, fins);
  std::vector<TrianglePair> close = plc::make_conforming(vertices, triangles);
  // Pieces may equal other triangles.
  if (drop_equal_triangles(triangles, fins) > 0) close = plc::find_close_triangles(vertices, triangles);
  return close;
}

VertexCuts number_vertices(const std::vector<Arrangement>& arrangements, plc::UncheckedPlc& soup) {
  VertexFinder vertices(soup.plc);
  VertexCuts cuts;
  for (const Arrangement& arrangement : arrangements) {
    for (const auto& [p, q] : arrangement.pieces) {
      const VertexId a = vertices.at(p), b = vertices.at(q);
      cuts.pieces.push_back({arrangement.triangle, a, b, a, b});
    }
    for (const auto& [k, p] : arrangement.on_edges)
      cuts.on_edges.push_back({key_of_edge(soup.triangles.corners[arrangement.triangle], k), vertices.at(p)});
  }
  return cuts;
}

VertexCuts number_vertices(const Welds& welds, double reach, plc::UncheckedPlc& soup) {
  NearVertexFinder vertices(soup, reach);
  VertexCuts cuts;
  for (const auto& [edge, p] : welds.on_edges) cuts.on_edges.push_back({edge, vertices.at(p)});
  for (const WeldedEdge& e : welds.in_triangles)
    cuts.pieces.push_back({e.triangle, e.a, e.b, vertices.at(e.from), vertices.at(e.to)});
  std::ranges::stable_sort(cuts.pieces, {}, &Piece::triangle);
  return cuts;
}

/// Merges equal vertices into the first of them.
void merge_vertices(const std::vector<std::array<VertexId, 2>>& equal, plc::UncheckedPlc& soup,
                    std::vector<std::uint8_t>& is_near) {
  plc::Plc& plc = soup.plc;
  UnionFind sets(plc.vertices.size());
  for (const auto& [a, b] : equal) sets.join(a, b);
  std::vector<VertexId> numbers(plc.vertices.size());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < numbers.size(); ++v) {
    const std::uint32_t first = sets.find(v);
    if (first != v) {
      numbers[v] = numbers[first];
      continue;
    }
    numbers[v] = VertexId(next);
    plc.vertices[next] = plc.vertices[v];
    plc.world[next] = plc.world[v];
    is_near[next++] = is_near[v];
  }
  plc.vertices.resize(next);
  plc.world.resize(next);
  is_near.resize(next);
  const auto renumber = [&](auto& ids) {
    for (VertexId& v : ids) v = numbers[v];
  };
  renumber(plc.vertex_of_input);
  for (plc::VertexTriple& t : soup.triangles.corners) renumber(t);
  for (auto& ends : soup.segments.ends) renumber(ends);
}

/// Rounds all vertices to multiples of the spacing, and measures them in units in which it is a quantum.
void coarsen(double spacing, plc::UncheckedPlc& soup) {
  plc::Plc& plc = soup.plc;
  plc.grid.unit *= spacing / DyadicGrid::quantum;
  const auto round = [spacing](double x) { return DyadicGrid::quantum * std::nearbyint(x / spacing); };
  std::vector<std::array<VertexId, 2>> equal;
  HashTable<IntegerPoint, std::uint32_t> known;
  for (std::uint32_t v = 0; v < plc.vertices.size(); ++v) {
    Point3& p = plc.vertices[v];
    p = {round(p.x), round(p.y), round(p.z)};
    plc.world[v] = plc.grid.to_world(p);
    const auto [first, is_new] = known.insert(to_integers(p), v);
    if (!is_new) equal.push_back({VertexId(*first), VertexId(v)});
  }
  std::vector<std::uint8_t> is_near(plc.vertices.size(), 0);
  merge_vertices(equal, soup, is_near);
}

/// Measures the vertices in the units before `coarsen`.
void measure_finely(double spacing, plc::Plc& plc) {
  const double factor = spacing / DyadicGrid::quantum;
  plc.grid.unit /= factor;
  for (Point3& p : plc.vertices) p = factor * p;
}

/// Marks the corners of the triangles that are cut, and all vertices that were made.
void mark_near(const std::vector<Cut>& cuts, const plc::UncheckedPlc& soup, std::vector<std::uint8_t>& is_near) {
  is_near.resize(soup.plc.vertices.size(), is_near.empty() ? 0 : 1);
  for (const Cut& cut : cuts)
    for (const std::uint32_t t : {cut.triangle, cut.by})
      for (const VertexId v : soup.triangles.corners[t]) is_near[v] = 1;
}

/// Finds what should touch and does not, once something nearby was to be cut.
class WeldSearch {
 public:
  explicit WeldSearch(const CutOptions& options)
      : reach{std::max(WeldReach{}.edges, options.tolerance)}, is_near_everywhere_(options.weld_everywhere) {}

  Welds find(const std::vector<Cut>& cuts, const plc::UncheckedPlc& soup) {
    mark_near(cuts, soup, is_near);
    if (is_near_everywhere_) std::ranges::fill(is_near, std::uint8_t{1});
    Welds welds = find_welds(soup.plc.vertices, soup.triangles, is_near, reach);
    if (welds.empty() || is_near_everywhere_) return welds;
    // What should touch in one place may also have to touch elsewhere.
    is_near_everywhere_ = true;
    std::ranges::fill(is_near, std::uint8_t{1});
    return find_welds(soup.plc.vertices, soup.triangles, is_near, reach);
  }

  WeldReach reach;
  std::vector<std::uint8_t> is_near;  ///< by vertex: is it one of a triangle that was or is to be cut?

 private:
  bool is_near_everywhere_;
};

/// Joins what almost touches at cuts whose ends are all rounded to corners of the triangles, so that cutting does
/// nothing. Of such things, only the nearest are joined, since this moves them.
///
/// \return  was there anything?
bool join_where_stuck(const std::vector<Cut>& cuts, plc::UncheckedPlc& soup) {
  std::vector<std::uint8_t> is_near;
  mark_near(cuts, soup, is_near);
  for (WeldReach reach{.edges = DyadicGrid::quantum}; reach.edges <= WeldReach{}.edges; reach = {2 * reach.edges}) {
    const Welds welds = find_welds(soup.plc.vertices, soup.triangles, is_near, reach);
    if (!welds.equal.empty()) {
      merge_vertices(welds.equal, soup, is_near);
      return true;
    }
    const std::vector<plc::VertexTriple> before = soup.triangles.corners;
    cut_along(number_vertices(welds, reach.vertices, soup), soup);
    if (soup.triangles.corners != before) return true;
  }
  return false;
}

/// What becomes of things that almost touch.
enum class Closeness : std::uint8_t {
  welded,  ///< they are joined. This bends what is near them, so there can be new crossings, without end
  kept     ///< only exact intersections are cut
};

/// General position needs one round, welds usually up to eight. Without welds, further rounds are cheap.
constexpr std::size_t usual_rounds = 8;

constexpr std::size_t most_rounds(Closeness closeness) {
  return closeness == Closeness::welded ? usual_rounds : 4 * usual_rounds;
}

/// Where there is ever more to do, cuts make accidental intersections, and these make further cuts.
bool is_without_end(std::size_t left, std::size_t left_before) {
  return left > 2 * left_before + 1000;
}

CutCounts cut_in_rounds(plc::UncheckedPlc& soup, const CutOptions& options, Closeness closeness,
                        const Progress& progress) {
  CutCounts counts;
  WeldSearch search(options);
  std::size_t left_before = 0;  // at first; without welds, the least number so far
  for (;; ++counts.rounds) {
    report(progress, stage, std::min(counts.rounds, usual_rounds), usual_rounds);
    const Fins fins = counts.rounds == 0 ? Fins::keep : Fins::drop;  // those of the input may be intended
    const std::vector<TrianglePair> close = clean(soup.plc.vertices, soup.triangles, fins);
    const Cuts found = find_cuts(soup.plc.vertices, soup.triangles, close);
    counts.left = found.pairs;
    if (counts.rounds == 0) counts.pairs = found.pairs;
    if (counts.pairs == 0 && !options.weld_everywhere) break;
    const Welds welds = closeness == Closeness::welded ? search.find(found.cuts, soup) : Welds();
    counts.left += welds.size();
    if (counts.rounds == 0 || (closeness == Closeness::kept && counts.left < left_before)) left_before = counts.left;
    if (counts.left == 0 || counts.rounds == most_rounds(closeness) || is_without_end(counts.left, left_before)) break;
    plc::split_segments_at_vertices(soup.plc.vertices, soup.segments);
    // Where triangles almost touch, their intersection is accidental. So they are welded first.
    if (!welds.equal.empty()) {
      merge_vertices(welds.equal, soup, search.is_near);
      continue;
    }
    const std::vector<plc::VertexTriple> before = soup.triangles.corners;
    if (!welds.empty()) cut_along(number_vertices(welds, search.reach.vertices, soup), soup);
    if (soup.triangles.corners != before) continue;
    counts.left = found.pairs;
    if (found.pairs == 0) break;  // things near each other are welded as far as possible
    cut_along(number_vertices(arrange_cuts(soup.plc.vertices, soup.triangles, found.cuts), soup), soup);
    if (soup.triangles.corners == before && !join_where_stuck(found.cuts, soup)) break;
  }
  report(progress, stage, usual_rounds, usual_rounds);
  return counts;
}

}  // namespace

CutCounts cut_crossings(plc::UncheckedPlc& soup, const CutOptions& options, const Progress& progress) {
  CutCounts counts;
  for (const Closeness closeness : {Closeness::welded, Closeness::kept}) {
    plc::UncheckedPlc cut = soup;
    const bool is_coarse = options.spacing > DyadicGrid::quantum;
    if (is_coarse) coarsen(options.spacing, cut);
    counts = cut_in_rounds(cut,
                           {.tolerance = options.tolerance * DyadicGrid::quantum / options.spacing,
                            .weld_everywhere = options.weld_everywhere},
                           closeness, progress);
    if (counts.left > 0) continue;
    if (is_coarse) measure_finely(options.spacing, cut.plc);
    soup = std::move(cut);
    return counts;
  }
  counts.left = counts.pairs;
  return counts;
}

}  // namespace ccdt::repair
