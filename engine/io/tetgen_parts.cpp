#include "engine/io/tetgen_parts.h"

namespace ccdt::io {

TetgenNodes read_tetgen_nodes(TextScanner& in) {
  TetgenNodes nodes;
  const std::size_t count = in.count({"number of vertices"}, 8);
  if (!in.at_line_end())
    if (const std::int64_t dimension = in.integer({"dimension"}); dimension != 3)
      in.fail({"dimension"}, "it is " + std::to_string(dimension) + ", not 3", "give points in three dimensions");
  in.skip_line();  // how many attributes and markers follow each point: both are skipped with the line
  nodes.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item vertex{"vertex", static_cast<std::int64_t>(i)};
    const std::int64_t number = in.integer(vertex);
    if (i == 0) nodes.first = number;
    if (nodes.first != 0 && nodes.first != 1)
      in.fail(vertex, "the first vertex has the number " + std::to_string(number), "number the vertices from 0 or 1");
    if (const std::int64_t expected = nodes.first + vertex.number; number != expected)
      in.fail(vertex, "it has the number " + std::to_string(number) + " where " + std::to_string(expected) + " is due",
              "number the vertices without gaps");
    nodes.vertices.push_back(in.point(vertex));
    in.skip_line();
  }
  return nodes;
}

void write_tetgen_nodes(const std::vector<Point3>& vertices, OutputFile& out) {
  out << vertices.size() << " 3 0 0\n";
  for (std::size_t i = 0; i < vertices.size(); ++i)
    out << i + 1 << ' ' << vertices[i].x << ' ' << vertices[i].y << ' ' << vertices[i].z << '\n';
}

std::filesystem::path sibling(const std::filesystem::path& file, const char* ending) {
  std::filesystem::path other = file;
  return other.replace_extension(ending);
}

}  // namespace ccdt::io
