#include "engine/sizes/wanted_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "engine/base/check_arguments.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/sizes/curved_edges.h"
#include "engine/sizes/region_shape.h"
#include "engine/sizes/walls.h"

namespace ccdt::sizes {
namespace {

/// A mesh with such sizes would have far more tetrahedra.
constexpr std::size_t most_places = 1 << 24;

/// At most so many cubes wait for the function at a time.
constexpr std::size_t most_cubes = 1 << 22;

/// Curved surfaces and thin parts never need shorter edges than this share of the usual length.
constexpr double least_share = 0.02;

/// How often a cube around the input is halved before the function is asked.
constexpr int first_halvings = 4;

std::string listed(const std::set<int>& numbers) {
  constexpr std::size_t most = 20;
  std::string text;
  std::size_t count = 0;
  for (const int number : numbers) {
    if (count++ == most) return text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(number);
  }
  return text.empty() ? "none" : text;
}

/// What the numbers of a kind of things are, for messages.
struct Numbers {
  const char* what;
  std::set<int> known;

  void require(const std::vector<int>& wanted, const std::string& file) const {
    for (const int number : wanted)
      if (!known.contains(number))
        throw InputError(std::string("there is no ") + what + " " + std::to_string(number) + " to have an edge length",
                         {.file = file}, "use one of the input's: " + listed(known));
  }
};

Numbers numbers_of_regions(const plc::Plc& plc) {
  Numbers numbers{"region", {}};
  for (const plc::Region& region : plc.regions)
    if (region.inside) numbers.known.insert(region.attribute);
  return numbers;
}

bool has(const std::vector<int>& list, int number) {
  return std::ranges::find(list, number) != list.end();
}

/// Lists the places of one size after another.
class Lister {
 public:
  Lister(const plc::InputPlc& input, const plc::Plc& plc, const LocalSizes& sizes)
      : input_(input), plc_(plc), file_(sizes.name) {
    for (const plc::Facet& facet : plc.facets) markers_.known.insert(facet.marker);
    for (const plc::Segment& segment : plc.segments)
      if (segment.listed) segments_.known.insert(segment.marker);
  }

  void add(const LocalSize& size) {
    const double unit = plc_.grid.unit;
    length_ = size.edge_length / unit;
    if (size.edge_length == 0) length_ = edge_length_for_volume(size.volume) / unit;
    within_ = size.within / unit;
    add_facets(size);
    add_segments(size.segments);
    regions_.require(size.regions, file_);
    for (std::size_t r = 1; r < plc_.regions.size(); ++r)
      if (plc_.regions[r].inside && has(size.regions, plc_.regions[r].attribute)) add_region(RegionId(r));
    for (const Box& box : size.boxes) add(Box{in_grid(box.low), in_grid(box.high)});
    for (const Ball& ball : size.balls) add(Ball{in_grid(ball.center), ball.radius / unit});
  }

  /// The regions that have a largest volume.
  void add_volumes() {
    within_ = 0;
    for (std::size_t r = 1; r < plc_.regions.size(); ++r) {
      if (plc_.regions[r].largest_volume == 0) continue;
      length_ = edge_length_for_volume(plc_.regions[r].largest_volume) / plc_.grid.unit;
      add_region(RegionId(r));
    }
  }

  void add_function(const SizeFunction& function);

  std::vector<SizedPlace> take() && { return std::move(places_); }

 private:
  [[noreturn]] void refuse_too_many() const {
    throw LimitError("the local edge lengths are too short for the places that they are wanted at",
                     {.file = file_.empty() ? plc_.name : file_}, "give longer edges, or smaller places");
  }
  Point3 in_grid(const Point3& p) const { return (1 / plc_.grid.unit) * (p - plc_.grid.origin); }

  void add(const Box& box, double length) {
    if (places_.size() == most_places) refuse_too_many();
    places_.push_back({expanded(box, within_), length});
  }
  void add(const Box& box) { add(box, length_); }

