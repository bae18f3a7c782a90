#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"
#include "bench/surface_measures.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"

namespace ccdt::experiments {
namespace {

constexpr double half_cube = 4;
constexpr std::uint32_t apex = 8;  ///< after the corners of the cube

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// A cube around the apex.
InputPlc cube_around_apex() {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  for (int i = 0; i < 8; ++i)
    plc.vertices.push_back(half_cube * Point3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    plc.triangles.push_back({a, b, c});
    plc.triangles.push_back({a, c, d});
  }
  plc.vertices.push_back({0, 0, 0});
  return plc;
}

std::vector<double> lengths(std::size_t count, std::uint64_t variant) {
  std::vector<double> result;
  std::mt19937_64 random(variant);
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(random() >> 11) * 0x1p-53;
    result.push_back(variant > 0 ? 0.4 + 1.2 * fraction : i % 2 == 0 ? 1 : std::numbers::sqrt2 / 2);
  }
  return result;
}

/// Segments from the apex in the given directions, of length one.
InputPlc segments_along(const std::vector<Point3>& directions, std::uint64_t variant) {
  InputPlc plc = cube_around_apex();
  const std::vector<double> length = lengths(directions.size(), variant);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    plc.segments.push_back({apex, static_cast<std::uint32_t>(plc.vertices.size())});
    plc.vertices.push_back(length[i] * directions[i]);
  }
  return plc;
}

/// At an angle with the z axis, turned about it.
Point3 direction(double polar, double turn) {
  return {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
}

InputPlc pair(double degrees, std::uint64_t variant) {
  return segments_along({direction(0, 0), direction(radians(degrees), 0.3)}, variant);
}

/// Three directions, each two of which enclose the angle.
std::vector<Point3> three_directions(double degrees) {
  // A regular triangle on the unit sphere with sides of the angle has this circumradius.
  const double polar = std::asin(2 / std::sqrt(3.0) * std::sin(radians(degrees) / 2));
  std::vector<Point3> directions;
  for (int i = 0; i < 3; ++i) directions.push_back(direction(polar, 0.3 + radians(120 * i)));
  return directions;
}

InputPlc trio(double degrees, std::uint64_t variant) {
  return segments_along(three_directions(degrees), variant);
}

InputPlc bundle(double degrees, std::uint64_t variant) {
  std::vector<Point3> directions = {direction(0, 0)};
  for (int i = 0; i < 3; ++i) directions.push_back(direction(radians(degrees), 0.3 + radians(120 * i)));
  return segments_along(directions, variant);
}

InputPlc fins(double degrees, std::uint64_t variant) {
  constexpr std::uint32_t count = 3;
  constexpr double tip = 60;  // degrees from the common edge
  InputPlc plc = cube_around_apex();
  const std::vector<double> length = lengths(count, variant);
  plc.vertices.push_back(direction(0, 0));
  for (std::uint32_t i = 0; i < count; ++i) {
    plc.triangles.push_back({apex, apex + 1, static_cast<std::uint32_t>(plc.vertices.size())});
    plc.vertices.push_back(length[i] * direction(radians(tip), 0.3 + radians(i * degrees)));
  }
  return plc;
}

InputPlc wheel(double degrees, std::uint64_t variant) {
  const double spokes = std::round(360 / degrees);
  std::vector<Point3> directions;
  for (int i = 0; i < spokes; ++i) directions.push_back(direction(radians(90), radians(i * 360 / spokes)));
  for (Point3& d : directions) d.z = 0;  // in a plane, exactly
  return segments_along(directions, variant);
}

/// Directions all over the sphere (a Fibonacci spiral; Gonzalez 2010), so many that the angles to the nearest are about
/// as wanted.
InputPlc urchin(double degrees, std::uint64_t variant) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double nearest = radians(degrees);
  const double count = std::round(4 * std::numbers::pi / (nearest * nearest));
  std::vector<Point3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(direction(std::acos(1 - (2 * i + 1) / count), i * golden_angle));
  return segments_along(directions, variant);
}

