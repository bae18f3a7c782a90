#include "bench/json_parts.h"

#include <nlohmann/json.hpp>

#include "bench/run_record.h"

namespace ccdt {

Json environment_json(const Environment& e) {
  return {{"cpu", e.cpu},
          {"cores", e.cores},
          {"load_average", e.load_average},
          {"system", e.system},
          {"compiler", e.compiler},
          {"flags", e.flags},
          {"build_type", e.build_type},
          {"revision", e.revision},
          {"libraries", e.libraries}};
}

Environment environment_from_json(const Json& j) {
  Environment e;
  e.cpu = j.at("cpu");
  e.cores = j.at("cores");
  e.load_average = j.at("load_average");
  e.system = j.at("system");
  e.compiler = j.at("compiler");
  e.flags = j.at("flags");
  e.build_type = j.at("build_type");
  e.revision = j.at("revision");
  for (const auto& [name, version] : j.at("libraries").items()) e.libraries[name] = version;
  return e;
}

namespace {

Json improve_json(const ImproveCounts& c) {
  return {{"bad_cells", c.bad_cells},
          {"bad_cells_left", c.bad_cells_left},
          {"removed_edges", c.removed_edges},
          {"facet_flips", c.facet_flips},
          {"removed_faces", c.removed_faces},
          {"moved_vertices", c.moved_vertices},
          {"inserted_vertices", c.inserted_vertices},
          {"collapsed_edges", c.collapsed_edges},
          {"stop", name_of(c.stop)}};
}

}  // namespace

Json counts_json(const MeshCounts& c) {
  return {{"vertices", c.vertices},
          {"steiner_vertices", c.steiner_vertices},
          {"interior_vertices", c.interior_vertices},
          {"tetrahedra", c.tetrahedra},
          {"faces", c.faces},
          {"undelaunay_faces", c.undelaunay_faces},
          {"front_tetrahedra", c.front_tetrahedra},
          {"splits_by_level", c.splits_by_level},
          {"dropped_interior_vertices", c.dropped_interior_vertices},
          {"front_faces", c.front_faces},
          {"improve", improve_json(c.improve)}};
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ccdt
