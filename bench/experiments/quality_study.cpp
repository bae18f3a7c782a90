#include <algorithm>
#include <cmath>
#include <numeric>

#include "baselines/mesher_input.h"
#include "bench/experiments/quality_experiments.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"

namespace ccdt::experiments {
namespace {

constexpr double usual_exponent = 3;  ///< of the edge length in the number of tetrahedra, which it divides
constexpr double most_stretch = 2;    ///< of an edge length from one try to the next, where the secant misleads
constexpr double least_exponent = 0.7, largest_exponent = 6;

struct Try {
  double edge_length, count;
};

/// The exponent between two tries, if it can be trusted.
double exponent_between(const Try& a, const Try& b) {
  const double lengths = std::log(a.edge_length / b.edge_length), counts = std::log(b.count / a.count);
  if (std::abs(lengths) < 1e-9) return usual_exponent;
  return std::clamp(counts / lengths, least_exponent, largest_exponent);
}

/// The edge lengths between which the wanted one is, as far as tries have told.
struct Bracket {
  double shorter, longer;
  bool is_shorter_tried = false, is_longer_tried = false;

  void take(const Try& made, double wanted) {
    if (made.count > wanted && made.edge_length >= shorter) {
      shorter = made.edge_length;
      is_shorter_tried = true;
    } else if (made.count <= wanted && made.edge_length <= longer) {
      longer = made.edge_length;
      is_longer_tried = true;
    }
  }

  /// A guess that leads out gives way to an end that has not been tried yet, or else to something between the ends.
  double hold(double guess) const {
    if (guess > shorter && guess < longer) return guess;
    if (guess <= shorter && !is_shorter_tried) return shorter;
    if (guess >= longer && !is_longer_tried) return longer;
    const double low = is_shorter_tried ? shorter : std::max(shorter, longer / most_stretch);
    const double high = is_longer_tried ? longer : std::min(longer, shorter * most_stretch);
    return std::sqrt(low * high);
  }
};

/// Have much longer edges made hardly fewer tetrahedra? Then small features of the surface decide, and no edge length
/// would.
bool is_stuck(const Try& before, const Try& made, double wanted) {
  constexpr double much = 1.2, hardly = 1.03;
  return made.count > wanted && made.edge_length > much * before.edge_length && before.count < hardly * made.count;
}

/// A solid's name or a file, to be read when its turn comes.
struct StudySource {
  std::string name;
  std::filesystem::path file = {};  ///< none of a solid
};

std::vector<StudySource> sources_of(const ExperimentOptions& options, const StudyPlan& plan) {
  std::vector<StudySource> sources;
  for (const std::string& model : plan.models)
    if (is_asked_for(options, model)) sources.push_back({model});
  for (const auto& input : options.inputs) sources.push_back({input.filename().string(), input});
  return sources;
}

/// One source at one size, while it is measured.
struct SourceStudy {
  const ExperimentOptions& options;
  const StudyPlan& plan;
  const SurfaceSource& source;
  std::string stem;                      ///< of the names of its files
  std::vector<MeasuredCase> cases = {};  ///< one a variant
  std::vector<KeptMesh> meshes = {};

  std::filesystem::path mesh() const { return options.folder / "meshes" / (plan.experiment + ".vtu"); }

