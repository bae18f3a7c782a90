#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/point.h"
#include "engine/io/output_file.h"
#include "engine/io/text_scanner.h"

/// What TetGen's formats have in common.
namespace ccdt::io {

struct TetgenNodes {
  std::vector<Point3> vertices;
  std::int64_t first = 0;  ///< number of the first vertex, 0 or 1; indices in all lists count from it
};

/// Reads a list of nodes: a line "count dimension attributes markers", then "number x y z ..." a node.
TetgenNodes read_tetgen_nodes(TextScanner& in);

/// Writes the same, numbered from 1.
void write_tetgen_nodes(const std::vector<Point3>& vertices, OutputFile& out);

/// Skips the number at the start of each line of a list.
inline void skip_number(TextScanner& in, const Item& item) {
  in.integer(item);
}

/// The file beside the given one with another ending.
std::filesystem::path sibling(const std::filesystem::path& file, const char* ending);

}  // namespace ccdt::io
