#include "tools/share_folder.h"

namespace ccdt {

std::filesystem::path own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

std::filesystem::path share_folder() {
  auto beside = own_program().parent_path() / "share" / "ccdt";
  if (std::filesystem::exists(beside)) return beside;
  return own_program().parent_path().parent_path() / "share" / "ccdt";
}

}  // namespace ccdt