  MeasuredCase case_of(const QualityVariant& variant, const std::filesystem::path& surface, double edge_length) const {
    std::string name = variant.name;
    std::ranges::replace(name, ' ', '-');
    std::vector<std::string> words = variant.words;
    append(words, std::vector<std::string>{"--edge-length", digits(edge_length), "--grading", "0"});
    return {variant.name, stem + "-" + name, {variant.mesher, surface, mesh(), words}};
  }
};

/// Looks for the edge length of the surface at which our FCC lattice makes the wanted number of tetrahedra, the surface
/// having edges of the length of those inside.
EvenSurface find_surface(const SourceStudy& study, double wanted) {
  const QualityVariant bare = {"surface", "ccdt", {"--lattice", "fcc", "--improve", "none"}};
  const auto file = study.options.folder / "models" / (study.stem + ".poly");
  EvenSurface surface;
  std::string reason;
  const auto count_of = [&](double edge_length) -> std::optional<std::uint64_t> {
    surface = make_even_surface(study.source, edge_length, file);
    MeasuredCase measured = study.case_of(bare, file, edge_length);
    run_once(study.options, measured, 0);
    reason = measured.first.reason;
    if (measured.failed()) return {};
    return measured.first.counts.tetrahedra;
  };
  const double regular = std::cbrt(study.source.volume / wanted / baselines::regular_tetrahedron_volume(1));
  const auto found = search_edge_length({.wanted = wanted,
                                         .first = regular,
                                         .shortest = study.source.shortest,
                                         .longest = study.source.longest,
                                         .most_tries = 5},
                                        count_of);
  if (!found) throw MeshError("no surface of this source was meshed: " + reason, {}, "");
  if (found->edge_length != surface.edge_length) surface = make_even_surface(study.source, found->edge_length, file);
  return surface;
}

/// Runs a variant for the first time, at the edge length that makes as many tetrahedra as the first variant has.
void run_at_equal_count(SourceStudy& study, const QualityVariant& variant, const EvenSurface& surface) {
  const double wanted = static_cast<double>(study.cases.front().first.counts.tetrahedra);
  MeasuredCase tried, best;
  const auto count_of = [&](double edge_length) -> std::optional<std::uint64_t> {
    tried = study.case_of(variant, surface.file, edge_length);
    run_once(study.options, tried, 0);
    const double count = static_cast<double>(tried.first.counts.tetrahedra);
    const auto error = [&](double n) { return std::abs(std::log(std::max(n, 1.0) / wanted)); };
    const double least = static_cast<double>(best.first.counts.tetrahedra);
    if (best.stem.empty() || (!tried.failed() && error(count) < error(least))) best = tried;
    if (tried.failed()) return {};
    return tried.first.counts.tetrahedra;
  };
  search_edge_length({.wanted = wanted, .first = surface.edge_length}, count_of);
  study.cases.push_back(best);
}

void run_first(SourceStudy& study, const QualityVariant& variant, const EvenSurface& surface) {
  const bool has_reference = !study.cases.empty() && !study.cases.front().failed();
  if (study.plan.equal_counts && has_reference) return run_at_equal_count(study, variant, surface);
  study.cases.push_back(study.case_of(variant, surface.file, surface.edge_length));
  run_once(study.options, study.cases.back(), 0);
}

/// Keeps the mesh that a variant has just made, if it is wanted and not too large.
void keep_small_mesh(SourceStudy& study, const MeasuredCase& measured) {
  if (!study.plan.keeps_meshes || measured.failed()) return;
  if (measured.first.counts.tetrahedra > most_kept_tetrahedra) return;
  study.meshes.push_back(keep_mesh(study.options, measured, study.source.name + ", " + measured.name));
}

/// Counts the runs after the first, in turn; or the first itself, if it is the only one.
void run_counted(SourceStudy& study) {
  if (study.plan.once) {
    for (MeasuredCase& measured : study.cases)
      if (!measured.failed()) measured.counted = {measured.first};
    return;
  }
  run_in_turn(study.options, study.cases, 1, {}, [&](const MeasuredCase& measured, int number) {
    if (number == 1) keep_small_mesh(study, measured);
  });
}

/// The edge length among the options of a case.
double asked_edge_length(const MeasuredCase& measured) {
  const auto& words = measured.call.options;
  return std::stod(*(std::ranges::find(words, "--edge-length") + 1));
}

QualityRow row_of(const MeasuredCase& measured, const QualityVariant& variant, const MeasuredCase& reference) {
  QualityRow row{outcome_of(measured, &StageSeconds::mesh), measured.name, variant.labels};
  row.is_ours = variant.mesher == "ccdt";
  row.edge_length = asked_edge_length(measured);
  if (measured.failed()) return row;
  row.improve_seconds = bench::median(samples_of(measured, &StageSeconds::improve));
  row.quality = measured.first.quality;
  const double ratio =
      static_cast<double>(row.counts.tetrahedra) / static_cast<double>(reference.first.counts.tetrahedra);
  row.is_comparable = std::abs(ratio - 1) <= equal_count_tolerance;
  return row;
}

void measure_case(SourceStudy& study, StepCounter& steps, QualityCase& result) {
  steps.next(study.stem);
  try {
    result.surface = find_surface(study, static_cast<double>(result.wanted));
  } catch (const Error& error) {
    result.reason = error.what();
    return;
  }
  for (const QualityVariant& variant : study.plan.variants) {
    steps.next(study.stem + " " + variant.name);
    run_first(study, variant, result.surface);
  }
  run_counted(study);
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    result.rows.push_back(row_of(study.cases[i], study.plan.variants[i], study.cases.front()));
  std::filesystem::remove(study.mesh());
}

/// A source. One that cannot be read is a case without rows, not the end of the experiment.
void measure_source(const ExperimentOptions& options, const StudyPlan& plan, const StudySource& source,
                    StepCounter& steps, QualityStudy& study) {
  const std::string stem = plan.experiment + "-" + std::to_string(study.cases.size()) + "-" +
                           std::filesystem::path(source.name).stem().string();
  QualityCase& result = study.cases.emplace_back();
  result.name = source.name;
  result.wanted = static_cast<std::uint64_t>(options.tetrahedra);
  SurfaceSource surface;
  try {
    surface = source.file.empty() ? solid_source(source.name) : file_source(source.file);
  } catch (const Error& error) {
    result.reason = error.what();
    return;
  }
  surface.name = source.name;
  SourceStudy source_study{options, plan, surface, stem};
  measure_case(source_study, steps, result);
  append(study.meshes, source_study.meshes);
}

std::vector<std::string> study_definitions() {
  return {
      "r: the paper's measure, ((1/6) sum of squared edges)^(3/2) / (8.48528 volume); 1 is the regular tetrahedron.",
      "Dihedral angles: the smallest and the largest of the whole mesh, in degrees.",
      "Aspect ratio: the longest edge over 2 sqrt(6) times the radius of the inscribed sphere, as in VTK and Verdict.",
      "HXT improves its inverse. The regular tetrahedron's is 1.",
      "Radius-edge ratio: the circumscribed sphere's radius over the shortest edge, as in TetGen; regular: 0.612.",
      "Surface: triangles of nearly one size, at which our tetrahedra inside have edges of the surface's length.",
      "It is remeshed, unless its angles have 25 degrees or more and nine tenths of its edges differ by less than 2.",
      "Seconds are of meshing alone, with improvement, without reading and writing; one thread.",
  };
}

/// The columns that say whose a row is, and more.
std::vector<Column> columns_of(const QualityStudy& study, const std::vector<Column>& more) {
  std::vector<Column> columns = {label_column("model")};
  append(columns, study.labels);
  append(columns, more);
  return columns;
}

std::vector<Cell> label_cells(const QualityCase& c, const QualityRow& row) {
  std::vector<Cell> labels = {c.name};
  append(labels, std::vector<Cell>(row.labels.begin(), row.labels.end()));
  return labels;
}

/// A single run has no interval.
Cell seconds_of(const QualityRow& row) {
  return row.samples.size() > 1 ? Cell(*row.seconds) : Cell(row.seconds->value);
}

/// Million tetrahedra a second, where the clock could tell.
Cell speed_of(const QualityRow& row) {
  const double millions = static_cast<double>(row.counts.tetrahedra) / 1e6;
  return row.seconds->value > 0 ? Cell(millions / row.seconds->value) : Cell();
}

ResultTable quality_table(const QualityStudy& study) {
  ResultTable table = table_of(
      "quality", "Quality",
      columns_of(
          study,
          {label_column("status"), figure_column("tetrahedra"), figure_column("mean_r"), figure_column("median_r"),
           figure_column("p99_r", "99% of r below"), figure_column("worst_r"),
           figure_column("smallest_dihedral", "", "degrees"), figure_column("largest_dihedral", "", "degrees"),
           figure_column("mean_aspect", "mean aspect ratio"), figure_column("worst_aspect", "worst aspect ratio"),
           figure_column("mean_radius_edge", "mean radius-edge ratio"),
           figure_column("worst_radius_edge", "worst radius-edge ratio"),
           figure_column("edge_length", "edge length asked for"),
           figure_column("comparable", "comparable number of tetrahedra"), time_column("seconds", "", "s"),
           time_column("improve_seconds", "of these improvement", "s"),
           time_column("speed", "million tetrahedra a second"), note_column("reason")}));
  for (const QualityCase& c : study.cases)
    for (const QualityRow& row : c.rows) {
      std::vector<Cell> values = label_cells(c, row);
      values.push_back(as_cell(name_of(row.status)));
      const bench::Quality& q = row.quality;
      if (row.ok())
        append(values, cells(row.counts.tetrahedra, q.r.mean, q.r.median, q.r.p99, q.r.max, q.dihedral_degrees.min,
                             q.dihedral_degrees.max, q.aspect_ratio.mean, q.aspect_ratio.max, q.radius_edge_ratio.mean,
                             q.radius_edge_ratio.max, row.edge_length, row.is_comparable, seconds_of(row),
                             row.improve_seconds, speed_of(row)));
      values.resize(table.columns.size());
      values.back() = row.reason;
      table.rows.push_back({std::move(values), row.runs});
    }
  return table;
}

/// A row a bin. The histograms have as many bins as the quality's.
template <class HistogramOf>
ResultTable histogram_table(const QualityStudy& study, std::string name, std::string title, const std::string& unit,
                            HistogramOf histogram_of) {
  ResultTable table = table_of(std::move(name), std::move(title),
                               columns_of(study, {figure_column("low", "from", unit), figure_column("high", "to", unit),
                                                  figure_column("count"), figure_column("percent")}),
                               true);
  for (const QualityCase& c : study.cases)
    for (const QualityRow& row : c.rows) {
      if (!row.ok()) continue;
      const bench::Histogram& h = histogram_of(row.quality);
      const auto total = static_cast<double>(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}));
      for (std::size_t bin = 0; bin < h.counts.size(); ++bin) {
        std::vector<Cell> values = label_cells(c, row);
        const double percent = total > 0 ? 100 * static_cast<double>(h.counts[bin]) / total : 0;
        append(values, cells(h.edges[bin], h.edges[bin + 1], h.counts[bin], percent));
        table.rows.push_back({std::move(values), {row.runs.front()}});
      }
    }
  return table;
}

