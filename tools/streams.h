#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/io/files.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::tools {

/// Is this `-`? As the name of a file it stands for standard input or standard output.
bool is_stream(const std::string& name);

/// The names for people.
std::string name_of_input(const std::string& name);
std::string name_of_output(const std::string& name);

/// All of standard input, which is read when this is called first. \throw InputError  it is empty, or cannot be read
const io::FileBytes& standard_input();

/// Adds an option for the format of an input, if that is not shown by its name. \param option  "--input-format"
void add_input_format(CLI::App& verb, const std::string& option, std::string& format,
                      const std::vector<std::string>& formats);

/// Adds --format for a surface that may be written to standard output.
void add_surface_format(CLI::App& verb, std::string& format);

/// `io::read_plc` and `io::read_tet_mesh` of a file or of standard input.
/// \param format  empty: that of the extension or, of some surfaces, that of the first word. Of a mesh, it has one file
plc::InputPlc read_plc(const std::string& name, const std::string& format);
mesh::TetMesh read_tet_mesh(const std::string& name, const std::string& format);

/// Gives standard output to the one of these files that it is. Words then go to standard error.
/// \throw CLI::ValidationError  several are standard output
void give_standard_output(const std::vector<std::string>& names);

/// Checks, if a mesh will be written to standard output, that its format is known and is one file.
/// \throw OutputError
void check_mesh_stream(const std::string& name, const std::string& format);

/// Checks that a surface has a format if it will be written to standard output, and only then.
/// \throw OutputError, CLI::ValidationError
void check_surface_stream(const std::string& name, const std::string& format);

/// Calls `write(file)` with the name. If that is standard output, the file is a temporary one, whose contents go there.
/// \param format  the extension of the temporary file, without the dot
/// \throw OutputError  standard output cannot be written
void write_output(const std::string& name, const std::string& format,
                  const std::function<void(const std::filesystem::path&)>& write);

/// Writes a text to a file, whole or not at all, or to standard output.
void write_text(const std::string& name, const std::string& text);

}  // namespace ccdt::tools
