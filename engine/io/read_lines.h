#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

/// Some consecutive lines of a text.
struct LineBlock {
  std::size_t begin;  ///< the byte where the first line begins
  std::size_t first;  ///< the number of the first line, from 0
  std::size_t lines;
};

/// Finds the first lines of a text, on several threads.
/// \return  none if there are fewer line ends
std::vector<LineBlock> cut_lines(std::string_view text, char line_end, std::size_t lines);

/// Reads items on several threads if each is on its own line.
///
/// \param in    is before the first item's line; then is after the last item's line
/// \param read  `read(in, i)` reads item i, or its whole line. The calls are in any order, and some may fail.
/// \return  false: nothing was read. There are few items or one thread, or some line is not as expected.
template <class Read>
bool read_lines_together(TextScanner& in, std::size_t count, const Read& read) {
  constexpr std::size_t least_count = 4096;  // fewer are not worth the trouble
  if (thread_count() == 1 || count < least_count) return false;
  TextScanner first = in;
  if (first.at_line_end()) first.skip_line();
  const std::string_view text = first.rest();
  const std::vector<LineBlock> blocks = cut_lines(text, first.line_end(), count);
  std::atomic<bool> is_as_expected = !blocks.empty();
  std::size_t end = 0;  // of the last line
  const auto read_block = [&](const LineBlock& block) {
    TextScanner here = first;
    std::size_t begin = block.begin;
    for (std::size_t i = block.first; i < block.first + block.lines; ++i) {
      if (!is_as_expected.load(std::memory_order_relaxed)) return;
      const std::size_t next = text.find(first.line_end(), begin) + 1;
      here.move_to(first.position() + begin);
      read(here, i);
      const std::size_t reached = here.position() - first.position();
      if (reached > next || (reached < next && !here.at_line_end())) is_as_expected = false;
      begin = next;
    }
    if (block.first + block.lines == count) end = begin;
  };
  parallel_for(blocks.size(), 1, [&](std::size_t b) {
    try {
      read_block(blocks[b]);
    } catch (const InputError&) {
      is_as_expected = false;
    }
  });
  if (!is_as_expected) return false;
  in.move_to(first.position() + end);
  return true;
}

/// Reads items, on several threads if each is on its own line. The result and the errors are the same.
template <class Read>
void read_lines(TextScanner& in, std::size_t count, const Read& read) {
  if (read_lines_together(in, count, read)) return;
  for (std::size_t i = 0; i < count; ++i) read(in, i);
}

}  // namespace ccdt::io