constexpr std::array all_stars = {
    Star{"two segments", "Two segments that enclose the angle.", 1, pair},
    Star{"three segments", "Three segments, each two of which enclose the angle.", 1, trio},
    Star{"bundle", "A segment in the middle of three others, which have the angle with it.", 1, bundle},
    Star{"fins", "Three triangles at one common edge, with the angle between neighbours.", 1, fins},
    Star{"wheel", "Segments all around a point in a plane, with the angle between neighbours.", 1, wheel},
    Star{"urchin", "Segments all around a point in space, with about the angle between neighbours.", 5, urchin},
};

constexpr std::array angles = {90.0, 60.0, 45.0, 36.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0};
constexpr std::array coarsenings = {3.0, 1.0};  ///< of a solid's usual edge length

/// An input whose edges are to be protected.
struct TerminationInput {
  std::string group, name;
  double degrees;
  std::string stem;  ///< of the names of its records
  std::filesystem::path file;
};

std::string with_hyphens(std::string text) {
  std::ranges::replace(text, ' ', '-');
  return text;
}

/// More lengths of the segments where more effort is wanted.
std::uint64_t variants(const ExperimentOptions& options) {
  constexpr double tetrahedra_per_variant = 10000, most = 10;
  return static_cast<std::uint64_t>(std::clamp(std::round(options.tetrahedra / tetrahedra_per_variant), 1.0, most));
}

void add_stars(const ExperimentOptions& options, std::vector<TerminationInput>& inputs) {
  for (const Star& star : stars()) {
    if (!is_asked_for(options, star.name)) continue;
    for (const double degrees : angles)
      for (std::uint64_t variant = 0; variant < variants(options) && degrees >= star.smallest_angle; ++variant) {
        const std::string stem = "termination-" + with_hyphens(std::string(star.name)) + "-" +
                                 std::to_string(static_cast<int>(degrees)) + "-" + std::to_string(variant);
        inputs.push_back({std::string(star.name), std::to_string(variant), degrees, stem,
                          options.folder / "models" / (stem + ".poly")});
        io::write_plc(star.make(degrees, variant), inputs.back().file);
      }
  }
}

double smallest_angle_of(const std::filesystem::path& file) {
  try {
    return bench::smallest_segment_angle(plc::build_plc(io::read_plc(file), {}));
  } catch (const Error&) {
    return std::nan("");  // the runs say why
  }
}

TerminationCase measure(const ExperimentOptions& options, const TerminationInput& input, double smallest,
                        Protection protection) {
  const std::string way(name_of(protection)), stem = input.stem + "-" + way;
  const auto mesh = options.folder / "meshes" / (stem + ".vtu");
  MeasuredCase measured{
      stem, stem, {"ccdt", input.file, mesh, {"--protection", way, "--lattice", "none", "--improve", "none"}}};
  run_once(options, measured, 0);
  std::filesystem::remove(mesh);
  return {outcome_of(measured), input.group, input.name, input.degrees, smallest, protection};
}

using Cases = std::vector<const TerminationCase*>;

template <class Chosen>
Cases select(std::span<const TerminationCase> cases, Chosen is_chosen) {
  Cases result;
  for (const TerminationCase& c : cases)
    if (is_chosen(c)) result.push_back(&c);
  return result;
}

std::size_t count(const Cases& cases, Termination termination) {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [&](const TerminationCase* c) { return termination_of(*c) == termination; }));
}

bool is_star(const TerminationCase& c) {
  return c.group != "solid" && c.group != "file";
}

std::string degrees_in_words(double degrees) {
  return std::to_string(static_cast<int>(std::lround(degrees)));
}

double steiner_vertices(const TerminationCase& c) {
  return static_cast<double>(c.counts.steiner_vertices);
}

double deepest_level(const TerminationCase& c) {
  return static_cast<double>(c.counts.splits_by_level.size());
}

