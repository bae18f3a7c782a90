#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/results/kept_mesh.h"
#include "tools/tests/program.h"
#include "tools/tests/published_schemas.h"

// Checks all JSON that the verbs write, in success and failure, against the schemas that come with the program.

namespace ccdt {
namespace {

using Json = nlohmann::json;

class EveryVerb : public Program {
 protected:
  EveryVerb() {
    setenv("CCDT_TEST_PROGRAM", CCDT_PROGRAM, 1);
    for (const char* variable : {"TMPDIR", "PATH"})
      if (const char* value = getenv(variable)) before_[variable] = value;
  }
  ~EveryVerb() override {
    for (const auto& [variable, value] : before_) setenv(variable.c_str(), value.c_str(), 1);
  }

  /// Calls the program, and keeps what it prints if that is JSON.
  void call(const std::string& arguments, const std::set<int>& exit_codes = {0}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(arguments);
    EXPECT_TRUE(exit_codes.contains(outcome.exit_code)) << outcome.exit_code << "\n" << outcome.err;
    if (arguments.find("--json") != std::string::npos)
      write("printed" + std::to_string(++printed_) + ".json", outcome.out);
  }

  /// A user's mesher: a script whose first argument is the input.
  void describe(const std::string& name, const std::string& script) const {
    write(name + ".json", Json({{"schema", "ccdt.mesher/1"},
                                {"name", name},
                                {"what", "a mesher"},
                                {"licence", "MIT"},
                                {"command", {"/bin/sh", "-c", script, "sh", "{input}"}},
                                {"files", {{"script", "# of no use\n"}}},
                                {"environment", {{"USE", "none"}}},
                                {"input_format", "off"},
                                {"output", "out.vtu"}})
                              .dump());
  }

  void write_meshers() const {
    describe("mine", "\"$CCDT_TEST_PROGRAM\" mesh \"$1\" -o out.vtu");
    describe("refusing", "exit 5");
    describe("crashing", "kill -SEGV $$");
    describe("wrong", "echo nothing >out.vtu");
    describe("slow", "sleep 100");
  }

  void check_and_mesh();
  void sweep();
  void sweep_on_a_cluster();
  void gate();
  void reproduce();

  /// Checks a document by the schema that it names; benchmarks of Google Benchmark are in its own format.
  void expect_valid(const Json& document, const std::string& name) {
    if (document.is_object() && document.contains("context") && document.contains("benchmarks")) return;
    const std::string schema = document.is_object() ? document.value("schema", "") : "";
    expect_valid(document, schema, name);
  }

  void expect_valid(const Json& document, const std::string& schema, const std::string& name) {
    seen_.insert(schema);
    const std::vector<std::string> faults = published_.faults(schema, document);
    EXPECT_TRUE(faults.empty()) << name << ": " << Json(faults).dump(1).substr(0, 2000);
    if (schema == "ccdt.run/1") statuses_.insert(document.at("status"));
  }

  void expect_valid_file(const std::filesystem::path& file);
  void expect_valid_page(const std::filesystem::path& file);

  const PublishedSchemas published_ = PublishedSchemas(SCHEMA_FOLDER);
  std::set<std::string> seen_, statuses_;

