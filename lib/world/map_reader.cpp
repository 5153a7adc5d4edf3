#include "world/map_reader.h"

#include <algorithm>
#include <cctype>

#include "base/error_list.h"
#include "world/picture.h"

namespace robosim {
namespace {

OccupancyGrid readPictureMap(const std::string& bytes, const std::string& path, const MapReading& reading) {
  OccupancyGrid grid = gridOf(readPicture(bytes, path, Picture::Alpha::counts),
                              {.thresholds = reading.thresholds, .negate = reading.negate});
  grid.cell_m = reading.pixel_m;
  return grid;
}

}  // namespace

MapFormat mapFormatOf(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::pair<const char*, MapFormat> formats[] = {
      {".gridmap", MapFormat::gridmap}, {".gridmap.gz", MapFormat::gridmap}, {".yaml", MapFormat::ros_yaml},
      {".yml", MapFormat::ros_yaml},    {".png", MapFormat::picture},        {".pgm", MapFormat::picture},
      {".ppm", MapFormat::picture},     {".pbm", MapFormat::picture},        {".map", MapFormat::activmedia}};
  for (const auto& [ending, format] : formats) {
    if (name.ends_with(ending)) return format;
  }
  throw ConfigError(file.string() +
                    ": is not a map by its name; maps end in .gridmap, .yaml (of ROS), .png, .pgm, .ppm, .pbm or .map");
}

bool isMapFile(const std::filesystem::path& file) {
  try {
    mapFormatOf(file);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

FloorPlan readMap(const std::string& name, const FileProvider& files, const MapReading& reading) {
  const std::string path = files.pathOf(name);
  const auto checked = [&](FloorPlan plan) {
    const std::size_t solids = plan.occupied.size() + plan.boxes.size();
    const std::size_t boxes = std::max(solids, plan.unknown.size());
    if (boxes <= kMaxMapBoxes) return plan;
    throw ConfigError(path + (solids == boxes ? ": its occupied" : ": its unknown") +
                      " cells are so scattered that they make " + std::to_string(boxes) + " boxes; a map may have " +
                      std::to_string(kMaxMapBoxes) + " at most, so make it smaller, or its cells larger");
  };
  OccupancyGrid grid;
  switch (mapFormatOf(name)) {
    case MapFormat::activmedia:
      return checked(readActivmediaMap(files.read(name), path));
    case MapFormat::gridmap:
      grid = readGridmap(files.read(name), path, reading.thresholds);
      break;
    case MapFormat::ros_yaml:
      grid = readRosMap(name, files);
      break;
    case MapFormat::picture:
      grid = readPictureMap(files.read(name), path, reading);
      break;
  }
  const double far_m = std::max(grid.columns, grid.rows) * grid.cell_m;
  if (far_m > kMapReach_m)
    throw ConfigError(path + ": reaches over more than 10,000 km; its resolution cannot be right");
  return checked(floorPlanOf(grid, reading.unknown_is_occupied));
}

}  // namespace robosim
