#include "bench/json_parts.h"

#include <nlohmann/json.hpp>

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
          {"front_faces", c.front_faces}};
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ccdt
