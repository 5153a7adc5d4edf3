#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file_kind.h"
#include "base/portable_pose.h"
#include "base/xml_parser.h"
#include "base/xml_reader.h"
#include "world/body_xml.h"
#include "world/caching_file_provider.h"
#include "world/included_files.h"
#include "world/placement_reader.h"
#include "world/scatter_reader.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// Maximum length unit; files use kilometres at most.
constexpr double kUnitMax_m = 1000;

/// Reads the elements of a world file, except those of its robots and objects.
class WorldReader {
 public:
  WorldReader(const XmlElement& root, const std::string& file, const FileProvider& files, ErrorList& errors)
      : root_(root, file, errors),
        files_(files),
        errors_(errors),
        includes_(files, errors),
        placements_(world_, root_.file()),
        scatters_(world_, placements_) {
    world_.name = std::filesystem::path(file).stem().string();
  }

  World read() {
    if (root_.name() != "world") {
      root_.error("is not a world; the first element of a world file is <world>");
      return world_;
    }
    world_.unit_m = root_.number("unit_m", Bounds::positive(kUnitMax_m), 1);
    world_.win_distance_m = root_.length("win_distance", Bounds::positive(), world_.unit_m, kWinDistance_m);
    if (root_.has("start_distance"))
      world_.start_distance_m = root_.length("start_distance", Bounds::notNegative(), world_.unit_m);
    XmlReader surface = root_.requiredChild("surface");
    readSurface(surface);
    scatters_.checkNames();
    if (auto communication = root_.child("communication"))
      world_.communication = readCommunication(*communication, world_.unit_m);
    if (auto reference = root_.child("georeference")) world_.georeference = readGeoReference(*reference, world_.unit_m);
    readTimeline();
    root_.finish();
    placements_.checkNeighbours();
    return std::move(world_);
  }

 private:
  using Place = PlacementReader::Place;

  void readSurface(XmlReader& surface) {
    world_.surface_type = surface.word("type", "smooth");
    includes_.read(surface);
    world_.origin.included = includes_.names();
    std::vector<XmlReader*> parts{&surface};
    for (auto& part : includes_.surfaces()) parts.push_back(&part);
    for (auto* part : parts) {
      for (auto& map : part->all("map")) readMapElement(map);
    }
    readSize(surface);
    for (auto* part : parts) {
      for (auto& object : part->all("object")) readObject(object);
      for (auto& scatter : part->all("scatter")) scatters_.read(scatter);
      part->finish();
    }
  }

  void readSize(XmlReader& surface) {
    if (!world_.maps.empty() && !surface.child("size")) {
      takeSizeOfMaps(surface);
      return;
    }
    XmlReader size = surface.requiredChild("size");
    const std::size_t faults = errors_.count();
    world_.bounds.x_min = length(size, "xmin");
    world_.bounds.x_max = length(size, "xmax");
    world_.bounds.y_min = length(size, "ymin");
    world_.bounds.y_max = length(size, "ymax");
    if (errors_.count() == faults) {
      const std::string fault = "; the size of the surface must be positive; fix one of them";
      if (world_.bounds.x_min >= world_.bounds.x_max) size.errorAt("xmin", "is not below <xmax>" + fault);
      if (world_.bounds.y_min >= world_.bounds.y_max) size.errorAt("ymin", "is not below <ymax>" + fault);
    }
    size.finish();
  }

  void takeSizeOfMaps(XmlReader& surface) {
    Bounds2D& all = world_.bounds;
    all = boundsOf(world_.maps[0].plan, world_.maps[0].world_from_map);
    for (const auto& map : world_.maps) {
      const Bounds2D b = boundsOf(map.plan, map.world_from_map);
      all = {std::min(all.x_min, b.x_min), std::max(all.x_max, b.x_max), std::min(all.y_min, b.y_min),
             std::max(all.y_max, b.y_max)};
    }
    if ((all.x_min >= all.x_max || all.y_min >= all.y_max) && errors_.empty()) {
      surface.error(surface.line().number == 0 ? "the map is empty; write a world with a <size> around it"
                                               : "has no <size>, and its maps are empty; add a <size>");
    }
  }

  /// Reads a <map> and the file that it refers to.
  void readMapElement(XmlReader& reader) {
    const std::size_t faults = errors_.count();
    WorldMap map;
    map.line = reader.line();
    map.file = reader.word("file");
    // A map's path is relative to the file that refers to it.
    if (map.line.file > 0 && !map.file.empty() && map.file.front() != '/') {
      map.file = std::filesystem::path(includes_.folderOf(map.line.file) + map.file).lexically_normal().string();
    }
    const auto place = [&](const char* tag) { return reader.length(tag, Bounds::any(), world_.unit_m, 0); };
    map.world_from_map = {place("x"), place("y"), reader.number("direction", Bounds::any(), 0)};
    map.height_m = reader.length("height", Bounds::notNegative(), world_.unit_m, map.height_m);
    if (const auto color = readColor(reader)) map.color = *color;
    try {
      if (errors_.count() == faults) readMapSettings(reader, recognizeMapFormat(map.file), map.reading);
      reader.finish();
      if (errors_.count() == faults) map.plan = readMap(map.file, files_, map.reading);
      for (const auto& start : map.plan.starts) placements_.addStart(portable::compose(map.world_from_map, start));
    } catch (const ConfigError& error) {
      for (const auto& fault : error.errors()) addMapError(reader, map.file, fault);
    }
    world_.maps.push_back(std::move(map));
  }