 private:
  int printed_ = 0;
  std::map<std::string, std::string> before_;
};

/// The text between the tags of an element of a page.
std::string element(const std::string& page, const std::string& id) {
  const auto tag = page.find("id=\"" + id + "\"");
  if (tag == std::string::npos) return "";
  const auto begin = page.find('>', tag) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

void EveryVerb::expect_valid_page(const std::filesystem::path& file) {
  const std::string page = text_of(file), packed = element(page, "ccdt-packed-report");
  expect_valid(Json::parse(packed.empty() ? element(page, "ccdt-report") : results::unpacked(packed)), file.string());
  for (const Json& part :
       {Json::parse(element(page, "ccdt-meshes")), Json::parse(results::unpacked(element(page, "ccdt-files")))})
    for (const auto& [name, document] : part.items()) expect_valid(document, file.string() + ": " + name);
}

void EveryVerb::expect_valid_file(const std::filesystem::path& file) {
  SCOPED_TRACE(file);
  if (file.extension() == ".json") expect_valid(Json::parse(text_of(file)), file.string());
  if (file.filename() == "index.html") expect_valid_page(file);
  if (file.extension() != ".jsonl") return;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) expect_valid(Json::parse(line), "ccdt.runs/1", file.string());
}

void EveryVerb::check_and_mesh() {
  call("model torus --edge-length 0.4 -o part.off");
  call("check part.off --report check.json");
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  call("check open.off --report open.json --repair -o repaired.off", {0, 3});
  call("mesh part.off -o part.mesh --report ok.json");
  write("field.json", R"({"schema": "ccdt.sizefield/1", "what": "all", "curvature_angle": 40, "elements_through": 1,
    "sizes": [{"edge_length": 0.4, "markers": [0], "within": 0.1, "boxes": [{"low": [0, 0, 0], "high": [1, 1, 1]}]},
              {"volume": 0.1, "regions": [1], "balls": [{"center": [1, 0, 0], "radius": 0.1}]}]})");
  call("mesh part.off -o sized.mesh --report sized.json --size-field field.json");
  call("mesh part.off -o even.mesh --report even.json --surface remesh --edge-length 0.3 --surface-output even.off");
  call(
      "mesh part.off -o rough.mesh --report missed.json --surface remesh --edge-length 0.4 --require-r 1.01 "
      "--require-dihedral 70 --deviation 1e-6",
      {1});
  call("mesh part.off -o fine.mesh --report fine.json --surface refine --lattice none --steiner keep --threads 2");
  call("mesh part.off -o papers.mesh --report papers.json --strategies paper");
  call("mesh open.off -o open.mesh --report invalid.json", {3});
  call("mesh missing.off -o open.mesh --report missing.json", {3});
  call("mesh part.off -o huge.mesh --report huge.json --edge-length 1e-6", {4});
  call("mesh part.off -o other.mesh --report refused.json --mesher refusing.json", {1});
  call("verify part.off part.mesh --report right.json");
  call("verify part.off even.mesh --report wrong-mesh.json", {1});
  call("verify part.off even.mesh --within 0.2 --report within.json");
  for (const char* mesher : {"tetgen", "cgal-mesh3", "cgal-delaunay", "gmsh-hxt"})
    if (run("mesh --help").out.find(std::string("  ") + mesher + " ") != std::string::npos)
      call("mesh part.off -o " + std::string(mesher) + ".mesh --report " + mesher + "-run.json --mesher " + mesher,
           {0, 1, 3});
}

void EveryVerb::sweep() {
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "all", "what": "all", "expects": "a second", "seed": 3,
    "inputs": [{"model": "cube", "edge_length": [0.5], "options": {"grading": [0.5, 1]}}, {"files": "part.off"}],
    "meshers": ["ccdt", "mine.json", "refusing.json", "crashing.json", "wrong.json"],
    "options": {"lattice": ["fcc", "bcc"], "surface": "keep"}, "exclude": [{"model": "cube", "mesher": "w*"}],
    "repetitions": {"until": 0.9, "at_least": 6, "at_most": 6}, "verify": true, "keep_meshes": true,
    "limits": {"seconds": 20, "bytes": 4000000000, "disk_bytes": 100000000}})");
  call("sweep spec.json -o sweep --dry-run --json");
  call("sweep spec.json -o sweep");
  call("sweep spec.json -o sweep --status --json");
  describe("mine", "\"$CCDT_TEST_PROGRAM\" mesh \"$1\" -o out.vtu --lattice bcc");
  call("sweep spec.json -o sweep --mixed");
  call("report sweep");
  call("sweep sweep/sweep.json -o again --dry-run --json");
  write("slow-spec.json", R"({"schema": "ccdt.sweep/1", "inputs": [{"files": "part.off"}],
    "meshers": ["slow.json"], "limits": {"seconds": 0.5}})");
  call("sweep slow-spec.json -o slow");
  write("poor-spec.json", R"({"schema": "ccdt.sweep/1", "inputs": [{"files": "part.off"}], "limits": {"bytes": 1},
    "options": {"face-protection": "off", "edge-length": 0.3, "surface": "remesh", "sharp-angle": 20}})");
  call("sweep poor-spec.json -o poor", {0, 1});
  call("report poor");
}

