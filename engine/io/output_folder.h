#pragma once

#include <deque>
#include <filesystem>

#include "engine/io/unfinished_files.h"

namespace ccdt::io {

/// Removes a file, or a folder with all in it. It stays if the system forbids it, or if there is no memory left. For
/// destructors, which must not throw: `std::filesystem::remove_all` does, even if it returns an error code.
void remove_if_possible(const std::filesystem::path& path) noexcept;

/// A folder of files that appears completely or not at all, like `OutputFile`: it is filled under a temporary name
/// beside the target, and `commit` renames it.
class OutputFolder {
 public:
  /// \throw OutputError  the folder beside the target cannot be written to
  explicit OutputFolder(std::filesystem::path target);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file of this name.
  std::filesystem::path file(const char* name);
  /// Puts the folder in the place of the target, which is removed. \throw OutputError
  void commit();

 private:
  void rename(const std::filesystem::path& from, const std::filesystem::path& to) const;

  std::filesystem::path target_, temporary_;
  std::deque<UnfinishedFile> unfinished_;
};

}  // namespace ccdt::io
