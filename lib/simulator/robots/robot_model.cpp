#include "robots/robot_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "arcos/protocol/parameters.h"
#include "base/angle_units.h"
#include "base/digest.h"
#include "base/label.h"
#include "base/xml_reader.h"
#include "robots/drive_reader.h"
#include "robots/robot_type_includes.h"
#include "sensors/camera.h"
#include "sensors/odometry.h"
#include "sensors/registry.h"
#include "world/body_xml.h"

namespace robosim {
namespace {

int wholeNumber(XmlReader& reader, const std::string& setting, const Bounds& bounds, int default_value) {
  const double value = reader.number(setting, bounds, default_value);
  if (value != std::floor(value)) reader.errorAt(setting, "must be a whole number");
  return static_cast<int>(value);
}

/// Reads `<arcos>` of a robot type, which lets ARCOS programs drive robots of the type.
arcos::Parameters readArcosParameters(XmlReader& reader) {
  arcos::Parameters p;
  // Largest value of a field of 16 bits.
  const Bounds in_packet = Bounds::positive(65535);
  p.subclass = reader.word("subclass");
  p.distance_unit_mm = reader.number("distance_unit_mm", Bounds::positive(100), p.distance_unit_mm);
  p.turn_radpmm = reader.number("turn_radpmm", Bounds::positive(1), p.turn_radpmm);
  p.wheel_speed_unit_mmps = reader.number("wheel_speed_unit_mmps", Bounds::positive(1000), p.wheel_speed_unit_mmps);
  p.speed_mmps = reader.number("speed_mmps", in_packet, p.speed_mmps);
  p.turn_degps = reader.number("turn_degps", in_packet, p.turn_degps);
  p.accel_mmps2 = reader.number("accel_mmps2", in_packet, p.accel_mmps2);
  p.turn_accel_degps2 = reader.number("turn_accel_degps2", in_packet, p.turn_accel_degps2);
  p.front_bumpers = wholeNumber(reader, "front_bumpers", {0, 7}, p.front_bumpers);
  p.rear_bumpers = wholeNumber(reader, "rear_bumpers", {0, 7}, p.rear_bumpers);
  p.has_front_sonar = reader.flag("has_front_sonar", p.has_front_sonar);
  p.has_rear_sonar = reader.flag("has_rear_sonar", p.has_rear_sonar);
  p.encoder_ticks_per_mm = reader.number("encoder_ticks_per_mm", in_packet, p.encoder_ticks_per_mm);
  p.battery_volts = reader.number("battery_volts", Bounds::positive(100), p.battery_volts);
  p.low_battery_volts = reader.number("low_battery_volts", Bounds::notNegative(100), p.low_battery_volts);
  reader.finish();
  return p;
}

/// Reports a setting whose value an earlier sensor of the robot already has.
template <typename Value>
void checkUnique(XmlReader& sensor, const std::string& setting, const Value& value, std::map<Value, int>& line_of) {
  const auto [first, is_new] = line_of.emplace(value, sensor.line().number);
  if (is_new) return;
  sensor.errorAt(setting, "is taken already, by the sensor in line " + std::to_string(first->second) +
                              "; give each sensor of a robot " + (setting == "id" ? "an id" : "a label") +
                              " of its own");
}

/// Checks the `id`s and `label`s of one robot's sensors. Reports duplicate ids and labels, and labels that recordings
/// cannot hold (sensorLabelError()).
void checkSensorNames(std::vector<XmlReader>& sensors) {
  std::map<double, int> line_of_id;
  std::map<std::string, int> line_of_label;
  for (auto& sensor : sensors) {
    // Only the 2005 <sensor> has an id, and it has no label.
    if (sensor.name() == "sensor") {
      const auto id = sensor.has("id") ? parseNumber(sensor.word("id", "")) : std::nullopt;
      if (id) checkUnique(sensor, "id", *id, line_of_id);
    } else if (sensor.has("label")) {
      const std::string label = sensor.word("label", "");
      checkUnique(sensor, "label", label, line_of_label);
      if (const std::string fault = sensorLabelError(label); !fault.empty()) sensor.errorAt("label", fault);
    }
  }
}

/// Makes labels unique. Keeps the labels given in the file; appends _2, _3, … to other sensors' labels, the names of
/// their kinds, where they are taken.
void makeLabelsUnique(std::vector<SensorInfo>& sensors, const std::vector<bool>& labelled) {
  std::unordered_set<std::string> taken;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (labelled[i]) taken.insert(sensors[i].label);
  }
  std::unordered_map<std::string, int> next;  // next suffix to try for a label
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (labelled[i]) continue;
    const std::string label = sensors[i].label;
    int& number = next.try_emplace(label, 1).first->second;
    do {
      sensors[i].label = number == 1 ? label : label + "_" + std::to_string(number);
      ++number;
    } while (!taken.insert(sensors[i].label).second);
  }
}

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
  for (const BodyProperty& property : kBodyProperties) body.*property.value = readProperty(reader, property, 0);
  look = reader.choice("look", {{"drum", BodyLook::drum}, {"deck", BodyLook::deck}}, BodyLook::drum);
  reader.finish();
  return body;
}

