#include "baselines/process_tree.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace ccdt::baselines {
namespace {

std::string folder_of(pid_t process) {
  return "/proc/" + std::to_string(process);
}

/// The beginning of a file in /proc; empty if it cannot be read. It is read in one call, since this happens a hundred
/// times a second.
class KernelText {
 public:
  explicit KernelText(const std::string& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    const ssize_t size = read(descriptor, bytes_.data(), bytes_.size());
    close(descriptor);
    end_ = bytes_.data() + std::max<ssize_t>(0, size);
  }

  /// The next number in the text; none at the end.
  std::optional<std::uint64_t> next_number() {
    while (at_ != end_ && (*at_ < '0' || *at_ > '9')) ++at_;
    std::uint64_t number = 0;
    const auto [after, error] = std::from_chars(at_, end_, number);
    if (error != std::errc()) return std::nullopt;
    at_ = after;
    return number;
  }

  void skip_past(std::string_view word) {
    const auto found = std::search(at_, end_, word.begin(), word.end());
    at_ = found == end_ ? end_ : found + word.size();
  }

 private:
  std::array<char, 4096> bytes_;
  const char* at_ = bytes_.data();
  const char* end_ = bytes_.data();
};

/// Resident memory; counts a shared page in each process.
std::uint64_t resident_bytes(pid_t process) {
  KernelText statm(folder_of(process) + "/statm");
  statm.next_number();  // the size of its address space
  return statm.next_number().value_or(0) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Resident memory; counts a page that n processes share as 1/n. This takes the kernel milliseconds per GB.
std::uint64_t proportional_bytes(pid_t process) {
  KernelText rollup(folder_of(process) + "/smaps_rollup");
  rollup.skip_past("\nPss:");
  const auto kilobytes = rollup.next_number();
  return kilobytes ? *kilobytes << 10 : resident_bytes(process);
}

/// The names in a folder of /proc that are numbers.
std::vector<std::string> numbers_in(const std::string& folder) {
  std::vector<std::string> names;
  DIR* const entries = opendir(folder.c_str());
  if (entries == nullptr) return names;  // a process may end at any time
  for (const dirent* entry = readdir(entries); entry != nullptr; entry = readdir(entries))
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  closedir(entries);
  return names;
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
    const std::string threads = folder_of(parents.back()) + "/task/";
    parents.pop_back();
    for (const std::string& thread : numbers_in(threads)) {
      KernelText children(threads + thread + "/children");
      while (const auto child = children.next_number()) {
        all.push_back(static_cast<pid_t>(*child));
        parents.push_back(all.back());
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
  constexpr std::uint64_t block_bytes = 512;  // block size of stat, on every file system
  std::uint64_t bytes = 0;
  std::error_code error;  // files may disappear at any time
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    struct stat status {};
    if (lstat(entry->path().c_str(), &status) == 0) bytes += static_cast<std::uint64_t>(status.st_blocks) * block_bytes;
  }
  return bytes;
}

}  // namespace ccdt::baselines
