#include "engine/steps/repeat_splits.h"

#include <utility>
#include <vector>

#include "engine/protection/repeat_chains.h"
#include "engine/steps/tetrahedralize_vertices.h"

namespace ccdt::steps {

bool repeat_splits(const protection::SegmentChains& chains, folds::SurfaceProtector& protector, Run& run) {
  const plc::Plc& plc = protector.undivided();
  if (plc.periodicity == plc::Periodicity::none) return false;
  auto repeated = run.measured(Stage::protect, [&] { return protection::repeat_chains(plc, chains); });
  if (!repeated) return false;
  std::vector<Point3> points = plc.vertices;
  points.insert(points.end(), repeated->points.begin(), repeated->points.end());
  protector.restart(tetrahedralize_vertices(points, run).value(), std::move(repeated->chains));
  return true;
}

}  // namespace ccdt::steps
