#include "bench/sweep/chunks.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <tuple>

#include "bench/run/json.h"
#include "bench/run/json_fields.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::bench {
template <>
inline constexpr auto fields<sweep::Chunk> = std::make_tuple(field("number", &sweep::Chunk::number),
                                                             field("cases", &sweep::Chunk::cases),
                                                             field("seconds", &sweep::Chunk::seconds),
                                                             field("threads", &sweep::Chunk::threads));
}  // namespace ccdt::bench

namespace ccdt::sweep {
namespace {

constexpr bench::DocumentKind chunk_kind = {"ccdt.chunk/1", "this is not a chunk of a sweep",
                                            "remove the folder chunks, and call ccdt sweep again"};

/// Memory beyond the limit of a run: for this program, and for what a run allocates between two checks.
constexpr double memory_factor = 1.1, memory_margin = 256 << 20;

std::filesystem::path chunk_folder(const std::filesystem::path& folder) {
  return folder / "chunks";
}

std::filesystem::path chunk_file(const std::filesystem::path& folder, int number) {
  return chunk_folder(folder) / (std::to_string(number) + ".json");
}

std::vector<std::vector<const MissingCase*>> groups_of(std::span<const MissingCase> cases) {
  std::vector<std::vector<const MissingCase*>> groups;
  std::map<std::string, std::size_t> known;
  for (const MissingCase& c : cases) {
    // A case without a group is not compared with others.
    const auto [found, is_new] = known.try_emplace(c.group.empty() ? c.id : c.group, groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(&c);
  }
  return groups;
}

double seconds_of(const std::vector<const MissingCase*>& group) {
  double sum = 0;
  for (const MissingCase* c : group) sum += c->seconds;
  return sum;
}

void add(Chunk& chunk, const MissingCase& c) {
  chunk.cases.push_back(c.id);
  chunk.seconds += c.seconds;
  chunk.threads = std::max(chunk.threads, c.threads);
}

/// The number of a chunk's file; none for other files.
std::optional<int> number_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  int number = -1;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc() || end != stem.data() + stem.size() || file.extension() != ".json" || number < 0) return {};
  return number;
}

}  // namespace

std::vector<Chunk> cut_into_chunks(std::span<const MissingCase> cases, double seconds) {
  std::vector<Chunk> chunks;
  const auto begin_chunk_for = [&](double more) {
    if (chunks.empty() || (!chunks.back().cases.empty() && chunks.back().seconds + more > seconds))
      chunks.emplace_back();
  };
  for (const auto& group : groups_of(cases)) {
    const double all = seconds_of(group);
    begin_chunk_for(all);
    for (const MissingCase* c : group) {
      if (all > seconds) begin_chunk_for(c->seconds);
      add(chunks.back(), *c);
    }
  }
  return chunks;
}

void write_chunks(const std::filesystem::path& folder, std::vector<Chunk>& chunks) {
  std::filesystem::create_directories(chunk_folder(folder));
  std::map<std::vector<std::string>, int> known;
  int next = 0;
  for (const Chunk& chunk : read_chunks(folder)) {
    known[chunk.cases] = chunk.number;
    next = std::max(next, chunk.number + 1);
  }
  for (Chunk& chunk : chunks) {
    const auto [found, is_new] = known.try_emplace(chunk.cases, next);
    chunk.number = found->second;
    if (!is_new) continue;
    ++next;
    bench::Json json = {{"schema", chunk_kind.schema}};
    json.update(bench::Json(chunk));
    bench::write_json(json, chunk_file(folder, chunk.number));
  }
}

Chunk read_chunk(const std::filesystem::path& folder, int number) {
  const auto file = chunk_file(folder, number);
  if (!io::is_there(file))
    throw InputError("there is no chunk " + std::to_string(number), io::place_in(file.string()),
                     "the numbers of the chunks are the names of the files there");
  Chunk chunk;
  bench::parse_document(file, chunk_kind, [&](const bench::Json& json) { chunk = json.get<Chunk>(); });
  return chunk;
}

std::vector<Chunk> read_chunks(const std::filesystem::path& folder) {
  std::vector<Chunk> chunks;
  if (!io::is_there(chunk_folder(folder))) return chunks;
  for (const auto& entry : std::filesystem::directory_iterator(chunk_folder(folder)))
    if (const auto number = number_of(entry.path())) chunks.push_back(read_chunk(folder, *number));
  std::ranges::sort(chunks, {}, &Chunk::number);
  return chunks;
}

ChunkLock::ChunkLock(const std::filesystem::path& folder, int number) {
  const std::string name = chunk_file(folder, number).string();
  file_ = open(name.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);  // NFS locks only writable files
  if (file_ >= 0 && flock(file_, LOCK_EX) == 0) return;
  const std::string fault = std::generic_category().message(errno);
  if (file_ >= 0) close(file_);
  throw OutputError("the chunk cannot be locked: " + fault, io::place_in(name),
                    "check that the file can be written, and that its file system has locks");
}

ChunkLock::~ChunkLock() {
  close(file_);
}

std::uint64_t task_megabytes(std::uint64_t limit_bytes) {
  if (limit_bytes == 0) return 0;
  const double bytes = static_cast<double>(limit_bytes) * memory_factor + memory_margin;
  return static_cast<std::uint64_t>(std::ceil(bytes / (1 << 20)));
}

std::string chunk_marker(int number) {
  return "chunks/" + std::to_string(number) + ".done";
}

}  // namespace ccdt::sweep
