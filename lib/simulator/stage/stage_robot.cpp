#include "stage/stage_robot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "stage/stage_names.h"
#include "stage/stage_objects.h"
#include "stage/stage_sensors.h"
#include "stage/stage_shape.h"

namespace robosim::stage {
namespace {

/// Height of robots and sensors of Stage 2 and 3, so that they are below walls.
constexpr double kPlanarHeight_m = 0.3;
/// Without acceleration_bounds, Stage changes speeds at once: the largest values of robot types.
constexpr double kAtOnce_mps2 = 1000, kAtOnce_radps2 = 36000 * kRadPerDeg;

constexpr double kLeast = 1e-6;  ///< stands for 0 where that is not valid
/// In Stage a car turns by at most its speed by its wheelbase, v · sin(steering angle) / wheelbase: as one does that is
/// steered by 45°, v · tan(steering angle) / wheelbase.
constexpr double kCarSteering_deg = 45;

/// Whether a body is as good as round: one block with eight corners or more, of which none is far from a circle.
bool isRound(const Shape& shape, const Size& size) {
  if (shape.prisms.size() != 1 || shape.bitmap || shape.prisms[0].outline.size() < 8) return false;
  const double radius_m = std::max(size.x, size.y) / 2;
  if (std::abs(size.x - size.y) > 0.02 * radius_m) return false;
  return std::all_of(shape.prisms[0].outline.begin(), shape.prisms[0].outline.end(),
                     [&](const auto& point) { return portable::hypot(point.x, point.y) > 0.85 * radius_m; });
}

class RobotTranslator {
 public:
  RobotTranslator(const Entity& position, const RobotContext& context)
      : context_(context), reader_(position, *context.units) {}

  TranslatedRobot translate() {
    translated_.type.name = "robot";
    Size otherwise = defaultSize("position");
    if (context_.is_planar) otherwise.z = kPlanarHeight_m;
    size_ = reader_.size(otherwise);
    const Shape shape = readShape(reader_, size_, true, *context_.files, *context_.notes);
    const bool is_round = isRound(shape, size_);
    const Pose origin = reader_.pose("origin");
    if (origin.plan.x != 0 || origin.plan.y != 0) {
      context_.notes->add(reader_.find("origin")->place,
                          "a robot's body is centred on its axis of turning, without its 'origin'");
    }
    sensors_.name = "sensors";
    addOdometry();
    readEnergy(reader_);
    addChildren(reader_.entity(), {{}, reader_.flag("stack_children", true) ? size_.z : 0});
    addBattery();
    if (context_.is_planar) size_.z = std::max(size_.z, highest_m_ + 0.01);
    addBody(is_round);
    addLimits();
    translated_.type.children.push_back(sensors_);
    return std::move(translated_);
  }

 private:
  void addBody(bool is_round) {
    XmlElement& body = translated_.type.add("body");
    const auto clamped = [](double value_m) { return std::clamp(value_m, 0.001, 100.0); };
    if (is_round) {
      setNumber(body, "radius_m", clamped(std::max(size_.x, size_.y) / 2));
    } else {
      setNumber(body, "length_m", clamped(size_.x));
      setNumber(body, "width_m", clamped(size_.y));
    }
    setNumber(body, "height_m", clamped(std::max(size_.z, top_m_)));
    if (const double mark = readFiducial(reader_, *context_.notes); mark != 0) setNumber(body, "fiducial", mark);
  }

  void addLimits() {
    const auto drive = reader_.text("drive", "diff");
    const double wheelbase_m = reader_.length("wheelbase", 1);
    double speed_mps = 1, lateral_mps = 1, turn_radps = 90 * kRadPerDeg, accel_mps2 = kAtOnce_mps2,
           turn_radps2 = kAtOnce_radps2;
    const double unit = reader_.lengthUnit_m(), angle = reader_.angleUnit_rad();
    const auto read = [&](const char* name, double& along, double& about) {
      const auto bounds = reader_.numbers(name, 2);
      if (bounds.empty()) return;
      along = std::max(std::abs(bounds[0]), std::abs(bounds[1])) * unit;
      if (&along == &speed_mps && bounds.size() >= 4) {
        lateral_mps = std::max(std::abs(bounds[2]), std::abs(bounds[3])) * unit;
      }
      if (bounds.size() >= 8) about = std::max(std::abs(bounds[6]), std::abs(bounds[7])) * angle;
      const bool is_symmetric = bounds[0] == -bounds[1] && (bounds.size() < 8 || bounds[6] == -bounds[7]);
      if (!is_symmetric) {
        context_.notes->add(reader_.find(name)->place,
                            std::string(name) + " has the larger of its values in both directions");
      }
    };
    read("velocity_bounds", speed_mps, turn_radps);
    read("acceleration_bounds", accel_mps2, turn_radps2);
    if (const auto old = reader_.numbers("max_speed", 1); !old.empty()) {
      speed_mps = std::abs(old[0]) * unit;
      if (old.size() > 2) {
        lateral_mps = std::abs(old[1]) * unit;
        turn_radps = std::abs(old.back()) * angle;
      }
    }
    if (const auto velocity = reader_.numbers("velocity", 1);
        std::any_of(velocity.begin(), velocity.end(), [](double each) { return each != 0; })) {
      context_.notes->add(reader_.find("velocity")->place, "robots start at rest, without their 'velocity'");
    }
    XmlElement& limits = translated_.type.add("limits");
    setNumber(limits, "speed_max_mps", std::clamp(speed_mps, kLeast, 100.0));
    setNumber(limits, "accel_mps2", std::clamp(accel_mps2, kLeast, kAtOnce_mps2));
    setNumber(limits, "decel_mps2", std::clamp(accel_mps2, kLeast, kAtOnce_mps2));
    setNumber(limits, "turn_max_degps", std::clamp(toDegrees(turn_radps), kLeast, 3600.0));
    setNumber(limits, "turn_accel_degps2", std::clamp(toDegrees(turn_radps2), kLeast, 36000.0));
    addDrive(drive, lateral_mps, wheelbase_m);
  }

