#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "engine/io/unfinished_files.h"

namespace ccdt::tools {

/// A whole file that is of no use unless what comes after it succeeds, too. Unless `keep` is called, the object removes
/// it; so does a signal.
class PartOfResult {
 public:
  /// \param file  exists; an empty name stands for no file
  explicit PartOfResult(const std::string& file) : file_(file) {
    if (!file.empty()) unfinished_.emplace(file_);
  }
  ~PartOfResult() {
    std::error_code ignored;
    if (unfinished_) std::filesystem::remove(file_, ignored);
  }
  PartOfResult(const PartOfResult&) = delete;
  PartOfResult& operator=(const PartOfResult&) = delete;

  void keep() { unfinished_.reset(); }

 private:
  std::filesystem::path file_;
  std::optional<io::UnfinishedFile> unfinished_;
};

}  // namespace ccdt::tools
