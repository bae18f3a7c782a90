#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ccdt {

/// Where a program of somebody else's is: what the environment variable says, else the first of that name on PATH.
/// None if that is no file that can be run.
std::optional<std::filesystem::path> find_program(const std::string& name, const char* environment_variable);

/// The first file of that name on PATH that can be run. None if there is none.
std::optional<std::filesystem::path> find_on_path(const std::string& name);

/// Where a program runs.
struct ProgramSurroundings {
  std::filesystem::path folder = {};                                  ///< empty: where the caller is
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< variables beside those of the caller
};

/// Runs a program to its end, or to that of the calling process. It gets no input; all that it prints goes to the log.
/// \return  its exit code; as shells have it, 128 and the number of the signal that ended it, and 127 if it cannot be
/// run
/// \throw std::system_error  no process can be started, or the log cannot be written
int run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                const ProgramSurroundings& surroundings = {});

/// A folder of this object's own among the system's temporary files; removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ccdt
