#include <cmath>
#include <vector>

#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "tests/fuzz/targets/right_mesh.h"

// Checks and repairs small surfaces on a coarse grid, with vertices near each other. What is said to be valid must get
// a right mesh.

namespace ccdt::fuzz {
namespace {

using Corners = std::vector<std::uint32_t>;

/// An input that grows by one command after the other.
class SmallInput {
 public:
  explicit SmallInput(Bytes& bytes) : bytes_(bytes) {
    input_.inside = bytes.pick(std::array{InputPlc::Inside::even_odd, InputPlc::Inside::seeds});
    while (!bytes_.empty() && input_.vertices.size() < 60 && input_.facet_count() < 100) obey();
  }

  const InputPlc& input() const { return input_; }

 private:
  void obey() {
    switch (bytes_.below(8)) {
      case 0:
        input_.vertices.push_back(point());
        break;
      case 1:
        input_.vertices.push_back(near(some_vertex()));
        break;
      case 2:
        facet(corners(3));
        break;
      case 3:
        facet(corners(4 + bytes_.below(3)));
        break;
      case 4:
        tetrahedron(corners(4));
        break;
      case 5:
        box(point(), point());
        break;
      case 6:
        segment(corners(2));
        break;
      default:
        seed(point());
    }
  }

  Point3 point() {
    const auto level = [&] { return static_cast<double>(bytes_.below(5)); };
    const double x = level(), y = level(), z = level();
    return {x, y, z};
  }
  Point3 near(const Point3& p) {
    const auto step = [&] {
      const std::uint8_t byte = bytes_.next();
      return byte % 4 < 2 ? 0 : std::ldexp(byte % 4 == 2 ? 1 : -1, -(byte / 4));
    };
    const double x = step(), y = step(), z = step();
    return p + Point3{x, y, z};
  }
  Point3 some_vertex() { return input_.vertices.empty() ? Point3{} : input_.vertices[corner()]; }
  std::uint32_t corner() { return static_cast<std::uint32_t>(bytes_.below(input_.vertices.size())); }
  Corners corners(std::size_t count) {
    Corners corners;
    if (input_.vertices.empty()) input_.vertices.push_back(point());
    while (corners.size() < count) corners.push_back(corner());
    return corners;
  }

  void facet(const Corners& c) {
    const auto number = static_cast<std::uint32_t>(input_.facet_count());
    if (c.size() == 3) {
      input_.triangles.push_back({c[0], c[1], c[2]});
      input_.triangle_numbers.push_back(number);
    } else {
      input_.polygon_facets.push_back({{c}, {}, 0, number});
    }
  }
  void tetrahedron(const Corners& c) {
    facet({c[0], c[2], c[1]});
    facet({c[0], c[1], c[3]});
    facet({c[1], c[2], c[3]});
    facet({c[2], c[0], c[3]});
  }
  void box(const Point3& a, const Point3& b) {
    const auto first = static_cast<std::uint32_t>(input_.vertices.size());
    for (const double z : {a.z, b.z})
      for (const double y : {a.y, b.y})
        for (const double x : {a.x, b.x}) input_.vertices.push_back({x, y, z});
    const std::vector<Corners> sides = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const Corners& s : sides) facet({first + s[0], first + s[1], first + s[2], first + s[3]});
  }
  void segment(const Corners& c) { input_.segments.push_back({c[0], c[1]}); }
  void seed(const Point3& p) {
    const Point3 middle = p + Point3{0.5, 0.5, 0.5};
    if (bytes_.flag())
      input_.holes.push_back(middle);
    else
      input_.regions.push_back({middle, 1, 0});
  }

  Bytes& bytes_;
  InputPlc input_;
};

/// What is wrong with the input is an error exactly if it cannot be meshed.
void try_input(const InputPlc& input) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.threads = 1;
  const bool is_valid = repair::find_faults(input).is_valid();
  const bool is_meshed = accepts([&] { require_right_mesh(input, options, 3); });
  require(is_valid == is_meshed, is_valid ? "a valid input is refused" : "an invalid input is meshed");
}

void try_bytes(Bytes bytes) {
  const InputPlc input = SmallInput(bytes).input();
  try_input(input);
  const repair::Repaired repaired = repair::repair_input(input, {.seconds = 2});
  try_input(repaired.input);
}

}  // namespace
}  // namespace ccdt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ccdt::fuzz::accepts([&] { ccdt::fuzz::try_bytes({data, size}); });
  return 0;
}
