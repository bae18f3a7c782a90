#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::results {

/// Bytes compressed in zlib format, in base64.
std::string packed(const void* data, std::size_t size);
/// The bytes that were packed in this way. \throw std::runtime_error  they were not
std::string unpacked(const std::string& text);

/// Writes a mesh as JSON of schema `ccdt.mesh/1`, small enough for a page: single precision, deflated, in base64.
/// \throw OutputError
void write_kept_mesh(const mesh::TetMesh& mesh, const std::string& title, const std::filesystem::path& file);

}  // namespace ccdt::results
