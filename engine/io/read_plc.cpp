#include "engine/io/read_plc.h"

#include "engine/base/errors.h"
#include "engine/io/plc_formats.h"

namespace ccdt {

namespace {

struct Format {
  std::string_view ending;
  InputPlc (*read)(const io::FileBytes&);
};

constexpr Format formats[] = {
    {".stl", io::read_stl},   {".off", io::read_off},     {".obj", io::read_obj},   {".ply", io::read_ply},
    {".poly", io::read_poly}, {".smesh", io::read_smesh}, {".node", io::read_node}, {".mesh", io::read_medit_plc},
};

}  // namespace

InputPlc read_plc(const std::filesystem::path& file) {
  const std::string ending = io::lower_ending(file);
  for (const Format& format : formats) {
    if (format.ending != ending) continue;
    InputPlc plc = format.read(io::read_whole_file(file));
    plc.name = file.string();
    return plc;
  }
  io::check_is_file(file);  // no such file is the better message
  throw InputError("unknown ending '" + ending + "'", io::place_in(file.string()),
                   "known are .stl, .off, .obj, .ply, .poly, .smesh, .node and .mesh: convert or rename the file");
}

}  // namespace ccdt
