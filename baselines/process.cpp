#include "baselines/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>

namespace ccdt::baselines {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int watch_milliseconds = 10;
constexpr int cannot_execute = 127;  ///< as shells have it
constexpr std::size_t most_captured = 4000;

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A file descriptor that is closed at the end of its scope.
struct Descriptor {
  int value = -1;
  Descriptor(int v, const std::string& what) : value(v) {
    if (v < 0) fail(what);
  }
  ~Descriptor() { close(value); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

/// A file in memory, which the child writes and this process reads.
Descriptor memory_file() {
  return {memfd_create("child", MFD_CLOEXEC), "cannot make a file in memory"};
}

Descriptor open_file(const char* name, int flags) {
  return {open(name, flags | O_CLOEXEC, 0600), std::string("cannot open ") + name};
}

/// The last bytes of a file.
std::string read_end(const Descriptor& file, std::size_t most) {
  const auto size = static_cast<std::size_t>(std::max<off_t>(0, lseek(file.value, 0, SEEK_END)));
  std::string bytes(std::min(most, size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const auto at = static_cast<off_t>(size - bytes.size() + done);
    const ssize_t got = pread(file.value, bytes.data() + done, bytes.size() - done, at);
    if (got <= 0 && errno != EINTR) fail("cannot read a file in memory");
    done += static_cast<std::size_t>(std::max<ssize_t>(0, got));
  }
  return bytes;
}

bool write_whole(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, written)));
  }
  return true;
}

/// Strings as a system call takes them: pointers, the last of which is null.
class StringPointers {
 public:
  explicit StringPointers(std::vector<std::string> strings) : strings_(std::move(strings)) {
    for (std::string& string : strings_) pointers_.push_back(string.data());
    pointers_.push_back(nullptr);
  }
  char* const* get() const { return pointers_.data(); }

 private:
  std::vector<std::string> strings_;
  std::vector<char*> pointers_;
};

/// "NAME=value" of this process and of `more`, which overrides; of variables that are there twice, the last counts.
std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& more) {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const auto equals = text.find('=');
    if (equals != std::string::npos) variables[text.substr(0, equals)] = text.substr(equals + 1);
  }
  for (const auto& [name, value] : more) variables[name] = value;
  std::vector<std::string> all;
  for (const auto& [name, value] : variables) all.push_back(std::string(name).append("=").append(value));
  return all;
}

