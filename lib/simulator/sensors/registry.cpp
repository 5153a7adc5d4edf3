#include "sensors/registry.h"

#include <algorithm>
#include <vector>

#include "base/error_list.h"
#include "sensors/battery.h"
#include "sensors/beacons.h"
#include "sensors/blob_finder.h"
#include "sensors/bumper.h"
#include "sensors/camera.h"
#include "sensors/compass.h"
#include "sensors/encoders.h"
#include "sensors/fiducial.h"
#include "sensors/gnss.h"
#include "sensors/gripper.h"
#include "sensors/ground.h"
#include "sensors/heat.h"
#include "sensors/imu.h"
#include "sensors/infrared.h"
#include "sensors/laser.h"
#include "sensors/lidar.h"
#include "sensors/light.h"
#include "sensors/odometry.h"
#include "sensors/omni_camera.h"
#include "sensors/range_and_bearing.h"
#include "sensors/sonar.h"

namespace robosim {
namespace {

using Made = std::unique_ptr<Sensor>;

std::size_t raycastPixels(const CameraInfo& camera) {
  return camera.isRaycast() ? std::size_t{camera.width_px} * camera.height_px : 0;
}

std::size_t raycastPixels(const Mount& mount) {
  std::size_t pixels = 0;
  for (const auto& sensor : mount.mounted) {
    if (sensor->info().kind == SensorKind::camera) pixels += raycastPixels(sensor->info().camera);
  }
  return pixels;
}

/// The head of a camera is mounted directly before it (makeHeadOf()).
Made readCamera(XmlReader& reader, const Mount& mount) {
  const CameraOptions options = CameraOptions::read(reader);
  const auto is_head = [](const auto& sensor) { return CameraAim::isOf(sensor->info()); };
  if (options.head && std::any_of(mount.mounted.begin(), mount.mounted.end(), is_head)) {
    reader.error("is the second camera with a <ptz> of its robot; a controller commands one, so drop one <ptz>");
  }
  // Rejected before the memory of its pixels is allocated.
  const std::size_t before = raycastPixels(mount), pixels = raycastPixels(options.view.info);
  if (before + pixels > kRobotPixelsMax) {
    reader.error("has " + std::to_string(pixels) + " pixels, and the ray-cast cameras before it " +
                 std::to_string(before) + "; a robot may have " + std::to_string(kRobotPixelsMax) +
                 " in all, so use fewer");
    return nullptr;
  }
  return makeCamera(options, mount.mounted.size());
}

Made readBlobFinder(XmlReader& reader, const Mount& mount) {
  const BlobFinderOptions options = BlobFinderOptions::read(reader);
  Made finder = makeBlobFinder(options, mount.mounted);
  if (finder) return finder;
  if (options.camera.empty()) {
    reader.error("has no camera with colours; mount one before it");
  } else {
    reader.errorAt("camera",
                   "is not the label of a camera with colours that is mounted before it; mount one, or fix the label");
  }
  return nullptr;
}

/// Reports a sensor that exceeds its robot's limit of rays.
bool fits(XmlReader& reader, const Mount& mount, std::size_t rays) {
  if (mount.mounted_rays + rays <= kRobotRaysMax) return true;
  reader.error("has " + std::to_string(rays) + " rays, and the sensors before it " +
               std::to_string(mount.mounted_rays) + "; a robot may have " + std::to_string(kRobotRaysMax) +
               " in all, so use fewer");
  return false;
}

/// Sensors with too many rays are rejected before their memory is allocated.
Made make(XmlReader& reader, const Mount& mount, const SonarOptions& options) {
  return fits(reader, mount, options.rayCount()) ? makeSonar(options) : nullptr;
}

Made make(XmlReader& reader, const Mount& mount, const LidarOptions& options) {
  const auto rays = static_cast<std::size_t>(options.layers) * static_cast<std::size_t>(options.beams);
  return fits(reader, mount, rays) ? makeLidar(options) : nullptr;
}

// clang-format off
const SensorType kOwnTypes[] = {
    {"sonar", "A ring of sonars; each measures the nearest object in its cone.", true,
     [](XmlReader& r, const Mount& m) -> Made { return make(r, m, SonarOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return make(r, m, SonarOptions::read2005(r, m)); }},
    {"laser", "A planar laser scanner, or one beam that pans.", true,
     [](XmlReader& r, const Mount&) -> Made { return makeLaser(LaserOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return makeLaser(LaserOptions::read2005(r, m)); }},
    {"lidar", "A laser scanner with several layers.", true,
     [](XmlReader& r, const Mount& m) -> Made { return make(r, m, LidarOptions::read(r)); }, nullptr},
    {"heat", "The sum of the heat of all sources within range.", true,
     [](XmlReader& r, const Mount&) -> Made { return makeHeat(HeatOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return makeHeat(HeatOptions::read2005(r, m)); }},
    {"infrared", "Short-range single beams.", true,
     [](XmlReader& r, const Mount&) -> Made { return makeInfrared(InfraredOptions::read(r)); }, nullptr},
    {"bumper", "A ring of contact segments.", true,
     [](XmlReader& r, const Mount& m) -> Made { return makeBumper(BumperOptions::read(r, m)); }, nullptr},
    {"odometry", "The pose since the start as measured by the wheels.", true,
     [](XmlReader& r, const Mount& m) -> Made { return makeOdometry(OdometryOptions::read(r, m)); }, nullptr},
    {"compass", "The heading in the world.", true,
     [](XmlReader& r, const Mount&) -> Made { return makeCompass(CompassOptions::read(r)); }, nullptr},
    {"camera", "Colour pictures.", true,
     [](XmlReader& r, const Mount& m) -> Made { return readCamera(r, m); }, nullptr},
    {"battery", "The battery's voltage, which falls with use.", true,
     [](XmlReader& r, const Mount&) -> Made { return makeBattery(BatteryOptions::read(r)); }, nullptr},
    {"beacons", "Ranges to ultra-wideband beacons.", true, readBeacons, nullptr},
    {"range_and_bearing", "Distance and direction to the nearest robots in line of sight.", true, readRangeAndBearing,
     nullptr},
    {"gnss", "The position on the earth by satellites.", true, readGnss, nullptr},
    {"imu", "Turn rate and accelerations.", true, readImu, nullptr},
    {"encoders", "The angles and speeds of the two wheels.", true, readEncoders, nullptr},
    {"ground", "Brightness of the floor at points below the robot.", true, readGround, nullptr},
    {"light", "Light sensors around the robot.", true, readLight, nullptr},
    {"omni_camera", "Direction, distance and colour of the lights and LEDs all around.", true, readOmniCamera, nullptr},
    {"fiducial", "Number, distance, direction and orientation of marks.", true, readFiducial, nullptr},
    {"gripper", "Two paddles that close on an object between them, with two light barriers.", false, readGripper, nullptr},
    {"blob_finder", "The largest blob of each given colour in a camera's picture.", false, readBlobFinder, nullptr},
};
// clang-format on

std::vector<SensorType>& allTypes() {
  static std::vector<SensorType> types(std::begin(kOwnTypes), std::end(kOwnTypes));
  return types;
}

std::string names(bool of_2005) {
  std::string all;
  for (const auto& type : allTypes()) {
    if (!of_2005 || type.read_2005) all += (all.empty() ? "" : ", ") + std::string(type.name);
  }
  return all;
}

Made read2005(XmlReader& reader, const Mount& mount) {
  reader.number("id", {0, 1e6}, 0);  // 2005 numbered a robot's sensors; nothing refers to it
  const std::string name = reader.word("type");
  const SensorType* type = sensorType(name);
  if (!type || !type->read_2005) {
    if (!name.empty()) reader.errorAt("type", "is unknown; accepted are: " + names(true));
    return nullptr;
  }
  return type->read_2005(reader, mount);
}

}  // namespace

std::span<const SensorType> sensorTypes() { return allTypes(); }

void addSensorTypes(std::span<const SensorType> types) {
  std::vector<SensorType> all = allTypes();
  for (const auto& type : types) {
    const std::string name = type.name ? type.name : "";
    const std::string of_type = "sensor '" + name + "': ";
    const auto is_valid = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_valid)) {
      throw ConfigError(of_type + "a name consists of the letters a to z and '_'");
    }
    const auto is_known = [&](const SensorType& known) { return name == known.name; };
    if (name == "sensor" || std::any_of(all.begin(), all.end(), is_known)) {
      throw ConfigError(of_type + "there is one of this name already");
    }
    if (!type.read || !type.help)
      throw ConfigError(of_type + "its type has no help text, or no function that reads it");
    all.push_back(type);
  }
  allTypes() = std::move(all);
}

const SensorType* sensorType(const std::string& name) {
  for (const auto& type : allTypes()) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

std::vector<XmlSetting> settingsOf(const SensorType& type) {
  const XmlElement none{type.name, "", {}, {}, {}};
  ErrorList missing;
  XmlReader reader(none, "", missing);
  std::vector<XmlSetting> settings;
  reader.describeTo(settings);
  type.read(reader, {});
  return settings;
}

std::unique_ptr<Sensor> readSensor(XmlReader& reader, const Mount& mount) {
  Made sensor;
  if (reader.name() == "sensor") {
    sensor = read2005(reader, mount);
  } else if (const SensorType* type = sensorType(reader.name())) {
    sensor = type->read(reader, mount);
  } else {
    reader.error("is not a sensor; accepted are: " + names(false) + ", and the 2005 <sensor>");
  }
  if (!sensor) return nullptr;
  reader.finish();
  return fits(reader, mount, sensor->rayCount()) ? std::move(sensor) : nullptr;
}

}  // namespace robosim