std::string coordinates(const Point3& p) {
  return "(" + rounded(p.x, 5) + ", " + rounded(p.y, 5) + ", " + rounded(p.z, 5) + ")";
}

ResultTable surfaces_table(const QualityStudy& study) {
  ResultTable table = table_of(
      "surfaces", "The surfaces",
      {label_column("model"), figure_column("edge_length"), figure_column("vertices"), figure_column("triangles"),
       figure_column("made"), figure_column("smallest_angle", "smallest angle of a triangle", "degrees"),
       figure_column("smallest_angle_at", "at"),
       figure_column("smallest_facet_angle", "smallest angle between facets", "degrees"),
       figure_column("smallest_facet_angle_at", "at")});
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) continue;
    const EvenSurface& s = c.surface;
    add_row(table, {}, c.name, s.edge_length, s.vertices, s.triangles, s.remeshed ? "remeshed" : "kept",
            s.angles.planar.degrees, coordinates(s.angles.planar.at), s.angles.dihedral.degrees,
            coordinates(s.angles.dihedral.at));
  }
  return table;
}

/// "piston, 10,000 tetrahedra"
std::string title_of(const QualityCase& c) {
  return c.name + ", " + with_separators(c.wanted) + " tetrahedra";
}

std::vector<std::string> problems_of(const QualityStudy& study) {
  std::vector<std::string> lines;
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) lines.push_back(title_of(c) + ": " + c.reason);
    for (const QualityRow& row : c.rows) {
      const std::string who = title_of(c) + ", " + row.variant + ": ";
      if (!row.ok())
        lines.push_back(who + row.failure());
      else if (!row.is_comparable)
        lines.push_back(who + with_separators(row.counts.tetrahedra) +
                        " tetrahedra are not comparable: no edge length was found that makes about " +
                        with_separators(c.rows.front().counts.tetrahedra));
    }
  }
  return lines;
}

}  // namespace