  void add(const Ball& ball) {
    const auto filling = [&](const Box& cube) {
      if (!cube.meets(ball)) return Filling::none;
      const double radius = ball.radius;
      return squared_farthest_distance(cube, ball.center) <= radius * radius ? Filling::all : Filling::part;
    };
    const Point3 radius{ball.radius, ball.radius, ball.radius};
    cover({ball.center - radius, ball.center + radius}, length_, filling, [&](const Box& cube) { add(cube); });
  }

  /// Cuts a triangle, or a segment given as one, into pieces about as long as the edges, so that their boxes are small.
  void add(const Triangle& triangle) {
    const auto [a, b, c] = longest_edge_first(triangle);
    if (length(b - a) <= 2 * length_) return add(bounding_box(std::array{a, b, c}));
    const Point3 middle = 0.5 * (a + b);
    add(Triangle{a, middle, c});
    add(c == b ? Triangle{middle, b, b} : Triangle{middle, b, c});
  }

  void add_facets(const LocalSize& size) {
    markers_.require(size.markers, file_);
    std::vector<int> markers = size.markers;
    for (const std::string& name : size.names) {
      const auto named = std::ranges::find(input_.marker_names, name, [](const auto& pair) { return pair.second; });
      if (named == input_.marker_names.end())
        throw InputError("no facets are called '" + name + "'", {.file = file_},
                         "use one of the input's markers: " + listed(markers_.known));
      markers.push_back(named->first);
    }
    for (const plc::Facet& facet : plc_.facets)
      if (has(markers, facet.marker))
        for (const auto& [a, b, c] : plc_.triangles_of(facet))
          add(Triangle{plc_.vertices[a], plc_.vertices[b], plc_.vertices[c]});
  }

  void add_segments(const std::vector<int>& markers) {
    segments_.require(markers, file_);
    for (const plc::Segment& segment : plc_.segments) {
      if (!segment.listed || !has(markers, segment.marker)) continue;
      const Point3 a = plc_.vertices[segment.ends[0]], b = plc_.vertices[segment.ends[1]];
      add(Triangle{a, b, b});
    }
  }

  void add_region(RegionId region) {
    const RegionShape shape(plc_, region);
    cover(
        cube_around(shape.bounds()), length_, [&](const Box& cube) { return shape.filling_of(cube); },
        [&](const Box& cube) { add(cube); });
  }

  const plc::InputPlc& input_;
  const plc::Plc& plc_;
  const std::string file_;
  Numbers markers_{"facet with marker", {}}, segments_{"segment with marker", {}}, regions_ = numbers_of_regions(plc_);
  double length_ = 0, within_ = 0;  // of the size that is being listed, in grid units
  std::vector<SizedPlace> places_;
};

/// The children of cubes that are longer than the length there.
void Lister::add_function(const SizeFunction& function) {
  within_ = 0;
  std::vector<Box> cubes;
  const Box whole = cube_around(bounding_box(plc_.vertices));
  cover(
      whole, std::ldexp(whole.high.x - whole.low.x, -first_halvings), [](const Box&) { return Filling::part; },
      [&](const Box& cube) { cubes.push_back(cube); });
  while (!cubes.empty()) {
    std::vector<Point3> centers;
    for (const Box& cube : cubes) centers.push_back(plc_.grid.to_world(cube.center()));
    std::vector<double> lengths(cubes.size(), std::numeric_limits<double>::infinity());
    function(centers, lengths);
    std::vector<Box> children;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      if (!(lengths[i] > 0))
        throw InputError("the size function gives the edge length " + digits(lengths[i]),
                         {.file = file_, .points = {as_array(centers[i])}},
                         "give a positive length, or infinity where any length will do");
      const double side = cubes[i].high.x - cubes[i].low.x, wanted = lengths[i] / plc_.grid.unit;
      if (wanted < side)
        cover(
            cubes[i], 0.5 * side, [](const Box&) { return Filling::part; },
            [&](const Box& cube) { children.push_back(cube); });
      else if (wanted < HUGE_VAL)
        add(cubes[i], wanted);
      if (children.size() > most_cubes) refuse_too_many();
    }
    cubes = std::move(children);
  }
}

/// Where the domain is thin, edges get so short that several fit in.
void add_thin_parts(const plc::Plc& plc, double elements, double usual, std::vector<SizedPlace>& places) {
  WallRules rules{.largest = usual, .ratios = {}, .least_size = least_share * usual};
  for (const plc::Facet& f : plc.facets)
    rules.ratios.push_back(
        {plc.regions[f.above].inside ? 1 / elements : 0, plc.regions[f.below].inside ? 1 / elements : 0});
  Walls walls(plc, std::move(rules));
  walls.measure(0, places);
}

}  // namespace

