#include "baselines/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
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
#include <thread>

#include "baselines/process_tree.h"
#include "baselines/supervisor.h"

namespace ccdt::baselines {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int watch_milliseconds = 10;
constexpr int rounds_per_look_at_disk = 10;
constexpr double most_seconds = 1e9;
constexpr int cannot_execute = 127;  ///< as in shells
constexpr std::size_t most_captured = 4000;

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
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

/// Strings in the form that system calls take: pointers, ending with null.
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

/// The variables of the options, and TMPDIR.
std::vector<std::pair<std::string, std::string>> variables_of(const ProgramOptions& options) {
  auto variables = options.environment;
  if (!options.scratch.empty()) variables.emplace_back("TMPDIR", options.scratch.string());
  return variables;
}

/// "NAME=value" of this process and of `more`, which overrides it. If a variable occurs twice, the last one counts.
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

/// Why a supervised program must end.
enum class Reached { nothing, seconds, memory, disk, stop };

constexpr FailureKind kind_of(Reached limit) {
  return limit == Reached::seconds  ? FailureKind::timeout
         : limit == Reached::memory ? FailureKind::out_of_memory
                                    : FailureKind::limit;
}

/// The limits of a supervised program, and where its resource use is measured.
struct Watched {
  pid_t supervisor;
  const Limits& limits;
  const std::filesystem::path& scratch;
  int printed;  ///< descriptor of the file that gets its output
};

bool exceeds_disk(const Watched& watched) {
  struct stat printed {};
  const auto size = fstat(watched.printed, &printed) == 0 ? static_cast<std::uint64_t>(printed.st_size) : 0;
  if (size > watched.limits.disk_bytes) return true;
  return !watched.scratch.empty() && size + bytes_in_folder(watched.scratch) > watched.limits.disk_bytes;
}

/// Waits until the program ends, a limit is reached, or this process is asked to stop.
Reached watch(const Watched& watched, Clock::time_point begin) {
  const Limits& limits = watched.limits;
  const Descriptor process(static_cast<int>(syscall(SYS_pidfd_open, watched.supervisor, 0)), "cannot watch a process");
  for (int round = 1;; ++round) {
    const double left = limits.seconds > 0 ? limits.seconds - seconds_since(begin) : most_seconds;
    pollfd ended{process.value, POLLIN, 0};
    const int wait = static_cast<int>(std::clamp(left * 1000 + 1, 0.0, static_cast<double>(watch_milliseconds)));
    if (poll(&ended, 1, wait) > 0) return Reached::nothing;
    if (stop_requested()) return Reached::stop;
    if (left <= 0) return Reached::seconds;
    if (limits.memory_bytes > 0 && tree_exceeds(watched.supervisor, limits.memory_bytes)) return Reached::memory;
    if (limits.disk_bytes > 0 && round % rounds_per_look_at_disk == 0 && exceeds_disk(watched)) return Reached::disk;
  }
}

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

std::string mebibytes_text(std::uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

std::string text_of_limit(Reached limit, const Limits& limits) {
  const std::string text = "stopped at the limit of ";
  if (limit == Reached::seconds) return text + seconds_text(limits.seconds);
  if (limit == Reached::memory) return text + mebibytes_text(limits.memory_bytes) + " of memory";
  return text + mebibytes_text(limits.disk_bytes) + " of disk space";
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
    if (result.signal == SIGKILL) result.reason += "; the kernel does this when the machine runs out of memory";
    if (!result.printed.empty()) result.reason += ": " + result.printed;
    return;
  }
  result.exit_code = WEXITSTATUS(wait_status);
  if (result.exit_code == 0) return;
  set_failure(failure_kind_of_exit_code(result.exit_code), result);
  result.reason = result.printed.empty() ? "exit code " + std::to_string(result.exit_code) : result.printed;
}

/// Where the output of a child process goes.
struct OutputFiles {
  int out = -1, err = -1;
  const Descriptor* captured = nullptr;  ///< becomes `printed` of the result; may be null
};

/// If memory runs out, the kernel should end this process before its parent.
void kill_first_when_out_of_memory() {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  write_whole(file, "500");
  close(file);
}

/// In a fork of this process: sets up the standard streams.
void set_up_child(const OutputFiles& files, const Descriptor& null) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(null.value, STDIN_FILENO);
  dup2(files.out < 0 ? null.value : files.out, STDOUT_FILENO);
  dup2(files.err, STDERR_FILENO);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

ProcessResult result_of(const OutputFiles& files, Clock::time_point begin) {
  ProcessResult result;
  result.seconds = seconds_since(begin);
  if (files.captured != nullptr) result.printed = read_end(*files.captured, most_captured);
  result.printed.erase(result.printed.find_last_not_of("\n ") + 1);
  return result;
}

/// Forks this process and waits for the fork's end. Its standard streams are set up before `body` runs, which must end
/// it; if this process may have several threads, only async-signal-safe calls are allowed there.
template <class Body>
ProcessResult run_child(const OutputFiles& files, Body body) {
  const Descriptor null = open_file("/dev/null", O_RDWR);
  const pid_t parent = getpid();
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child < 0) fail("cannot start a child process");
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // so that an interrupted run leaves no orphans
    if (getppid() != parent) _exit(cannot_execute);
    set_up_child(files, null);
    body();
  }
  const int status = wait_for(child);
  ProcessResult result = result_of(files, begin);
  explain_end(status, result);
  return result;
}