std::optional<CountFound> search_edge_length(const CountSearch& search,
                                             const std::function<std::optional<std::uint64_t>(double)>& count_of) {
  std::optional<CountFound> best;
  std::optional<Try> before;
  Bracket bracket{search.shortest, search.longest};
  double edge_length = std::clamp(search.first, search.shortest, search.longest);
  const auto error = [&](double count) { return std::abs(std::log(count / search.wanted)); };
  for (int i = 0; i < search.most_tries; ++i) {
    const auto counted = count_of(edge_length);
    if (!counted || *counted == 0) return best;
    const Try made{edge_length, static_cast<double>(*counted)};
    const bool is_near = std::abs(made.count / search.wanted - 1) <= search.tolerance;
    if (!best || error(made.count) < error(best->count)) best = CountFound{edge_length, made.count, is_near};
    if (is_near) return best;
    if (before && is_stuck(*before, made, search.wanted)) return best;
    bracket.take(made, search.wanted);
    const double exponent = before ? exponent_between(*before, made) : usual_exponent;
    const double next = bracket.hold(edge_length * std::pow(made.count / search.wanted, 1 / exponent));
    if (std::abs(next / edge_length - 1) < 1e-6) return best;  // at an end of what may be tried
    before = made;
    edge_length = next;
  }
  return best;
}

