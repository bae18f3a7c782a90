#pragma once

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/tests/program.h"

namespace ccdt {

using Json = nlohmann::ordered_json;
using Change = std::function<void(Json&)>;

inline void change_nothing(Json&) {}

/// The parts of a report of `ccdt mesh` that a gate reads.
inline Json run_of(const std::string& input) {
  return {{"schema", "ccdt.run/1"},
          {"mesher", {{"name", "ccdt"}, {"version", "1"}, {"revision", "abc"}}},
          {"input", {{"name", "parts/" + input}, {"sha256", ""}}},
          {"options", {{"lattice", "fcc"}}},
          {"command", {"ccdt", "mesh", input}},
          {"environment", {{"cpu", "some"}, {"compiler", "GNU 12"}, {"flags", "-O3"}, {"revision", "abc"}}},
          {"counts", {{"vertices", 100}, {"tetrahedra", 400}, {"steiner_vertices", 4}, {"splits_by_level", {2, 1}}}},
          {"work", {{"delaunay", {{"walk_steps", 1000}, {"exact_evaluations", 0}}}}},
          {"seconds", {{"mesh", 1.5}}},
          {"quality",
           {{"r", {{"max", 2.5}, {"histogram", {{"edges", {1, 2}}, {"counts", {3}}}}}},
            {"dihedral_degrees", {{"min", 20.5}}}}},
          {"volume", 1.25},
          {"mesh_fingerprint", "0123"},
          {"status", "ok"}};
}

class Gate : public Program {
 protected:
  void write_run(const std::string& folder, const std::string& input, const Change& change = change_nothing) const {
    Json run = run_of(input);
    change(run);
    std::filesystem::create_directories(work() / folder);
    write(folder + "/" + input + ".json", run.dump());
  }

  /// Two recordings of one case; the head's is changed.
  void write_pair(const Change& change) const {
    write_run("base", "a.off");
    write_run("head", "a.off", change);
  }

  Json verdict(const std::string& folder = "out") const {
    return Json::parse(text_of(work() / folder / "verdict.json"));
  }

  /// The entry of a figure; null if there is none.
  static Json figure(const Json& verdict, const std::string& name) {
    for (const Json& one : verdict.at("figures"))
      if (one.at("name") == name) return one;
    return {};
  }

  /// Judges the change of one figure.
  Json judged(const std::string& name, const Change& change, const std::string& options = "") const {
    write_pair(change);
    run("gate head --against base -o out " + options);
    return figure(verdict(), name);
  }
};

/// Sets the figure of that name.
inline Change set(std::string name, const Json& value) {
  std::ranges::replace(name, '.', '/');
  return [=](Json& run) { run[Json::json_pointer("/" + name)] = value; };
}

}  // namespace ccdt
