// Medit's binary format, .meshb, as the library libMeshb defines it: the number 1, which shows the byte order, the
// version, and then sections "keyword, byte of the next keyword, contents" up to the keyword End. The version
// determines the width of the numbers.

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/io/byte_scanner.h"
#include "engine/io/formats.h"
#include "engine/io/medit.h"

namespace ccdt::io {

namespace {

enum Keyword : std::int32_t {
  dimension_keyword = 3,
  vertices_keyword = 4,
  edges_keyword = 5,
  triangles_keyword = 6,
  quadrilaterals_keyword = 7,
  tetrahedra_keyword = 8,
  end_keyword = 54
};

constexpr std::int32_t own_order = 1, other_order = 1 << 24;

/// The widths of the numbers in a version, in bytes.
struct Version {
  std::int32_t number = 2;

  std::size_t real() const { return number == 1 ? 4 : 8; }
  std::size_t integer() const { return number == 4 ? 8 : 4; }
  std::size_t position() const { return number >= 3 ? 8 : 4; }
  std::size_t head() const { return 4 + position() + integer(); }  ///< of a section with a count
  std::size_t vertex() const { return 3 * real() + integer(); }
  std::size_t element(std::size_t corners) const { return (corners + 1) * integer(); }
};

class MeditReader {
 public:
  explicit MeditReader(const FileBytes& file) : size_(file.bytes.size()), in_(file) {}

  MeditFile read() {
    read_head();
    while (true) {
      const std::size_t begin = in_.position();
      const std::int32_t keyword = in_.next<std::int32_t>("keyword");
      const std::size_t next = read_position();
      if (keyword == end_keyword) break;
      if (next <= begin || next > size_)
        in_.fail("section",
                 "the next one is said to be at byte " + std::to_string(next) + " of " + std::to_string(size_),
                 "the file is truncated or damaged: export it again");
      read_section(keyword);
      if (in_.position() > next) in_.fail("section", "it reaches into the next one", ByteScanner::damaged_remedy);
      in_.move_to(next);
    }
    return std::move(medit_);
  }

 private:
  void read_head() {
    const Item head = "header";
    const std::int32_t order = in_.next<std::int32_t>(head);
    if (order != own_order && order != other_order)
      in_.fail(head, "this is not a binary Medit file", "check the file extension");
    in_.set_big_endian(order == other_order);
    version_.number = in_.next<std::int32_t>(head);
    if (version_.number < 1 || version_.number > 4)
      in_.fail(head, "version " + std::to_string(version_.number) + " is not known",
               "write one of the versions 1 to 4");
    if (const std::int32_t keyword = in_.next<std::int32_t>(head); keyword != dimension_keyword)
      in_.fail(head, "the first keyword is " + std::to_string(keyword) + ", not that of the dimension");
    read_position();
    if (const std::int32_t dimension = in_.next<std::int32_t>(head); dimension != 3)
      in_.fail(head, "the dimension is " + std::to_string(dimension), "give a mesh in three dimensions");
  }

  void read_section(std::int32_t keyword) {
    mesh::TetMesh& mesh = medit_.mesh;
    const std::size_t facets = mesh.faces.size() + medit_.quadrilaterals.size();
    if (keyword == vertices_keyword) {
      version_.real() == 4 ? read_vertices<float>() : read_vertices<double>();
    } else if (keyword == edges_keyword) {
      read_elements({"edge", mesh.edges.size()}, mesh.edges, mesh.edge_markers);
    } else if (keyword == triangles_keyword) {
      medit_.first_triangle = facets;
      read_elements({"facet", facets}, mesh.faces, mesh.face_markers);
    } else if (keyword == quadrilaterals_keyword) {
      medit_.first_quadrilateral = facets;
      read_elements({"facet", facets}, medit_.quadrilaterals, medit_.quadrilateral_references);
    } else if (keyword == tetrahedra_keyword) {
      read_elements({"tetrahedron", mesh.tetrahedra.size()}, mesh.tetrahedra, mesh.regions);
    }
  }