  void addDrive(const std::string& drive, double lateral_mps, double wheelbase_m) {
    const auto add = [&](const char* type) -> XmlElement& {
      XmlElement& element = translated_.type.add("drive");
      element.attributes.emplace_back("type", type);
      return element;
    };
    if (drive == "omni") {
      setNumber(add("omni"), "lateral_max_mps", std::clamp(lateral_mps, kLeast, 100.0));
    } else if (drive == "car") {
      XmlElement& car = add("car");
      setNumber(car, "wheelbase_m", std::clamp(wheelbase_m, kLeast, 100.0));
      setNumber(car, "steering_max_deg", kCarSteering_deg);
    } else if (drive != "diff") {
      context_.notes->add(reader_.find("drive")->place, "drive \"" + drive + "\" is driven as differential");
    }
  }

  void addOdometry() {
    XmlElement& odometry = sensors_.add("odometry");
    reader_.pose("localization_origin");
    const std::string localization = reader_.text("localization", "gps");
    const auto error = reader_.numbers("odom_error", 3);
    if (localization != "odom" || error.empty()) return;
    if (error[0] != 0 || error[1] != 0) {
      context_.notes->add(reader_.find("odom_error")->place,
                          "the errors of odom_error along x and y have no equivalent; that of turns has");
    }
    const double turn = error.back() * reader_.angleUnit_rad();
    if (turn == 0) return;
    XmlElement& noise = odometry.add("noise");
    for (const char* exact : {"length_std_per_sqrt_m", "turn_std_per_sqrt_rad", "drift_std_per_sqrt_m"}) {
      setNumber(noise, exact, 0);
    }
    setNumber(noise, "wheelbase_ratio", std::clamp(1 + turn, 0.5, 2.0));
  }

  void readEnergy(const PropertyReader& reader) {
    for (const char* name : {"joules", "joules_capacity"}) joules_ = std::max(joules_, reader.number(name, 0));
    for (const char* name : {"kjoules", "kjoules_capacity"}) joules_ = std::max(joules_, 1000 * reader.number(name, 0));
    watts_ += std::max(0.0, reader.number("watts", 0));
  }

  void addBattery() {
    if (!(joules_ > 0) || !(watts_ > 0)) return;
    XmlElement& battery = sensors_.add("battery");
    const double hours = std::clamp(joules_ / watts_ / 3600, 1e-6, 1e6);
    setNumber(battery, "standing_h", hours);
    setNumber(battery, "driving_h", hours);
  }

  /// @param robot_from_top of the parent: where its children stand
  void addChildren(const Entity& parent, const Pose& robot_from_top) {
    for (const auto& child : parent.children) {
      if (child.kind == "block" || child.kind == "sensor" || child.kind == "window") continue;
      const PropertyReader reader(child, *context_.units);
      if (addWithoutBody(reader)) continue;
      const Pose robot_from_child = compose(robot_from_top, reader.pose("pose"));
      const Pose robot_from_body = compose(robot_from_child, reader.pose("origin"));
      readEnergy(reader);
      for (const char* drawn : {"color", "color_rgba"}) {
        if (reader.has(drawn)) child.properties.at(drawn)->is_drawn = true;  // devices are not drawn
      }
      reader.number("update_interval", 0);
      const Size size = reader.size(defaultSize(child.kind));
      SensorMount mount{&reader, robot_from_body, size, context_.notes, context_.robots, size_.z};
      const std::size_t before = sensors_.children.size();
      if (addSensor(mount, sensors_)) {
        nameSensors(reader.text("name", ""), before);
        highest_m_ = std::max(highest_m_, mount.highest_m);
      } else if (!hasBody(child.kind)) {
        context_.notes->add(child.place, "'" + child.type + "' on a robot has no equivalent");
      }
      addBodyOf(reader, robot_from_body, size);
      const double top_m = reader.flag("stack_children", true) ? size.z : 0;
      addChildren(child, compose(robot_from_child, {{}, top_m}));
    }
  }

