#include "tools/read_cad.h"

#include <algorithm>
#include <array>
#include <string>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "engine/io/plc_files.h"

namespace ccdt::tools {

bool is_cad_file(const std::filesystem::path& file) {
  constexpr std::array endings = {".step", ".stp", ".iges", ".igs", ".brep"};
  return std::ranges::find(endings, io::lower_ending(file)) != endings.end();
}

plc::InputPlc read_cad(const std::filesystem::path& file) {
  const auto gmsh = baselines::find_program("gmsh", "GMSH");
  if (!gmsh)
    throw InputError("a CAD file is read by Gmsh, and there is no program 'gmsh'", io::place_in(file.string()),
                     "install it (package gmsh), set GMSH to its path, or give a surface, such as STL");
  if (!std::filesystem::exists(file))
    throw InputError("no such file", io::place_in(file.string()), "check the path and the spelling of the name");
  const baselines::TemporaryFolder folder;
  const std::filesystem::path part = folder.path() / ("part" + io::lower_ending(file)),
                              surface = folder.path() / "surface.stl", log = folder.path() / "log";
  std::filesystem::copy_file(file, part);
  const baselines::ProcessResult ended =
      baselines::run_program({gmsh->string(), part.string(), "-2", "-clcurv", "36", "-setnumber",
                              "Mesh.StlOneSolidPerSurface", "1", "-o", surface.string()},
                             {.folder = folder.path(), .log = log, .limits = baselines::Limits{.seconds = 600}});
  if (ended.kind == baselines::FailureKind::timeout)
    throw LimitError("Gmsh did not triangulate it within ten minutes", io::place_in(file.string()),
                     "export a surface, such as STL, from the CAD program");
  if (ended.status != baselines::RunStatus::ok || !std::filesystem::exists(surface))
    throw InputError("Gmsh could not triangulate it: " + baselines::last_lines(log), io::place_in(file.string()),
                     "open it in Gmsh, or export a surface, such as STL, from the CAD program");
  plc::InputPlc plc = io::read_plc(surface);
  plc.name = file.string();
  return plc;
}

}  // namespace ccdt::tools
