#include "engine/io/files.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

namespace ccdt::io {

std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter = 0;
  std::string name = ".";
  name += target.filename().string() + "." + std::to_string(::getpid()) + "." + std::to_string(counter++) + ".tmp";
  return target.parent_path() / name;
}

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

bool is_within(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto place = std::filesystem::canonical(file, error);
  if (error) return false;
  const auto of_folder = std::filesystem::canonical(folder, error);
  if (error) return false;
  return std::ranges::mismatch(of_folder, place).in1 == of_folder.end();
}

void check_links_stay_within(const std::filesystem::path& folder) {
  std::filesystem::recursive_directory_iterator entry(folder), end;
  for (; entry != end; ++entry) {
    if (entry.depth() > 0) entry.disable_recursion_pending();
    if (entry->is_symlink() && !is_within(folder, entry->path()))
      throw InputError("a link that leads out of the folder, or to nothing", place_in(entry->path().string()),
                       "remove it: results are only read from this folder and written to it");
  }
}

void check_is_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const Place place = place_in(file.string());
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError("no such file", place, "check the path and the spelling of the name");
  if (error) throw InputError("cannot be opened: " + error.message(), place, "check the path and its permissions");
  if (std::filesystem::is_directory(status))
    throw InputError("this is a folder", place, "give the name of a file in it");
  if (!std::filesystem::is_regular_file(status))
    throw InputError("is not a regular file", place, "write the data to a file and name that file");
}

FileBytes read_whole_file(const std::filesystem::path& file) {
  check_is_file(file);
  FileBytes result{file.string(), {}};
  const Place place = place_in(result.name);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!in)
    throw InputError(std::string("cannot be opened: ") + std::strerror(errno), place, "check the file's permissions");
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError("cannot be read: " + error.message(), place, "check the file's permissions");
  if (size == 0) throw InputError("the file is empty", place, "write the file again; its writer may have failed");
  try {
    result.bytes.resize(size);
  } catch (const std::exception&) {
    throw MemoryError("out of memory: the file has " + std::to_string(size) + " bytes", place,
                      "use a machine with more memory or a coarser model");
  }
  if (const std::size_t got = std::fread(result.bytes.data(), 1, size, in.get()); got != size)
    throw InputError("reading stopped after " + std::to_string(got) + " of " + std::to_string(size) + " bytes", place,
                     "check the disk, and that no other program is writing the file");
  return result;
}

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

char line_end_of(std::string_view text) {
  return text.find('\n') == std::string_view::npos ? '\r' : '\n';
}

Place line_of_byte(const FileBytes& file, std::size_t byte) {
  const auto begin = file.bytes.begin();
  return {.file = file.name,
          .line = 1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(byte), line_end_of(file.bytes))};
}

void fail_at_byte(const FileBytes& file, std::size_t byte, const std::string& what, const std::string& remedy,
                  std::vector<long long> facets) {
  throw InputError(what, {.file = file.name, .byte = static_cast<long long>(byte), .facets = std::move(facets)},
                   remedy);
}

void check_is_no_folder(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw OutputError("this is a folder", place_in(file.string()), "give the name of a file in it");
}

OutputFile::OutputFile(std::filesystem::path target) : target_(std::move(target)) {
  check_is_no_folder(target_);
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError("is not a regular file and cannot be replaced", place_in(target_.string()),
                      "name an ordinary file");
  buffer_.reserve(buffer_size + 64);  // may throw, so there must be no file yet
  temporary_ = temporary_beside(target_);
  unfinished_.emplace(temporary_);
  stream_ = std::fopen(temporary_.c_str(), "wbx");
  if (!stream_) fail(errno);
}

OutputFile::~OutputFile() {
  if (stream_) std::fclose(stream_);
  std::error_code ignored;
  if (!committed_ && !temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::flush() {
  const std::string& bytes = buffer_.bytes();
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) fail(errno);
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
                    "check that the folder exists and is writable, and that the disk has space");
}

}  // namespace ccdt::io
