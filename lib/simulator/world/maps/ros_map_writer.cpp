#include <cmath>

#include <opencv2/imgcodecs.hpp>
#include <yaml-cpp/yaml.h>

#include "base/xml_element.h"
#include "world/maps/map_writer.h"

namespace robosim {
namespace {

std::string pictureOf(const OccupancyGrid& grid) {
  cv::Mat picture(static_cast<int>(grid.rows), static_cast<int>(grid.columns), CV_8U);
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    auto* pixel = picture.ptr<std::uint8_t>(static_cast<int>(grid.rows - 1 - row));
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const Occupancy cell = grid.at(column, row);
      pixel[column] = cell == Occupancy::free ? 254 : cell == Occupancy::occupied ? 0 : 205;
    }
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
  return {bytes.begin(), bytes.end()};
}

/// Text of a length [m] without digits caused by rounding.
std::string lengthText(double length_m) { return toText(std::round(length_m * 1e9) / 1e9 + 0.0); }

}  // namespace

RosMap toRosMap(const OccupancyGrid& grid, const std::string& picture_name) {
  const auto& corner = grid.map_from_grid;
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "image" << YAML::Value << picture_name;
  yaml << YAML::Key << "resolution" << YAML::Value << toText(grid.cell_m);
  yaml << YAML::Key << "origin" << YAML::Value << YAML::Flow << YAML::BeginSeq << lengthText(corner.x)
       << lengthText(corner.y) << toText(corner.phi) << YAML::EndSeq;
  yaml << YAML::Key << "negate" << YAML::Value << 0;
  yaml << YAML::Key << "occupied_thresh" << YAML::Value << toText(OccupancyThresholds().occupied);
  yaml << YAML::Key << "free_thresh" << YAML::Value << toText(OccupancyThresholds().free);
  yaml << YAML::EndMap;
  return {pictureOf(grid), std::string(yaml.c_str()) + "\n"};
}

}  // namespace robosim
