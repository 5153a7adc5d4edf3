#include <algorithm>
#include <cassert>

#include "world/body_xml.h"
#include "world/controller_xml.h"
#include "world/world_file.h"

namespace robosim {
namespace {

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
      writeObject(object, world_.unit_m, true, surface.add("object").add("shape").add("primitive"));
    }
    for (const auto& robot : world_.robots) {
      addRobot(surface.add("object").add("shape").add("robot"), robot, Place::given);
    }
    for (const auto& scatter : world_.scatters) addScatter(surface.add("scatter"), scatter);
    if (world_.communication != Communication{})
      writeCommunication(world_.communication, world_.unit_m, root.add("communication"));
    if (world_.georeference) writeGeoReference(*world_.georeference, world_.unit_m, root.add("georeference"));
    for (const auto& timed : world_.timeline) {
      XmlElement& at = root.add("at");
      at.attributes.emplace_back("time", toText(timed.time_s));
      at.children.push_back(toElement(timed.change, world_.unit_m));
    }
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
      writeObject(object, world_.unit_m, false, element.add("primitive"));
    }
  }

  void addMap(XmlElement& element, const WorldMap& map) const {
    element.add("file", map.file);
    writePose(map.world_from_map, world_.unit_m, element);
    addLength(element, "height", map.height_m);
    element.add("color", colorText(map.color));
    const MapFormat format = recognizeMapFormat(map.file);
    if (format == MapFormat::activmedia) return;
    element.add("unknown", map.reading.unknown_is_occupied ? "occupied" : "free");
    if (format == MapFormat::octomap) {
      addLength(element, "z_min", map.reading.slice.z_min_m);
      addLength(element, "z_max", map.reading.slice.z_max_m);
      return;
    }
    if (map.reading.is_of_ros1) element.add("map_server", "ros1");
    if (map.reading.is_of_stage) element.add("map_server", "stage");
    if (format == MapFormat::ros_yaml) return;
    element.add("threshold", toText(map.reading.thresholds.occupied));
    if (format == MapFormat::gridmap) return;
    addLength(element, "resolution", map.reading.pixel_m);
    if (format == MapFormat::simple_map) return;
    if (map.reading.pixel_y_m > 0) addLength(element, "resolution_y", map.reading.pixel_y_m);
    element.add("negate", map.reading.negate ? "1" : "0");
  }

  void addRobot(XmlElement& element, const RobotPlacement& robot, Place place) const {
    assert(robot.body || !robot.model.empty());
    if (!robot.model.empty()) element.add("model", robot.model);
    if (robot.body) {
      Body body = *robot.body;
      body.world_from_body = robot.world_from_robot;
      writeBody(robot.name, body, world_.unit_m, place == Place::given, element).add("stationary", "0");
    } else {
      element.add("name", robot.name);
      if (place == Place::given) writePose(robot.world_from_robot, world_.unit_m, element);
      if (robot.color) element.add("color", colorText(*robot.color));
    }
    if (robot.drive) element.children.push_back(*robot.drive);
    addSensors(element, robot.sensors);
    if (!robot.controller.empty()) writeController(robot.controller, element);
    if (!robot.neighbour.empty()) element.add("neighbour", robot.neighbour);
  }

  void addSensors(XmlElement& robot, const std::vector<XmlElement>& sensors) const {
    if (sensors.empty()) return;
    // Uses the 2005 form if all sensors have it; otherwise puts all into one element, which keeps their order.
    const bool all_2005 =
        std::all_of(sensors.begin(), sensors.end(), [](const XmlElement& sensor) { return sensor.name == "sensor"; });
    auto& place = (all_2005 ? robot : robot.add("sensors")).children;
    place.insert(place.end(), sensors.begin(), sensors.end());
  }

  void addLength(XmlElement& element, const char* tag, double length_m) const {
    element.add(tag, toText(length_m, world_.unit_m));
  }

  const World& world_;
};

}  // namespace

std::string toXml(const World& world) { return toXml(WorldWriter(world).write()); }

}  // namespace robosim
