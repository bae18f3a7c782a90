#include "bench/gate/instructions.h"

#include <gnu/libc-version.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <vector>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "bench/run/environment.h"
#include "bench/run/in_parallel.h"
#include "bench/run/run_record.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t shown_digits = 12;

/// The files have the same names in every run: a longer path moves objects on the heap, which changes counts.
constexpr const char* program_name = "program";
constexpr const char* profile_name = "profile";
constexpr const char* report_name = "report.json";

/// "2.36 (libc.so.6 1a2b3c...)". The hash is there because distributions patch a library without a new version number.
std::string library(const std::string& version, const std::string& name_begins) {
  struct Wanted {
    std::string name, path;
  } wanted{"/" + name_begins, ""};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& w = *static_cast<Wanted*>(data);
        if (std::strstr(info->dlpi_name, w.name.c_str()) != nullptr) w.path = info->dlpi_name;
        return 0;
      },
      &wanted);
  if (wanted.path.empty()) return version + " (static)";
  const fs::path file = fs::canonical(wanted.path);
  const std::string hash = bench::sha256_of_file(file).substr(0, shown_digits);
  return version + (version.empty() ? "" : " ") + "(" + file.filename().string() + " " + hash + ")";
}

void link_to(const fs::path& file, const fs::path& name) {
  fs::create_symlink(fs::canonical(file), name);
}

/// Links the input under a name of fixed length, with the file from which a list of facets may take its vertices.
std::string link_input(const fs::path& input, const fs::path& folder) {
  std::string name = "input" + input.extension().string();
  link_to(input, folder / name);
  fs::path nodes = input;
  nodes.replace_extension(".node");
  if (nodes != input && fs::exists(nodes)) link_to(nodes, folder / "input.node");
  return name;
}

/// Runs `ccdt mesh` under callgrind in a fixed environment. All symbols are resolved at the start. Otherwise the first
/// stage that calls a function pays for the lookup, which takes longer in a program with more libraries.
std::vector<std::string> command_of(const fs::path& valgrind, const std::string& input,
                                    const std::vector<std::string>& options) {
  std::vector<std::string> command = {"/usr/bin/env", "-i",       "PATH=/usr/bin:/bin",
                                      "LC_ALL=C",     "TMPDIR=.", "LD_BIND_NOW=1"};
  command.insert(command.end(), {same_on_all_processors, valgrind.string(), "-q", "--tool=callgrind",
                                 std::string("--callgrind-out-file=") + profile_name, std::string("./") + program_name,
                                 "mesh", input, "-o", "mesh.vtu", "--report", report_name, "--threads", "1"});
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

/// The command that repeats the count outside the gate.
std::string repeating_command(const fs::path& program, const bench::Case& asked) {
  std::vector<std::string> command = {"valgrind", "--tool=callgrind", program.string(), "mesh", asked.input.string(),
                                      "-o",       "again.vtu",        "--threads",      "1"};
  command.insert(command.end(), asked.options.begin(), asked.options.end());
  return baselines::command_line(command);
}

StageInstructions count_stages(const fs::path& valgrind, const fs::path& program, const bench::Case& asked,
                               const fs::path& kept_profile) {
  const baselines::TemporaryFolder folder;
  link_to(program, folder.path() / program_name);
  const std::string input = link_input(asked.input, folder.path());
  const baselines::ProcessResult run =
      baselines::run_program(command_of(valgrind, input, asked.options),
                             {.folder = folder.path(), .log = folder.path() / "log", .limits = baselines::Limits{}});
  if (run.status != baselines::RunStatus::ok)
    throw MeshError("the case " + asked.name + " failed under callgrind: " + run.reason + ": " +
                        baselines::last_lines(folder.path() / "log"),
                    {}, "repeat it: " + repeating_command(program, asked));
  const auto profile = folder.path() / profile_name;
  fs::copy_file(profile, kept_profile, fs::copy_options::overwrite_existing);
  try {
    return stage_instructions(io::read_whole_file(profile).bytes);
  } catch (Error& error) {
    error.place().file = kept_profile.string();
    throw;
  }
}

CaseFigures& case_of(Recording& recording, const std::string& name) {
  const auto found = std::ranges::find(recording.cases, name, &CaseFigures::name);
  return found != recording.cases.end() ? *found : recording.cases.emplace_back(CaseFigures{name, "", {}});
}

void add_figures(const StageInstructions& stages, CaseFigures& figures) {
  for (const auto& [stage, instructions] : stages)
    figures.figures.push_back({"instructions." + stage, Layer::instructions, {static_cast<double>(instructions)}});
}

}  // namespace

fs::path find_valgrind() {
  const auto found = baselines::find_on_path("valgrind");
  if (!found)
    throw InputError("instructions cannot be counted: there is no valgrind", {},
                     "install it (Debian: apt-get install valgrind), or remove the layer instructions from the rules");
  return *found;
}

bench::Identity instruction_identity(const fs::path& program) {
  const fs::path valgrind = find_valgrind();
  const baselines::TemporaryFolder folder;
  const auto input = folder.path() / "cube.off", report = folder.path() / report_name;
  const std::string path = fs::absolute(program).string();
  const baselines::ProgramOptions options = {.folder = folder.path()};
  baselines::run_program({path, "model", "cube", "-o", input.string()}, options);
  baselines::run_program({path, "mesh", input.string(), "-o", "cube.vtu", "--report", report.string()}, options);
  const auto record = bench::find_run_record(report);
  if (!record)
    throw InputError("this program is not a working ccdt", {.file = program.string()},
                     "name a built one, such as build/release/ccdt");
  return {{"instructions.cpu", bench::capture_environment().cpu},
          {"instructions.valgrind", baselines::version_of_program({valgrind.string(), "--version"}, "")},
          {"instructions.libc", library(gnu_get_libc_version(), "libc.so")},
          {"instructions.libm", library("", "libm.so")},
          {"instructions.libstdc++", library("", "libstdc++.so")},
          {"instructions.compiler", record->environment.compiler},
          {"instructions.flags", record->environment.flags}};
}

void add_instructions(const fs::path& program, std::span<const bench::Case> cases, const Rules& rules,
                      const fs::path& folder, Recording& recording, const Progress& progress) {
  std::vector<const bench::Case*> counted;
  for (const bench::Case& c : cases)
    if (c.mesher == "ccdt" && matches(rules.instructions.cases, c.name)) counted.push_back(&c);
  if (counted.empty()) return;
  recording.identity.merge(instruction_identity(program));
  const fs::path valgrind = find_valgrind(), profiles = folder / "instructions";
  fs::create_directories(profiles);

  std::vector<StageInstructions> stages(counted.size());
  std::mutex reporting;
  std::size_t done = 0;
  bench::in_parallel(counted.size(), [&](std::size_t i) {
    const auto profile = profiles / (std::to_string(i) + ".callgrind");
    stages[i] = count_stages(valgrind, program, *counted[i], profile);
    const std::lock_guard lock(reporting);
    report(progress, "instructions", ++done, counted.size());
  });
  for (std::size_t i = 0; i < counted.size(); ++i) {
    CaseFigures& figures = case_of(recording, counted[i]->name);
    if (figures.command.empty()) figures.command = repeating_command(program, *counted[i]);
    add_figures(stages[i], figures);
  }
}

}  // namespace ccdt::gate
