#include <nlohmann/json.hpp>

#include "baselines/mesher_description.h"
#include "baselines/parse_json.h"
#include "bench/gate/baseline.h"
#include "bench/gate/calibration.h"
#include "bench/gate/callgrind_profile.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/results/compact_mesh.h"
#include "bench/results/experiment_result.h"
#include "bench/results/run_values.h"
#include "bench/run/run_record.h"
#include "bench/sweep/chunks.h"
#include "bench/sweep/spec.h"
#include "bench/sweep/sweep_document.h"
#include "engine/io/files.h"
#include "reports/charts.h"
#include "reports/report.h"
#include "tests/fuzz/targets/target.h"
#include "tests/fuzz/targets/temporary_folder.h"

// All readers of JSON, and that of callgrind's profiles. The first byte chooses one: 'a' is the first line of the
// table.

namespace ccdt::fuzz {
namespace {

/// Reads the file of this name in the folder.
struct Door {
  const char* name;
  void (*read)(const std::filesystem::path& folder, const std::filesystem::path& file);
};
using Path = const std::filesystem::path&;

const sweep::MeshOptionRules any_options = {{"lattice", "edge-length", "threads", "sizes"},
                                            [](const std::string&, const std::string&) { return std::string(); },
                                            [](const std::vector<std::string>&) { return std::string(); }};

/// What is written of a document must be read as the same.
template <class Value>
void write_and_read(const std::string& text, Value (*read)(const std::string&)) {
  require(to_json(read(text)) == text, "a written document is another one");
}

void read_compact_mesh(Path, Path file) {
  try {
    results::compact_mesh(baselines::parse_json(io::read_whole_file(file).bytes));
  } catch (const std::exception&) {  // as documented
  }
}

constexpr Door doors[] = {
    {"spec.json", [](Path, Path file) { sweep::to_json(sweep::read_spec(file, any_options)); }},
    {"sweep.json", [](Path folder, Path) { sweep::read_sweep(folder); }},
    {"chunks/0.json", [](Path folder, Path) { sweep::read_chunks(folder); }},
    {"rules.json", [](Path, Path file) { gate::to_json(gate::read_rules(file)); }},
    {"baseline.json", [](Path, Path file) { gate::read_baseline(file); }},
    {"calibration.json", [](Path, Path file) { to_text(gate::read_calibration(file)); }},
    {"samples.json", [](Path, Path file) { gate::read_samples(file); }},
    {"recording.json", [](Path, Path file) { gate::read_recording(file); }},
    {"run.json",
     [](Path, Path file) { write_and_read(to_json(bench::read_run_record(file)), bench::run_record_from_json); }},
    {"values.json", [](Path, Path file) { results::read_run_values(file); }},
    {"experiment.json",
     [](Path, Path file) {
       write_and_read(to_json(results::read_experiment_result(file)), results::experiment_result_from_json);
     }},
    {"conditions.json", [](Path folder, Path) { report_json(reports::read_report(folder, {})); }},
    {"chart.json", [](Path folder, Path) { reports::read_charts(folder); }},
    {"mesher.json", [](Path, Path file) { texts_of(baselines::read_mesher_description(file)); }},
    {"mesh.json", read_compact_mesh},
    {"profile", [](Path, Path file) { gate::read_callgrind(io::read_whole_file(file).bytes); }},
};

}  // namespace
}  // namespace ccdt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ccdt::fuzz;
  Bytes bytes(data, size);
  const Door& door = doors[static_cast<std::uint8_t>(bytes.next() - 'a') % std::size(doors)];
  const std::filesystem::path& folder = temporary_folder().path();
  std::filesystem::create_directories(folder / "chunks");
  const std::filesystem::path file = temporary_folder().write(door.name, bytes.text());
  accepts([&] { door.read(folder, file); });
  std::filesystem::remove(file);
  return 0;
}
