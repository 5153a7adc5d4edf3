#include <algorithm>
#include <cassert>
#include <charconv>

#include "base/type_choice.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// The shortest text that, parsed as a double, gives exactly `value`.
std::string floatText(float value) {
  char buffer[32];
  const std::string text{buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
  // Double rounding from decimal to double to float may be wrong for a number very close to the middle between two
  // floats.
  return static_cast<float>(toNumber(text, 1)) == value ? text : toText(static_cast<double>(value));
}

class WorldWriter {
 public:
  explicit WorldWriter(const World& world) : world_(world) {}

  XmlElement write() const {
    XmlElement root;
    root.name = "world";
    if (world_.unit_m != 1) root.attributes.emplace_back("unit_m", toText(world_.unit_m));
    if (world_.win_distance_m != kWinDistance_m) {
      root.attributes.emplace_back("win_distance", toText(world_.win_distance_m, world_.unit_m));
    }
    if (world_.start_distance_m) {
      root.attributes.emplace_back("start_distance", toText(*world_.start_distance_m, world_.unit_m));
    }
    XmlElement& surface = root.add("surface");
    surface.add("type", world_.surface_type);
    XmlElement& size = surface.add("size");
    addLength(size, "xmin", world_.bounds.x_min);
    addLength(size, "xmax", world_.bounds.x_max);
    addLength(size, "ymin", world_.bounds.y_min);
    addLength(size, "ymax", world_.bounds.y_max);
    for (const auto& map : world_.maps) addMap(surface.add("map"), map);
    for (const auto& object : world_.objects) {
      addBody(surface.add("object").add("shape").add("primitive"), object.name, object.body, object.stationary,
              Place::given);
    }
    for (const auto& robot : world_.robots) {
      addRobot(surface.add("object").add("shape").add("robot"), robot, Place::given);
    }
    for (const auto& scatter : world_.scatters) addScatter(surface.add("scatter"), scatter);
    addCommunication(root);
    return root;
  }

 private:
  enum class Place { given, scattered };

  void addScatter(XmlElement& element, const Scatter& scatter) const {
    element.add("count", std::to_string(scatter.count));
    using enum ScatterPattern;
    element.add("pattern", scatter.pattern == uniform ? "uniform"
                           : scatter.pattern == free  ? "free"
                           : scatter.pattern == grid  ? "grid"
                                                      : "ring");
    if (scatter.pattern == ring) {
      addLength(element, "x", scatter.ring_center.x);
      addLength(element, "y", scatter.ring_center.y);
      addLength(element, "radius", scatter.ring_radius_m);
    } else if (scatter.area) {
      addLength(element, "xmin", scatter.area->x_min);
      addLength(element, "xmax", scatter.area->x_max);
      addLength(element, "ymin", scatter.area->y_min);
      addLength(element, "ymax", scatter.area->y_max);
    }
    addLength(element, "gap", scatter.gap_m);
    if (scatter.has_neighbour_ring) element.add("neighbours", "ring");
    if (scatter.direction_rad) element.add("direction", toText(*scatter.direction_rad));
    if (const auto* robot = std::get_if<RobotPlacement>(&scatter.copied)) {
      addRobot(element.add("robot"), *robot, Place::scattered);
    } else {
      const auto& object = std::get<WorldObject>(scatter.copied);
      addBody(element.add("primitive"), object.name, object.body, object.stationary, Place::scattered);
    }
  }

  void addCommunication(XmlElement& root) const {
    const Communication& communication = world_.communication;
    if (communication == Communication{}) return;
    XmlElement& element = root.add("communication");
    if (communication.range_m) addLength(element, "range", *communication.range_m);
    if (communication.loss_probability != 0) element.add("loss", toText(communication.loss_probability));
    if (communication.wall_range_m != 0) addLength(element, "wall_range", communication.wall_range_m);
    const Communication defaults;
    const auto add = [&](const char* name, double value, double otherwise) {
      if (value != otherwise) element.add(name, toText(value));
    };
    add("wall_loss", communication.wall_loss, defaults.wall_loss);
    add("burst_gap_s", communication.burst_gap_s, defaults.burst_gap_s);
    add("burst_s", communication.burst_s, defaults.burst_s);
    add("burst_loss", communication.burst_loss, defaults.burst_loss);
    add("delay_s", communication.delay_s, defaults.delay_s);
    add("rate_hz", communication.rate_hz, defaults.rate_hz);
  }

  void addMap(XmlElement& element, const WorldMap& map) const {
    element.add("file", map.file);
    addPose(element, map.world_from_map);
    addLength(element, "height", map.height_m);
    element.add("color", colorText(map.color));
    const MapFormat format = mapFormatOf(map.file);
    if (format == MapFormat::activmedia) return;
    element.add("unknown", map.reading.unknown_is_occupied ? "occupied" : "free");
    if (map.reading.is_of_ros1) element.add("map_server", "ros1");
    if (format == MapFormat::ros_yaml) return;
    element.add("threshold", toText(map.reading.thresholds.occupied));
    if (format == MapFormat::gridmap) return;
    addLength(element, "resolution", map.reading.pixel_m);
    element.add("negate", map.reading.negate ? "1" : "0");
  }

  void addRobot(XmlElement& element, const RobotPlacement& robot, Place place) const {
    assert(robot.body || !robot.model.empty());
    if (!robot.model.empty()) element.add("model", robot.model);
    if (robot.body) {
      Body body = *robot.body;
      body.world_from_body = robot.world_from_robot;
      addBody(element, robot.name, body, false, place);
    } else {
      element.add("name", robot.name);
      if (place == Place::given) addPose(element, robot.world_from_robot);
      if (robot.color) element.add("color", colorText(*robot.color));
    }
    addSensors(element, robot.sensors);
    if (!robot.controller.empty()) addController(element, TypeChoice::parse(robot.controller));
    if (!robot.neighbour.empty()) element.add("neighbour", robot.neighbour);
  }

  void addController(XmlElement& robot, const TypeChoice& choice) const {
    XmlElement& element = robot.add("controller");
    if (choice.parameters.empty()) {
      element.text = choice.name;
      return;
    }
    element.attributes = choice.parameters;
    element.attributes.insert(element.attributes.begin(), {"name", choice.name});
  }

  void addSensors(XmlElement& robot, const std::vector<XmlElement>& sensors) const {
    if (sensors.empty()) return;
    // Uses the 2005 form if all sensors have it; otherwise puts all into one element, which keeps their order.
    const bool all_2005 =
        std::all_of(sensors.begin(), sensors.end(), [](const XmlElement& sensor) { return sensor.name == "sensor"; });
    auto& place = (all_2005 ? robot : robot.add("sensors")).children;
    place.insert(place.end(), sensors.begin(), sensors.end());
  }

  void addBody(XmlElement& owner, const std::string& name, const Body& body, bool stationary, Place place) const {
    const auto* cylinder = std::get_if<Cylinder>(&body.shape);
    XmlElement& element = owner.add(cylinder ? "cylinder" : "cube");
    element.add("name", name);
    if (place == Place::given) addPose(element, body.world_from_body);
    addLength(element, "z", body.center_z_m);
    if (cylinder) {
      addLength(element, "radius", cylinder->radius_m);
    } else {
      const auto& cube = std::get<Cube>(body.shape);
      addLength(element, "length", cube.length_m);
      addLength(element, "width", cube.width_m);
    }
    addLength(element, "height", body.height_m);
    element.add("color", colorText(body.color));
    element.add("hot", toText(body.heat_celsius));
    if (body.reflectivity != kReflectivity) element.add("reflectivity", toText(body.reflectivity));
    element.add("stationary", stationary ? "1" : "0");
  }

  void addPose(XmlElement& element, const mrpt::math::TPose2D& pose) const {
    addLength(element, "x", pose.x);
    addLength(element, "y", pose.y);
    element.add("direction", toText(pose.phi));
  }

  void addLength(XmlElement& element, const char* tag, double length_m) const {
    element.add(tag, toText(length_m, world_.unit_m));
  }

  static std::string colorText(const std::array<float, 3>& color) {
    return floatText(color[0]) + " " + floatText(color[1]) + " " + floatText(color[2]);
  }

  const World& world_;
};

}  // namespace

std::string toXml(const World& world) { return toXml(WorldWriter(world).write()); }

}  // namespace robosim
