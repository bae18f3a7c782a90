#include "tools/partition_mesh.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/errors.h"

namespace ccdt::tools {
namespace {

void check_size(std::size_t tetrahedra, int count) {
  if (tetrahedra < static_cast<std::size_t>(count))
    throw LimitError(
        "the mesh has only " + std::to_string(tetrahedra) + " tetrahedra for " + std::to_string(count) + " partitions",
        {}, "ask for fewer partitions, or for a shorter edge length");
  if (tetrahedra > std::numeric_limits<idx_t>::max() / 4)
    throw LimitError("the mesh has more tetrahedra than METIS can count", {}, "partition it in the solver");
}

PartitionSizes measure(const std::vector<int>& partitions, int count, idx_t cut) {
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(count), 0);
  for (const int partition : partitions) ++sizes[static_cast<std::size_t>(partition - 1)];
  const auto [least, most] = std::ranges::minmax(sizes);
  return {least, most, static_cast<std::uint64_t>(cut)};
}

}  // namespace

PartitionSizes partition_mesh(int count, mesh::TetMesh& mesh) {
  check_size(mesh.tetrahedra.size(), count);
  mesh.partitions.assign(mesh.tetrahedra.size(), 1);
  if (count == 1) return {mesh.tetrahedra.size(), mesh.tetrahedra.size(), 0};
  auto elements = static_cast<idx_t>(mesh.tetrahedra.size()), nodes = static_cast<idx_t>(mesh.vertices.size());
  std::vector<idx_t> begins, corners;
  begins.push_back(0);
  for (const auto& tetrahedron : mesh.tetrahedra) {
    for (const std::uint32_t v : tetrahedron) corners.push_back(static_cast<idx_t>(v));
    begins.push_back(static_cast<idx_t>(corners.size()));
  }
  std::array<idx_t, METIS_NOPTIONS> options;
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;  // the default, too, is a constant, but METIS does not promise it
  idx_t common = 3, parts = count, cut = 0;
  std::vector<idx_t> of_element(mesh.tetrahedra.size()), of_node(mesh.vertices.size());
  const int status = METIS_PartMeshDual(&elements, &nodes, begins.data(), corners.data(), nullptr, nullptr, &common,
                                        &parts, nullptr, options.data(), &cut, of_element.data(), of_node.data());
  if (status == METIS_ERROR_MEMORY)
    throw MemoryError("there is not enough memory to partition the mesh", {}, "ask for a coarser mesh");
  if (status != METIS_OK)
    throw LimitError("METIS did not partition the mesh", {}, "ask for another number of partitions");
  std::ranges::transform(of_element, mesh.partitions.begin(), [](idx_t part) { return static_cast<int>(part) + 1; });
  return measure(mesh.partitions, count, cut);
}

}  // namespace ccdt::tools
