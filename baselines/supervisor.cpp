#include "baselines/supervisor.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>

namespace ccdt::baselines {
namespace {

/// Kills the children of this process, which has one thread.
void kill_children() {
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  std::array<char, 4096> text;  // further children are found next time
  const ssize_t size = read(file, text.data(), text.size());
  close(file);
  pid_t child = 0;
  for (ssize_t i = 0; i < size; ++i) {
    const char c = text[static_cast<std::size_t>(i)];
    if (c >= '0' && c <= '9') {
      child = 10 * child + (c - '0');
    } else if (child > 0) {  // a number cut off by the end of the buffer is not followed by a blank
      kill(child, SIGKILL);
      child = 0;
    }
  }
}

}  // namespace

Supervisor::Supervisor(pid_t parent) : self_(getpid()) {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGTERM);
  sigaddset(&watched_, SIGCHLD);
  sigprocmask(SIG_BLOCK, &watched_, &usual_);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
}

void Supervisor::release_child() const {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != self_) _exit(1);
  sigprocmask(SIG_SETMASK, &usual_, nullptr);
}

void Supervisor::watch(pid_t program, int report) const {
  // Locks and pipes of the parent must not stay open here.
  if (report > 3) close_range(3, static_cast<unsigned>(report) - 1, 0);
  close_range(static_cast<unsigned>(report) + 1, ~0U, 0);
  int status = 0;
  bool has_ended = false;
  const auto reap = [&](int flags) {
    int some_status = 0;
    const pid_t ended = waitpid(-1, &some_status, flags);
    if (ended != program) return ended;
    status = some_status;
    has_ended = true;
    return ended;
  };
  int why = SIGCHLD;
  while (why != SIGTERM && !has_ended) {
    why = sigwaitinfo(&watched_, nullptr);
    while (why == SIGCHLD && reap(WNOHANG) > 0) {
    }
  }
  pid_t last = 0;
  do {
    if (!has_ended) kill(program, SIGKILL);
    kill_children();
    last = reap(0);  // orphans of its children become children of this process
  } while (last > 0 || errno == EINTR);
  if (why == SIGTERM) {  // keeps the status that it ended with, not that of the signal just sent
    signal(SIGTERM, SIG_DFL);
    sigprocmask(SIG_SETMASK, &usual_, nullptr);
    raise(SIGTERM);
  }
  _exit(has_ended && pwrite(report, &status, sizeof status, 0) == sizeof status ? 0 : 1);
}

}  // namespace ccdt::baselines