void readLimits(XmlReader& reader, RobotModel& model) {
  MotionLimits& limits = model.type.edit().limits;
  limits.speed_max_mps = reader.number("speed_max_mps", Bounds::positive(100));
  limits.turn_max_radps = kRadPerDeg * reader.number("turn_max_degps", Bounds::positive(3600));
  limits.accel_mps2 = reader.number("accel_mps2", Bounds::positive(1000));
  limits.decel_mps2 = reader.number("decel_mps2", Bounds::positive(1000));
  limits.turn_accel_radps2 = kRadPerDeg * reader.number("turn_accel_degps2", Bounds::positive(36000));
  limits.emergency_decel_mps2 = reader.number("emergency_decel_mps2", {limits.decel_mps2, 1000}, limits.decel_mps2);
  model.push_max_n = reader.number("push_max_n", {0, 100000}, model.push_max_n);
  reader.finish();
}

/// Reads the drive that a world file gives a robot.
void readDescribedDrive(const RobotDescription& description, RobotModel& model, ErrorList& errors) {
  if (!description.drive) return;
  XmlReader reader(*description.drive, description.file, errors);
  RobotTypeInfo& type = model.type.edit();
  type.drive = readDrive(reader, type.limits);
}

/// Sensors of a model, with whether the file gives each a label.
struct Mounted {
  explicit Mounted(RobotModel& robot_model) : model(robot_model) {}

  void add(std::shared_ptr<const Sensor> sensor, bool is_labelled) {
    model.sensors.push_back(std::move(sensor));
    labelled.push_back(is_labelled);
  }

  RobotModel& model;
  std::vector<bool> labelled;  ///< in the order of model.sensors
};

void mount(std::vector<XmlReader> readers, double unit_m, Mounted& mounted) {
  checkSensorNames(readers);
  const RobotModel& model = mounted.model;
  std::size_t rays = 0;
  for (auto& reader : readers) {
    if (auto sensor =
            readSensor(reader, {unit_m, model.radius_m, model.body.height_m, model.sensors, rays, model.type->drive})) {
      rays += sensor->rayCount();
      if (auto head = makeHeadOf(*sensor)) mounted.add(std::move(head), false);
      mounted.add(std::move(sensor), reader.has("label"));
    }
  }
}

/// Readers of the sensors of a type, those of included files with the names of these.
std::vector<XmlReader> sensorReaders(XmlReader& sensors, const std::string& type_file, ErrorList& errors) {
  std::vector<XmlReader> readers;
  for (auto& reader : sensors.all()) {
    const XmlElement& element = reader.element();
    if (element.name == "include" && element.children.size() == 1) {
      const auto file = std::filesystem::path(type_file).parent_path() / reader.word("file");
      readers.emplace_back(element.children.front(), file.string(), errors);
    } else {
      readers.push_back(std::move(reader));
    }
  }
  return readers;
}

