#include "baselines/size_field_file.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "baselines/json_schema.h"
#include "baselines/size_field_schema.h"

namespace ccdt::baselines {
namespace {

using FieldJson = nlohmann::ordered_json;

constexpr UserFile size_field_file = {"a size field", size_field_schema, "; the page on meshing has examples"};

Point3 point_of(const FieldJson& json) {
  return {json.at(0), json.at(1), json.at(2)};
}

sizes::LocalSize local_size_of(const FieldJson& json) {
  const FieldJson nothing = FieldJson::array();
  sizes::LocalSize size;
  size.edge_length = json.value("edge_length", 0.0);
  size.volume = json.value("volume", 0.0);
  size.within = json.value("within", 0.0);
  size.segments = json.value("segments", std::vector<int>());
  size.regions = json.value("regions", std::vector<int>());
  for (const FieldJson& marker : json.value("markers", nothing))
    if (marker.is_string())
      size.names.push_back(marker);
    else
      size.markers.push_back(marker);
  for (const FieldJson& box : json.value("boxes", nothing))
    size.boxes.push_back({point_of(box.at("low")), point_of(box.at("high"))});
  for (const FieldJson& ball : json.value("balls", nothing))
    size.balls.push_back({point_of(ball.at("center")), ball.at("radius")});
  return size;
}

}  // namespace

sizes::LocalSizes read_size_field(const std::filesystem::path& file) {
  const FieldJson json = read_user_file(file, size_field_file);
  sizes::LocalSizes local{.name = file.string(),
                          .sizes = {},
                          .curvature_angle = json.value("curvature_angle", 0.0),
                          .elements_through = json.value("elements_through", 0.0)};
  for (const FieldJson& size : json.value("sizes", FieldJson::array())) local.sizes.push_back(local_size_of(size));
  return local;
}

}  // namespace ccdt::baselines
