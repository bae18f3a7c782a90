#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ccdt::sweep {

/// What a cluster must know about a case with missing runs.
struct MissingCase {
  std::string id;
  std::string group;   ///< cases of one group take turns, so they belong on one machine
  double seconds = 0;  ///< estimated seconds of all its missing runs
  int threads = 1;     ///< threads of a run
};

/// The cases that one task on a cluster runs. Thousands of tasks of one second each would keep the cluster busy with
/// scheduling.
struct Chunk {
  int number = -1;                      ///< its file is chunks/NUMBER.json; -1: no file yet
  std::vector<std::string> cases = {};  ///< ids
  double seconds = 0;                   ///< estimated
  int threads = 1;                      ///< the most that any of its cases uses
};

/// Cuts cases into chunks that take about this many seconds. A group stays in one chunk unless it alone is longer than
/// a chunk. Cases keep their order within a group, and groups are in the order of their first cases.
std::vector<Chunk> cut_into_chunks(std::span<const MissingCase> cases, double seconds);

/// Numbers the chunks and writes their files. A chunk with the same cases as an older one keeps its number, so a second
/// call with the same cases changes nothing. Files are never changed, because tasks may be about to read them.
/// \throw OutputError
void write_chunks(const std::filesystem::path& folder, std::vector<Chunk>& chunks);

/// \throw InputError  there is no such chunk, or its file is invalid
Chunk read_chunk(const std::filesystem::path& folder, int number);

/// All chunks that have files, by number. \throw InputError
std::vector<Chunk> read_chunks(const std::filesystem::path& folder);

/// While a lock exists, other tasks that want the same chunk wait. This is needed when the daemon of a node dies: its
/// tasks keep running, but the cluster starts new ones in their place.
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

/// The memory that a task must request, in MiB, if its runs have this limit; 0 if they have none.
std::uint64_t task_megabytes(std::uint64_t limit_bytes);

/// The file that tells a workflow manager that a chunk is done, relative to the folder.
std::string chunk_marker(int number);

}  // namespace ccdt::sweep
