#pragma once

#include <chrono>
#include <ctime>

namespace ccdt {

/// Adds the wall-clock seconds of its lifetime to a number.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

/// Adds the CPU seconds of its lifetime, of all threads of the process, to a number.
class CpuStopwatch {
 public:
  explicit CpuStopwatch(double& seconds) : seconds_(seconds), start_(std::clock()) {}
  ~CpuStopwatch() { seconds_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }
  CpuStopwatch(const CpuStopwatch&) = delete;
  CpuStopwatch& operator=(const CpuStopwatch&) = delete;

 private:
  double& seconds_;
  std::clock_t start_;
};

}  // namespace ccdt
