#pragma once

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/stages.h"
#include "engine/base/stopwatch.h"

namespace ccdt {

/// Adds what happens during the life of the scope to the cost of a stage.
class StageScope {
 public:
  explicit StageScope(StageCost& cost)
      : watch_(cost.seconds), cpu_watch_(cost.cpu_seconds), threads_(cost.threads), work_(cost.work) {}

 private:
  Stopwatch watch_;
  CpuStopwatch cpu_watch_;
  ThreadScope threads_;
  WorkScope work_;
};

}  // namespace ccdt
