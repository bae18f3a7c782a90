#include "tests/fuzz/one_meaning.h"

#include <cmath>
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

MeshOptions bare() {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
  options.threads = 1;
  return options;
}

bool is_meshed(const plc::InputPlc& input, const std::string& what) {
  try {
    const MeshResult result = mesh_plc(input, bare());
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

void find(const plc::InputPlc& input, Meaning& meaning) {
  const repair::Diagnosis before = check(input, "input");
  meaning.is_valid = before.is_valid();
  repair::Repaired repaired;
  try {
    repaired = repair::repair_input(input);
  } catch (const InputError&) {
    return demand(!meaning.is_valid, "valid, but not repaired");  // nothing is enclosed
  }
  meaning.is_refused = !repaired.refused.empty();
  if (meaning.is_refused) return demand(!meaning.is_valid, "valid, but its repair is refused");
  const repair::Diagnosis after = check(repaired.input, "copy");
  meaning.is_copy_valid = after.is_valid();
  if (!meaning.is_copy_valid) return demand(!meaning.is_valid, "valid, but its copy is not");
  if (meaning.is_valid)
    demand(std::fabs(after.volume - before.volume) <= 1e-6 * std::fabs(before.volume), "the repair changes the volume");
  const repair::Repaired again = repair::repair_input(repaired.input);
  demand(again.steps.empty(), "another repair changes the copy");
}

}  // namespace

Meaning find_meaning(const plc::InputPlc& input) {
  Meaning meaning;
  try {
    const auto triangulated = plc::triangulate_warped_facets(input);
    find(triangulated ? *triangulated : input, meaning);
  } catch (const std::exception& error) {
    meaning.disagreement = error.what();
  }
  return meaning;
}

}  // namespace ccdt::fuzz
