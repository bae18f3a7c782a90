#pragma once

#include <deque>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "bench/run/run_record.h"

namespace ccdt::tools {

/// The report that a run leaves if a signal ends it: what is known of it, and the stage that it was in. One at a time;
/// it belongs to the process that made it.
class LastRecord {
 public:
  /// \param file  of the report: empty: none; `-`: standard output
  explicit LastRecord(const std::string& file);
  ~LastRecord();
  LastRecord(const LastRecord&) = delete;
  LastRecord& operator=(const LastRecord&) = delete;

  /// From now on, this is known of the run.
  void set(const bench::RunRecord& record);
  /// From now on, a signal leaves no report: the run writes its own.
  static void disarm();
  /// The run is now in this stage.
  void enter(std::string_view stage);

 private:
  std::string file_, temporary_;
  std::deque<std::string> texts_;  // a signal may come while it is changed, so no text goes before the end
  std::set<std::string, std::less<>> stages_;
  std::string_view stage_;
};

/// Writes that report, if there is one. A signal handler may call this.
void leave_last_record();

}  // namespace ccdt::tools
