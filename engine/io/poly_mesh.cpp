#include <algorithm>
#include <tuple>

#include "engine/base/simplex_map.h"
#include "engine/io/formats.h"
#include "engine/io/output_folder.h"
#include "engine/io/plain_names.h"
#include "engine/mesh/boundary_faces.h"

namespace ccdt::io {

namespace {

/// A face of a cell. It faces away from its owner, towards the neighbor, which has the greater number.
struct PolyFace {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t owner;
  std::uint32_t neighbor = none;  ///< none: the face is on the boundary
  bool is_listed = false;         ///< in `mesh.faces`, with this marker
  bool is_flipped = false;        ///< the listed face has the opposite orientation
  int marker = 0;

  bool is_inside() const { return neighbor != none; }
};

/// In OpenFOAM's order: inside by owner and neighbor, which it calls upper-triangular, then on the boundary by marker.
std::vector<PolyFace> poly_faces(const mesh::TetMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> all;
  all.reserve(4 * mesh.tetrahedra.size());
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const auto& face : mesh::outward_faces(tetrahedron)) all.push_back(face);
  const FaceMap first_of(all, mesh.vertices.size()), listed(mesh.faces, mesh.vertices.size());
  std::vector<PolyFace> faces;
  std::vector<std::uint32_t> place(all.size());  // in `faces`, of the first of two equal ones
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const auto [a, b, c] = all[i];
    if (const std::uint32_t first = first_of.find(a, b, c).index; first < i) {
      faces[place[first]].neighbor = i / 4;
      continue;
    }
    place[i] = static_cast<std::uint32_t>(faces.size());
    PolyFace& face = faces.emplace_back(PolyFace{all[i], i / 4});
    const auto [index, is_flipped] = listed.find(a, b, c);
    if (index == none) continue;
    face.is_listed = true, face.is_flipped = is_flipped;
    face.marker = attribute_of(mesh.face_markers, index);
  }
  std::ranges::stable_sort(faces, {}, [](const PolyFace& face) {
    return std::tuple(!face.is_inside(), face.is_inside() ? 0 : face.marker, face.owner, face.neighbor);
  });
  return faces;
}

/// The vertices that cells have get the numbers from 0; the others `none`.
std::vector<std::uint32_t> number_points(const mesh::TetMesh& mesh, std::uint32_t& points) {
  std::vector<std::uint32_t> point_of(mesh.vertices.size(), none);
  for (const auto& corners : mesh.tetrahedra)
    for (const std::uint32_t v : corners) point_of[v] = 0;
  points = 0;
  for (std::uint32_t& point : point_of)
    if (point != none) point = points++;
  return point_of;
}

class PolyMeshWriter {
 public:
  PolyMeshWriter(const mesh::TetMesh& mesh, const std::filesystem::path& target)
      : mesh_(mesh), faces_(poly_faces(mesh)), folder_(target) {
    PlainNames names;
    for (const PolyFace& face : faces_)
      if ((!face.is_inside() || face.is_listed) && !marker_names_.contains(face.marker))
        marker_names_[face.marker] = names.name_of(face.marker, "MARKER_", mesh.face_names);
  }

  void write() {
    write_points_and_faces();
    write_patches();
    write_cell_zones();
    write_face_zones();
    folder_.commit();
  }

 private:
  /// Begins a file, lets `write_content` write the rest, and ends it.
  template <class WriteContent>
  void write_file(const char* name, const char* kind, const WriteContent& write_content) {
    OutputFile out(folder_.file(name));
    out << "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " << kind;
    if (!note_.empty()) out << ";\n    note \"" << note_ << '"';
    out << ";\n    location \"constant/polyMesh\";\n    object " << name << ";\n}\n";
    write_content(out);
    out.commit();
  }

  /// "count ( items )" \param item  as for `write_lines`, without the line's end
  template <class Item>
  static void write_list(std::size_t count, const Item& item, OutputFile& out) {
    out << count << "\n(\n";
    const auto line = [&](std::size_t i, auto& text) {
      item(i, text);
      text << '\n';
    };
    write_lines(count, line, out);
    out << ")\n";
  }

  template <class Item>
  void write_list_file(const char* name, const char* kind, std::size_t count, const Item& item) {
    write_file(name, kind, [&](OutputFile& out) { write_list(count, item, out); });
  }

