#include "bench/experiments/interior_existence.h"

#include "bench/experiments/small_plcs/families.h"
#include "bench/experiments/small_plcs/tetrahedralization.h"

namespace ccdt {
namespace {

constexpr int most_draws = 50;

/// The smallest box with whole corners around the vertices.
struct Box {
  small::Point low, high;
};

Box box_of(const small::SmallPlc& plc) {
  Box box{plc.vertices.front(), plc.vertices.front()};
  for (const small::Point& p : plc.vertices) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

bool has_constrained_delaunay(const small::SmallPlc& plc) {
  return search_constrained_delaunay(plc).constrained_delaunay > 0;
}

}  // namespace

small::SmallPlc with_interior_point(const small::SmallPlc& plc, std::uint64_t seed) {
  small::Random random(seed);
  const Box box = box_of(plc);
  const auto last = static_cast<small::Vertex>(plc.vertices.size());
  small::SmallPlc more = plc;
  more.vertices.emplace_back();
  for (int draw = 0; draw < most_draws; ++draw) {
    more.vertices.back() = {random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y),
                            random.between(box.low.z, box.high.z)};
    if (is_inside(more, {last}) && is_generic(more)) return more;
  }
  return {};
}

std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_a_family) {
  std::vector<ExistenceTrials> all;
  std::uint64_t seed = 1;
  for (const small::Family& family : small::families()) {
    if (family.is_cospherical) continue;
    ExistenceTrials trials{.family = std::string(family.name)};
    small::Random random(++seed);
    for (std::uint64_t i = 0; i < cases_a_family; ++i) {
      const small::SmallPlc plc = next_plc(family, random);
      const small::SmallPlc more = with_interior_point(plc, ++seed);
      if (more.vertices.empty() || !has_constrained_delaunay(plc)) continue;
      ++trials.cases;
      if (has_constrained_delaunay(more)) continue;
      const bool is_smallest = trials.lost++ == 0 || more.vertices.size() < trials.counterexample.vertices.size();
      if (is_smallest) trials.counterexample = more;
    }
    all.push_back(std::move(trials));
  }
  return all;
}

}  // namespace ccdt
