#include "engine/io/read_lines.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/tests/io/io_test_files.h"

// Reading items on several threads gives the same items as reading them one by one, whatever the layout of the lines.

namespace ccdt {
namespace {

constexpr std::size_t count = 60'000;  // several blocks

using Item = std::array<std::int64_t, 2>;

struct Layout {
  const char* name;
  bool is_one_per_line;
  std::function<std::string(std::size_t i)> item;  ///< with what separates it from the next one
  std::string end = "after 1\n";
};

std::string numbers(std::size_t i) {
  return std::to_string(i) + " " + std::to_string(i * i);
}

std::vector<Layout> layouts() {
  const auto at = [](std::size_t place, const std::string& there) {
    return [=](std::size_t i) { return numbers(i) + (i == place ? there : "\n"); };
  };
  const auto everywhere = [](const std::string& between) {
    return [=](std::size_t i) { return numbers(i) + between; };
  };
  return {
      {"plain", true, everywhere("\n")},
      {"blanks and comments", true, everywhere(" \t # here\n")},
      {"carriage return and line feed", true, everywhere("\r\n")},
      {"carriage return alone", true, everywhere("\r"), "after 1\r"},
      {"a line longer than a block", true, at(70, "#" + std::string(1 << 20, '-') + "\n")},
      {"the text ends with the last line", true, everywhere("\n"), ""},
      {"the last line does not end", false, at(count - 1, ""), ""},
      {"a line of comment", false, at(30'000, "\n# here\n")},
      {"an empty line", false, at(count - 2, "\n\n")},
      {"two on a line", false, at(40'000, " ")},
      {"all on a line", false, everywhere(" "), "\n"},
      {"one on two lines", false, [](std::size_t i) { return std::to_string(i) + (i == 9 ? "\n" : " ") + "1\n"; }},
      {"one number too many", false, at(50'000, " 7\n")},
      {"a word that is no number", false, at(12'345, "x\n")},
      {"one too few", false, [](std::size_t i) { return i == 0 ? "" : numbers(i) + "\n"; }, ""},
      {"one too few, and another section", false, [](std::size_t i) { return i == 0 ? "" : numbers(i) + "\n"; }},
  };
}

struct Result {
  std::vector<Item> items;
  std::string rest, error;

  bool operator==(const Result&) const = default;
};

void read_item(io::TextScanner& in, Item& item, std::size_t i) {
  for (std::int64_t& number : item) number = in.integer({"item", i});
}

Result read(const io::FileBytes& file) {
  Result result{std::vector<Item>(count), {}, {}};
  io::TextScanner in(file);
  in.word("header");
  try {
    io::read_lines(in, count, [&](io::TextScanner& line, std::size_t i) { read_item(line, result.items[i], i); });
    result.rest = in.at_end() ? "" : in.rest_of_line();
  } catch (const InputError& error) {
    result.items.clear();  // some may have been read
    result.error = error.what();
  }
  return result;
}

bool are_read_together(const io::FileBytes& file) {
  std::vector<Item> items(count);
  io::TextScanner in(file);
  in.word("header");
  return io::read_lines_together(in, count,
                                 [&](io::TextScanner& line, std::size_t i) { read_item(line, items[i], i); });
}

TEST(ReadingLines, IsTheSameOnSeveralThreads) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    std::string text = layout.item(0).ends_with('\r') ? "header\r" : "header\n";
    for (std::size_t i = 0; i < count; ++i) text += layout.item(i);
    const io::FileBytes file{"items", text + layout.end};
    const Result one = with_threads(1, [&] { return read(file); });
    const Result four = with_threads(4, [&] { return read(file); });
    EXPECT_TRUE(one == four) << one.error << " / " << four.error;
    EXPECT_EQ(with_threads(4, [&] { return are_read_together(file); }), layout.is_one_per_line);
  }
}

std::string lines_of(std::size_t lines, const std::function<std::string(std::size_t)>& line) {
  std::string text;
  for (std::size_t i = 0; i < lines; ++i) text += line(i);
  return text;
}

TEST(ReadingLines, OfEachFormatIsTheSameOnSeveralThreads) {
  const std::size_t vertices = 10'000, triangles = 20'000;
  const auto point = [](std::size_t i) { return std::to_string(i % 100) + " " + std::to_string(i / 100) + " 0.25"; };
  const auto corners = [](std::size_t i, std::size_t first) {
    return std::to_string(i % 9'000 + first) + " " + std::to_string(i % 9'000 + 1 + first) + " " +
           std::to_string(i % 9'000 + 100 + first);
  };
  const std::string off = "OFF\n10000 20000 0\n" +
                          lines_of(vertices, [&](std::size_t i) { return point(i) + " 255 0 0\n"; }) +
                          lines_of(triangles, [&](std::size_t i) { return "3 " + corners(i, 0) + " 1\n"; });
  std::string mixed = off;
  mixed.replace(mixed.find("3 0 1 100 1\n"), 12, "4 0 1 101 100\n");
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n10000\n" +
      lines_of(vertices, [&](std::size_t i) { return point(i) + " 0\n"; }) + "Triangles\n20000\n" +
      lines_of(triangles, [&](std::size_t i) { return corners(i, 1) + " " + std::to_string(i % 5) + "\n"; }) + "End\n";
  const std::string node = "10000 3 0 0\n" + lines_of(vertices, [&](std::size_t i) {
                             return std::to_string(i + 1) + " " + point(i) + "\n";
                           });
  const std::vector<std::array<std::string, 2>> files = {
      {"a.off", off}, {"mixed.off", mixed}, {"a.mesh", medit}, {"a.node", node}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const io_test::Folder folder;
    const auto file = io_test::put(folder / name, text);
    const plc::InputPlc one = with_threads(1, [&] { return io::read_plc(file); });
    const plc::InputPlc four = with_threads(4, [&] { return io::read_plc(file); });
    EXPECT_EQ(one.vertices.size(), vertices);
    EXPECT_TRUE(one.vertices == four.vertices);
    EXPECT_TRUE(one.triangles == four.triangles);
    EXPECT_TRUE(one.triangle_markers == four.triangle_markers);
    EXPECT_TRUE(one.triangle_numbers == four.triangle_numbers);
    EXPECT_EQ(one.polygon_facets.size(), four.polygon_facets.size());
  }
}

}  // namespace
}  // namespace ccdt
