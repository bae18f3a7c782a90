#include "engine/io/read_sizes.h"

#include <utility>

#include "engine/io/formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

constexpr const char* scalar_remedy = "write one size per vertex: the target edge length there";

/// The file that the sizes belong to: the first of these beside it.
std::filesystem::path background_of(const std::filesystem::path& file, std::initializer_list<const char*> endings,
                                    const std::string& names) {
  for (const char* ending : endings)
    if (is_there(sibling(file, ending))) return sibling(file, ending);
  throw InputError("there is no " + names + " file of this name beside it, so the positions of the sizes are unknown",
                   place_in(file.string()), "put the mesh of the sizes beside this file, under the same name");
}

/// Reads the number of sizes, which must equal the number of vertices.
void read_count(TextScanner& in, const sizes::BackgroundSizes& background) {
  const Item item = "number of sizes";
  const std::size_t count = in.count(item, 2), vertices = background.vertices.size();
  if (count != vertices)
    in.fail(item,
            "there are " + std::to_string(count) + ", but " + background.mesh_name + " has " +
                std::to_string(vertices) + " vertices",
            "put the sizes beside the mesh that they were made for");
  if (count == 0) in.fail(item, "there is no size", "give the size function at one or more vertices");
}

void read_values(TextScanner& in, sizes::BackgroundSizes& background) {
  background.sizes.reserve(background.vertices.size());
  for (std::size_t i = 0; i < background.vertices.size(); ++i) {
    const Item item{"size of vertex", i};
    background.sizes.push_back(in.number(item));
    if (!(background.sizes.back() > 0)) in.fail(item, "it is not greater than 0", scalar_remedy);
  }
  const std::string_view next = in.peek();
  if (!next.empty() && std::string_view("+-.0123456789").find(next[0]) != std::string_view::npos)
    in.fail("sizes", "there is another number after one for each vertex: " + in_quotes(next), scalar_remedy);
}

/// Goes to the relevant section.
void find_sizes(TextScanner& in) {
  in.expect("header", "MeshVersionFormatted", "check that this is a Medit text file");
  in.integer("MeshVersionFormatted");
  const Item section = "keyword 'SolAtVertices'";
  for (std::string_view word = in.word(section); word != "SolAtVertices"; word = in.word(section)) {
    if (word == "End") in.fail(section, "the file ends without it", scalar_remedy);
    if (word == "Dimension") in.expect_integer("Dimension", 3, "give sizes in three dimensions");
  }
}

/// Medit gives the number of values per vertex, and the type of each.
void check_scalar(TextScanner& in) {
  in.expect_integer("number of fields", 1, scalar_remedy);
  const std::int64_t type = in.integer("type of the field");
  if (type == 1) return;
  const char* name = type == 2 ? " (a vector)" : type == 3 ? " (a tensor: an anisotropic metric)" : "";
  in.fail("type of the field", "it is " + std::to_string(type) + name + ", not 1 (a scalar)", scalar_remedy);
}

sizes::BackgroundSizes read_sol(const std::filesystem::path& file) {
  const FileBytes bytes = read_whole_file(file);
  const std::filesystem::path beside = background_of(file, {".mesh"}, ".mesh");
  mesh::TetMesh mesh = read_medit_mesh(read_whole_file(beside));
  sizes::BackgroundSizes result;
  result.mesh_name = beside.string();
  result.vertices = std::move(mesh.vertices);
  result.tetrahedra = std::move(mesh.tetrahedra);
  TextScanner in(bytes);
  find_sizes(in);
  read_count(in, result);
  check_scalar(in);
  read_values(in, result);
  return result;
}

sizes::BackgroundSizes read_mtr(const std::filesystem::path& file) {
  const FileBytes bytes = read_whole_file(file);
  const auto beside = background_of(file, {".node", ".poly", ".smesh"}, ".node, .poly or .smesh");
  const std::filesystem::path cells = sibling(file, ".ele");
  sizes::BackgroundSizes result;
  result.mesh_name = beside.string();
  if (beside.extension() == ".node" && is_there(cells)) {
    mesh::TetMesh mesh = read_tetgen_mesh(cells);
    result.vertices = std::move(mesh.vertices);
    result.tetrahedra = std::move(mesh.tetrahedra);
  } else {
    result.vertices = read_node(read_whole_file(beside)).vertices;
  }
  TextScanner in(bytes);
  read_count(in, result);
  if (!in.at_line_end()) in.expect_integer("values per vertex", 1, scalar_remedy, "they are");
  in.skip_line();
  read_values(in, result);
  return result;
}

}  // namespace

sizes::BackgroundSizes read_sizes(const std::filesystem::path& file) {
  const std::string ending = lower_ending(file);
  check_is_file(file);
  if (ending != ".sol" && ending != ".mtr")
    throw InputError("unknown file extension '" + ending + "' of a size function", place_in(file.string()),
                     "use one of .sol .mtr");
  sizes::BackgroundSizes sizes = ending == ".sol" ? read_sol(file) : read_mtr(file);
  sizes.name = file.string();
  return sizes;
}

}  // namespace ccdt::io
