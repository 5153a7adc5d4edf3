#include "world/maps/map_formats.h"

#include <algorithm>

#include "base/error_list.h"
#include "base/text_table.h"
#include "world/maps/picture.h"

namespace robosim {
namespace {

OccupancyGrid readPictureMap(const std::string& bytes, const std::string& path, const MapReading& reading) {
  PixelInterpretation pixels{.thresholds = reading.thresholds, .negate = reading.negate};
  pixels.thresholds.are_inclusive = !reading.is_of_ros1 && !reading.is_of_stage;
  const auto alpha = reading.is_of_stage  ? Picture::Alpha::only_red
                     : reading.is_of_ros1 ? Picture::Alpha::counts
                                          : Picture::Alpha::marks_unknown;
  OccupancyGrid grid = gridOf(readPicture(bytes, path, alpha), pixels);
  grid.cell_m = reading.pixel_m;
  return grid;
}

std::vector<std::string> warningsOf(const OccupancyGrid& grid, MapFormat format) {
  const auto lacks = [&](Occupancy state) {
    return std::find(grid.cells.begin(), grid.cells.end(), state) == grid.cells.end();
  };
  const std::string check = format == MapFormat::ros_yaml  ? "; check its occupied_thresh, free_thresh and negate"
                            : format == MapFormat::picture ? "; check the threshold and negate of its <map>"
                            : format == MapFormat::octomap ? "; check the z_min and z_max of its <map>"
                                                           : "; check the threshold of its <map>";
  std::vector<std::string> warnings;
  if (lacks(Occupancy::occupied)) warnings.push_back("has no occupied cell, and so no walls" + check);
  if (lacks(Occupancy::free)) {
    warnings.push_back("has no free cell, and so no known place for a robot" + check);
  }
  if (grid.transparent > 0) {
    warnings.push_back("has " + withCommas(grid.transparent) +
                       " transparent pixels, which are unknown cells, as in nav2; remove the picture's alpha channel, "
                       "or set map_server=\"ros1\" in its <map>");
  }
  return warnings;
}

/// A plan whose cells are not square, as boxes, which are no cells; unknown cells are left out.
FloorPlan ofRectangularPixels(const FloorPlan& square, double pixel_y_m) {
  FloorPlan plan;
  for (const auto& cells : square.occupied) {
    PlanBox box;
    box.length_m = cells.columns * square.cell_m;
    box.width_m = cells.rows * pixel_y_m;
    box.map_from_box = {(cells.column + cells.columns / 2.0) * square.cell_m,
                        (cells.row + cells.rows / 2.0) * pixel_y_m, 0};
    plan.boxes.push_back(box);
  }
  return plan;
}

FloorPlan readMapFile(const std::string& name, const FileProvider& files, const MapReading& reading) {
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
  switch (recognizeMapFormat(name)) {
    case MapFormat::activmedia:
      return checked(readActivmediaMap(files.read(name), path));
    case MapFormat::gridmap:
      grid = readGridmap(files.read(name), path, reading.thresholds);
      break;
    case MapFormat::simple_map:
      grid = readSimpleMap(files.read(name), path, reading.pixel_m > 0 ? reading.pixel_m : kSimpleMapCell_m,
                           reading.thresholds);
      break;
    case MapFormat::octomap:
      grid = readOctomap(files.read(name), path, reading.slice);
      break;
    case MapFormat::ros_yaml:
      grid = readRosMap(name, files, reading);
      break;
    case MapFormat::picture:
      grid = readPictureMap(files.read(name), path, reading);
      break;
  }
  const double far_m = std::max(grid.columns, grid.rows) * grid.cell_m;
  if (far_m > kMapReach_m)
    throw ConfigError(path + ": reaches over more than 10,000 km; its resolution cannot be right");
  FloorPlan plan = toFloorPlan(grid, reading.unknown_is_occupied);
  if (reading.pixel_y_m > 0) plan = ofRectangularPixels(plan, reading.pixel_y_m);
  plan.warnings = warningsOf(grid, recognizeMapFormat(name));
  return checked(std::move(plan));
}

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& map) {
  std::vector<std::filesystem::path> files{map};
  std::error_code none;
  if (!isMapFile(map) || recognizeMapFormat(map) != MapFormat::ros_yaml ||
      !std::filesystem::is_regular_file(map, none)) {
    return files;
  }
  if (const auto picture = pictureOfRosMap(map); !picture.empty()) files.push_back(picture);
  return files;
}

}  // namespace

MapReaders mapReadersOfAllFormats() { return {.read = readMapFile, .files = filesOf}; }

void useMapFormats() { setMapReaders(mapReadersOfAllFormats()); }

}  // namespace robosim
