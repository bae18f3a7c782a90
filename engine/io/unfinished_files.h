#pragma once

#include <filesystem>

namespace ccdt::io {

/// The name of a file that must not stay if this process is ended. While the object lives, `remove_unfinished_files`
/// finds the name. (One name of more than 4,095 bytes, or more than 64 at a time, it does not find.)
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

 private:
  struct Entry* entry_ = nullptr;
};

/// Removes all unfinished files of this process. Not those of the process of which it is a fork. May be called from a
/// signal handler.
void remove_unfinished_files();

}  // namespace ccdt::io
