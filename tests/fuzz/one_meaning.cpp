#include "tests/fuzz/one_meaning.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/verify/verify.h"
#include "engine/base/errors.h"
#include "engine/mesher.h"
#include "engine/plc/warped_facets.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"

namespace ccdt::fuzz {

namespace {

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

/// The words of the exception that a function throws; empty if none.
template <class Function>
std::string what_is_thrown(const Function& function) {
  try {
    function();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

MeshOptions bare() {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
  options.threads = 1;
  return options;
}

/// A copy with tiny features can need very many vertices.
Progress at_most(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  return [end](std::string_view, std::uint64_t, std::uint64_t) {
    if (std::chrono::steady_clock::now() > end) throw LimitError("meshing takes too long", {}, "give it more time");
  };
}

bool is_meshed(const plc::InputPlc& input, const std::string& what) {
  try {
    const MeshResult result = mesh_plc(input, bare(), at_most(5));
    for (const verify::Check& check : verify::verify(input, result.mesh).checks)
      demand(!check.required || check.failed == 0,
             what + ": wrong mesh: " + check.name + ": " + (check.examples.empty() ? "" : check.examples[0]));
    return true;
  } catch (const InputError&) {
    return false;
  } catch (const Error& error) {
    throw std::runtime_error(what + ": " + error.what());
  }
}

/// \return  the diagnosis, which the mesher agrees with
repair::Diagnosis check(const plc::InputPlc& input, const std::string& what) {
  repair::Diagnosis diagnosis = repair::find_faults(input);
  const bool meshed = is_meshed(input, what);
  demand(diagnosis.is_valid() || !meshed, what + ": invalid, but meshed");
  demand(!diagnosis.is_valid() || meshed, what + ": valid, but refused");
  return diagnosis;
}

/// Of a valid copy, which another repair must not change.
/// \return  its volume, if it is valid
std::optional<double> check_copy(const plc::InputPlc& copy) {
  const repair::Diagnosis diagnosis = check(copy, "copy");
  if (!diagnosis.is_valid()) return {};
  demand(repair::repair_input(copy).steps.empty(), "another repair changes the copy");
  return diagnosis.volume;
}

void find(const plc::InputPlc& input, Meaning& meaning) {
  const repair::Diagnosis before = check(input, "input");
  meaning.is_valid = before.is_valid();
  repair::Repaired repaired;
  try {
    repaired = repair::repair_input(input, {.seconds = 2});  // these inputs are small: others do not end
  } catch (const InputError&) {
    return demand(!meaning.is_valid, "valid, but not repaired");  // nothing is enclosed
  }
  meaning.is_refused = !repaired.refused.empty();
  demand(!meaning.is_valid || !meaning.is_refused, "valid, but its repair is refused");
  if (meaning.is_refused) return;
  if (meaning.is_valid) {
    const std::optional<double> volume = check_copy(repaired.input);
    demand(volume && std::fabs(*volume - before.volume) <= 1e-6 * before.volume, "the repair changes the volume");
  } else {
    meaning.about_copy = what_is_thrown([&] { meaning.is_copy_valid = check_copy(repaired.input).has_value(); });
  }
}

}  // namespace

Meaning find_meaning(const plc::InputPlc& input) {
  Meaning meaning;
  const auto triangulated = plc::triangulate_warped_facets(input);
  meaning.disagreement = what_is_thrown([&] { find(triangulated ? *triangulated : input, meaning); });
  return meaning;
}

}  // namespace ccdt::fuzz
