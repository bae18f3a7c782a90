#include "baselines/isolated_call.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <sstream>
#include <system_error>

namespace ccdt {
namespace {

constexpr std::size_t most_printed = 1000;

/// Follows the value: an exit code would not tell that the work has returned, since it may call exit itself.
constexpr char end_mark = '.';

/// A file in memory that the work writes and the caller reads.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("isolated-call", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "cannot make a file in memory");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  bool write(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno != EINTR) return false;
      done += static_cast<std::size_t>(std::max<ssize_t>(0, written));
    }
    return true;
  }

  std::string read(std::size_t most) const {
    const off_t size = std::max<off_t>(0, lseek(descriptor_, 0, SEEK_END));
    std::string bytes(std::min(most, static_cast<std::size_t>(size)), '\0');
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t got = pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (got <= 0 && errno != EINTR)
        throw std::system_error(errno, std::generic_category(), "cannot read a file in memory");
      done += static_cast<std::size_t>(std::max<ssize_t>(0, got));
    }
    return bytes;
  }

 private:
  int descriptor_;
};

/// The rest of the fork's life. It leaves without destructors and exit handlers: those belong to the original.
[[noreturn]] void work_and_leave(const std::function<std::string()>& work, const MemoryFile& value,
                                 const MemoryFile& printed) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(printed.descriptor(), STDOUT_FILENO);
  dup2(printed.descriptor(), STDERR_FILENO);
  std::setvbuf(stdout, nullptr, _IONBF, 0);  // a crash must not lose the explanation
  const bool whole = value.write(work() + end_mark);
  _exit(whole ? 0 : 1);
}

std::string in_one_line(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos) all += (all.empty() ? "" : "; ") + line.substr(begin);
  }
  return all;
}

}  // namespace

IsolatedCall call_isolated(const std::function<std::string()>& work) {
  const MemoryFile value, printed;
  std::fflush(nullptr);  // or the fork would print what is still in the buffers once more
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a child process");
  if (child == 0) work_and_leave(work, value, printed);

  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  IsolatedCall call;
  if (WIFSIGNALED(status)) {
    call.signal = WTERMSIG(status);
  } else if (WEXITSTATUS(status) == 0) {
    call.value = value.read(static_cast<std::size_t>(-1));
    call.returned = !call.value.empty();
    if (call.returned) call.value.pop_back();
  }
  call.printed = in_one_line(printed.read(most_printed));
  return call;
}

}  // namespace ccdt