  void write_points_and_faces() {
    std::uint32_t points = 0;
    const std::vector<std::uint32_t> point_of = number_points(mesh_, points);
    std::vector<std::uint32_t> vertex_of(points);
    for (std::uint32_t v = 0; v < point_of.size(); ++v)
      if (point_of[v] != none) vertex_of[point_of[v]] = v;
    const auto is_on_boundary = [](const PolyFace& face) { return !face.is_inside(); };
    inside_ = static_cast<std::size_t>(std::ranges::find_if(faces_, is_on_boundary) - faces_.begin());
    write_list_file("points", "vectorField", points,
                    [&](std::size_t i, auto& text) { text << '(' << mesh_.vertices[vertex_of[i]] << ')'; });
    write_list_file("faces", "faceList", faces_.size(), [&](std::size_t i, auto& text) {
      const auto [a, b, c] = faces_[i].corners;
      text << "3(" << point_of[a] << ' ' << point_of[b] << ' ' << point_of[c] << ')';
    });
    note_ = "nPoints:" + std::to_string(points) + " nCells:" + std::to_string(mesh_.tetrahedra.size()) +
            " nFaces:" + std::to_string(faces_.size()) + " nInternalFaces:" + std::to_string(inside_);
    write_list_file("owner", "labelList", faces_.size(), [&](std::size_t i, auto& text) { text << faces_[i].owner; });
    write_list_file("neighbour", "labelList", inside_, [&](std::size_t i, auto& text) { text << faces_[i].neighbor; });
    note_.clear();
  }

  void write_patches() {
    std::map<int, std::pair<std::size_t, std::size_t>> patches;  // where each begins, and how many faces it has
    for (std::size_t i = inside_; i < faces_.size(); ++i)
      ++patches.try_emplace(faces_[i].marker, i, 0).first->second.second;
    write_file("boundary", "polyBoundaryMesh", [&](OutputFile& out) {
      out << patches.size() << "\n(\n";
      for (const auto& [marker, range] : patches)
        out << marker_names_.at(marker) << "\n{\n    type patch;\n    nFaces " << range.second << ";\n    startFace "
            << range.first << ";\n}\n";
      out << ")\n";
    });
  }

  void write_cell_zones() {
    const ElementGroups regions = group_elements(mesh_.tetrahedra.size(), mesh_.regions);
    if (regions.size() < 2) return;
    PlainNames names;
    write_file("cellZones", "regIOobject", [&](OutputFile& out) {
      out << regions.size() << "\n(\n";
      for (const auto& [region, cells] : regions) {
        out << names.name_of(region, "REGION_") << "\n{\n    type cellZone;\n    cellLabels List<label> ";
        write_list(
            cells.size(), [&list = cells](std::size_t i, auto& text) { text << list[i]; }, out);
        out << ";\n}\n";
      }
      out << ")\n";
    });
  }

  /// The facets inside. A face is flipped if its zone faces the other way.
  void write_face_zones() {
    ElementGroups zones;
    for (std::uint32_t i = 0; i < inside_; ++i)
      if (faces_[i].is_listed) zones[faces_[i].marker].push_back(i);
    if (zones.empty()) return;
    write_file("faceZones", "regIOobject", [&](OutputFile& out) {
      out << zones.size() << "\n(\n";
      for (const auto& [marker, members] : zones) {
        const auto label = [&list = members](std::size_t i, auto& text) { text << list[i]; };
        const auto flip = [&, &list = members](std::size_t i, auto& text) {
          text << (faces_[list[i]].is_flipped ? 1 : 0);
        };
        out << marker_names_.at(marker) << "\n{\n    type faceZone;\n    faceLabels List<label> ";
        write_list(members.size(), label, out);
        out << ";\n    flipMap List<bool> ";
        write_list(members.size(), flip, out);
        out << ";\n}\n";
      }
      out << ")\n";
    });
  }

  const mesh::TetMesh& mesh_;
  std::vector<PolyFace> faces_;
  std::size_t inside_ = 0;  ///< how many faces are inside; they come first
  std::map<int, std::string> marker_names_;
  std::string note_;  ///< in the head of the next file
  OutputFolder folder_;
};

}  // namespace

void check_replaces_poly_mesh(const std::filesystem::path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (status.type() == std::filesystem::file_type::not_found) return;
  const bool is_poly_mesh = std::ranges::all_of(std::to_array<const char*>({"points", "faces", "owner", "boundary"}),
                                                [&](const char* name) { return is_there(folder / name); });
  if (is_poly_mesh || (std::filesystem::is_directory(status) && std::filesystem::is_empty(folder, error))) return;
  throw OutputError("this is not a polyMesh, so it is not replaced", place_in(folder.string()),
                    "name the folder polyMesh of a case, such as case/constant/polyMesh");
}

void write_poly_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& folder) {
  const auto target = folder.has_filename() ? folder : folder.parent_path();  // the shell may have added a slash
  check_replaces_poly_mesh(target);
  PolyMeshWriter(mesh, target).write();
}

}  // namespace ccdt::io
