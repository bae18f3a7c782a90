#include <fcntl.h>
#include <sys/resource.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/tests/shared/gzipped.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

template <class Number>
std::string bytes_of(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/// A file that takes much memory for its size.
struct CostlyFile {
  std::string name;
  std::function<std::string(std::size_t)> of_size;  ///< about so many bytes
  int most_per_byte;                                ///< bytes of memory, as docs/security.md says
  const char* arguments = "mesh FILE -o o.vtu";
};

const char* const three_vertices = "0 0 0\n1 0 0\n0 1 0\n";

/// Zeros, which zlib makes a thousand times shorter, as the points of a mesh.
std::string compressed_mesh(std::size_t size) {
  const std::string zeros(size * 1000 / 24 * 24, '\0');
  std::string packed(compressBound(zeros.size()), '\0');
  uLongf length = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(zeros.data()),
            zeros.size(), 9);
  std::string header;
  for (const std::size_t number : {std::size_t{1}, zeros.size(), std::size_t{0}, std::size_t{length}})
    header += bytes_of(static_cast<std::uint32_t>(number));
  return R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32"
 compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece NumberOfCells="1" NumberOfPoints=")" +
         std::to_string(zeros.size() / 24) +
         R"("><Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="0"/></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells></Piece></UnstructuredGrid><AppendedData encoding="raw">_)" +
         header + packed.substr(0, length) + "</AppendedData></VTKFile>";
}

/// Vertices that zlib makes nearly a hundred times shorter: behind them is as much that it cannot shorten.
std::string compressed_vertices(std::size_t size) {
  std::mt19937 random(1);
  std::string noise = "#";
  while (noise.size() < size) noise += static_cast<char>('0' + random() % 64);
  return gzipped(repeated("v 0 0 0\n", 70 * size / 8) + "f 1 2 3\n" + noise);
}

std::vector<CostlyFile> costly_files() {
  const std::string triangle =
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  return {
      {"corners.off",
       [](std::size_t size) {
         const std::string count = std::to_string(size / 2);
         return "OFF\n3 1 0\n" + std::string(three_vertices) + count + repeated(" 0", size / 2);
       },
       100},
      {"vertices.obj", [](std::size_t size) { return repeated("v 0 0 0\n", size / 8) + "f 1 2 3\n"; }, 100},
      {"strip.ply",
       [](std::size_t size) {
         return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
                "property char z\nelement tristrips 1\nproperty list int uchar vertex_indices\nend_header\n" +
                std::string("\0\0\0\1\0\0\0\1\0", 9) + bytes_of(static_cast<std::int32_t>(size / 3 * 3)) +
                repeated(std::string("\0\1\2", 3), size / 3);
       },
       100},
      {"solid.stl",
       [=](std::size_t size) { return "solid\n" + repeated(triangle, size / triangle.size()) + "endsolid\n"; }, 100},
      {"polygons.poly",
       [](std::size_t size) {
         return "3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n1 0\n" + std::to_string(size / 6) + "\n" +
                repeated("2 0 1\n", size / 6) + "0\n0\n";
       },
       100},
      {"triangles.mesh",
       [](std::size_t size) {
         return "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles\n" +
                std::to_string(size / 8) + "\n" + repeated("1 2 3 0\n", size / 8) + "End\n";
       },
       100},
      {"elements.vtu", [](std::size_t size) { return "<VTKFile>" + repeated("<a>", size / 3); }, 100,
       "verify far.off FILE"},
      {"zeros.vtu", [](std::size_t size) { return compressed_mesh(size / 16); }, 2500, "verify far.off FILE"},
      {"corners.vtp",
       [](std::size_t size) {
         return R"(<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="0"
 NumberOfStrips="0" NumberOfPolys="1"><Points><DataArray type="Float64" format="ascii">)" +
                std::string(three_vertices) + R"(</DataArray></Points><Polys>
<DataArray type="Int64" Name="offsets" format="ascii">)" +
                std::to_string(size / 2) +
                R"(</DataArray><DataArray type="Int64" Name="connectivity" format="ascii">)" +
                repeated("0 ", size / 2) + "</DataArray></Polys></Piece></PolyData></VTKFile>";
       },
       100},
      {"vertices.obj.gz", [](std::size_t size) { return compressed_vertices(size / 16); }, 10000},
      {"zeros.obj.gz", [](std::size_t size) { return gzipped(std::string(size * 10, ' ')); }, 10000},
      {"lists.json",
       [](std::size_t size) {
         return "[" + repeated(std::string(150, '[') + std::string(150, ']') + ",", size / 301) + "1]";
       },
       100, "gate FILE --against FILE"},
  };
}

class FileCosts : public Program {
 protected:
  /// The largest memory of a call that is refused, in bytes.
  double memory_of(std::string arguments, const std::string& file) const {
    for (std::size_t at = arguments.find("FILE"); at != std::string::npos; at = arguments.find("FILE"))
      arguments.replace(at, 4, file);
    const std::string command = "cd '" + work().string() + "' && exec '" CCDT_PROGRAM "' " + arguments + " 2>/dev/null";
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << file;
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
  }
};

TEST_F(FileCosts, MemoryGrowsWithTheSizeByAStatedFactorAtMost) {
  // Too large, so that nothing happens after the mesh was read.
  write("far.off", "OFF\n4 4 0\n0 0 0\n1e200 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const CostlyFile& file : costly_files()) {
    std::array<double, 2> sizes{}, memory{};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string text = file.of_size((i + 1) << 20);
      write(file.name, text);
      sizes[i] = static_cast<double>(text.size());
      memory[i] = memory_of(file.arguments, file.name);
    }
    EXPECT_LE(memory[1] - memory[0], file.most_per_byte * (sizes[1] - sizes[0])) << file.name;
    EXPECT_LE(memory[1], 30e6 + file.most_per_byte * sizes[1]) << file.name;
  }
}

}  // namespace
}  // namespace ccdt
