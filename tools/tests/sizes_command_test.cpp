#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/point.h"
#include "engine/io/tet_mesh_files.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// A plate of 100 x 60 x 10 with a hole of radius 8 in its middle, as a CAD program writes it: few, long triangles, and
/// one named solid for each of its faces.
class Plate {
 public:
  Plate() {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      circle_.push_back({50 + 8 * std::cos(angle), 30 + 8 * std::sin(angle), 0});
    }
    const Point3 up{0, 0, 10};
    begin("hole");
    for (int i = 0; i < sides; ++i) add_quad(at(i), at(i) + up, at(i + 1) + up, at(i + 1));
    begin("bottom");
    add_ring({});
    begin("top");
    add_ring(up);
    for (int k = 0; k < 4; ++k) {
      begin("side" + std::to_string(k));
      add_quad(corner(k), corner(k + 1), corner(k + 1) + up, corner(k) + up);
    }
    text_ << "endsolid " << name_ << "\n";
  }
  std::string text() const { return text_.str(); }

 private:
  static constexpr int sides = 24;

  const Point3& at(int i) const { return circle_[static_cast<std::size_t>(i % sides)]; }
  static Point3 corner(int k) {
    constexpr std::array<std::array<double, 2>, 4> corners = {{{100, 60}, {0, 60}, {0, 0}, {100, 0}}};
    const auto& [x, y] = corners[static_cast<std::size_t>(k % 4)];
    return {x, y, 0};
  }
  void begin(const std::string& name) {
    if (!name_.empty()) text_ << "endsolid " << name_ << "\n";
    name_ = name;
    text_ << "solid " << name_ << "\n";
  }
  void add(const Point3& a, const Point3& b, const Point3& c) {
    text_ << "facet normal 0 0 0\nouter loop\n";
    for (const Point3& p : {a, b, c}) text_ << "vertex " << p.x << " " << p.y << " " << p.z << "\n";
    text_ << "endloop\nendfacet\n";
  }
  void add_quad(const Point3& a, const Point3& b, const Point3& c, const Point3& d) { add(a, b, c), add(a, c, d); }
  /// Between the circle and the rectangle. `check --repair` is not needed: orientations of an STL do not matter.
  void add_ring(const Point3& shift) {
    for (int k = 0; k < 4; ++k) {
      for (int i = k * sides / 4; i < (k + 1) * sides / 4; ++i)
        add(at(i) + shift, at(i + 1) + shift, corner(k) + shift);
      add(at(k * sides / 4) + shift, corner(k) + shift, corner(k + 3) + shift);
    }
  }

  std::vector<Point3> circle_;
  std::ostringstream text_;
  std::string name_;
};

constexpr const char* fine_hole =
    R"({"schema": "ccdt.sizefield/1", "sizes": [{"edge_length": 2, "markers": ["hole"]}]})";

/// The mean length of the edges of faces, by the physical name of their marker.
std::map<std::string, double> mean_lengths(const std::filesystem::path& file) {
  std::map<int, std::string> names;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line) && line != "$EndPhysicalNames";) {
    int dimension = 0, marker = 0;
    std::string name;
    if (std::istringstream(line) >> dimension >> marker >> std::quoted(name) && dimension == 2) names[marker] = name;
  }
  const mesh::TetMesh mesh = io::read_tet_mesh(file);
  std::map<std::string, double> sums, counts;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string& name = names[mesh.face_markers[f]];
      sums[name] += length(mesh.vertices[mesh.faces[f][i]] - mesh.vertices[mesh.faces[f][(i + 1) % 3]]);
      ++counts[name];
    }
  for (auto& [name, sum] : sums) sum /= counts[name];
  return sums;
}

