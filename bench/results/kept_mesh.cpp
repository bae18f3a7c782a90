#include "bench/results/kept_mesh.h"

#include <nettle/base64.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/run/json.h"

namespace ccdt::results {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays of ccdt.mesh/1 are little-endian");

std::string base64(const std::string& bytes) {
  std::string text(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
  base64_encode_raw(text.data(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  return text;
}

std::string deflated(const void* data, std::size_t size) {
  uLongf length = compressBound(size);
  std::string bytes(length, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &length, static_cast<const Bytef*>(data), size,
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::bad_alloc();  // nothing else can go wrong if there is enough room
  bytes.resize(length);
  return bytes;
}

std::string from_base64(const std::string& text) {
  std::string bytes(BASE64_DECODE_LENGTH(text.size()), '\0');
  std::size_t length = bytes.size();
  base64_decode_ctx context;
  base64_decode_init(&context);
  if (base64_decode_update(&context, &length, reinterpret_cast<std::uint8_t*>(bytes.data()), text.size(),
                           text.data()) != 1 ||
      base64_decode_final(&context) != 1)
    throw std::runtime_error("not in base64");
  bytes.resize(length);
  return bytes;
}

std::string inflated(const std::string& bytes) {
  std::string text;
  for (std::size_t room = 8 * bytes.size() + 64;; room *= 4) {
    text.resize(room);
    uLongf length = text.size();
    const int code = uncompress(reinterpret_cast<Bytef*>(text.data()), &length,
                                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (code == Z_OK) {
      text.resize(length);
      return text;
    }
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code != Z_BUF_ERROR || room > std::numeric_limits<std::uint32_t>::max())
      throw std::runtime_error("zlib could not inflate " + std::to_string(bytes.size()) + " bytes");
  }
}

}  // namespace

std::string unpacked(const std::string& text) {
  return inflated(from_base64(text));
}

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
