#include "world/map_reader.h"

#include <algorithm>
#include <cctype>

#include "base/error_list.h"

namespace robosim {
namespace {

MapReaders& mapReaders() {
  static MapReaders readers;
  return readers;
}

}  // namespace

MapFormat recognizeMapFormat(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::pair<const char*, MapFormat> formats[] = {
      {".gridmap", MapFormat::gridmap},      {".gridmap.gz", MapFormat::gridmap},
      {".simplemap", MapFormat::simple_map}, {".simplemap.gz", MapFormat::simple_map},
      {".bt", MapFormat::octomap},           {".ot", MapFormat::octomap},
      {".yaml", MapFormat::ros_yaml},        {".yml", MapFormat::ros_yaml},
      {".png", MapFormat::picture},          {".pgm", MapFormat::picture},
      {".ppm", MapFormat::picture},          {".pbm", MapFormat::picture},
      {".jpg", MapFormat::picture},          {".jpeg", MapFormat::picture},
      {".bmp", MapFormat::picture},          {".map", MapFormat::activmedia}};
  for (const auto& [ending, format] : formats) {
    if (name.ends_with(ending)) return format;
  }
  throw ConfigError(file.string() +
                    ": is not a map by its name; maps end in .gridmap, .simplemap, .bt, .ot, .yaml (of ROS), .png, "
                    ".jpg, .bmp, .pgm, .ppm, .pbm or .map");
}

bool isMapFile(const std::filesystem::path& file) {
  try {
    recognizeMapFormat(file);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

FloorPlan readMap(const std::string& name, const FileProvider& files, const MapReading& reading) {
  if (!mapReaders().read)
    throw ConfigError(files.pathOf(name) +
                      ": this program cannot read maps; it must call useMapFormats() of the library robosim::maps");
  return mapReaders().read(name, files, reading);
}

std::vector<std::filesystem::path> filesOfMap(const std::filesystem::path& map) {
  return mapReaders().files ? mapReaders().files(map) : std::vector<std::filesystem::path>{map};
}

void setMapReaders(const MapReaders& readers) { mapReaders() = readers; }

}  // namespace robosim
