#include "engine/io/output_folder.h"

#include <new>
#include <system_error>
#include <utility>

#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::io {
namespace {

[[noreturn]] void fail_to_make(const std::filesystem::path& target, const std::error_code& error) {
  throw OutputError("cannot be written: " + error.message(), place_in(target.string()),
                    "check that the folder it is in exists and is writable, and that the disk has space");
}

}  // namespace

void remove_if_possible(const std::filesystem::path& path) noexcept {
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  } catch (const std::bad_alloc&) {
    // The files stay. What was to be reported is on its way already.
  }
}

OutputFolder::OutputFolder(std::filesystem::path target)
    : target_(std::move(target)), temporary_(temporary_beside(target_)) {
  unfinished_.emplace_back(temporary_);
  std::error_code error;
  std::filesystem::create_directory(temporary_, error);
  if (error) fail_to_make(target_, error);
}

OutputFolder::~OutputFolder() {
  remove_if_possible(temporary_);
}

std::filesystem::path OutputFolder::file(const char* name) {
  unfinished_.emplace_back(temporary_ / name);
  return temporary_ / name;
}

void OutputFolder::commit() {
  // A folder that has files cannot be replaced in one step.
  const std::filesystem::path old = temporary_beside(target_);
  const bool replaces = is_there(target_);
  if (replaces) rename(target_, old);
  try {
    rename(temporary_, target_);
  } catch (const OutputError&) {
    if (replaces) rename(old, target_);
    throw;
  }
  remove_if_possible(old);
}

void OutputFolder::rename(const std::filesystem::path& from, const std::filesystem::path& to) const {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) fail_to_make(target_, error);
}

}  // namespace ccdt::io
