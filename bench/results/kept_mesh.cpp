#include "bench/results/kept_mesh.h"

#include <openssl/evp.h>
#include <zlib.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/json.h"

namespace ccdt::results {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays of ccdt.mesh/1 are little-endian");

std::string base64(const std::string& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // with the zero that OpenSSL puts behind it
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string deflated(const void* data, std::size_t size) {
  uLongf length = compressBound(size);
  std::string bytes(length, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &length, static_cast<const Bytef*>(data), size,
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib could not deflate " + std::to_string(size) + " bytes");
  bytes.resize(length);
  return bytes;
}

}  // namespace

std::string packed(const void* data, std::size_t size) {
  return base64(deflated(data, size));
}

void write_kept_mesh(const mesh::TetMesh& mesh, const std::string& title, const std::filesystem::path& file) {
  std::vector<float> points;
  points.reserve(3 * mesh.vertices.size());
  for (const Point3& p : mesh.vertices)
    for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
  const auto bytes_of = [](const auto& array) { return array.size() * sizeof(array[0]); };
  const bench::Json json = {{"schema", "ccdt.mesh/1"},
                            {"title", title},
                            {"vertices", mesh.vertices.size()},
                            {"tetrahedra", mesh.tetrahedra.size()},
                            {"points", packed(points.data(), bytes_of(points))},
                            {"cells", packed(mesh.tetrahedra.data(), bytes_of(mesh.tetrahedra))},
                            {"regions", packed(mesh.regions.data(), bytes_of(mesh.regions))}};
  bench::write_json(json, file);
}

}  // namespace ccdt::results