  template <class Real>
  void read_vertices() {
    const std::size_t count = read_count("number of vertices", version_.vertex());
    std::vector<Point3>& vertices = medit_.mesh.vertices;
    vertices.reserve(vertices.size() + count);
    for (std::size_t i = 0; i < count; ++i) {
      const Item vertex{"vertex", i};
      vertices.push_back(in_.point<Real>(vertex));
      in_.skip(vertex, version_.integer());  // its reference
    }
  }

  /// \param item  the first element
  template <std::size_t Corners>
  void read_elements(const Item& item, std::vector<std::array<std::uint32_t, Corners>>& elements,
                     std::vector<int>& references) {
    const std::size_t count = read_count("number of elements", version_.element(Corners));
    elements.reserve(elements.size() + count);
    references.reserve(references.size() + count);
    if (version_.integer() == 4)
      read_elements_of<std::int32_t>(item, count, elements, references);
    else
      read_elements_of<std::int64_t>(item, count, elements, references);
  }

  template <class Integer, std::size_t Corners>
  void read_elements_of(const Item& first, std::size_t count, std::vector<std::array<std::uint32_t, Corners>>& elements,
                        std::vector<int>& references) {
    const std::size_t place = in_.position(), old = elements.size();
    elements.resize(old + count);
    references.resize(old + count);
    const auto read = [&](std::size_t begin, std::size_t end) {
      ByteScanner in = in_;
      in.move_to(place + begin * version_.element(Corners));
      for (std::size_t i = begin; i < end; ++i) {
        const Item item(first.kind, static_cast<std::size_t>(first.number) + i);
        for (std::uint32_t& corner : elements[old + i]) corner = read_index<Integer>(item, in);
        references[old + i] = in.attribute<Integer>(item);
      }
    };
    try {
      parallel_ranges(count, 8192, read);
    } catch (const InputError&) {
      read(0, count);  // the first error of the file is the one to report
    }
    in_.move_to(place + count * version_.element(Corners));
  }

  template <class Integer>
  std::uint32_t read_index(const Item& item, ByteScanner& in) const {
    const Integer index = in.next<Integer>(item);
    const std::size_t vertices = medit_.mesh.vertices.size();
    if (index < 1 || static_cast<std::size_t>(index) > vertices)
      in.fail(item, "vertex index " + std::to_string(index) + " is out of range: " + std::to_string(vertices) +
                        " vertices come before it, counted from 1");
    return static_cast<std::uint32_t>(index - 1);
  }

  std::size_t read_count(const Item& item, std::size_t bytes_each) {
    return version_.integer() == 4 ? in_.count<std::int32_t>(item, bytes_each)
                                   : in_.count<std::int64_t>(item, bytes_each);
  }
  std::size_t read_position() {
    const Item item = "position";
    return version_.position() == 4 ? in_.next<std::uint32_t>(item) : in_.next<std::uint64_t>(item);
  }

  std::size_t size_;
  ByteScanner in_;
  Version version_;
  MeditFile medit_;
};

class MeditWriter {
 public:
  /// \param surface  null, or the file that `mesh` belongs to, which may also have quadrilaterals
  MeditWriter(const mesh::TetMesh& mesh, const MeditFile* surface, OutputFile& out)
      : mesh_(mesh), surface_(surface), out_(out) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (std::max({mesh.vertices.size(), mesh.tetrahedra.size(), mesh.faces.size(), mesh.edges.size(),
                  quadrilaterals()}) > most)
      version_.number = 4;
    else if (file_size() > most)
      version_.number = 3;
  }