std::vector<std::string> definitions() {
  std::vector<std::string> all = {
      "The paper, section 2: middle points of missing grazeable edges are inserted repeatedly until none is missing.",
      "It does not say that this ends.",
      "Ended: all grazeable edges of the input are chains of Delaunay edges.",
      "Not ended: the engine stopped, for a piece would have been smaller than 2^-20 of its segment,",
      "or there were a hundred times as many pieces as vertices.",
      "Level: how many splits led to a piece, and one more.",
      "Midpoint is the paper's way (--protection midpoint), shell ours (--protection shell).",
      "Nothing is placed inside (--lattice none), and the meshes are not improved.",
      "In a star, segments or facets meet at one point in the middle of a cube.",
      "Variant 0 has lengths that alternate between 1 and 1 / sqrt 2, the others random ones from 0.4 to 1.6.",
  };
  for (const Star& star : stars()) all.push_back(std::string(star.name) + ": " + std::string(star.what));
  return all;
}

std::string case_label(const TerminationCase& c) {
  return is_star(c) ? degrees_in_words(c.degrees) + " degrees, variant " + c.input : c.input;
}

std::string words_of(const TerminationCase& c) {
  return is_star(c) ? c.group + ", " + case_label(c) : c.input;
}

/// One row a run.
ResultTable runs_table(const std::string& name, const std::string& title, const Cases& cases) {
  ResultTable table = table_of(
      name, title,
      {label_column("group", "input"), label_column("case"), label_column("protection"), label_column("status"),
       figure_column("smallest_angle", "", "degrees"), figure_column("ended"),
       figure_column("steiner_vertices", "Steiner vertices"), figure_column("deepest_level"), note_column("reason")});
  for (const TerminationCase* c : cases) {
    const Termination termination = termination_of(*c);
    add_row(table, c->runs, c->group, case_label(*c), name_of(c->protection), name_of(c->status),
            cell_if(std::isfinite(c->smallest_angle), c->smallest_angle),
            cell_if(termination != Termination::unknown, termination == Termination::ended),
            cell_if(c->ok(), steiner_vertices(*c)), cell_if(c->ok(), deepest_level(*c)),
            cell_if(!c->reason.empty(), c->reason));
  }
  return table;
}

/// One way of protection over all variants of a star at one angle: in how many it ended, and what it took at most.
std::vector<Cell> summary_of(const Cases& cases) {
  double steiner = 0, deepest = 0;
  for (const TerminationCase* c : cases) {
    steiner = std::max(steiner, steiner_vertices(*c));
    deepest = std::max(deepest, deepest_level(*c));
  }
  const std::size_t ended = count(cases, Termination::ended);
  return cells(ended, cell_if(ended > 0, steiner), cell_if(ended > 0, deepest));
}

