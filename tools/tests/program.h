#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ccdt {

/// The outcome of a call of the program.
struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// A test in an empty folder of its own, in which it calls the `ccdt` program as a person would.
class Program : public testing::Test {
 protected:
  Program() {
    setenv("CCDT_NODE", "none", 1);  // figures take seconds, and have a test of their own
    std::string name = testing::TempDir() + "/ccdt-test-XXXXXX";
    folder_ = mkdtemp(name.data());
    std::filesystem::create_directory(folder_ / "work");
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path work() const { return folder_ / "work"; }

  Outcome run(const std::string& arguments) const { return run_in(".", arguments); }

  /// With standard input from this file.
  Outcome run_on(const std::string& input, const std::string& arguments) const { return run_in(".", arguments, input); }

  Outcome run_in(const std::string& folder, const std::string& arguments,
                 const std::string& input = "/dev/null") const {
    const auto quoted = [](const std::filesystem::path& path) { return "'" + path.string() + "'"; };
    const std::string command = "cd " + quoted(work() / folder) + " && " + quoted(CCDT_PROGRAM) + " " + arguments +
                                " <" + quoted(input) + " >" + quoted(folder_ / "out") + " 2>" + quoted(folder_ / "err");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "out"), text_of(folder_ / "err")};
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(work() / name, std::ios::binary) << text;
  }

  static std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  std::size_t file_count() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(work())) ++count;
    return count;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace ccdt