std::uint64_t digestOf(const std::vector<XmlElement>& sensors) {
  Digest digest;
  for (const auto& sensor : sensors) {
    const std::string text = toXml(sensor);
    digest.addBytes(text.data(), text.size());
  }
  return digest.value();
}

/// Mounts the sensors that a world file lists, and adds exact odometry if it lists none, because controllers require
/// it.
void mountDescribed(const RobotDescription& description, Mounted& mounted, ErrorList& errors) {
  std::vector<XmlReader> readers;
  for (const auto& element : *description.sensors) readers.emplace_back(element, description.file, errors);
  mount(std::move(readers), description.unit_m, mounted);
  mounted.model.sensors_digest = digestOf(*description.sensors);
  const auto& sensors = mounted.model.sensors;
  const bool has_odometry = std::any_of(sensors.begin(), sensors.end(),
                                        [](const auto& sensor) { return sensor->info().kind == SensorKind::odometry; });
  if (!has_odometry) mounted.add(makeOdometry({}), false);
}

void describeSensors(Mounted& mounted) {
  std::vector<SensorInfo> infos;
  for (const auto& sensor : mounted.model.sensors) {
    infos.push_back(sensor->info());
    if (const GripperOptions* gripper = gripperOptionsOf(*sensor)) mounted.model.gripper = *gripper;
  }
  makeLabelsUnique(infos, mounted.labelled);
  mounted.model.sensor_infos = std::make_shared<const std::vector<SensorInfo>>(std::move(infos));
}

void setBody(const Body& body, RobotModel& model) {
  model.body = body;
  model.body.world_from_body = {};
  model.radius_m = body.coveringRadius();
}

}  // namespace

RobotModel readRobotModel(const std::filesystem::path& file, ErrorList& errors) {
  try {
    return modelOf(readRobotType({file, std::nullopt}), file.string(), {}, errors);
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
  RobotTypeInfo& info = model.type.edit();
  info.model = root.word("name");
  if (!info.model.empty() && info.model != std::filesystem::path(type_file).stem()) {
    root.errorAt("name", "must be the file's name without .xml; rename one of them");
  }
  model.help = root.word("help", "");
  XmlReader body = root.requiredChild("body");
  setBody(readBody(body, model.look), model);
  XmlReader limits = root.requiredChild("limits");
  readLimits(limits, model);
  if (auto element = root.child("drive")) info.drive = readDrive(*element, info.limits);
  readDescribedDrive(description, model, errors);
  if (auto element = root.child("arcos")) model.arcos = readArcosParameters(*element);
  if (description.body) setBody(*description.body, model);
  auto sensors = root.child("sensors");
  Mounted mounted(model);
  if (description.sensors) {
    mountDescribed(description, mounted, errors);
  } else if (sensors) {
    mount(sensorReaders(*sensors, type_file, errors), 1, mounted);
    sensors->finish();
    model.sensors_digest = digestOf(sensorsOf(type));
  }
  root.finish();
  describeSensors(mounted);
  return model;
}

RobotModel modelOf2005(const RobotDescription& description, ErrorList& errors) {
  RobotModel model;
  setBody(*description.body, model);
  RobotTypeInfo& info = model.type.edit();
  info.model = "2005";
  info.limits = {.speed_max_mps = 2.5 * model.radius_m,
                 .turn_max_radps = 1.74,
                 .accel_mps2 = 2.5 * model.radius_m,
                 .decel_mps2 = 2.5 * model.radius_m,
                 .turn_accel_radps2 = 3.5};
  readDescribedDrive(description, model, errors);
  Mounted mounted(model);
  mountDescribed(description, mounted, errors);
  describeSensors(mounted);
  return model;
}

}  // namespace robosim
