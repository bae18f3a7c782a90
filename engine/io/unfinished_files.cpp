#include "engine/io/unfinished_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

namespace ccdt::io {

// A signal handler must not allocate, lock or wait. So the names are in fixed places, and an entry is valid as soon as
// it has an owner.
struct Entry {
  std::atomic<bool> is_taken = false;
  std::atomic<pid_t> owner = 0;  ///< 0: the name is not there yet, or is gone
  std::array<char, 4096> name{};
};

namespace {

static_assert(std::atomic<pid_t>::is_always_lock_free);

std::array<Entry, 64> entries;

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& file) {
  const std::string name = std::filesystem::absolute(file).string();  // the process may change its folder
  if (name.size() >= Entry().name.size()) return;
  const auto free = std::ranges::find_if(entries, [](Entry& entry) { return !entry.is_taken.exchange(true); });
  if (free == entries.end()) return;
  entry_ = &*free;
  std::ranges::copy(name, entry_->name.begin());
  entry_->name[name.size()] = '\0';
  entry_->owner = getpid();
}

UnfinishedFile::~UnfinishedFile() {
  if (entry_ == nullptr) return;
  entry_->owner = 0;
  entry_->is_taken = false;
}

void remove_unfinished_files() {
  for (const Entry& entry : entries)
    if (entry.owner == getpid()) unlink(entry.name.data());
  for (const Entry& entry : entries)
    if (entry.owner == getpid()) rmdir(entry.name.data());  // a folder, which is empty now
}

}  // namespace ccdt::io