void check_local_sizes(const LocalSizes& sizes) {
  const Place place{.file = sizes.name};
  check_number("angle of curvature", sizes.curvature_angle, 0, most_curvature_angle);
  check_number("number of elements through thin parts", sizes.elements_through, 0, most_elements_through);
  for (const LocalSize& size : sizes.sizes) {
    check_number("local edge length", size.edge_length);
    check_number("largest volume", size.volume);
    check_number("distance of a local edge length", size.within);
    if (size.edge_length == 0 && size.volume == 0)
      throw InputError("a local size has neither an edge length nor a volume", place, "give one of them");
    for (const Box& box : size.boxes)
      if (!is_finite(box.low) || !is_finite(box.high) || box.low != componentwise_min(box.low, box.high))
        throw InputError("a box of a local edge length is not one", place,
                         "give the lower coordinates first, then the higher ones");
    for (const Ball& ball : size.balls)
      if (const bool has_radius = ball.radius >= 0 && ball.radius <= largest_argument;
          !has_radius || !is_finite(ball.center))
        throw InputError("a ball of a local edge length is not one", place, "give a center and a radius");
  }
}

double edge_length_for_volume(double volume) {
  return std::cbrt(6 * std::sqrt(2.0) * volume) / std::sqrt(2.0);
}

void set_volumes(const LocalSizes& sizes, plc::Plc& plc) {
  const Numbers known = numbers_of_regions(plc);
  std::map<int, double> least;  // by attribute: that is all a mesh knows of regions
  const auto limit = [&](int attribute, double volume) {
    double& limited = least.try_emplace(attribute, volume).first->second;
    limited = std::min(limited, volume);
  };
  for (const plc::Region& region : plc.regions)
    if (region.inside && region.largest_volume > 0) limit(region.attribute, region.largest_volume);
  for (const LocalSize& size : sizes.sizes) {
    if (size.volume == 0) continue;
    known.require(size.regions, sizes.name);
    for (const int attribute : size.regions) limit(attribute, size.volume);
  }
  for (plc::Region& region : plc.regions)
    if (region.inside && least.contains(region.attribute)) region.largest_volume = least[region.attribute];
}

std::vector<SizedPlace> wanted_places(const plc::InputPlc& input, const plc::Plc& plc, const LocalSizes& sizes,
                                      double edge_length, double sharp_angle) {
  check_local_sizes(sizes);
  Lister lister(input, plc, sizes);
  for (const LocalSize& size : sizes.sizes) lister.add(size);
  lister.add_volumes();
  if (sizes.function) lister.add_function(sizes.function);
  std::vector<SizedPlace> places = std::move(lister).take();
  if (sizes.curvature_angle > 0)
    add_curved_edges(plc, to_radians(sizes.curvature_angle), sharp_angle, {least_share * edge_length, edge_length},
                     places);
  if (sizes.elements_through > 0) add_thin_parts(plc, sizes.elements_through, edge_length, places);
  return places;
}

}  // namespace ccdt::sizes
