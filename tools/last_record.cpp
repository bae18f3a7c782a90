#include "tools/last_record.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>

#include "engine/io/files.h"
#include "tools/streams.h"

namespace ccdt::tools {
namespace {

constexpr const char* place_of_stage = "<name of the stage>";

// What the signal handler reads. It must not allocate or lock.
std::atomic<const char*> before = nullptr, after = nullptr, stage_now = nullptr, file_now = nullptr,
                         temporary_now = nullptr;
std::atomic<pid_t> owner = 0;
static_assert(std::atomic<const char*>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

bool write_all(int descriptor, const char* text) {
  for (std::size_t left = std::strlen(text); left > 0;) {
    const ssize_t written = write(descriptor, text, left);
    if (written <= 0) return false;
    text += written;
    left -= static_cast<std::size_t>(written);
  }
  return true;
}

bool write_record(int descriptor) {
  return write_all(descriptor, before) && write_all(descriptor, stage_now) && write_all(descriptor, after);
}

}  // namespace

LastRecord::LastRecord(const std::string& file) : file_(file) {
  if (file.empty()) return;
  // The process may change its folder.
  const auto whole = std::filesystem::absolute(file);
  if (!is_stream(file)) file_ = whole.string(), temporary_ = io::temporary_beside(whole).string();
  enter("read");
  file_now = file_.c_str();
  temporary_now = temporary_.c_str();
}

LastRecord::~LastRecord() {
  disarm();
}

void LastRecord::disarm() {
  owner = 0;
}

void LastRecord::set(const bench::RunRecord& record) {
  if (file_.empty()) return;
  bench::RunRecord ended = record;
  ended.set_failure(baselines::FailureKind::interrupted, "a signal ended it");
  ended.stage = place_of_stage;
  const std::string text = bench::to_json(ended);
  const std::size_t place = text.rfind(place_of_stage);
  owner = 0;
  before = texts_.emplace_back(text.substr(0, place)).c_str();
  after = texts_.emplace_back(text.substr(place + std::strlen(place_of_stage))).c_str();
  owner = getpid();
}

void LastRecord::enter(std::string_view stage) {
  if (file_.empty() || stage == stage_) return;
  stage_ = *stages_.emplace(stage).first;
  stage_now = stage_.data();
}

void leave_last_record() {
  if (owner != getpid()) return;
  if (std::strlen(temporary_now) == 0) {
    write_record(STDOUT_FILENO);
    return;
  }
  const int descriptor = open(temporary_now, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return;
  const bool is_whole = write_record(descriptor) && close(descriptor) == 0;
  if (!is_whole || rename(temporary_now, file_now) != 0) unlink(temporary_now);
}

}  // namespace ccdt::tools
