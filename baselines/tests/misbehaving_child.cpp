#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "";
  if (how == "fail") {
    std::fputs("the child's own words\n", stderr);
    return 3;
  }
  if (how == "abort") std::abort();
  if (how == "sleep") std::this_thread::sleep_for(std::chrono::seconds(60));
  if (how == "sleep-in-grandchild") {
    if (fork() == 0) std::this_thread::sleep_for(std::chrono::seconds(60));
    std::this_thread::sleep_for(std::chrono::seconds(60));
  }
  if (how == "eat-memory") {
    // Slowly enough to be seen, and no more than 4 GB if nobody stops it.
    std::vector<std::vector<char>> eaten;
    for (int i = 0; i < 1024; ++i) {
      eaten.emplace_back(4 << 20, 'x');
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  if (how == "print") std::puts("this must not reach the caller's output");
  return 0;
}
