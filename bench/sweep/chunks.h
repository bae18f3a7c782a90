#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ccdt::sweep {

/// What is missing of a case, as far as its place on a cluster matters.
struct MissingCase {
  std::string id;
  std::string group;   ///< cases of one group take turns, so they belong on one machine
  double seconds = 0;  ///< of all its missing runs, estimated
  int threads = 1;     ///< that a run uses
};

/// Cases that one task of a cluster runs. Thousands of tasks of a second each would keep the cluster busy with itself.
struct Chunk {
  int number = -1;                      ///< its file is chunks/NUMBER.json; -1: it has none yet
  std::vector<std::string> cases = {};  ///< ids
  double seconds = 0;                   ///< estimated
  int threads = 1;                      ///< the most that any of its cases uses
};

/// Cuts cases into chunks that take about so many seconds. A group stays in one chunk unless it is longer than a chunk
/// by itself. The order of the cases is kept within a group, and that of the groups is that of their first cases.
std::vector<Chunk> cut_into_chunks(std::span<const MissingCase> cases, double seconds);

/// Numbers the chunks and writes their files. A chunk with the same cases as an older one has the number of that, so a
/// second call with the same cases changes nothing; files are never changed, since tasks may be about to read them.
/// \throw OutputError
void write_chunks(const std::filesystem::path& folder, std::vector<Chunk>& chunks);

/// \throw InputError  there is no such chunk, or its file is none
Chunk read_chunk(const std::filesystem::path& folder, int number);

/// All chunks that have files, by number. \throw InputError
std::vector<Chunk> read_chunks(const std::filesystem::path& folder);

/// While it lives, others that want the same chunk wait. Where only the daemon of a node has died, its tasks run on
/// while others are started in their place.
class ChunkLock {
 public:
  /// \throw OutputError  there is no such chunk, or its file system cannot lock
  ChunkLock(const std::filesystem::path& folder, int number);
  ~ChunkLock();
  ChunkLock(const ChunkLock&) = delete;
  ChunkLock& operator=(const ChunkLock&) = delete;

 private:
  int file_ = -1;
};

/// What a task has to ask for, in MiB, if its runs have this limit; 0 if they have none.
std::uint64_t task_megabytes(std::uint64_t limit_bytes);

/// The file that says that a workflow manager has seen the end of a chunk, relative to the folder.
std::string chunk_marker(int number);

}  // namespace ccdt::sweep
