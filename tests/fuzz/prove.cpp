#include "tests/fuzz/prove.h"

#include <algorithm>
#include <ctime>
#include <optional>

#include "bench/verify/verify.h"
#include "engine/base/box.h"
#include "engine/base/errors.h"
#include "engine/plc/warped_facets.h"

namespace ccdt::fuzz {

namespace {

struct TooLong {};

/// The CPU time of this thread: how long a run takes by the clock depends on what else the machine does.
double thread_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Throws when the time is up.
Progress limited_to(double seconds) {
  return [end = thread_seconds() + seconds](std::string_view, std::uint64_t, std::uint64_t) {
    if (thread_seconds() > end) throw TooLong();
  };
}

std::string name(const MeshOptions& o) {
  return "lattice " + std::string(name_of(o.lattice)) + ", protection " + std::string(name_of(o.protection)) +
         ", locator " + std::string(name_of(o.locator)) + ", delaunay " + std::string(name_of(o.delaunay)) +
         (o.face_protection ? "" : ", without face protection") + ", surface " + std::string(name_of(o.surface)) +
         ", improve " + std::string(name_of(improvement_of(o))) +
         ", Steiner vertices: " + std::string(name_of(o.improve.steiner));
}

/// The tetrahedra as sorted lists of sorted vertices.
std::vector<std::array<std::uint32_t, 4>> sorted_cells(const TetMesh& mesh) {
  auto cells = mesh.tetrahedra;
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Together with the first options, these contain every pair of values of two different strategies. `core` occurs only
/// once, because it differs from `insert` only with a lattice.
struct Strategy {
  bool face_protection;
  LocatorKind locator;
  DelaunayMethod delaunay;
};
constexpr std::array others = {Strategy{true, LocatorKind::octree, DelaunayMethod::wrap},
                               Strategy{true, LocatorKind::grid, DelaunayMethod::insert},
                               Strategy{false, LocatorKind::grid, DelaunayMethod::core},
                               Strategy{false, LocatorKind::cavity, DelaunayMethod::wrap},
                               Strategy{false, LocatorKind::octree, DelaunayMethod::insert},
                               Strategy{false, LocatorKind::grid, DelaunayMethod::wrap}};

/// Midpoints may pile up at a small angle. Uniform grids are for even density; with all vertices in a few cells, they
/// would take most of the time. So larger meshes are compared without them.
constexpr std::size_t most_in_grids = 2000;

bool uses_grid(const Strategy& strategy) {
  return strategy.locator == LocatorKind::grid || strategy.delaunay == DelaunayMethod::wrap;
}

class Prover {
 public:
  Prover(const InputPlc& input, const ProofOptions& options) : input_(input), options_(options) {}

  Proof prove() {
    try {
      prove_all();
    } catch (const InputError&) {
      fail(Proof::Outcome::invalid, "the input is not valid");
    } catch (const TooLong&) {
      fail(Proof::Outcome::endless, "too long: " + now_);
    } catch (const LimitError& error) {
      fail(Proof::Outcome::endless, now_ + ": " + error.what());
    } catch (const std::exception& error) {
      fail(Proof::Outcome::wrong, now_ + ": " + error.what());
    }
    return proof_;
  }

 private:
  void prove_all() {
    MeshOptions options;
    options.edge_length = 0.25 * largest_extent(input_.vertices);
    options.lattice = Lattice::none;
    options.threads = 1;  // several seeds run at the same time
    options.delaunay = DelaunayMethod::insert, options.least_core = 0;
    options.thin_tetrahedra = 2000;  // thin plates must not decide how long everything takes
    options.improve.improvement = Improvement::none;
    options.improve.steiner = SteinerRule::keep;
    compare(options, mesh(options, options_.seconds).mesh);
    options.improve.steiner = SteinerRule::remove;
    verify(mesh(options, options_.seconds).mesh);
    options.improve.steiner = SteinerRule::keep;
    for (const Lattice lattice : options_.lattices) {
      options.lattice = lattice;
      compare(options, mesh(options, options_.seconds).mesh);
      options.improve.improvement = Improvement::all, options.improve.steiner = SteinerRule::remove;
      verify(mesh(options, options_.seconds).mesh);
      options.improve.improvement = Improvement::none, options.improve.steiner = SteinerRule::keep;
    }
    options.lattice = Lattice::none;
    if (options_.refined) {
      options.surface = SurfaceRule::refine;
      verify(mesh(options, options_.seconds).mesh);
      options.surface = SurfaceRule::keep;
    }
    options.protection = Protection::midpoint;
    if (const auto result = mesh_if_it_ends(options)) compare(options, result->mesh);
  }

  MeshResult mesh(const MeshOptions& options, double seconds) {
    now_ = name(options);
    ++proof_.meshes;
    return mesh_plc(input_, options, limited_to(seconds));
  }

  std::optional<MeshResult> mesh_if_it_ends(const MeshOptions& options) {
    try {
      return mesh(options, 0.02 * options_.seconds);  // the others take longer
    } catch (const LimitError&) {
    } catch (const TooLong&) {
    }
    return {};
  }

  void verify(const TetMesh& mesh) {
    ++proof_.verified;
    for (const verify::Check& check : verify::verify(input_, mesh).checks)
      if (check.required && check.failed > 0)
        fail(Proof::Outcome::wrong, now_ + ": " + check.name + ": " + std::to_string(check.failed) + " of " +
                                        std::to_string(check.checked) + " fail, " +
                                        (check.examples.empty() ? "" : check.examples.front()));
  }

  void compare(MeshOptions options, const TetMesh& first) {
    verify(first);
    const auto cells = sorted_cells(first);
    for (const Strategy& other : others) {
      if (cells.size() > most_in_grids && uses_grid(other)) continue;
      options.face_protection = other.face_protection;
      options.locator = other.locator;
      options.delaunay = other.delaunay;
      const TetMesh second = mesh(options, options_.seconds).mesh;
      if (second.vertices != first.vertices || sorted_cells(second) != cells)
        fail(Proof::Outcome::wrong, now_ + ": other tetrahedra");
    }
  }

  /// Keeps only the first message.
  void fail(Proof::Outcome outcome, const std::string& what) {
    if (proof_.outcome != Proof::Outcome::right) return;
    proof_.outcome = outcome;
    proof_.what = what;
  }

  const InputPlc& input_;
  const ProofOptions& options_;
  Proof proof_;
  std::string now_;  // how the last mesh was made
};

}  // namespace

Proof prove(const InputPlc& input, const ProofOptions& options) {
  const auto triangulated = plc::triangulate_warped_facets(input);
  return Prover(triangulated ? *triangulated : input, options).prove();
}

}  // namespace ccdt::fuzz
