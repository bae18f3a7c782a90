#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/io/files.h"

namespace ccdt::io {

/// Formats lines on several threads, and writes them in order.
///
/// \param line  `line(i, out)` writes line i to a `TextBuffer` or an `OutputFile`
template <class Line>
void write_lines(std::size_t count, const Line& line, OutputFile& out) {
  if (thread_count() == 1) {
    for (std::size_t i = 0; i < count; ++i) line(i, out);
    return;
  }
  constexpr std::size_t chunk_length = 2048;
  const std::size_t batch_length = 4 * thread_count() * chunk_length;  // twice this is in memory at the same time
  std::vector<TextBuffer> texts;
  const auto write_texts = [&] {
    for (const TextBuffer& text : texts) out << text.bytes();
  };
  for (std::size_t first = 0; first < count; first += batch_length) {
    std::vector<TextBuffer> next;
    const auto make_texts = [&] {
      next =
          parallel_chunks(std::min(batch_length, count - first), chunk_length, [&](std::size_t begin, std::size_t end) {
            TextBuffer text;
            for (std::size_t i = first + begin; i < first + end; ++i) line(i, text);
            return text;
          });
    };
    parallel_both(write_texts, make_texts);
    texts = std::move(next);
  }
  write_texts();
}

}  // namespace ccdt::io
