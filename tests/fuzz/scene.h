#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"
#include "engine/plc/input.h"

namespace ccdt::fuzz {

using small_plcs::Random;

/// A piecewise linear complex that is built piece by piece, in or near the cube from 0 to 16. Most coordinates are at a
/// few levels of each axis, so that things touch, line up and share planes.
class Scene {
 public:
  explicit Scene(Random& random);

  /// A body or a thing within it, built by calls of the functions below.
  using Thing = void (*)(Scene&);

  /// Adds a thing, unless the engine's check of its input objects to the result.
  /// \return whether it was added
  bool add(Thing thing);

  Random& random() { return random_; }
  bool chance(std::uint64_t one_in) { return random_.below(one_in) == 0; }
  double level(int axis) { return levels_[axis][random_.below(levels_[axis].size())]; }
  Point3 point() { return {level(0), level(1), level(2)}; }
  /// 2^-k, with k between the two.
  double tiny(int least, int most);

  /// A triangle or a polygon, given by its corners.
  void facet(const std::vector<Point3>& corners, int marker = 0);
  /// A facet across an axis. Edges of other things that lie within it become part of it.
  void rectangle(int axis, double at, const std::array<double, 4>& low_and_high, int marker = 0);
  /// Six rectangles.
  void box(const Point3& low, const Point3& high);
  void segment(const Point3& a, const Point3& b);
  void vertex(const Point3& p) { index_of(p); }
  void hole(const Point3& p) { plc_.holes.push_back(p); }
  void region(const Point3& p, int attribute) { plc_.regions.push_back({p, attribute, 0}); }

  const plc::InputPlc& plc() const { return plc_; }

 private:
  using Edge = std::array<std::uint32_t, 2>;
  struct Rectangle {
    int axis;
    std::uint32_t low, high;  ///< opposite corners
    std::size_t facet;
  };

  std::uint32_t index_of(const Point3& p);
  void note_edge(std::uint32_t a, std::uint32_t b);
  void draw(const Edge& edge, const Rectangle& rectangle);

  Random& random_;
  std::array<std::vector<double>, 3> levels_;
  plc::InputPlc plc_;
  std::map<std::array<double, 3>, std::uint32_t> index_;
  std::vector<Edge> edges_;
  std::vector<Rectangle> rectangles_;
};

/// Bodies: the first thing of a scene.
void box_body(Scene& scene);
void voxel_body(Scene& scene);
void hollow_body(Scene& scene);
void comb_body(Scene& scene);
void screw_body(Scene& scene);
void plates_body(Scene& scene);
void bipyramid_body(Scene& scene);

/// Things within a body.
void loose_rectangle(Scene& scene);
void loose_triangle(Scene& scene);
void fan(Scene& scene);
void bundle_of_segments(Scene& scene);
void comb(Scene& scene);
void screw(Scene& scene);
void stacked_plates(Scene& scene);
void star_of_segments(Scene& scene);
void loose_vertices(Scene& scene);
void chain_of_segments(Scene& scene);

}  // namespace ccdt::fuzz
