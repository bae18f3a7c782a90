#include "bench/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace ccdt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int watch_milliseconds = 10;
constexpr int cannot_execute = 127;  ///< as shells have it
constexpr std::size_t longest_reason = 4000;

constexpr std::array<std::string_view, 5> status_names = {"ok", "failed", "timeout", "out_of_memory", "crashed"};

/// A file descriptor that is closed at the end of its scope.
struct Descriptor {
  int value = -1;
  explicit Descriptor(int v) : value(v) {
    if (v < 0) throw std::system_error(errno, std::generic_category(), "cannot start a child process");
  }
  ~Descriptor() { close(value); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

/// The life of the child between fork and exec: only async-signal-safe calls.
[[noreturn]] void become(char* const* arguments, const char* folder, int null, int errors, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever interrupts the benchmark does not want orphans
  if (getppid() != parent) _exit(cannot_execute);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(null, STDIN_FILENO);
  dup2(null, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  if (*folder == '\0' || chdir(folder) == 0) execv(arguments[0], arguments);
  constexpr std::string_view message = "the program cannot be started";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
  _exit(cannot_execute);
}

std::uint64_t resident_bytes(pid_t child) {
  std::ifstream statm("/proc/" + std::to_string(child) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return statm ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

std::string last_words(int errors) {
  const off_t size = lseek(errors, 0, SEEK_END);
  const off_t begin = std::max<off_t>(0, size - static_cast<off_t>(longest_reason));
  std::string text(static_cast<std::size_t>(std::max<off_t>(0, size - begin)), '\0');
  const ssize_t got = pread(errors, text.data(), text.size(), begin);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

/// Waits for the end of the child or for a limit; tells which limit it was, or `ok`.
RunStatus watch(pid_t child, int child_descriptor, const Limits& limits, Clock::time_point begin) {
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (;;) {
    pollfd ended{child_descriptor, POLLIN, 0};
    int wait = limits.memory_bytes > 0 ? watch_milliseconds : -1;
    if (limits.seconds > 0) {
      const int left = static_cast<int>(std::clamp((limits.seconds - elapsed()) * 1000 + 1, 0.0, 1e6));
      wait = wait < 0 ? left : std::min(wait, left);
    }
    if (poll(&ended, 1, wait) > 0) return RunStatus::ok;
    if (limits.seconds > 0 && elapsed() >= limits.seconds) return RunStatus::timeout;
    if (limits.memory_bytes > 0 && resident_bytes(child) > limits.memory_bytes) return RunStatus::out_of_memory;
  }
}

void explain(int wait_status, const std::string& words, ChildResult& result) {
  if (WIFSIGNALED(wait_status)) {
    result.signal = WTERMSIG(wait_status);
    result.status = RunStatus::crashed;
    const char* name = sigabbrev_np(result.signal);
    result.reason =
        "ended by signal SIG" + std::string(name == nullptr ? "?" : name) + " (" + sigdescr_np(result.signal) + ")";
    if (result.signal == SIGKILL) result.reason += "; the kernel does this when the machine's memory runs out";
    if (!words.empty()) result.reason += ": " + words;
    return;
  }
  result.exit_code = WEXITSTATUS(wait_status);
  if (result.exit_code == 0) return;
  result.status = RunStatus::failed;
  result.reason = words.empty() ? "exit code " + std::to_string(result.exit_code) : words;
}

}  // namespace

std::string_view name_of(RunStatus status) {
  return status_names.at(static_cast<std::size_t>(status));
}

RunStatus run_status(std::string_view name) {
  const auto found = std::ranges::find(status_names, name);
  if (found == status_names.end()) throw std::invalid_argument("no run has the status '" + std::string(name) + "'");
  return static_cast<RunStatus>(found - status_names.begin());
}

ChildResult run_child(const std::vector<std::string>& command, const Limits& limits,
                      const std::filesystem::path& folder) {
  std::vector<std::string> copies = command;
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& argument : copies) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  const Descriptor null(open("/dev/null", O_RDWR | O_CLOEXEC));
  const Descriptor errors(memfd_create("child-errors", MFD_CLOEXEC));

  const pid_t parent = getpid();
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a child process");
  if (child == 0) become(arguments.data(), folder.c_str(), null.value, errors.value, parent);
  setpgid(child, child);  // here as well, lest a kill of the group comes before the child has made it

  const Descriptor child_descriptor(static_cast<int>(syscall(SYS_pidfd_open, child, 0)));
  const RunStatus limit = watch(child, child_descriptor.value, limits, begin);
  if (limit != RunStatus::ok) kill(-child, SIGKILL);
  int wait_status = 0;
  while (waitpid(child, &wait_status, 0) < 0 && errno == EINTR) {
  }

  ChildResult result;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (limit == RunStatus::ok) {
    explain(wait_status, last_words(errors.value), result);
  } else {
    result.status = limit;
    result.signal = SIGKILL;
    result.reason = limit == RunStatus::timeout
                        ? "stopped at the limit of " + seconds_text(limits.seconds)
                        : "stopped at the limit of " + std::to_string(limits.memory_bytes >> 20) + " MiB of memory";
  }
  return result;
}

}  // namespace ccdt