TEST_F(Program, MakesAPartFineAtAHoleAndCoarseElsewhereInOneCommand) {
  write("plate.stl", Plate().text());
  write("f.json", fine_hole);
  for (const char* surface : {"refine", "remesh"}) {
    SCOPED_TRACE(surface);
    const Outcome outcome =
        run(std::string("mesh plate.stl -o plate.msh --edge-length 8 --size-field f.json --surface ") + surface +
            " --most-tetrahedra 25000 --report r.json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(text_of(work() / "r.json"));
    EXPECT_GT(report["quality"]["dihedral_degrees"]["min"], 20);
    const auto lengths = mean_lengths(work() / "plate.msh");
    ASSERT_EQ(lengths.size(), 7u) << "a name was lost";
    EXPECT_NEAR(lengths.at("hole"), 2, 0.5);
    for (int k = 0; k < 4; ++k) EXPECT_GT(lengths.at("side" + std::to_string(k)), 5);
  }
  EXPECT_EQ(run("mesh plate.stl -o plate.msh --edge-length 8 --size-field f.json --surface refine").exit_code, 0);
  EXPECT_EQ(run("verify plate.stl plate.msh").exit_code, 0);
}

TEST_F(Program, TellsWhatIsWrongWithASizeField) {
  write("plate.stl", Plate().text());
  const auto code = [&](const std::string& text, const std::string& more = "") {
    write("f.json", text);
    return run("mesh plate.stl -o plate.vtu --edge-length 8 --size-field f.json " + more).exit_code;
  };
  EXPECT_EQ(code(fine_hole), 0);
  EXPECT_EQ(code("{}"), 3);
  EXPECT_EQ(code("nonsense"), 3);
  const auto size = [](const std::string& members) {
    return R"({"schema": "ccdt.sizefield/1", "sizes": [{)" + members + "}]}";
  };
  EXPECT_EQ(code(size(R"("edge_length": 3)")), 0);
  EXPECT_EQ(code(size(R"("markers": ["hole"])")), 3);
  EXPECT_EQ(code(size(R"("edge_length": 0, "markers": ["hole"])")), 3);
  EXPECT_EQ(code(size(R"("edge_length": 3, "markers": ["whole"])")), 3);
  EXPECT_EQ(code(size(R"("edge_length": 3, "markers": [99])")), 3);
  EXPECT_EQ(code(size(R"("edge_length": 3, "marker": ["hole"])")), 3);
  EXPECT_EQ(code(size(R"("edge_length": 3, "boxes": [{"low": [1, 1, 1], "high": [0, 2, 2]}])")), 3);
  EXPECT_EQ(code(size(R"("volume": 300, "regions": [1])"), "--surface refine"), 0);
  EXPECT_EQ(code(size(R"("volume": 3)")), 3);
  EXPECT_EQ(code(fine_hole, "--grading 0"), 3);
  EXPECT_EQ(code(fine_hole, "--most-tetrahedra 100"), 4);
  EXPECT_EQ(run("mesh plate.stl -o plate.vtu --size-field none.json").exit_code, 3);
}

TEST_F(Program, NumbersOnTheCommandLineReplaceThoseOfASizeField) {
  write("plate.stl", Plate().text());
  write("f.json", R"({"schema": "ccdt.sizefield/1", "curvature_angle": 40, "elements_through": 1})");
  const auto tetrahedra = [&](const std::string& more) {
    const Outcome outcome =
        run("mesh plate.stl -o plate.vtu --edge-length 12 --surface remesh --report r.json " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(text_of(work() / "r.json"))["counts"]["tetrahedra"].get<int>();
  };
  EXPECT_EQ(tetrahedra("--size-field f.json --elements-through 4"),
            tetrahedra("--curvature-angle 40 --elements-through 4"));
  EXPECT_GT(tetrahedra("--size-field f.json --elements-through 4"), 2 * tetrahedra("--size-field f.json"));
}

TEST_F(Program, ReachesANumberOfTetrahedraWithAnyMesher) {
  write("plate.stl", Plate().text());
  for (const char* options :
       {"--surface refine", "--surface remesh --edge-length 8", "--edge-length 6 --surface remesh --mesher tetgen"}) {
    SCOPED_TRACE(options);
    const Outcome outcome =
        run(std::string("mesh plate.stl -o plate.vtu --tetrahedra 15000 --report r.json ") + options);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(text_of(work() / "r.json"));
    EXPECT_NEAR(report["counts"]["tetrahedra"].get<double>(), 15000, 750);
    EXPECT_EQ(report["options"]["tetrahedra"], 15000);
  }
}

}  // namespace
}  // namespace ccdt
