#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/label.h"
#include "base/portable_pose.h"
#include "base/printable_text.h"
#include "base/type_choice.h"
#include "base/xml_parser.h"
#include "base/xml_reader.h"
#include "world/caching_file_provider.h"
#include "world/included_files.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Color = std::array<float, 3>;

/// Maximum length unit; files use kilometres at most.
constexpr double kUnitMax_m = 1000;

class WorldReader {
 public:
  WorldReader(const XmlElement& root, const std::string& file, const FileProvider& files, ErrorList& errors)
      : root_(root, file, errors), files_(files), errors_(errors), includes_(files, errors) {
    world_.name = std::filesystem::path(file).stem().string();
  }

  World read() {
    if (root_.name() != "world") {
      root_.error("is not a world; the first element of a world file is <world>");
      return world_;
    }
    world_.unit_m = root_.number("unit_m", Bounds::positive(kUnitMax_m), 1);
    world_.win_distance_m = root_.length("win_distance", Bounds::positive(), world_.unit_m, kWinDistance_m);
    XmlReader surface = root_.requiredChild("surface");
    readSurface(surface);
    nameScattered();
    if (auto communication = root_.child("communication")) readCommunication(*communication);
    root_.finish();
    checkNeighbours();
    return std::move(world_);
  }

 private:
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
      for (auto& scatter : part->all("scatter")) readScatter(scatter);
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
    map.height_m = reader.length("height", Bounds::positive(), world_.unit_m, map.height_m);
    if (const auto color = readColor(reader)) map.color = *color;
    try {
      if (errors_.count() == faults) readMapSettings(reader, mapFormatOf(map.file), map.reading);
      reader.finish();
      if (errors_.count() == faults) map.plan = readMap(map.file, files_, map.reading);
      for (const auto& start : map.plan.starts) starts_.push_back(portable::compose(map.world_from_map, start));
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

  /// Reads the settings that apply to the format.
  void readMapSettings(XmlReader& reader, MapFormat format, MapReading& reading) {
    if (format == MapFormat::activmedia) return;
    reading.unknown_is_occupied =
        reader.choice<bool>("unknown", {{"free", false}, {"occupied", true}}, reading.unknown_is_occupied);
    if (format == MapFormat::ros_yaml) return;
    auto& thresholds = reading.thresholds;
    thresholds.occupied = reader.number("threshold", {0, 1}, thresholds.occupied);
    thresholds.free = std::min(thresholds.free, thresholds.occupied);
    if (format == MapFormat::gridmap) return;
    reading.pixel_m = reader.length("resolution", Bounds::positive(kCellMax_m / world_.unit_m), world_.unit_m);
    reading.negate = reader.flag("negate", reading.negate);
  }

  void readCommunication(XmlReader& communication) {
    if (communication.has("range")) {
      world_.communication.range_m = length(communication, "range", Bounds::positive());
    }
    world_.communication.loss_probability = communication.number("loss", {0, 1}, 0);
    communication.finish();
  }

  void readObject(XmlReader& object) {
    XmlReader shape = object.requiredChild("shape");
    auto primitive = shape.child("primitive");
    auto robot = shape.child("robot");
    if (!primitive && !robot) shape.error("contains neither a <primitive> nor a <robot>; add one");
    if (primitive && robot) robot->error("is given beside a <primitive>; put each in its own <object>");
    if (primitive) world_.objects.push_back(readPrimitive(*primitive, Place::given));
    if (robot) world_.robots.push_back(readRobot(*robot, Place::given));
    shape.finish();
    object.finish();
  }

  void readScatter(XmlReader& reader) {
    Scatter scatter;
    scatter.line = reader.line();
    const double count = reader.number("count", {1, kScatteredMax});
    if (count != std::floor(count)) reader.errorAt("count", "must be a whole number");
    scatter.count = std::max(1, static_cast<int>(count));
    using enum ScatterPattern;
    scatter.pattern = reader.choice<ScatterPattern>(
        "pattern", {{"uniform", uniform}, {"free", free}, {"grid", grid}, {"ring", ring}}, uniform);
    if (scatter.pattern == ring) {
      scatter.ring_center = {reader.length("x", Bounds::any(), world_.unit_m, 0),
                             reader.length("y", Bounds::any(), world_.unit_m, 0)};
      scatter.ring_radius_m = length(reader, "radius", Bounds::positive());
    } else {
      readArea(reader, scatter);
    }
    scatter.gap_m = reader.length("gap", Bounds::notNegative(), world_.unit_m, 0);
    if (reader.has("direction")) scatter.direction_rad = reader.number("direction", Bounds::any());
    auto primitive = reader.child("primitive");
    auto robot = reader.child("robot");
    if (!primitive && !robot) reader.error("contains neither a <primitive> nor a <robot> to scatter; add one");
    if (primitive && robot) robot->error("is given beside a <primitive>; put each in its own <scatter>");
    if (primitive) scatter.copied = readPrimitive(*primitive, Place::scattered);
    if (robot) scatter.copied = readRobot(*robot, Place::scattered);
    reader.finish();
    scatter_readers_.push_back(reader);
    world_.scatters.push_back(std::move(scatter));
  }

  void readArea(XmlReader& reader, Scatter& scatter) {
    if (!reader.has("xmin") && !reader.has("xmax") && !reader.has("ymin") && !reader.has("ymax")) return;
    const Bounds2D& all = world_.bounds;
    const auto side = [&](const char* name, double otherwise_m) {
      return reader.length(name, Bounds::any(), world_.unit_m, otherwise_m);
    };
    scatter.area = {side("xmin", all.x_min), side("xmax", all.x_max), side("ymin", all.y_min), side("ymax", all.y_max)};
    if (scatter.area->x_min >= scatter.area->x_max || scatter.area->y_min >= scatter.area->y_max) {
      reader.error("has an area without extent; xmin must be below xmax, and ymin below ymax");
    }
  }

  /// Checks that the names of all copies are free. Comes last, so that a conflict is reported at the <scatter>.
  void nameScattered() {
    std::size_t total = 0;
    for (std::size_t i = 0; i < world_.scatters.size(); ++i) {
      const Scatter& scatter = world_.scatters[i];
      XmlReader& reader = scatter_readers_[i];
      total += static_cast<std::size_t>(scatter.count);
      if (total > kScatteredMax) {
        reader.errorAt("count", "makes more than " + std::to_string(kScatteredMax) +
                                    " scattered robots and objects; use smaller counts");
        return;
      }
      for (int k = 1; k <= scatter.count; ++k) {
        const std::string name = scatter.nameOf(k);
        const auto [first, is_new] = line_of_name_.emplace(name, reader.line());
        if (is_new) continue;
        reader.error("'" + quotable(name) + "' is taken already, " + lineText(first->second, reader.line()) +
                     "; scatter with another <name>");
        break;
      }
    }
  }

  /// Whether the place of a robot or an object is given, or that of a <scatter>.
  enum class Place { given, scattered };

  WorldObject readPrimitive(XmlReader& primitive, Place place) {
    WorldObject object;
    object.line = primitive.line();
    if (auto solid = solidIn(primitive)) {
      object.line = solid->line();
      object.name = place == Place::given ? readName(*solid) : solid->word("name");
      object.body = readBody(*solid, place);
      object.stationary = solid->flag("stationary", true);
      solid->finish();
    } else {
      primitive.error("contains neither a <cylinder> nor a <cube>; add one");
    }
    primitive.finish();
    return object;
  }

  RobotPlacement readRobot(XmlReader& robot, Place place) {
    RobotPlacement placement;
    placement.line = robot.line();
    placement.model = robot.word("model", "");
    if (auto solid = solidIn(robot)) {
      placement.name = readRobotName(*solid, place);
      placement.body = readBody(*solid, place);
      placement.world_from_robot = placement.body->world_from_body;
      solid->flag("stationary", false);  // 2005 files set it for robots too; ignored
      solid->finish();
    } else if (robot.has("model")) {
      placement.name = readRobotName(robot, place);
      if (place == Place::given) placement.world_from_robot = readPlace(robot);
      placement.color = readColor(robot);
    } else {
      robot.error("has no body; add a <cylinder> or <cube>, or a <model> that has one");
    }
    for (const auto& sensor : robot.all("sensor")) placement.sensors.push_back(sensor.element());
    if (auto sensors = robot.child("sensors")) {
      for (const auto& sensor : sensors->all()) placement.sensors.push_back(sensor.element());
      sensors->finish();
    }
    readController(robot, placement);
    if (place == Place::given) {
      placement.neighbour = robot.word("neighbour", "");
      if (!placement.neighbour.empty()) neighbours_.emplace_back(robot, world_.robots.size());
    }
    robot.finish();
    return placement;
  }

  /// <controller>NAME</controller>, or <controller name="NAME" PARAMETER="VALUE"…/>.
  void readController(XmlReader& robot, RobotPlacement& placement) {
    const auto& children = robot.element().children;
    const auto found = std::find_if(children.begin(), children.end(),
                                    [](const XmlElement& child) { return child.name == "controller"; });
    placement.controller_line = found == children.end() ? robot.line() : found->line;
    if (found == children.end() || found->attributes.empty()) {
      placement.controller = robot.word("controller", "");
      try {
        if (!placement.controller.empty()) TypeChoice::parse(placement.controller);
      } catch (const ConfigError& error) {
        robot.errorAt("controller", error.what());
      }
      return;
    }
    XmlReader controller = *robot.child("controller");
    TypeChoice choice{controller.word("name"), {}};
    for (const auto& [parameter, value] : found->attributes) {
      if (parameter == "name") continue;
      choice.parameters.emplace_back(parameter, controller.word(parameter));
      if (value.find_first_of(" \t\n") != std::string::npos) controller.errorAt(parameter, "must be a single number");
    }
    controller.finish();
    placement.controller = choice.text();
  }

  /// The <cylinder> or <cube> inside; nullopt if there is none.
  std::optional<XmlReader> solidIn(XmlReader& owner) {
    auto cylinder = owner.child("cylinder");
    auto cube = owner.child("cube");
    if (cylinder && cube) cube->error("is given beside a <cylinder>; keep one");
    return cylinder ? cylinder : cube;
  }

  Body readBody(XmlReader& solid, Place place) {
    Body body;
    if (solid.name() == "cylinder") {
      body.shape = Cylinder{length(solid, "radius", Bounds::positive())};
    } else {
      const double length_m = length(solid, "length", Bounds::positive());
      body.shape = Cube{length_m, length(solid, "width", Bounds::positive())};
    }
    if (place == Place::given) body.world_from_body = readPose(solid);
    body.center_z_m = length(solid, "z");
    body.height_m = length(solid, "height", Bounds::positive());
    if (const auto color = readColor(solid)) body.color = *color;
    body.heat_celsius = solid.number("hot", Bounds::notNegative(), 0);
    return body;
  }

  /// A robot without a position gets the next start pose that a map gives.
  mrpt::math::TPose2D readPlace(XmlReader& robot) {
    if (robot.has("x") || robot.has("y") || next_start_ == starts_.size()) return readPose(robot);
    mrpt::math::TPose2D start = starts_[next_start_++];
    start.phi = robot.number("direction", Bounds::any(), start.phi);
    return start;
  }

  mrpt::math::TPose2D readPose(XmlReader& reader) {
    const double x = length(reader, "x");
    const double y = length(reader, "y");
    return {x, y, reader.number("direction", Bounds::any(), 0)};
  }

  std::optional<Color> readColor(XmlReader& reader) {
    const auto rgb = reader.numbers("color", 3, {0, 1}, {});
    if (rgb.empty()) return std::nullopt;
    return Color{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  }

  std::string readName(XmlReader& reader) {
    std::string name = reader.word("name");
    if (name.empty()) return name;
    const auto [first, is_new] = line_of_name_.emplace(name, reader.line());
    if (!is_new) {
      reader.errorAt("name", "is taken already, " + lineText(first->second, reader.line()) +
                                 "; give each object and robot a name of its own");
    }
    return name;
  }

  /// "in line 5", or "in line 5 of FILE" when this is another file than that of the reported line.
  std::string lineText(const SourceLine& line, const SourceLine& reported) const {
    const std::string text = "in line " + std::to_string(line.number);
    return line.file == reported.file ? text : text + " of " + world_.fileOf(line, root_.file());
  }

  std::string readRobotName(XmlReader& reader, Place place) {
    std::string name = place == Place::given ? readName(reader) : reader.word("name");
    const std::string longest = place == Place::given ? name : name + std::to_string(kScatteredMax);
    if (const std::string fault = robotNameError(longest); !fault.empty()) reader.errorAt("name", fault);
    return name;
  }

  double length(XmlReader& reader, const char* tag, Bounds bounds = Bounds::any()) {
    return reader.length(tag, bounds, world_.unit_m);
  }

  void checkNeighbours() {
    std::vector<std::string> names;
    for (const auto& robot : world_.robots) names.push_back(robot.name);
    for (const auto& scatter : world_.scatters) {
      if (!std::holds_alternative<RobotPlacement>(scatter.copied) || neighbours_.empty()) continue;
      for (int k = 1; k <= scatter.count; ++k) names.push_back(scatter.nameOf(k));
    }
    const std::unordered_set<std::string> known(names.begin(), names.end());
    const std::string fix = "; the robots are: " + listed(names);
    for (auto& [reader, index] : neighbours_) {
      const RobotPlacement& robot = world_.robots[index];
      if (robot.neighbour == robot.name) {
        reader.errorAt("neighbour", "is the robot itself; name another one, or drop it");
      } else if (!known.contains(robot.neighbour)) {
        reader.errorAt("neighbour", "is not the name of a robot" + fix);
      }
    }
  }

  XmlReader root_;
  const FileProvider& files_;
  ErrorList& errors_;
  IncludedFiles includes_;  ///< readers refer to them
  World world_;
  std::unordered_map<std::string, SourceLine> line_of_name_;
  std::vector<mrpt::math::TPose2D> starts_;  ///< start poses given by maps, world frame
  std::size_t next_start_ = 0;
  std::vector<std::pair<XmlReader, std::size_t>> neighbours_;  ///< robots with a neighbour, and their index
  std::vector<XmlReader> scatter_readers_;                     ///< of World::scatters
};

/// Clears the line numbers of a world generated around a map, which refer to no file.
void clearLines(XmlElement& element) {
  element.line.number = 0;
  for (auto& child : element.children) clearLines(child);
}

/// A generated world that consists of one map.
XmlElement worldAround(const std::filesystem::path& map_file, const FileProvider& files) {
  const std::string name = map_file.filename().string();
  const MapFormat format = mapFormatOf(map_file);
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

std::string readWorldText(const std::filesystem::path& file, const FileProvider& files) {
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
    if (isMapFile(file)) clearLines(root);
    return WorldReader(root, file, files, errors).read();
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

World parseWorld(std::string text, const std::string& file, ErrorList& errors) {
  const FileTexts none;
  return parseWorld(std::move(text), file, providerOf(file, none), errors);
}

}  // namespace robosim
