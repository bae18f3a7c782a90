#include "baselines/external_program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <map>
#include <sstream>
#include <system_error>

namespace ccdt {
namespace {

constexpr int code_not_run = 127, code_of_signal = 128;

bool can_be_run(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

/// A file that is closed at the end.
class Descriptor {
 public:
  Descriptor(const char* file, int flags) : value_(open(file, flags | O_CLOEXEC, 0600)) {
    if (value_ < 0) throw std::system_error(errno, std::generic_category(), std::string("cannot open ") + file);
  }
  ~Descriptor() { close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int value() const { return value_; }

 private:
  int value_;
};

/// Texts as a call of the system wants them: pointers, the last of which is null.
class Texts {
 public:
  explicit Texts(std::vector<std::string> texts) : texts_(std::move(texts)) {
    for (std::string& text : texts_) pointers_.push_back(text.data());
    pointers_.push_back(nullptr);
  }

  char* const* pointers() const { return pointers_.data(); }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

/// "NAME=value", those of this process first; of variables that are there twice, the last counts.
std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& more) {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const auto equals = text.find('=');
    if (equals != std::string::npos) variables[text.substr(0, equals)] = text.substr(equals + 1);
  }
  for (const auto& [name, value] : more) variables[name] = value;
  std::vector<std::string> all;
  for (const auto& [name, value] : variables) all.push_back(std::string(name).append("=").append(value));
  return all;
}

/// The rest of the fork's life: the program, or the shells' code for one that cannot be run. It ends with its parent.
/// Only async-signal-safe calls.
[[noreturn]] void become(const Texts& arguments, const Texts& environment, const char* folder, int input, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  if (*folder == '\0' || chdir(folder) == 0)
    execve(arguments.pointers()[0], arguments.pointers(), environment.pointers());
  _exit(code_not_run);
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name, const char* environment_variable) {
  const char* told = std::getenv(environment_variable);
  if (told != nullptr && *told != '\0')
    return can_be_run(told) ? std::optional<std::filesystem::path>(told) : std::nullopt;
  return find_on_path(name);
}

std::optional<std::filesystem::path> find_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / name;
    if (can_be_run(file)) return file;
  }
  return std::nullopt;
}

int run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                const ProgramSurroundings& surroundings) {
  const Texts arguments(command), environment(environment_with(surroundings.environment));
  const Descriptor null("/dev/null", O_RDONLY), output(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start " + command[0]);
  if (child == 0) become(arguments, environment, surroundings.folder.c_str(), null.value(), output.value());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : code_of_signal + WTERMSIG(status);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "ccdt-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace ccdt
