#include "baselines/stop.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <exception>

#include "engine/io/unfinished_files.h"

namespace ccdt::baselines {
namespace {

constexpr std::array handled = {SIGINT, SIGTERM, SIGHUP};
constexpr int signal_base = 128;

std::atomic<bool> is_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a signal handler must not use it

volatile std::sig_atomic_t received = 0;

void (*last_act)() = nullptr;

extern "C" void on_stop(int signal) {
  received = signal;
  request_stop();
}

extern "C" void on_end(int signal) {
  io::remove_unfinished_files();
  if (last_act != nullptr) last_act();
  _exit(signal_base + signal);
}

/// \return  the previous action for each signal
std::array<struct sigaction, handled.size()> handle_by(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  std::array<struct sigaction, handled.size()> before{};
  for (std::size_t i = 0; i < handled.size(); ++i) {
    sigaction(handled[i], nullptr, &before[i]);
    const bool stays = handled[i] == SIGHUP && before[i].sa_handler == SIG_IGN;
    if (!stays) sigaction(handled[i], &action, nullptr);
  }
  return before;
}

}  // namespace

void request_stop() {
  is_requested = true;
}

bool stop_requested() {
  return is_requested;
}

void clean_up_on_signals(void (*last)()) {
  last_act = last;
  handle_by(on_end);
  std::signal(SIGXFSZ, SIG_IGN);  // writing more than the system allows is then an error
}

StopSignals::StopSignals() : before_(handle_by(on_stop)) {}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < handled.size(); ++i) sigaction(handled[i], &before_[i], nullptr);
  const bool is_outermost = before_[0].sa_handler != on_stop;
  if (!is_outermost || received == 0 || std::uncaught_exceptions() > 0) return;
  std::fflush(nullptr);
  raise(received);  // it came too late to stop anything here
}

int stopped_exit_code() {
  return signal_base + (received == 0 ? SIGTERM : received);
}

}  // namespace ccdt::baselines