QualityStudy measure_study(const ExperimentOptions& options, const StudyPlan& plan, const Progress& progress) {
  QualityStudy study{start_experiment(options, plan.once ? 1 : options.runs), plan.labels, {}};
  const std::vector<StudySource> sources = sources_of(options, plan);
  check_something_is_measured(sources.size(), plan.experiment);
  StepCounter steps(progress, sources.size() * (plan.variants.size() + 1));
  for (const StudySource& source : sources) measure_source(options, plan, source, steps, study);
  return study;
}

ExperimentResult study_result(const QualityStudy& study, const std::vector<std::string>& definitions) {
  ExperimentResult result{.how = study.how, .definitions = study_definitions()};
  append(result.definitions, definitions);
  result.tables = {
      quality_table(study),
      histogram_table(study, "r_histogram", "Histogram of r", "",
                      [](const bench::Quality& q) -> const bench::Histogram& { return q.r.histogram; }),
      histogram_table(study, "dihedral_histogram", "Histogram of the dihedral angles", "degrees",
                      [](const bench::Quality& q) -> const bench::Histogram& { return q.dihedral_degrees.histogram; }),
      surfaces_table(study)};
  result.problems = problems_of(study);
  result.meshes = study.meshes;
  for (const QualityCase& c : study.cases) {
    result.is_good = result.is_good && c.reason.empty();
    for (const QualityRow& row : c.rows) result.is_good = result.is_good && (row.ok() || !row.is_ours);
  }
  return result;
}

}  // namespace ccdt::experiments
