#include <nlohmann/json.hpp>

#include "bench/experiments/experiment_json.h"
#include "bench/experiments/quality_study.h"
#include "bench/quality_json.h"

namespace ccdt {
namespace {

Json angle_json(const SurfaceAngle& angle) {
  return {{"degrees", angle.degrees}, {"at", {angle.at.x, angle.at.y, angle.at.z}}};
}

Json surface_json(const EvenSurface& surface) {
  return {{"file", surface.file.filename().string()},
          {"edge_length", surface.edge_length},
          {"remeshed", surface.remeshed},
          {"vertices", surface.vertices},
          {"triangles", surface.triangles},
          {"smallest_angle", angle_json(surface.angles.planar)},
          {"smallest_dihedral_angle", angle_json(surface.angles.dihedral)}};
}

Json row_json(const QualityRow& row) {
  Json json = {{"variant", row.variant},
               {"status", name_of(row.status)},
               {"edge_length", row.edge_length},
               {"comparable", row.is_comparable},
               {"seconds", estimate_json(row.seconds)},
               {"improve_seconds", row.improve_seconds},
               {"samples", row.samples},
               {"counts", counts_json(row.counts)},
               {"quality", quality_json(row.quality)}};
  if (!row.reason.empty()) json["reason"] = row.reason;
  return json;
}

}  // namespace

Json study_json(const std::string& schema, const std::vector<std::string>& definitions, const QualityStudy& study) {
  Json json = head_json(schema, definitions, study.how);
  json["cases"] = Json::array();
  for (const QualityCase& c : study.cases) {
    Json rows = Json::array();
    for (const QualityRow& row : c.rows) rows.push_back(row_json(row));
    json["cases"].push_back(
        {{"name", c.name}, {"wanted_tetrahedra", c.wanted}, {"surface", surface_json(c.surface)}, {"rows", rows}});
    if (!c.reason.empty()) json["cases"].back()["reason"] = c.reason;
  }
  return json;
}

}  // namespace ccdt