/// Batch systems and shutdowns end both this process and the program, perhaps the program a moment earlier. That it
/// ended then says nothing about the program itself.
bool must_stop_too() {
  constexpr auto a_moment = std::chrono::milliseconds(10);
  if (!stop_requested()) std::this_thread::sleep_for(a_moment);
  return stop_requested();
}

/// Like `run_child`, but in a new process group, with a supervisor and limits. The program ends when this process is
/// asked to stop.
template <class Body>
ProcessResult run_supervised(const OutputFiles& files, const Limits& limits, const std::filesystem::path& scratch,
                             Body body) {
  if (stop_requested()) throw Stopped();
  const Descriptor null = open_file("/dev/null", O_RDWR);
  const Descriptor program_status = memory_file();
  const pid_t parent = getpid();
  const auto begin = Clock::now();
  const pid_t supervisor = fork();
  if (supervisor < 0) fail("cannot start a child process");
  if (supervisor == 0) {
    setpgid(0, 0);  // signals from the terminal to this process must not reach the program
    const Supervisor self(parent);
    // A fork copies the page tables, which takes milliseconds per 100 MB.
    const pid_t child = vfork();  // NOLINT(clang-analyzer-security.insecureAPI.vfork)
    if (child == 0) {
      self.release_child();
      kill_first_when_out_of_memory();
      set_up_child(files, null);
      body();
    }
    if (child < 0) _exit(cannot_execute);
    self.watch(child, program_status.value);
  }
  const Reached reached = watch({supervisor, limits, scratch, files.err}, begin);
  if (reached != Reached::nothing) kill(supervisor, SIGTERM);
  int status = wait_for(supervisor);
  if (reached == Reached::stop) throw Stopped();
  ProcessResult result = result_of(files, begin);
  if (reached == Reached::nothing) {
    int of_program = 0;  // missing if the supervisor was killed
    if (pread(program_status.value, &of_program, sizeof of_program, 0) == sizeof of_program) status = of_program;
    explain_end(status, result);
    if (result.kind && must_stop_too()) throw Stopped();
  } else {
    set_failure(kind_of(reached), result);
    result.signal = SIGKILL;
    result.reason = text_of_limit(reached, limits);
  }
  return result;
}

std::string quoted_for_shell(const std::string& word) {
  const bool is_plain = !word.empty() && word.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789-_./=:,+@%") == std::string::npos;
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

ProcessResult run_program(const std::vector<std::string>& command, const ProgramOptions& options) {
  const StringPointers arguments(command), environment(environment_with(variables_of(options)));
  const char* folder = options.folder.c_str();
  const bool has_log = !options.log.empty();
  const Descriptor file = has_log ? open_file(options.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC) : memory_file();
  const OutputFiles files = {has_log ? file.value : -1, file.value, has_log ? nullptr : &file};
  const auto start = [&] {
    if (*folder == '\0' || chdir(folder) == 0) execve(arguments.get()[0], arguments.get(), environment.get());
    write_whole(STDERR_FILENO, "the program cannot be started");
    _exit(cannot_execute);
  };
  return options.limits ? run_supervised(files, *options.limits, options.scratch, start) : run_child(files, start);
}

ProcessResult run_function(const std::function<std::string()>& function) {
  // Follows the value, because the exit code does not prove that the function returned: it may have called exit.
  constexpr char end_mark = '.';
  const Descriptor printed = memory_file(), value = memory_file();
  std::fflush(nullptr);  // otherwise the child would print the contents of the buffers again
  ProcessResult result = run_child({printed.value, printed.value, &printed}, [&] {
    std::setvbuf(stdout, nullptr, _IONBF, 0);  // a crash must not lose the explanation
    const bool is_whole = write_whole(value.value, function() + end_mark);
    _exit(is_whole ? 0 : 1);  // without destructors and exit handlers, which belong to the parent
  });
  if (result.status != RunStatus::ok) return result;
  std::string bytes = read_end(value, static_cast<std::size_t>(-1));
  if (bytes.empty()) return result;
  bytes.pop_back();
  result.value = std::move(bytes);
  return result;
}

std::string command_line(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) line += (line.empty() ? "" : " ") + quoted_for_shell(word);
  return line;
}

}  // namespace ccdt::baselines