  /// The sensors of a device with a name have it as their label.
  void nameSensors(const std::string& name, std::size_t first) {
    if (name.empty()) return;
    auto& all = sensors_.children;
    // A blob finder follows its camera.
    const bool is_blob_finder = all.size() > first && all.back().name == "blob_finder";
    if (is_blob_finder) first = all.size() - 1;
    for (std::size_t i = first; i < all.size(); ++i) all[i].attributes.emplace_back("label", labels_.make(name));
  }

  /// Kinds that are no part of the robot. @return whether it is one
  bool addWithoutBody(const PropertyReader& reader) {
    const Entity& child = reader.entity();
    if (child.kind == "wifi") {
      if (reader.text("model", "") == "simple") {
        translated_.wifi_ranges_m.push_back(reader.length("range", 0));
      } else {
        context_.notes->add(child.place,
                            "'wifi' other than of the model \"simple\" has no equivalent; robots "
                            "communicate at any range");
      }
      return true;
    }
    for (const auto& [kind, reason] :
         {std::pair("gps", "robots have exact odometry"), std::pair("truth", "recordings contain the true poses"),
          std::pair("broadcast", "every robot has a radio"), std::pair("blinkenlight", "there are no lights"),
          std::pair("lightindicator", "there are no lights"), std::pair("position", "a robot carries no other one"),
          std::pair("actuator", "a robot has no joints")}) {
      if (child.kind != kind) continue;
      leaveOut(child, reason, *context_.notes);
      return true;
    }
    return false;
  }

  /// A body on the robot makes it higher; one beside it is left out.
  void addBodyOf(const PropertyReader& reader, const Pose& robot_from_body, const Size& size) {
    const Shape shape = readShape(reader, size, hasBody(reader.entity().kind), *context_.files, *context_.notes);
    if (shape.prisms.empty() && !shape.bitmap) return;
    const auto& at = robot_from_body.plan;
    const double reach_m = std::min(size.x, size.y) / 2;
    const bool is_within =
        std::abs(at.x) + reach_m <= size_.x / 2 + 0.05 && std::abs(at.y) + reach_m <= size_.y / 2 + 0.05;
    if (is_within) {
      top_m_ = std::max(top_m_, robot_from_body.z_m + size.z);
    } else {
      context_.notes->add(reader.entity().place,
                          "'" + reader.entity().type + "' extends over the robot, and is no part of its body");
    }
  }

  const RobotContext& context_;
  PropertyReader reader_;
  TranslatedRobot translated_;
  XmlElement sensors_;
  Size size_;
  UniqueNames labels_;
  double top_m_ = 0;      ///< of bodies on the robot
  double highest_m_ = 0;  ///< of its sensors
  double joules_ = 0, watts_ = 0;
};

}  // namespace

TranslatedRobot translateRobot(const Entity& position, const RobotContext& context) {
  return RobotTranslator(position, context).translate();
}

void leaveOut(const Entity& entity, const std::string& reason, Notes& notes) {
  if (!reason.empty()) notes.add(entity.place, "'" + entity.type + "' is left out, because " + reason);
  for (const auto& [name, property] : entity.properties) property->is_noted = true;
  for (const auto& child : entity.children) leaveOut(child, "", notes);
}

void setNumber(XmlElement& element, const char* attribute, double value) {
  const double rounded = std::floor(value * 1e9 + 0.5) / 1e9;
  element.attributes.emplace_back(attribute, toText(rounded == 0 ? 0.0 : rounded));
}

Size defaultSize(const std::string& kind) {
  if (kind == "ranger" || kind == "laser") return {0.15, 0.15, 0.2};
  if (kind == "camera") return {0.1, 0.07, 0.05};
  if (kind == "sensor") return {0.02, 0.02, 0.02};
  if (kind == "gripper") return {0.2, 0.3, 0.2};
  if (kind == "blobfinder" || kind == "fiducial" || kind == "bumper") return {0, 0, 0};
  return {};
}

bool hasBody(const std::string& kind) {
  static const std::set<std::string> with{"model",  "position",     "map",      "box",           "puck",
                                          "bitmap", "blinkenlight", "actuator", "lightindicator"};
  return with.count(kind) > 0;
}

}  // namespace robosim::stage