  /// \param claim  follows the keyword End, where other readers do not look
  void write(std::string_view claim) {
    out_.raw(own_order).raw(version_.number);
    begin_section(dimension_keyword, dimension_size());
    out_.raw(std::int32_t{3});
    begin_section(vertices_keyword, mesh_.vertices.size(), version_.vertex());
    for (const Point3& p : mesh_.vertices) {
      out_.raw(p.x).raw(p.y).raw(p.z);
      write_integer(0);
    }
    write_elements(edges_keyword, mesh_.edges, mesh_.edge_markers);
    write_elements(triangles_keyword, mesh_.faces, mesh_.face_markers);
    if (surface_) write_elements(quadrilaterals_keyword, surface_->quadrilaterals, surface_->quadrilateral_references);
    write_elements(tetrahedra_keyword, mesh_.tetrahedra, mesh_.regions);
    out_.raw(std::int32_t{end_keyword});
    write_position(0);
    out_ << claim;
  }

 private:
  std::size_t quadrilaterals() const { return surface_ ? surface_->quadrilaterals.size() : 0; }
  std::size_t dimension_size() const { return 8 + version_.position(); }

  /// The size or a little more, since sections without elements are not written.
  std::size_t file_size() const {
    return 1000 + mesh_.vertices.size() * version_.vertex() + mesh_.edges.size() * version_.element(2) +
           mesh_.faces.size() * version_.element(3) +
           (mesh_.tetrahedra.size() + quadrilaterals()) * version_.element(4);
  }

  template <std::size_t Corners>
  void write_elements(Keyword keyword, const std::vector<std::array<std::uint32_t, Corners>>& elements,
                      const std::vector<int>& references) {
    if (elements.empty()) return;
    begin_section(keyword, elements.size(), version_.element(Corners));
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (const std::uint32_t v : elements[i]) write_integer(std::int64_t{v} + 1);
      write_integer(attribute_of(references, i));
    }
  }

  void begin_section(Keyword keyword, std::size_t bytes) {
    position_ += bytes;
    out_.raw(static_cast<std::int32_t>(keyword));
    write_position(position_);
  }
  void begin_section(Keyword keyword, std::size_t count, std::size_t bytes_each) {
    begin_section(keyword, version_.head() + count * bytes_each);
    write_integer(static_cast<std::int64_t>(count));
  }
  void write_position(std::size_t position) {
    if (version_.position() == 4)
      out_.raw(static_cast<std::uint32_t>(position));
    else
      out_.raw(static_cast<std::uint64_t>(position));
  }
  void write_integer(std::int64_t value) {
    if (version_.integer() == 4)
      out_.raw(static_cast<std::int32_t>(value));
    else
      out_.raw(value);
  }

  const mesh::TetMesh& mesh_;
  const MeditFile* surface_;
  OutputFile& out_;
  Version version_;
  std::size_t position_ = 8;  ///< where the next section begins; at first, after the version
};

/// Where our claims are.
std::string_view tail_of(const FileBytes& file) {
  constexpr std::size_t longest = 128;
  const std::string_view bytes = file.bytes;
  return bytes.substr(bytes.size() - std::min(bytes.size(), longest));
}

}  // namespace

plc::InputPlc read_meditb_plc(const FileBytes& file) {
  using Inside = plc::InputPlc::Inside;
  return plc_of(MeditReader(file).read(), tail_of(file).ends_with(even_odd_claim) ? Inside::even_odd : Inside::seeds);
}

mesh::TetMesh read_meditb_mesh(const FileBytes& file) {
  mesh::TetMesh mesh = MeditReader(file).read().mesh;
  take_claims(tail_of(file), mesh);
  return mesh;
}

void write_meditb_plc(const plc::InputPlc& plc, OutputFile& out) {
  const MeditFile medit = medit_of(plc);
  MeditWriter(medit.mesh, &medit, out).write(plc.inside == plc::InputPlc::Inside::even_odd ? even_odd_claim : "");
}

void write_meditb_mesh(const mesh::TetMesh& mesh, OutputFile& out) {
  MeditWriter(mesh, nullptr, out).write(claims_of(mesh));
}

}  // namespace ccdt::io
