#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/results/result_table.h"

namespace ccdt::results {

/// A value of every run: its column in runs.csv, and where it is in a record of schema `ccdt.run/1`.
struct RunColumn {
  std::string_view name;
  std::string_view path;  ///< as in `bench::value_at`
};

/// The values in the order of the file. Names are a contract: add names, never change them.
inline constexpr auto run_columns = std::to_array<RunColumn>({
    {"mesher", "mesher.name"},
    {"version", "mesher.version"},
    {"revision", "mesher.revision"},
    {"status", "status"},
    {"kind", "kind"},
    {"reason", "reason"},
    {"verified", "verification.right"},
    {"input_sha256", "input.sha256"},
    {"input_vertices", "input.vertices"},
    {"input_facets", "input.facets"},
    {"input_segments", "input.segments"},
    {"vertices", "counts.vertices"},
    {"steiner_vertices", "counts.steiner_vertices"},
    {"interior_vertices", "counts.interior_vertices"},
    {"tetrahedra", "counts.tetrahedra"},
    {"faces", "counts.faces"},
    {"undelaunay_faces", "counts.undelaunay_faces"},
    {"front_tetrahedra", "counts.front_tetrahedra"},
    {"mesh_fingerprint", "mesh_fingerprint"},
    {"volume", "volume"},
    {"seconds", "seconds.mesh"},
    {"seconds_read", "seconds.read"},
    {"seconds_remesh", "seconds.remesh"},
    {"seconds_plc", "seconds.plc"},
    {"seconds_refine", "seconds.refine"},
    {"seconds_protect", "seconds.protect"},
    {"seconds_facets", "seconds.facets"},
    {"seconds_lattice", "seconds.lattice"},
    {"seconds_delaunay", "seconds.delaunay"},
    {"seconds_face_check", "seconds.face_check"},
    {"seconds_front", "seconds.front"},
    {"seconds_label", "seconds.label"},
    {"seconds_finish", "seconds.finish"},
    {"seconds_improve", "seconds.improve"},
    {"seconds_write", "seconds.write"},
    {"seconds_verify", "verification.seconds"},
    {"peak_rss_bytes", "peak_rss_bytes"},
    {"r_mean", "quality.r.mean"},
    {"r_median", "quality.r.median"},
    {"r_p99", "quality.r.p99"},
    {"r_max", "quality.r.max"},
    {"dihedral_min", "quality.dihedral_degrees.min"},
    {"dihedral_max", "quality.dihedral_degrees.max"},
    {"cpu", "environment.cpu"},
    {"cores", "environment.cores"},
    {"load_average", "environment.load_average"},
    {"governor", "environment.governor"},
    {"temperature_celsius", "environment.temperature_celsius"},
    {"jobs", "environment.jobs"},
});

/// One of the columns; its name is checked at compile time.
struct RunField {
  consteval RunField(const char* name) {  // NOLINT(google-explicit-constructor): written as its name
    while (run_columns.at(index).name != name) ++index;
  }
  std::size_t index = 0;
};

/// The part of a run that a report needs.
struct RunValues {
  std::array<Cell, run_columns.size()> cells;  ///< empty: not in the record
  std::vector<std::string> command;
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the terms of the mesher
};

/// Nothing, if the record does not say.
std::optional<double> number_of(const RunValues& run, RunField field);
/// Empty, if the record does not say.
std::string_view text_of(const RunValues& run, RunField field);

/// Reads these values of a record.
///
/// \return  nothing if the file is not a record of schema `ccdt.run/1` (missing, or truncated by a full disk)
std::optional<RunValues> read_run_values(const std::filesystem::path& file);

}  // namespace ccdt::results
