#pragma once

#include <filesystem>

namespace ccdt::tools {

/// While it lives, no other process can lock the folder. The system unlocks it if the process is killed.
class FolderLock {
 public:
  /// \throw InputError   another process works in the folder; says which
  /// \throw OutputError  the folder cannot be written to
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace ccdt::tools
