#include "engine/io/output_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"

namespace ccdt::io {

namespace {

constexpr std::size_t buffer_size = 1 << 18;

std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter = 0;
  std::string name = ".";
  name += target.filename().string() + "." + std::to_string(::getpid()) + "." + std::to_string(counter++) + ".tmp";
  return target.parent_path() / name;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  if (std::filesystem::is_directory(status))
    throw OutputError("is a directory, not a file", place_in(target_.string()), "name a file in this directory");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError("is not a regular file and cannot be replaced", place_in(target_.string()),
                      "name an ordinary file");
  temporary_ = temporary_beside(target_);
  stream_ = std::fopen(temporary_.c_str(), "wbx");
  if (!stream_) fail(errno);
  buffer_.reserve(buffer_size + 64);
}

OutputFile::~OutputFile() {
  if (stream_) std::fclose(stream_);
  std::error_code ignored;
  if (!committed_ && !temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

OutputFile& OutputFile::operator<<(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= buffer_size) flush();
  return *this;
}

void OutputFile::flush() {
  if (!buffer_.empty() && std::fwrite(buffer_.data(), 1, buffer_.size(), stream_) != buffer_.size()) fail(errno);
  buffer_.clear();
}

void OutputFile::close() {
  if (!stream_) return;
  flush();
  std::FILE* stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0) fail(errno);
}

void OutputFile::commit() {
  close();
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail(error.value());
  committed_ = true;
}

void OutputFile::fail(int error) const {
  throw OutputError(std::string("cannot be written: ") + std::strerror(error), place_in(target_.string()),
                    "check that the folder exists, that you may write there and that the disk has room");
}

}  // namespace ccdt::io
