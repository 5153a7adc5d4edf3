#include "robots/robot_model.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/xml_reader.h"
#include "sensors/odometry.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

constexpr double kRadPerDeg = M_PI / 180;

Body readBody(XmlReader& reader, BodyLook& look) {
  Body body;
  const bool round = reader.has("radius_m") || !(reader.has("length_m") || reader.has("width_m"));
  if (round) {
    body.shape = Cylinder{reader.number("radius_m", Bounds::positive(100))};
  } else {
    const double length_m = reader.number("length_m", Bounds::positive(100));
    body.shape = Cube{length_m, reader.number("width_m", Bounds::positive(100))};
  }
  body.height_m = reader.number("height_m", Bounds::positive(100));
  body.center_z_m = reader.number("clearance_m", Bounds::notNegative(100), 0) + body.height_m / 2;
  const auto rgb = reader.numbers("color", 3, {0, 1}, {0.5, 0.5, 0.5});
  for (std::size_t i = 0; i < 3; ++i) body.color[i] = static_cast<float>(rgb[i]);
  look = reader.choice("look", {{"drum", BodyLook::drum}, {"deck", BodyLook::deck}}, BodyLook::drum);
  reader.finish();
  return body;
}

MotionLimits readLimits(XmlReader& reader) {
  MotionLimits limits;
  limits.speed_max_mps = reader.number("speed_max_mps", Bounds::positive(100));
  limits.turn_max_radps = kRadPerDeg * reader.number("turn_max_degps", Bounds::positive(3600));
  limits.accel_mps2 = reader.number("accel_mps2", Bounds::positive(1000));
  limits.decel_mps2 = reader.number("decel_mps2", Bounds::positive(1000));
  limits.turn_accel_radps2 = kRadPerDeg * reader.number("turn_accel_degps2", Bounds::positive(36000));
  reader.finish();
  return limits;
}

void mount(std::vector<XmlReader> readers, double unit_m, RobotModel& model) {
  for (auto& reader : readers) {
    if (auto sensor = readSensor(reader, {unit_m, model.radius_m, model.body.height_m, model.sensors})) {
      model.sensors.push_back(std::move(sensor));
    }
  }
}

/// Mounts the sensors that a world file lists, and, so that the robot can be programmed, exact odometry if it has none.
void mountDescribed(const RobotDescription& description, RobotModel& model, ErrorList& errors) {
  std::vector<XmlReader> readers;
  for (const auto& element : *description.sensors) readers.emplace_back(element, description.file, errors);
  mount(std::move(readers), description.unit_m, model);
  const bool has_odometry = std::any_of(model.sensors.begin(), model.sensors.end(),
                                        [](const auto& sensor) { return sensor->info().kind == SensorKind::odometry; });
  if (!has_odometry) model.sensors.push_back(makeOdometry({}));
}

/// The sensors' infos, a label that is taken with _2, _3, … behind it.
void tellSensors(RobotModel& model) {
  std::vector<SensorInfo> infos;
  std::unordered_set<std::string> taken;
  for (const auto& sensor : model.sensors) {
    SensorInfo info = sensor->info();
    const std::string label = info.label;
    for (int i = 2; !taken.insert(info.label).second; ++i) info.label = label + "_" + std::to_string(i);
    infos.push_back(std::move(info));
  }
  model.sensor_infos = std::make_shared<const std::vector<SensorInfo>>(std::move(infos));
}

void giveBody(const Body& body, RobotModel& model) {
  model.body = body;
  model.body.world_from_body = {};
  model.radius_m = body.coveringRadius();
}

}  // namespace

RobotModel readRobotModel(const std::filesystem::path& file, ErrorList& errors) {
  try {
    return modelOf(readXmlFile(file), file.string(), {}, errors);
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

RobotModel modelOf(const XmlElement& type, const std::string& type_file, const RobotDescription& description,
                   ErrorList& errors) {
  RobotModel model;
  XmlReader root(type, type_file, errors);
  if (root.name() != "robot") {
    root.error("is not a robot type; the first element of one is <robot>");
    return model;
  }
  model.name = root.word("name");
  if (!model.name.empty() && model.name != std::filesystem::path(type_file).stem()) {
    root.errorAt("name", "must be the file's name without .xml; rename one of them");
  }
  model.help = root.word("help", "");
  XmlReader body = root.requiredChild("body");
  giveBody(readBody(body, model.look), model);
  XmlReader limits = root.requiredChild("limits");
  model.limits = readLimits(limits);
  if (description.body) giveBody(*description.body, model);
  auto sensors = root.child("sensors");
  if (description.sensors) {
    mountDescribed(description, model, errors);
  } else if (sensors) {
    mount(sensors->all(), 1, model);
    sensors->finish();
  }
  root.finish();
  tellSensors(model);
  return model;
}

RobotModel modelOf2005(const RobotDescription& description, ErrorList& errors) {
  RobotModel model;
  model.name = "2005";
  giveBody(*description.body, model);
  model.limits = {.speed_max_mps = 2.5 * model.radius_m,
                  .turn_max_radps = 1.74,
                  .accel_mps2 = 2.5 * model.radius_m,
                  .decel_mps2 = 2.5 * model.radius_m,
                  .turn_accel_radps2 = 3.5};
  mountDescribed(description, model, errors);
  tellSensors(model);
  return model;
}

}  // namespace robosim
