#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace {

/// Long enough for every test, but not forever, so that a failing test leaves nothing behind.
void sleep_long() {
  std::this_thread::sleep_for(std::chrono::seconds(60));
}

/// Slowly enough to be seen, and no more than 4 GB if nobody stops it.
void eat_memory() {
  std::vector<std::vector<char>> eaten;
  for (int i = 0; i < 1024; ++i) {
    eaten.emplace_back(4 << 20, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// The same with a stream.
void fill(std::FILE* file) {
  const std::vector<char> block(1 << 20, 'x');
  for (int i = 0; i < 4096; ++i) {
    std::fwrite(block.data(), 1, block.size(), file);
    std::fflush(file);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Leaves a process that has left its parent, its group and its session, as servers do. Its number goes to a file.
void leave_a_server(const std::string& pid_file) {
  if (fork() != 0) {
    while (access(pid_file.c_str(), F_OK) != 0) usleep(1000);
    return;
  }
  setsid();
  if (fork() != 0) _exit(0);
  std::ofstream(pid_file + ".new") << getpid();
  std::rename((pid_file + ".new").c_str(), pid_file.c_str());
  sleep_long();
  _exit(0);
}

}  // namespace

/// misbehaving_child HOW [FILE]
int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "", file = argc > 2 ? argv[2] : "";
  if (how == "fail") {
    std::fputs("the child's own words\n", stderr);
    return 3;
  }
  if (how == "abort") std::abort();
  if (how == "segfault") {
    std::signal(SIGSEGV, SIG_DFL);  // sanitizers have a handler, which exits
    std::raise(SIGSEGV);
  }
  if (how == "kill-itself") std::raise(SIGKILL);
  if (how == "sleep") sleep_long();
  if (how == "sleep-in-grandchild") {
    fork();
    sleep_long();
  }
  if (how == "leave-a-server") leave_a_server(file);
  if (how == "leave-a-server-and-sleep") {
    leave_a_server(file);
    sleep_long();
  }
  if (how == "leave-a-server-and-print") {
    leave_a_server(file);
    fill(stderr);
  }
  if (how == "eat-memory") eat_memory();
  if (how == "eat-memory-in-grandchild") {
    if (fork() == 0) eat_memory();
    sleep_long();
  }
  if (how == "share-memory-with-children") {
    const std::vector<char> shared(60 << 20, 'x');
    for (int i = 0; i < 4; ++i)
      if (fork() == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        _exit(shared.back() == 'x' ? 0 : 1);
      }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  if (how == "fill-disk") {
    const char* folder = std::getenv("TMPDIR");
    const std::string name = file.empty() ? std::string(folder == nullptr ? "." : folder) + "/full" : file;
    if (std::FILE* full = std::fopen(name.c_str(), "wb"); full != nullptr) fill(full);
  }
  if (how == "print-without-end") fill(stderr);
  if (how == "print") std::puts("this must not reach the caller's output");
  return 0;
}
