#include "tools/stop_signals.h"

#include <array>
#include <csignal>

#include "baselines/stop.h"

namespace ccdt::tools {
namespace {

constexpr std::array handled = {SIGINT, SIGTERM, SIGHUP};
constexpr int signal_base = 128;

volatile std::sig_atomic_t received = SIGTERM;

extern "C" void on_stop(int signal) {
  received = signal;
  baselines::request_stop();
}

void handle_by(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  for (const int signal : handled) sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignals::StopSignals() {
  handle_by(on_stop);
}

StopSignals::~StopSignals() {
  handle_by(SIG_DFL);
}

int stopped_exit_code() {
  return signal_base + received;
}

}  // namespace ccdt::tools
