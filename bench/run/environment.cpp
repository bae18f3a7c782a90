#include "bench/run/environment.h"

#include <nettle/sha2.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/version.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>
#include <tuple>

#include "baselines/mesher.h"
#include "bench/revision.h"
#include "bench/run/json_fields.h"

namespace ccdt::bench {
namespace {

constexpr auto fields_of_environment = std::tuple(
    field("cpu", &Environment::cpu), field("cores", &Environment::cores),
    optional_field("memory_bytes", &Environment::memory_bytes), field("load_average", &Environment::load_average),
    field_if_any("governor", &Environment::governor),
    field_if_any("temperature_celsius", &Environment::temperature_celsius), field_if_any("jobs", &Environment::jobs),
    field("system", &Environment::system), field("compiler", &Environment::compiler),
    field("flags", &Environment::flags), field("build_type", &Environment::build_type),
    field("revision", &Environment::revision), field("libraries", &Environment::libraries));

/// The value of the first line of a file of "name : value" lines that has this name; empty if there is none.
std::string value_in_file(const char* file, const std::string& name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto colon = line.find(':');
    if (!line.starts_with(name) || colon == std::string::npos) continue;
    const auto begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return {};
}

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? static_cast<unsigned>(CPU_COUNT(&set)) : 1;
}

std::uint64_t memory_of_machine() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) : 0;
}

/// Empty if it cannot be read.
std::string first_word_of(const std::filesystem::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

/// The entries of a folder whose names begin and end like this: thermal_zone0, thermal_zone1, ...
std::vector<std::filesystem::path> entries_named(const std::filesystem::path& folder, const std::string& begin,
                                                 const std::string& end = "") {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && name.ends_with(end)) found.push_back(entry.path());
  }
  return found;
}

/// The words for the sensor of a whole processor: Intel's and AMD's.
bool is_processor(const std::string& label) {
  return label == "Package" || label == "Tctl" || label == "Tdie";
}

std::string dotted(long major, long minor, long patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::map<std::string, std::string> library_versions() {
  std::map<std::string, std::string> versions = {
      {"boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"nlohmann_json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
  };
  for (const baselines::Mesher& m : baselines::meshers()) {
    if (m.name == "tetgen") versions["tetgen"] = m.version;
    if (m.name.starts_with("cgal")) versions["cgal"] = m.version;
  }
  return versions;
}

/// Computes the SHA-256 digest of bytes.
class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }

  void add(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }

  std::string digits() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
    sha256_digest(&context_, digest.size(), digest.data());
    constexpr std::string_view hex = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
      text += hex[byte >> 4];
      text += hex[byte & 15];
    }
    return text;
  }

 private:
  sha256_ctx context_;
};

}  // namespace

Environment capture_environment() {
  Environment environment;
  environment.cpu = value_in_file("/proc/cpuinfo", "model name");
  environment.cores = usable_cores();
  environment.memory_bytes = memory_of_machine();
  environment.governor = first_word_of("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  environment.temperature_celsius = hottest_celsius("/sys/class");
  double load[1] = {0};
  if (getloadavg(load, 1) == 1) environment.load_average = load[0];
  utsname system{};
  if (uname(&system) == 0)
    environment.system = std::string(system.sysname) + " " + system.release + " " + system.machine;
  environment.compiler = CCDT_COMPILER;
  environment.flags = CCDT_FLAGS;
  environment.build_type = CCDT_BUILD_TYPE;
  environment.revision = source_revision;
  environment.libraries = library_versions();
  return environment;
}

std::optional<double> hottest_celsius(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> sensors;
  for (const auto& zone : entries_named(folder / "thermal", "thermal_zone")) sensors.push_back(zone / "temp");
  for (const auto& chip : entries_named(folder / "hwmon", "hwmon"))
    for (const auto& label : entries_named(chip, "temp", "_label")) {
      const std::string name = label.filename().string();
      if (is_processor(first_word_of(label))) sensors.push_back(chip / (name.substr(0, name.find('_')) + "_input"));
    }
  std::optional<double> hottest;
  for (const auto& sensor : sensors) {
    double thousandths = 0;
    if (std::ifstream(sensor) >> thousandths)
      hottest = std::max(hottest.value_or(thousandths / 1000), thousandths / 1000);
  }
  return hottest;
}

void to_json(Json& json, const Environment& environment) {
  write_fields(environment, fields_of_environment, json);
}

void from_json(const Json& json, Environment& environment) {
  read_fields(json, fields_of_environment, environment);
}

std::vector<std::string> command_line() {
  std::vector<std::string> words;
  std::ifstream file("/proc/self/cmdline");
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  if (!words.empty()) words[0] = std::filesystem::path(words[0]).filename().string();
  return words;
}

std::uint64_t peak_rss_bytes() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  const std::uint64_t own = std::strtoull(value_in_file("/proc/self/status", "VmHWM").c_str(), nullptr, 10);
  return 1024 * std::max(own, static_cast<std::uint64_t>(children.ru_maxrss));
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};  // opening a pipe would wait for its other end
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  Sha256 hash;
  std::array<char, 65536> block;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0)
    hash.add({block.data(), static_cast<std::size_t>(stream.gcount())});
  return stream.bad() ? "" : hash.digits();
}

std::string sha256_of_text(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.digits();
}

}  // namespace ccdt::bench