/// Slurm takes a job and forgets it.
void EveryVerb::sweep_on_a_cluster() {
  std::filesystem::create_directory(work() / "bin");
  for (const char* name : {"sbatch", "squeue"}) {
    write(std::string("bin/") + name, std::string(name) == "sbatch" ? "#!/bin/sh\necho 12\n" : "#!/bin/sh\n");
    std::filesystem::permissions(work() / "bin" / name, std::filesystem::perms::owner_all);
  }
  const std::string path = getenv("PATH");
  setenv("PATH", ((work() / "bin").string() + ":" + path).c_str(), 1);
  call("sweep slow-spec.json -o cluster --slurm");
  call("sweep slow-spec.json -o cluster --status --json");
  call("sweep slow-spec.json -o snakes --snakemake");
}

void EveryVerb::gate() {
  const std::set<int> verdicts = {0, 1, 3, 5};
  write("rules.json", R"({"schema": "ccdt.rules/1", "layers": ["exact", "time"], "may_be_missing": ["none*"],
    "exact": {"ignore": ["counts.improve.*"], "tolerances": {"work.front.*": 0.01}, "better": {"volume": "more"}},
    "time": {"at_least": 5, "at_most": 6},
    "special": [{"cases": "part*", "time": {"layout_deviation": 0.01}}]})");
  write("gate-spec.json", R"({"schema": "ccdt.sweep/1", "inputs": [{"files": "part.off"}]})");
  const std::string program = "'" CCDT_PROGRAM "'", both = "--base " + program + " --head " + program;
  call("gate sweep --against base.json --update --reason first");
  call("gate sweep --against base.json -o gate-of-recordings --rules rules.json", verdicts);
  call("gate " + both + " --sweep gate-spec.json -o gate-of-sweep --rules rules.json", verdicts);
  call("gate --base true --head false -o gate-of-failure --rules rules.json", verdicts);
  call("gate --base true --calibrate --pairs 12 -o calibration --rules rules.json");
}

void EveryVerb::reproduce() {
  const bool with_tetgen = run("mesh --help").out.find("  tetgen ") != std::string::npos;
  call("reproduce table1 fig7 theorem1 delaunay -o reproduction --scale 500 --models piston --beside refusing.json" +
       std::string(with_tetgen ? ",tetgen" : ""));
  describe("refusing", "exit 6");
  call("reproduce theorem1 -o reproduction --scale 500 --models piston --beside refusing.json --mixed");
  std::filesystem::create_directory(work() / "corpus");
  write("corpus/corpus.json", R"({"schema": "ccdt.corpus/1", "name": "own", "what": "a torus", "files": [{"file":
    "../part.off", "package": "parts", "version": "1", "path": "part.off", "license": "MIT", "sha256": ")" +
                                  std::string(64, '0') + R"(", "valid": true, "faults": []}],
    "left_out": [{"package": "parts", "path": "part.step", "why": "gmsh cannot mesh it"}]})");
  call("reproduce robustness -o reproduction --corpus corpus --beside refusing.json --mixed");
  call("report reproduction");
  call("report reproduction reproduction -o comparison");
}

TEST_F(EveryVerb, WritesOnlyJsonOfPublishedSchemas) {
  write_meshers();
  check_and_mesh();
  sweep();
  sweep_on_a_cluster();
  gate();
  reproduce();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(work()))
    if (entry.is_regular_file()) expect_valid_file(entry.path());

  std::set<std::string> all;
  for (const auto& [name, schema] : published_.all()) all.insert(name);
  if (!std::filesystem::exists(std::filesystem::path(SCHEMA_FOLDER) / "../page.html")) all.erase("ccdt.pagemesh/1");
  EXPECT_EQ(seen_, all) << "every schema is that of some file";
  EXPECT_EQ(statuses_, (std::set<std::string>{"ok", "failed", "timeout", "out_of_memory", "crashed"}));
}

}  // namespace
}  // namespace ccdt
