#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/xml_reader.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Color = std::array<float, 3>;

/// The longest length unit; no file is about more than kilometres.
constexpr double kUnitMax_m = 1000;

class WorldReader {
 public:
  WorldReader(const XmlElement& root, const std::string& file, ErrorList& errors)
      : root_(root, file, errors), errors_(errors) {
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
    if (auto communication = root_.child("communication")) readCommunication(*communication);
    root_.finish();
    checkNeighbours();
    return std::move(world_);
  }

 private:
  void readSurface(XmlReader& surface) {
    world_.surface_type = surface.word("type", "smooth");
    XmlReader size = surface.requiredChild("size");
    const std::size_t faults = errors_.count();
    world_.bounds.x_min = length(size, "xmin");
    world_.bounds.x_max = length(size, "xmax");
    world_.bounds.y_min = length(size, "ymin");
    world_.bounds.y_max = length(size, "ymax");
    if (errors_.count() == faults) {
      const std::string fault = "; the surface must be wider than nothing, so mend one of them";
      if (world_.bounds.x_min >= world_.bounds.x_max) size.errorAt("xmin", "is not below <xmax>" + fault);
      if (world_.bounds.y_min >= world_.bounds.y_max) size.errorAt("ymin", "is not below <ymax>" + fault);
    }
    size.finish();
    for (auto& object : surface.all("object")) readObject(object);
    surface.finish();
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
    if (!primitive && !robot) shape.error("holds neither a <primitive> nor a <robot>; put one in it");
    if (primitive && robot) robot->error("stands beside a <primitive>; give each an <object> of its own");
    if (primitive) readPrimitive(*primitive);
    if (robot) readRobot(*robot);
    shape.finish();
    object.finish();
  }

  void readPrimitive(XmlReader& primitive) {
    WorldObject object;
    object.line = primitive.line();
    if (auto solid = solidIn(primitive)) {
      object.line = solid->line();
      object.name = readName(*solid);
      object.body = readBody(*solid);
      object.stationary = solid->flag("stationary", true);
      solid->finish();
    } else {
      primitive.error("holds neither a <cylinder> nor a <cube>; put one in it");
    }
    primitive.finish();
    world_.objects.push_back(std::move(object));
  }

  void readRobot(XmlReader& robot) {
    RobotPlacement placement;
    placement.line = robot.line();
    placement.model = robot.word("model", "");
    if (auto solid = solidIn(robot)) {
      placement.name = readName(*solid);
      placement.body = readBody(*solid);
      placement.world_from_robot = placement.body->world_from_body;
      solid->flag("stationary", false);  // 2005 says it of robots too; they move
      solid->finish();
    } else if (robot.has("model")) {
      placement.name = readName(robot);
      placement.world_from_robot = readPose(robot);
      placement.color = readColor(robot);
    } else {
      robot.error("has no body; add a <cylinder> or <cube>, or a <model> that has one");
    }
    for (const auto& sensor : robot.all("sensor")) placement.sensors.push_back(sensor.element());
    if (auto sensors = robot.child("sensors")) {
      for (const auto& sensor : sensors->all()) placement.sensors.push_back(sensor.element());
      sensors->finish();
    }
    placement.controller = robot.word("controller", "");
    placement.neighbour = robot.word("neighbour", "");
    if (!placement.neighbour.empty()) neighbours_.emplace_back(robot, world_.robots.size());
    robot.finish();
    world_.robots.push_back(std::move(placement));
  }

  /// The <cylinder> or <cube> inside; nullopt when there is none.
  std::optional<XmlReader> solidIn(XmlReader& owner) {
    auto cylinder = owner.child("cylinder");
    auto cube = owner.child("cube");
    if (cylinder && cube) cube->error("stands beside a <cylinder>; keep one");
    return cylinder ? cylinder : cube;
  }

  Body readBody(XmlReader& solid) {
    Body body;
    if (solid.name() == "cylinder") {
      body.shape = Cylinder{length(solid, "radius", Bounds::positive())};
    } else {
      const double length_m = length(solid, "length", Bounds::positive());
      body.shape = Cube{length_m, length(solid, "width", Bounds::positive())};
    }
    body.world_from_body = readPose(solid);
    body.center_z_m = length(solid, "z");
    body.height_m = length(solid, "height", Bounds::positive());
    if (const auto color = readColor(solid)) body.color = *color;
    body.heat_celsius = solid.number("hot", Bounds::notNegative(), 0);
    return body;
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
    const auto [first, is_new] = line_of_name_.emplace(name, reader.line().number);
    if (!is_new) {
      reader.errorAt("name", "is taken already, in line " + std::to_string(first->second) +
                                 "; give each object and robot a name of its own");
    }
    return name;
  }

  double length(XmlReader& reader, const char* tag, Bounds bounds = Bounds::any()) {
    return reader.length(tag, bounds, world_.unit_m);
  }

  void checkNeighbours() {
    std::vector<std::string> names;
    for (const auto& robot : world_.robots) names.push_back(robot.name);
    const std::unordered_set<std::string> known(names.begin(), names.end());
    const std::string mend = "; the robots are: " + listed(names);
    for (auto& [reader, index] : neighbours_) {
      const RobotPlacement& robot = world_.robots[index];
      if (robot.neighbour == robot.name) {
        reader.errorAt("neighbour", "is the robot itself; name another one, or drop it");
      } else if (!known.contains(robot.neighbour)) {
        reader.errorAt("neighbour", "is the name of no robot" + mend);
      }
    }
  }

  XmlReader root_;
  ErrorList& errors_;
  World world_;
  std::unordered_map<std::string, int> line_of_name_;
  std::vector<std::pair<XmlReader, std::size_t>> neighbours_;  ///< robots that name one, and their index
};

World readFrom(const std::function<XmlElement()>& load, const std::string& file, ErrorList& errors) {
  try {
    return WorldReader(load(), file, errors).read();
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

}  // namespace

World readWorld(const std::filesystem::path& file, ErrorList& errors) {
  return readFrom([&] { return readXmlFile(file); }, file.string(), errors);
}

World parseWorld(const std::string& text, const std::string& file, ErrorList& errors) {
  return readFrom([&] { return parseXml(text, file); }, file, errors);
}

}  // namespace robosim