  /// Reports an error with a line of the map's own file unchanged, and any other at the world's line that refers to the
  /// map.
  void addMapError(XmlReader& reader, const std::string& map_file, const std::string& fault) {
    const std::string path = files_.pathOf(map_file) + ":";
    const bool has_line = fault.starts_with(path) && std::isdigit(static_cast<unsigned char>(fault[path.size()])) != 0;
    if (has_line || reader.line().number == 0) {
      errors_.add(ConfigError(fault));
    } else {
      reader.errorAt("file", fault);
    }
  }

  /// Reads whose rules apply to the pixels.
  static void readMapServer(XmlReader& reader, MapFormat format, MapReading& reading) {
    enum class Rules { nav2, ros1, stage };
    const Rules rules =
        format == MapFormat::picture
            ? reader.choice<Rules>("map_server",
                                   {{"nav2", Rules::nav2}, {"ros1", Rules::ros1}, {"stage", Rules::stage}}, Rules::nav2)
            : reader.choice<Rules>("map_server", {{"nav2", Rules::nav2}, {"ros1", Rules::ros1}}, Rules::nav2);
    reading.is_of_ros1 = rules == Rules::ros1;
    reading.is_of_stage = rules == Rules::stage;
    if (reading.is_of_stage) reading.thresholds = kStageThresholds;
  }

  /// Reads the settings that apply to the format.
  void readMapSettings(XmlReader& reader, MapFormat format, MapReading& reading) {
    if (format == MapFormat::activmedia) return;
    reading.unknown_is_occupied =
        reader.choice<bool>("unknown", {{"free", false}, {"occupied", true}}, reading.unknown_is_occupied);
    if (format == MapFormat::octomap) return readSlice(reader, reading.slice);
    const bool is_of_mrpt = format == MapFormat::gridmap || format == MapFormat::simple_map;
    if (!is_of_mrpt) readMapServer(reader, format, reading);
    if (format == MapFormat::ros_yaml) return;
    auto& thresholds = reading.thresholds;
    if (format == MapFormat::simple_map) thresholds = kSimpleMapThresholds;
    thresholds.occupied = reader.number("threshold", {0, 1}, thresholds.occupied);
    thresholds.free = reading.is_of_stage ? thresholds.occupied : std::min(thresholds.free, thresholds.occupied);
    if (format == MapFormat::gridmap) return;
    const Bounds side = Bounds::positive(kCellMax_m / world_.unit_m);
    if (format == MapFormat::simple_map) {
      reading.pixel_m = reader.length("resolution", side, world_.unit_m, kSimpleMapCell_m);
      return;
    }
    reading.pixel_m = reader.length("resolution", side, world_.unit_m);
    if (reader.has("resolution_y")) reading.pixel_y_m = reader.length("resolution_y", side, world_.unit_m);
    reading.negate = reader.flag("negate", reading.negate);
  }

  void readSlice(XmlReader& reader, HeightSpan& slice) {
    slice.z_min_m = reader.length("z_min", Bounds::any(), world_.unit_m, slice.z_min_m);
    slice.z_max_m = reader.length("z_max", Bounds::any(), world_.unit_m, slice.z_max_m);
    if (slice.z_min_m >= slice.z_max_m)
      reader.errorAt("z_max", "is not above z_min, " + toText(slice.z_min_m) + " m; fix one of them");
  }

  /// <at time="20"> with changes, in seconds of simulated time.
  void readTimeline() {
    for (auto& at : root_.all("at")) {
      const double time_s = at.number("time", Bounds::notNegative());
      for (auto& element : at.all())
        world_.timeline.push_back({time_s, readChange(element, world_.unit_m), element.line()});
      if (at.element().children.empty()) at.error("contains no change; add one, such as <place>");
      at.finish();
    }
    std::stable_sort(world_.timeline.begin(), world_.timeline.end(),
                     [](const TimedChange& a, const TimedChange& b) { return a.time_s < b.time_s; });
  }

