#include "baselines/process_tree.h"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <system_error>

namespace ccdt::baselines {
namespace {

std::string folder_of(pid_t process) {
  return "/proc/" + std::to_string(process);
}

/// Resident memory, a shared page in each process that has it.
std::uint64_t resident_bytes(pid_t process) {
  std::ifstream statm(folder_of(process) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return statm ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Resident memory, of a page that n processes share the nth part. This takes the kernel milliseconds per GB.
std::uint64_t proportional_bytes(pid_t process) {
  std::ifstream rollup(folder_of(process) + "/smaps_rollup");
  for (std::string name; rollup >> name;) {
    std::uint64_t kilobytes = 0;
    if (name == "Pss:" && rollup >> kilobytes) return kilobytes << 10;
  }
  return resident_bytes(process);
}

template <class BytesOf>
std::uint64_t sum_of(const std::vector<pid_t>& processes, BytesOf bytes_of) {
  std::uint64_t sum = 0;
  for (const pid_t process : processes) sum += bytes_of(process);
  return sum;
}

}  // namespace

std::vector<pid_t> descendants_of(pid_t process) {
  std::vector<pid_t> all;
  std::vector<pid_t> parents = {process};
  while (!parents.empty()) {
    const std::filesystem::path threads = folder_of(parents.back()) + "/task";
    parents.pop_back();
    std::error_code error;  // a process may end at any time
    for (std::filesystem::directory_iterator thread(threads, error), end; !error && thread != end;
         thread.increment(error)) {
      std::ifstream children(thread->path() / "children");
      for (pid_t child = 0; children >> child;) {
        all.push_back(child);
        parents.push_back(child);
      }
    }
  }
  return all;
}

bool tree_exceeds(pid_t process, std::uint64_t bytes) {
  const std::vector<pid_t> processes = descendants_of(process);
  return sum_of(processes, resident_bytes) > bytes && sum_of(processes, proportional_bytes) > bytes;
}

std::uint64_t bytes_in_folder(const std::filesystem::path& folder) {
  constexpr std::uint64_t block_bytes = 512;  // of stat, on every file system
  std::uint64_t bytes = 0;
  std::error_code error;  // files may go at any time
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    struct stat status {};
    if (lstat(entry->path().c_str(), &status) == 0) bytes += static_cast<std::uint64_t>(status.st_blocks) * block_bytes;
  }
  return bytes;
}

}  // namespace ccdt::baselines
