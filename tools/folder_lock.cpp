#include "tools/folder_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::tools {
namespace {

constexpr mode_t everyone_may_read = 0644;

std::string own_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(getpid()) + " on " + host.data();
}

/// The process that locked the file, as it wrote into it.
std::string holder(int file) {
  std::array<char, 512> text{};
  const ssize_t size = pread(file, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "another process";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  io::check_links_stay_within(folder);
  const std::string name = (folder / "lock").string();
  file_ = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, everyone_may_read);
  if (file_ < 0 && errno == ELOOP)
    throw OutputError("this is a link, and a lock is written into it", io::place_in(name), "remove the link");
  if (file_ < 0) throw OutputError("the folder cannot be written to", io::place_in(folder.string()), "choose another");
  // Forks do not inherit this kind of lock. One made by flock would last until the forks of a killed process end, too.
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(file_, F_SETLK, &whole) != 0) {
    const std::string other = holder(file_);
    close(file_);
    throw InputError(other + " is working in this folder", io::place_in(folder.string()),
                     "wait until it ends, or choose another folder");
  }
  const std::string own = own_name();
  const bool is_written = ftruncate(file_, 0) == 0 && pwrite(file_, own.data(), own.size(), 0) > 0;
  static_cast<void>(is_written);  // for people only
}

FolderLock::~FolderLock() {
  close(file_);
}

}  // namespace ccdt::tools