  void readObject(XmlReader& object) {
    XmlReader shape = object.requiredChild("shape");
    auto primitive = shape.child("primitive");
    auto robot = shape.child("robot");
    if (!primitive && !robot) shape.error("contains neither a <primitive> nor a <robot>; add one");
    if (primitive && robot) robot->error("is given beside a <primitive>; put each in its own <object>");
    if (primitive) world_.objects.push_back(placements_.readPrimitive(*primitive, Place::given));
    if (robot) world_.robots.push_back(placements_.readRobot(*robot, Place::given));
    shape.finish();
    object.finish();
  }

  double length(XmlReader& reader, const char* tag, Bounds bounds = Bounds::any()) {
    return reader.length(tag, bounds, world_.unit_m);
  }

  XmlReader root_;
  const FileProvider& files_;
  ErrorList& errors_;
  IncludedFiles includes_;  ///< readers refer to them
  World world_;
  PlacementReader placements_;
  ScatterReader scatters_;
};

/// Clears the line numbers of a generated world, which refer to no file.
void clearLines(XmlElement& element) {
  element.line.number = 0;
  for (auto& child : element.children) clearLines(child);
}

/// A generated world that consists of one map.
XmlElement worldAround(const std::filesystem::path& map_file, const FileProvider& files) {
  const std::string name = map_file.filename().string();
  const MapFormat format = recognizeMapFormat(map_file);
  if (format == MapFormat::picture) {
    throw ConfigError(
        map_file.string() +
        ": a picture does not say how large it is; write a world around it, <world><surface><map file=\"" + name +
        "\" resolution=\"0.05\"/></surface></world> for pixels of 5 cm");
  }
  XmlElement root;
  root.name = "world";
  XmlElement& surface = root.add("surface");
  surface.add("map", "").attributes.emplace_back("file", name);
  if (format != MapFormat::activmedia) return root;
  try {
    if (readMap(name, files, {}).starts.empty()) return root;
    XmlElement& robot = surface.add("object").add("shape").add("robot");
    robot.add("model", "pioneer3dx");
    robot.add("name", "Robot1");
  } catch (const ConfigError&) {
    // Reported when the world is read.
  }
  return root;
}

}  // namespace

bool isStageFile(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".world";
}

void requireNameOfKind(const std::filesystem::path& file) {
  struct Ending {
    FileKind kind;
    std::optional<MapFormat> format;  ///< nullopt: no map
    const char* ending;
  };
  const Ending endings[] = {{FileKind::gridmap, MapFormat::gridmap, ".gridmap or .gridmap.gz"},
                            {FileKind::simple_map, MapFormat::simple_map, ".simplemap"},
                            {FileKind::octomap, MapFormat::octomap, ".bt or .ot"},
                            {FileKind::ros_yaml, MapFormat::ros_yaml, ".yaml"},
                            {FileKind::picture, MapFormat::picture, ".png, .pgm, .ppm or .pbm"},
                            {FileKind::jpeg, MapFormat::picture, ".jpg or .jpeg"},
                            {FileKind::bmp, MapFormat::picture, ".bmp"},
                            {FileKind::stage_world, std::nullopt, ".world"},
                            {FileKind::activmedia, MapFormat::activmedia, ".map"},
                            {FileKind::world, std::nullopt, ".xml"},
                            {FileKind::robot_type, std::nullopt, ".xml"},
                            {FileKind::robot_list, std::nullopt, ".xml"},
                            {FileKind::rawlog, std::nullopt, ".rawlog"},
                            {FileKind::carmen_log, std::nullopt, ".log or .clf"}};
  const FileKind kind = kindOfFile(file);
  for (const auto& one : endings) {
    if (kind != one.kind) continue;
    const std::optional<MapFormat> named = isMapFile(file) ? std::optional(recognizeMapFormat(file)) : std::nullopt;
    if (named == one.format && isStageFile(file) == (kind == FileKind::stage_world)) return;
    const std::string what = kindText(kind);
    throw ConfigError(file.string() + ": is " + what.substr(0, what.find(": ")) + ", so that its name must end in " +
                      one.ending + "; rename it");
  }
}

std::string readWorldText(const std::filesystem::path& file, const FileProvider& files) {
  requireKind(file, kWorldKinds);
  requireNameOfKind(file);
  return isMapFile(file) ? toXml(worldAround(file, files)) : readXmlText(file);
}

World readWorld(const std::filesystem::path& file, ErrorList& errors) {
  try {
    const FileProvider files = isMapFile(file) ? cachingFileProvider(filesOnDisk(file)) : filesOnDisk(file);
    return parseWorld(readWorldText(file, files), file.string(), files, errors);
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

World parseWorld(std::string text, const std::string& file, const FileProvider& files, ErrorList& errors) {
  try {
    XmlElement root = parseXml(std::move(text), file);
    if (isMapFile(file) || isStageFile(file)) clearLines(root);
    return WorldReader(root, file, files, errors).read();
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

World parseWorld(std::string text, const std::string& file, ErrorList& errors) {
  const FileTexts none;
  return parseWorld(std::move(text), file, makeProvider(file, none), errors);
}

}  // namespace robosim
