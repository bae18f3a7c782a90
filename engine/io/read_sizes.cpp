#include "engine/io/read_sizes.h"

#include "engine/io/medit_parts.h"
#include "engine/io/tet_mesh_formats.h"
#include "engine/io/tetgen_parts.h"

namespace ccdt {

namespace {

using namespace io;

constexpr const char* scalar_remedy = "write one size a vertex, the target edge length there";

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

[[noreturn]] void fail_without_background(const std::filesystem::path& file, const std::string& endings) {
  throw InputError("there is no " + endings + " file of this name beside it, so it is not known where the sizes belong",
                   place_in(file.string()), "put the mesh that the sizes belong to beside them, under the same name");
}

/// The values of all vertices, which end the part of the file that matters.
std::vector<double> read_values(TextScanner& in, std::size_t count, std::size_t vertices,
                                const std::filesystem::path& background) {
  if (count != vertices)
    in.fail({"number of sizes"},
            "there are " + std::to_string(count) + ", but " + background.string() + " has " + std::to_string(vertices) +
                " vertices",
            "put the sizes beside the mesh that they were made for");
  if (count == 0) in.fail({"number of sizes"}, "there is none", "give the size function at one vertex at least");
  std::vector<double> sizes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{"size of vertex", static_cast<std::int64_t>(i)};
    sizes[i] = in.number(item);
    if (!(sizes[i] > 0)) in.fail(item, std::to_string(sizes[i]) + " is not greater than 0", scalar_remedy);
  }
  return sizes;
}

/// The number of values of a Medit solution at the vertices, and that they are scalars.
std::size_t read_sol_head(TextScanner& in) {
  if (const std::string_view first = in.word({"header"}); first != "MeshVersionFormatted")
    in.fail({"header"}, "expected 'MeshVersionFormatted', found " + in_quotes(first),
            "check that this is a Medit text file");
  in.integer({"MeshVersionFormatted"});
  std::string_view keyword = in.word({"keyword 'SolAtVertices'"});
  while (keyword != "SolAtVertices") {
    if (keyword == "Dimension") {
      if (const std::int64_t dimension = in.integer({"Dimension"}); dimension != 3)
        in.fail({"Dimension"}, "it is " + std::to_string(dimension) + ", not 3", "give sizes in three dimensions");
    } else if (keyword == "End") {
      in.fail({"keyword 'SolAtVertices'"}, "the file ends without it", scalar_remedy);
    }
    keyword = in.word({"keyword 'SolAtVertices'"});
  }
  const std::size_t count = in.count({"number of sizes"}, 2);
  if (const std::int64_t fields = in.integer({"number of fields"}); fields != 1)
    in.fail({"number of fields"}, "there are " + std::to_string(fields) + " values or more a vertex, not 1",
            scalar_remedy);
  if (const std::int64_t type = in.integer({"type of the field"}); type != 1)
    in.fail({"type of the field"},
            type == 2   ? "it is 2, a vector, not 1, a scalar"
            : type == 3 ? "it is 3, a tensor (an anisotropic metric), not 1, a scalar"
                        : "it is " + std::to_string(type) + ", not 1, a scalar",
            scalar_remedy);
  return count;
}

BackgroundSizes read_sol(const std::filesystem::path& file) {
  const FileBytes bytes = read_whole_file(file);
  TextScanner in(bytes);
  const std::size_t count = read_sol_head(in);
  const std::filesystem::path beside = sibling(file, ".mesh");
  if (!is_there(beside)) fail_without_background(file, ".mesh");
  MeditFile mesh = read_medit(read_whole_file(beside), true);
  BackgroundSizes result;
  result.mesh_name = beside.string();
  result.sizes = read_values(in, count, mesh.vertices.size(), beside);
  result.vertices = std::move(mesh.vertices);
  result.tetrahedra = std::move(mesh.tetrahedra.corners);
  return result;
}

std::filesystem::path background_of_mtr(const std::filesystem::path& file) {
  for (const char* ending : {".node", ".poly", ".smesh"})
    if (is_there(sibling(file, ending))) return sibling(file, ending);
  fail_without_background(file, ".node, .poly or .smesh");
}

BackgroundSizes read_mtr(const std::filesystem::path& file) {
  const FileBytes bytes = read_whole_file(file);
  TextScanner in(bytes);
  const std::size_t count = in.count({"number of sizes"}, 2);
  if (const std::int64_t values = in.at_line_end() ? 1 : in.integer({"values a vertex"}); values != 1)
    in.fail({"values a vertex"}, "they are " + std::to_string(values) + ", not 1", scalar_remedy);
  in.skip_line();
  const std::filesystem::path beside = background_of_mtr(file);
  BackgroundSizes result;
  result.mesh_name = beside.string();
  const std::filesystem::path cells = sibling(file, ".ele");
  if (beside.extension() == ".node" && is_there(cells)) {
    TetMesh mesh = read_tetgen_mesh(cells);
    result.vertices = std::move(mesh.vertices);
    result.tetrahedra = std::move(mesh.tetrahedra);
  } else {
    const FileBytes nodes = read_whole_file(beside);
    TextScanner node_in(nodes);
    result.vertices = read_tetgen_nodes(node_in).vertices;
  }
  result.sizes = read_values(in, count, result.vertices.size(), beside);
  return result;
}

}  // namespace

BackgroundSizes read_sizes(const std::filesystem::path& file) {
  const std::string ending = lower_ending(file);
  check_is_file(file);
  if (ending != ".sol" && ending != ".mtr")
    throw InputError("no format of size functions has this ending", place_in(file.string()), "use one of .sol .mtr");
  BackgroundSizes sizes = ending == ".sol" ? read_sol(file) : read_mtr(file);
  sizes.name = file.string();
  return sizes;
}

}  // namespace ccdt
