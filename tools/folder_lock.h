#pragma once

#include <filesystem>

namespace ccdt::tools {

/// Locks a folder against other processes while the object exists. The system unlocks it if the process is killed.
/// Within one process, a second lock of the same folder is not refused, and closing the file "lock" anywhere else
/// unlocks the folder.
class FolderLock {
 public:
  /// \throw InputError   another process is working in the folder; names it
  /// \throw OutputError  the folder cannot be written to
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace ccdt::tools