ResultTable stars_table(std::span<const TerminationCase> cases) {
  ResultTable table = table_of(
      "stars", "Segments that meet at small angles",
      {label_column("star"), figure_column("degrees", "angle", "degrees"), figure_column("cases"),
       figure_column("midpoint_ended"), figure_column("midpoint_steiner_vertices", "midpoint: most Steiner vertices"),
       figure_column("midpoint_deepest_level", "midpoint: deepest level"), figure_column("shell_ended"),
       figure_column("shell_steiner_vertices", "shell: most Steiner vertices"),
       figure_column("shell_deepest_level", "shell: deepest level")});
  std::vector<std::pair<std::string, double>> groups;
  for (const TerminationCase& c : cases) {
    const std::pair group(c.group, c.degrees);
    if (is_star(c) && std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  for (const auto& [star, degrees] : groups) {
    const auto of = [&](Protection protection) {
      return select(cases, [&, &star = star, degrees = degrees](const TerminationCase& c) {
        return c.group == star && c.degrees == degrees && c.protection == protection;
      });
    };
    const Cases by_midpoint = of(Protection::midpoint), by_shell = of(Protection::shell);
    ResultRow row{cells(star, degrees, by_midpoint.size())};
    for (const Cases& all : {by_midpoint, by_shell}) {
      append(row.cells, summary_of(all));
      for (const TerminationCase* c : all) append(row.runs, c->runs);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Where the midpoints of one star ended, and where not.
std::string midpoint_finding(const std::string& star, const Cases& cases) {
  const std::string ended =
      "Midpoint, " + star + ": ended in " + share_words(count(cases, Termination::ended), cases.size()) + " cases";
  double least = 180, largest_stopped = 0, least_stopped = 180;
  for (const TerminationCase* c : cases) {
    least = std::min(least, c->degrees);
    if (termination_of(*c) != Termination::stopped) continue;
    largest_stopped = std::max(largest_stopped, c->degrees);
    least_stopped = std::min(least_stopped, c->degrees);
  }
  if (largest_stopped == 0) return ended + ", down to " + degrees_in_words(least) + " degrees";
  double least_safe = 180;
  for (const TerminationCase* c : cases)
    if (c->degrees > largest_stopped) least_safe = std::min(least_safe, c->degrees);
  const std::string safe = least_safe < 180 ? "from " + degrees_in_words(least_safe) + " degrees up it always ended"
                                            : "it was safe at no angle";
  return ended + "; " + safe + "; it did not at " + degrees_in_words(largest_stopped) + " to " +
         degrees_in_words(least_stopped) + " degrees";
}

std::vector<std::string> findings_of(std::span<const TerminationCase> cases) {
  std::vector<std::string> findings;
  for (const Star& star : stars()) {
    const Cases of_star = select(
        cases, [&](const TerminationCase& c) { return c.group == star.name && c.protection == Protection::midpoint; });
    if (!of_star.empty()) findings.push_back(midpoint_finding(std::string(star.name), of_star));
  }
  const auto add = [&](const std::string& what, Protection protection, auto is_chosen) {
    const Cases chosen =
        select(cases, [&](const TerminationCase& c) { return c.protection == protection && is_chosen(c); });
    if (!chosen.empty())
      findings.push_back(what + " ended in " + share_words(count(chosen, Termination::ended), chosen.size()) +
                         " cases");
  };
  add("Midpoint on solids and files", Protection::midpoint, [](const TerminationCase& c) { return !is_star(c); });
  add("Shell on solids and files", Protection::shell, [](const TerminationCase& c) { return !is_star(c); });
  add("Shell on stars", Protection::shell, is_star);
  return findings;
}

}  // namespace

std::span<const Star> stars() {
  return all_stars;
}

Termination termination_of(const TerminationCase& c) {
  if (c.status == baselines::RunStatus::ok) return Termination::ended;
  // The engine's words for its limits; see engine/protection/protect_edges.cpp.
  const bool is_limit =
      c.status == baselines::RunStatus::failed && c.reason.starts_with("a segment cannot be protected");
  return is_limit ? Termination::stopped : Termination::unknown;
}

ExperimentResult termination_result(std::span<const TerminationCase> cases) {
  ExperimentResult result;
  result.definitions = definitions();
  result.tables = {stars_table(cases),
                   runs_table("solids", "Solids and files", select(cases, [](const auto& c) { return !is_star(c); })),
                   runs_table("star_runs", "Each run on a star", select(cases, is_star))};
  result.tables.back().is_data = true;
  result.findings = findings_of(cases);
  for (const TerminationCase& c : cases) {
    if (termination_of(c) != Termination::unknown) continue;
    add_problem(result, words_of(c) + ", " + std::string(name_of(c.protection)) + ": " + c.failure(),
                c.group != "file");
  }
  return result;
}

ExperimentResult measure_termination(const ExperimentOptions& options, const Progress& progress) {
  Circumstances how = start_experiment(options, 1);
  std::vector<TerminationInput> inputs;
  add_stars(options, inputs);
  for (const SurfaceFile& surface : write_solids(options, "termination", coarsenings))
    inputs.push_back(
        {"solid", surface.name + " at " + rounded(surface.edge_length), 0, surface.file.stem().string(), surface.file});
  for (const SurfaceFile& surface : input_files(options))
    inputs.push_back({"file", surface.name, 0, "termination-" + surface.file.filename().string(), surface.file});
  check_something_is_measured(inputs.size(), "termination");

  std::vector<TerminationCase> cases;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    report(progress, inputs[i].stem, i, inputs.size());
    const double smallest = smallest_angle_of(inputs[i].file);
    for (const Protection protection : {Protection::midpoint, Protection::shell})
      cases.push_back(measure(options, inputs[i], smallest, protection));
  }
  ExperimentResult result = termination_result(cases);
  result.how = std::move(how);
  return result;
}

}  // namespace ccdt::experiments
