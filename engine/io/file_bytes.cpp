#include "engine/io/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>

#include "engine/base/errors.h"

namespace ccdt::io {

namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

}  // namespace

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

void check_is_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const Place place = place_in(file.string());
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError("no such file", place, "check the path and the spelling of the name");
  if (error) throw InputError("cannot be opened: " + error.message(), place, "check the path and its permissions");
  if (std::filesystem::is_directory(status))
    throw InputError("is a directory, not a file", place, "name a file in this directory");
  if (!std::filesystem::is_regular_file(status))
    throw InputError("is not a regular file", place, "write the data to a file and name that file");
}

FileBytes read_whole_file(const std::filesystem::path& file) {
  check_is_file(file);
  FileBytes result{file.string(), {}};
  const Place place = place_in(result.name);
  const std::unique_ptr<std::FILE, CloseFile> in(std::fopen(file.c_str(), "rb"));
  if (!in)
    throw InputError(std::string("cannot be opened: ") + std::strerror(errno), place, "check the file's permissions");
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError("cannot be read: " + error.message(), place, "check the file's permissions");
  if (size == 0) throw InputError("the file is empty", place, "write the file again; its writer may have failed");
  try {
    result.bytes.resize(size);
  } catch (const std::exception&) {
    throw LimitError("a file of " + std::to_string(size) + " bytes does not fit into memory", place,
                     "use a machine with more memory or a coarser model");
  }
  if (const std::size_t got = std::fread(result.bytes.data(), 1, size, in.get()); got != size)
    throw InputError("reading stopped after " + std::to_string(got) + " of " + std::to_string(size) + " bytes", place,
                     "check the disk, and that nobody is writing the file");
  return result;
}

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

Place line_of_byte(const FileBytes& file, std::size_t byte) {
  const auto begin = file.bytes.begin();
  return {.file = file.name, .line = 1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(byte), '\n')};
}

void fail_at_byte(const FileBytes& file, std::size_t byte, const std::string& what, const std::string& remedy,
                  std::vector<long long> facets) {
  throw InputError(what, {.file = file.name, .byte = static_cast<long long>(byte), .facets = std::move(facets)},
                   remedy);
}

}  // namespace ccdt::io
