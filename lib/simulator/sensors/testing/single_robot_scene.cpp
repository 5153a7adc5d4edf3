#include "sensors/testing/single_robot_scene.h"

#include "base/xml_parser.h"

namespace robosim {

SingleRobotScene::SingleRobotScene(const std::vector<Solid>& solids, const mrpt::math::TPose2D& pose)
    : world_from_robot(pose), scene_(solids, 1, {-20, 20, -20, 20}), readings_(1) {}

Measurement SingleRobotScene::sense(const Sensor& sensor) {
  scene_.place(0, {Circle{{world_from_robot.x, world_from_robot.y}, 0.2}, {0, 0.3}});
  scene_.freeze();
  if (readings_[0].measurements.empty()) readings_[0].measurements.push_back(sensor.blank());
  const PlanarTransform frame(world_from_robot, 0);
  const std::uint32_t robot = 0;
  ++time_.step;
  const Snapshot now{.scene = scene_,
                     .heat_sources = heat_sources,
                     .world_from_robot = {&world_from_robot, 1},
                     .frames = {&frame, 1},
                     .last_motion = {&motion, 1},
                     .former_motion = {&former_motion, 1},
                     .laser_pan_rad = {&laser_pan_rad, 1},
                     .time = time_,
                     .seed = seed,
                     .images = images,
                     .surface = surface,
                     .paths = path ? std::span<const Path>(&*path, 1) : std::span<const Path>(),
                     .driven_m = {&driven_m, 1},
                     .reflectivity = reflectivity,
                     .commands = {&command, 1},
                     .georeference = georeference};
  sensor.sense(now, {&robot, 1}, 0, readings_);
  return readings_[0].measurements[0];
}

std::vector<double> SingleRobotScene::ranges(const Sensor& sensor) {
  const Measurement measured = sense(sensor);
  std::vector<double> ranges;
  for (const auto& echo : std::get<Echoes>(measured)) ranges.push_back(echo.range_m);
  return ranges;
}

Solid pillar(double x_m, double y_m, double radius_m, double height_m) {
  return {Circle{{x_m, y_m}, radius_m}, {0, height_m}};
}

Solid block(double x_m, double y_m, double length_m, double width_m, double turned_rad, double height_m) {
  return {OrientedBox::from({x_m, y_m, turned_rad}, length_m, width_m), {0, height_m}};
}

std::unique_ptr<Sensor> sensorFrom(const std::string& xml, const Mount& mount) {
  ErrorList errors;
  const XmlElement element = parseXml(xml, "sensor.xml");
  XmlReader reader(element, "sensor.xml", errors);
  auto sensor = readSensor(reader, mount);
  errors.throwIfAny();
  return sensor;
}

}  // namespace robosim
