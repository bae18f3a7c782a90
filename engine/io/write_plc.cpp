#include "engine/io/write_plc.h"

#include "engine/base/errors.h"
#include "engine/io/plc_formats.h"

namespace ccdt {

namespace {

constexpr std::size_t any = 0xFFFFFFFFu;

struct Format {
  std::string_view ending;
  void (*write)(const InputPlc&, io::OutputFile&);
  io::FormatLimits limits;
};

constexpr Format formats[] = {
    {".stl", io::write_stl, {.name = "STL", .most_corners = 3, .loose_vertices = false}},
    {".off", io::write_off, {.name = "OFF", .most_corners = any}},
    {".obj", io::write_obj, {.name = "OBJ", .most_corners = any}},
    {".ply", io::write_ply, {.name = "PLY", .most_corners = any}},
    {".poly",
     io::write_poly,
     {.name = ".poly", .most_corners = any, .several_polygons = true, .segments = true, .seeds = true}},
    {".smesh", io::write_smesh, {.name = ".smesh", .most_corners = any, .segments = true, .seeds = true}},
    {".mesh", io::write_medit_plc, {.name = "Medit .mesh", .most_corners = 4, .segments = true}},
};

}  // namespace

void write_plc(const InputPlc& plc, const std::filesystem::path& file) {
  const std::string ending = io::lower_ending(file);
  for (const Format& format : formats) {
    if (format.ending != ending) continue;
    io::check_format_holds(plc, format.limits, file.string());
    io::OutputFile out(file);
    format.write(plc, out);
    out.commit();
    return;
  }
  throw OutputError("unknown ending '" + ending + "'", io::place_in(file.string()),
                    "choose one of .stl, .off, .obj, .ply, .poly, .smesh and .mesh");
}

}  // namespace ccdt
