#include "bench/benchmarks/benchmark_main.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <memory>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"

namespace ccdt::benchmarks {
namespace {

/// The faults of one family by size, once they are known.
using Faults = std::map<std::int64_t, std::string>;

bool any_fault = false;

/// The user's options for all families.
struct Wanted {
  std::int64_t largest = std::numeric_limits<std::int64_t>::max();  ///< size
  bool no_complexity = false;
};
Wanted wanted;

std::string look_for_fault(const Family& family, std::int64_t size) {
  try {
    return family.find_fault(size);
  } catch (const Error& error) {
    return error.what();
  }
}

const std::string& fault_of(const Family& family, std::int64_t size, Faults& faults) {
  const auto at = faults.find(size);
  if (at != faults.end()) return at->second;
  const std::string& fault = faults[size] = look_for_fault(family, size);
  any_fault |= !fault.empty();
  return fault;
}

/// Arguments before those of the caller, which override them.
std::vector<std::string> with_defaults(int argc, char** argv) {
  std::vector<std::string> all = {argv[0], "--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=5",
                                  "--benchmark_min_time=0.1", "--benchmark_display_aggregates_only=true"};
  all.insert(all.end(), argv + 1, argv + argc);
  return all;
}

void print_help() {
  std::cout
      << "Measures one stage of the mesher; the top of its source says exactly what.\n\n"
         "  --input FILE   also measure this file, which \"ccdt mesh\" must be able to read; may be repeated\n"
         "  --largest N    skip sizes above N\n"
         "  --no-complexity  fit no complexity (Google Benchmark 1.7 crashes if all points of a fit are faults)\n\n";
  benchmark::PrintDefaultHelp();
}

/// Finds files that share a name: their results would be indistinguishable.
std::string check_names(const Files& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.filename().string());
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  return twice == names.end() ? "" : "two files are named " + *twice + ": rename one, or measure one at a time";
}

}  // namespace

void add_family(const Family& family) {
  std::vector<std::int64_t> sizes = family.sizes;
  std::erase_if(sizes, [](std::int64_t size) { return size > wanted.largest; });
  if (sizes.empty() && !family.sizes.empty()) return;
  auto* added = benchmark::RegisterBenchmark(family.name.c_str(),
                                             [family, faults = std::make_shared<Faults>()](benchmark::State& state) {
                                               const std::int64_t size = family.sizes.empty() ? 0 : state.range(0);
                                               const std::string& fault = fault_of(family, size, *faults);
                                               if (!fault.empty()) return state.SkipWithError(fault.c_str());
                                               family.measure(state, size);
                                             });
  added->Unit(benchmark::kMillisecond);
  for (const std::int64_t size : sizes) added->Arg(size);
  if (sizes.size() > 1 && !wanted.no_complexity) added->Complexity(family.complexity);
}

void add_stage(const StageBenchmark& stage, const Files& files) {
  const auto add = [&](const std::string& subject, const std::vector<std::int64_t>& sizes, const auto& stages_of) {
    add_family({.name = stage.name + "/" + subject,
                .sizes = sizes,
                .complexity = stage.complexity,
                .find_fault = [=](std::int64_t size) { return stage.find_fault(stages_of(size)); },
                .measure = [=](benchmark::State& state, std::int64_t size) { stage.measure(state, stages_of(size)); }});
  };
  const auto add_models = [&](bool flattened, std::int64_t largest) {
    std::vector<std::int64_t> sizes(model_sizes.begin(), model_sizes.end());
    std::erase_if(sizes, [&](std::int64_t size) { return size > largest; });
    for (const std::string model : model_names)
      add((flattened ? "flat-" : "") + model, sizes,
          [model, flattened](std::int64_t size) -> const Stages& { return stages_of_model(model, flattened, size); });
  };
  add_models(false, stage.largest);
  if (stage.flattened_too) add_models(true, std::min(stage.largest, largest_flattened));
  for (const auto& file : files)
    add(file.filename().string(), {}, [file](std::int64_t) -> const Stages& { return stages_of_file(file); });
}

void set_count(benchmark::State& state, const std::string& name, std::size_t count) {
  if (count > 0) state.counters[name] = static_cast<double>(count);
}

void set_counters(benchmark::State& state, std::size_t vertices, std::size_t cells) {
  const auto set = [&](const std::string& name, std::size_t count) {
    set_count(state, name, count);
    state.counters[name + "/s"] =
        benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate);
  };
  set("vertices", vertices);
  if (cells > 0) set("cells", cells);
  state.SetItemsProcessed(static_cast<std::int64_t>(vertices) * static_cast<std::int64_t>(state.iterations()));
  state.SetComplexityN(static_cast<std::int64_t>(vertices));
}

}  // namespace ccdt::benchmarks

int main(int argc, char** argv) {
  using namespace ccdt::benchmarks;
  std::vector<std::string> all = with_defaults(argc, argv);
  std::vector<char*> arguments;
  for (std::string& argument : all) arguments.push_back(argument.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data(), print_help);

  Files files;
  CLI::App app;
  app.add_option("--input", files)->check(CLI::ExistingFile)->allow_extra_args(false);
  app.add_option("--largest", wanted.largest)->check(CLI::PositiveNumber);
  app.add_flag("--no-complexity", wanted.no_complexity);
  try {
    app.parse(count, arguments.data());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (const std::string fault = check_names(files); !fault.empty()) {
    std::cerr << "--input: " << fault << '\n';
    return 2;
  }
  add_benchmarks(files);
  ccdt::with_threads(1, [] { return benchmark::RunSpecifiedBenchmarks(); });  // stages are compared on one core
  benchmark::Shutdown();
  return any_fault ? 1 : 0;
}
