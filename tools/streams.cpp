#include "tools/streams.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "baselines/external_program.h"
#include "engine/base/errors.h"
#include "engine/io/formats.h"
#include "engine/io/gzip.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "tools/options.h"
#include "tools/read_cad.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

constexpr std::size_t block = 1 << 16;

io::FileBytes read_standard_input() {
  io::FileBytes input{name_of_input("-"), {}};
  std::array<char, block> bytes;
  while (const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), stdin))
    input.bytes.append(bytes.data(), got);
  if (std::ferror(stdin) != 0) throw InputError("cannot be read", {.file = input.name}, "check what writes to it");
  if (input.bytes.empty()) throw InputError("it is empty", {.file = input.name}, "check what writes to it");
  return input;
}

void check_has_format(const std::string& format) {
  if (format.empty()) throw OutputError("its format is not known", {.file = "standard output"}, "name it by --format");
}

}  // namespace

bool is_stream(const std::string& name) {
  return name == "-";
}

std::string name_of_input(const std::string& name) {
  return is_stream(name) ? "standard input" : name;
}

std::string name_of_output(const std::string& name) {
  return is_stream(name) ? "standard output" : name;
}

const io::FileBytes& standard_input() {
  static const io::FileBytes input = read_standard_input();
  return input;
}

void add_input_format(CLI::App& verb, const std::string& option, std::string& format,
                      const std::vector<std::string>& formats) {
  verb.add_option(option, format, "format of that file, if its name does not show it")->check(one_of(formats));
}

void add_surface_format(CLI::App& verb, std::string& format) {
  verb.add_option("--format", format, "format of standard output, with -o -")
      ->check(one_of(io::plc_format_names(true)));
}

plc::InputPlc read_plc(const std::string& name, const std::string& format) {
  if (is_stream(name)) return io::read_plc(standard_input(), format);
  if (format.empty() && is_cad_file(name)) return read_cad(name);
  return format.empty() ? io::read_plc(name) : io::read_plc(io::read_inflated_file(name), format);
}

mesh::TetMesh read_tet_mesh(const std::string& name, const std::string& format) {
  if (is_stream(name)) return io::read_tet_mesh(standard_input(), format);
  return format.empty() ? io::read_tet_mesh(name) : io::read_tet_mesh(io::read_whole_file(name), format);
}

void give_standard_output(const std::vector<std::string>& names) {
  const auto count = std::ranges::count_if(names, is_stream);
  if (count > 1) throw CLI::ValidationError("-", "standard output can be only one of the files");
  if (count == 1 && !is_quiet()) send_words(Words::to_error);
}

void check_mesh_stream(const std::string& name, const std::string& format) {
  if (!is_stream(name)) return;
  check_has_format(format);
  if (!io::is_one_file(format))
    throw OutputError("the format '" + format + "' is a folder or several files", {.file = "standard output"},
                      "choose mesh, meshb, msh, msh4 or inp, or write it to a file");
}

void check_surface_stream(const std::string& name, const std::string& format) {
  if (is_stream(name)) return check_has_format(format);
  if (!format.empty())
    throw CLI::ValidationError("--format", "it is only for -o -; the extension of a file is its format");
}

void write_output(const std::string& name, const std::string& format,
                  const std::function<void(const std::filesystem::path&)>& write) {
  if (!is_stream(name)) return write(name);
  std::ifstream written;
  {
    const baselines::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / ("output." + format);
    write(file);
    written.open(file, std::ios::binary);
  }
  // The file is open but has no name any more: nothing remains of it, however this process ends.
  if (!written) throw OutputError("cannot be read again", {.file = "the temporary file"}, "allow more open files");
  std::array<char, block> bytes;
  while (written.read(bytes.data(), bytes.size()), written.gcount() > 0)
    print_data({bytes.data(), static_cast<std::size_t>(written.gcount())});
}

void write_text(const std::string& name, const std::string& text) {
  if (is_stream(name)) return print_data(text);
  io::OutputFile file(name);
  file << text;
  file.commit();
}

}  // namespace ccdt::tools
