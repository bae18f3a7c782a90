#pragma once

#include <filesystem>

namespace ccdt::io {

/// The name of a file that must not remain if this process is killed, or of a folder of such files. While the object
/// lives, `remove_unfinished_files` finds the name. (It misses names longer than 4,095 bytes, and all but 64 names at a
/// time.)
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

 private:
  struct Entry* entry_ = nullptr;
};

/// Removes all unfinished files of this process, but not those of the process that it was forked from. May be called
/// from a signal handler.
void remove_unfinished_files();

}  // namespace ccdt::io
