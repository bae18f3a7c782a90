#include "engine/io/read_lines.h"

#include <algorithm>

namespace ccdt::io {

std::vector<LineBlock> cut_lines(std::string_view text, char line_end, std::size_t lines) {
  constexpr std::size_t length = std::size_t{1} << 18;
  std::vector<std::size_t> ends;  // how many line ends are in each block of bytes
  std::size_t found = 0;
  while (found < lines) {
    const std::size_t begin = ends.size() * length;
    if (begin >= text.size()) return {};
    // About as many bytes as the remaining lines need if they are like the ones before.
    const std::size_t wanted = found == 0 ? 1 : (lines - found) * ends.size() / found + 1;
    const std::string_view some = text.substr(begin, wanted * length);
    for (const std::size_t count : parallel_chunks(some.size(), length, [&](std::size_t from, std::size_t to) {
           return static_cast<std::size_t>(std::count(some.begin() + from, some.begin() + to, line_end));
         })) {
      ends.push_back(count);
      found += count;
    }
  }
  // A line belongs to the block with the line end before it, and the first line to the first block.
  std::vector<LineBlock> blocks = {{0, 0, std::min(ends[0] + 1, lines)}};
  for (std::size_t b = 1; b < ends.size(); ++b) {
    const std::size_t first = blocks.back().first + blocks.back().lines;
    if (first < lines && ends[b] > 0)
      blocks.push_back({text.find(line_end, b * length) + 1, first, std::min(ends[b], lines - first)});
  }
  return blocks;
}

}  // namespace ccdt::io