std::uint64_t resident_bytes(pid_t child) {
  std::ifstream statm("/proc/" + std::to_string(child) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return statm ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Waits for the end of the child or for a limit.
/// \return  the limit that was reached, if any
std::optional<FailureKind> watch(pid_t child, const Limits& limits, Clock::time_point begin) {
  const Descriptor child_descriptor(static_cast<int>(syscall(SYS_pidfd_open, child, 0)), "cannot watch a process");
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (;;) {
    pollfd ended{child_descriptor.value, POLLIN, 0};
    int wait = limits.memory_bytes > 0 ? watch_milliseconds : -1;
    if (limits.seconds > 0) {
      const int left = static_cast<int>(std::clamp((limits.seconds - elapsed()) * 1000 + 1, 0.0, 1e6));
      wait = wait < 0 ? left : std::min(wait, left);
    }
    if (poll(&ended, 1, wait) > 0) return std::nullopt;
    if (limits.seconds > 0 && elapsed() >= limits.seconds) return FailureKind::timeout;
    if (limits.memory_bytes > 0 && resident_bytes(child) > limits.memory_bytes) return FailureKind::out_of_memory;
  }
}

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

std::string text_of_limit(FailureKind limit, const Limits& limits) {
  return "stopped at the limit of " + (limit == FailureKind::timeout
                                           ? seconds_text(limits.seconds)
                                           : std::to_string(limits.memory_bytes >> 20) + " MiB of memory");
}

void set_failure(FailureKind kind, ProcessResult& result) {
  result.kind = kind;
  result.status = status_of(kind);
}

void explain_end(int wait_status, ProcessResult& result) {
  if (WIFSIGNALED(wait_status)) {
    result.signal = WTERMSIG(wait_status);
    set_failure(failure_kind_of_signal(result.signal), result);
    const char* name = sigabbrev_np(result.signal);
    result.reason =
        "ended by signal SIG" + std::string(name == nullptr ? "?" : name) + " (" + sigdescr_np(result.signal) + ")";
    if (result.signal == SIGKILL) result.reason += "; the kernel does this when the machine's memory runs out";
    if (!result.printed.empty()) result.reason += ": " + result.printed;
    return;
  }
  result.exit_code = WEXITSTATUS(wait_status);
  if (result.exit_code == 0) return;
  set_failure(failure_kind_of_exit_code(result.exit_code), result);
  result.reason = result.printed.empty() ? "exit code " + std::to_string(result.exit_code) : result.printed;
}

/// Where the output of a child goes.
struct OutputFiles {
  int out = -1, err = -1;
  const Descriptor* captured = nullptr;  ///< the one of these that becomes the result's `printed`; may be null
};

/// Forks this process. In the child, the standard streams are set up before `body` runs, which must end the process;
/// if a program may have several threads, only async-signal-safe calls are allowed there.
template <class Body>
ProcessResult run_child(const OutputFiles& files, const Limits& limits, Body body) {
  const Descriptor null = open_file("/dev/null", O_RDWR);
  const bool has_limits = limits.seconds > 0 || limits.memory_bytes > 0;
  const pid_t parent = getpid();
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child < 0) fail("cannot start a child process");
  if (child == 0) {
    if (has_limits) setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // an interrupted run leaves no orphans
    if (getppid() != parent) _exit(cannot_execute);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(null.value, STDIN_FILENO);
    dup2(files.out < 0 ? null.value : files.out, STDOUT_FILENO);
    dup2(files.err, STDERR_FILENO);
    body();
  }
  if (has_limits) setpgid(child, child);  // here as well: the group may be killed before the child has made it
  const std::optional<FailureKind> limit = has_limits ? watch(child, limits, begin) : std::nullopt;
  if (limit) kill(-child, SIGKILL);
  int wait_status = 0;
  while (waitpid(child, &wait_status, 0) < 0 && errno == EINTR) {
  }

  ProcessResult result;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (files.captured != nullptr) result.printed = read_end(*files.captured, most_captured);
  result.printed.erase(result.printed.find_last_not_of("\n ") + 1);
  if (limit) {
    set_failure(*limit, result);
    result.signal = SIGKILL;
    result.reason = text_of_limit(*limit, limits);
  } else {
    explain_end(wait_status, result);
  }
  return result;
}

}  // namespace

ProcessResult run_program(const std::vector<std::string>& command, const ProgramOptions& options) {
  const StringPointers arguments(command), environment(environment_with(options.environment));
  const char* folder = options.folder.c_str();
  const bool has_log = !options.log.empty();
  const Descriptor file = has_log ? open_file(options.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC) : memory_file();
  const OutputFiles files = {has_log ? file.value : -1, file.value, has_log ? nullptr : &file};
  return run_child(files, options.limits, [&] {
    if (*folder == '\0' || chdir(folder) == 0) execve(arguments.get()[0], arguments.get(), environment.get());
    write_whole(STDERR_FILENO, "the program cannot be started");
    _exit(cannot_execute);
  });
}

ProcessResult run_function(const std::function<std::string()>& function) {
  // It follows the value: an exit code does not say that the function has returned, since it may call exit itself.
  constexpr char end_mark = '.';
  const Descriptor printed = memory_file(), value = memory_file();
  std::fflush(nullptr);  // or the child would print what is still in the buffers once more
  ProcessResult result = run_child({printed.value, printed.value, &printed}, {}, [&] {
    std::setvbuf(stdout, nullptr, _IONBF, 0);  // a crash must not lose the explanation
    const bool is_whole = write_whole(value.value, function() + end_mark);
    _exit(is_whole ? 0 : 1);  // without destructors and exit handlers: those belong to the parent
  });
  if (result.status != RunStatus::ok) return result;
  std::string bytes = read_end(value, static_cast<std::size_t>(-1));
  if (bytes.empty()) return result;
  bytes.pop_back();
  result.value = std::move(bytes);
  return result;
}

}  // namespace ccdt::baselines
