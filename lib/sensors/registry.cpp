#include "sensors/registry.h"

#include "sensors/battery.h"
#include "sensors/blob_finder.h"
#include "sensors/bumper.h"
#include "sensors/camera.h"
#include "sensors/compass.h"
#include "sensors/heat.h"
#include "sensors/infrared.h"
#include "sensors/laser.h"
#include "sensors/odometry.h"
#include "sensors/sonar.h"

namespace robosim {
namespace {

using Made = std::unique_ptr<Sensor>;

Made readBlobFinder(XmlReader& reader, const Mount& mount) {
  const BlobFinderOptions options = BlobFinderOptions::read(reader);
  Made finder = makeBlobFinder(options, mount.mounted);
  if (finder) return finder;
  if (options.camera.empty()) {
    reader.error("has no camera to look through; mount one before it");
  } else {
    reader.errorAt("camera", "is not the label of a camera that is mounted before it; mount one, or mend the label");
  }
  return nullptr;
}

// clang-format off
constexpr SensorType kTypes[] = {
    {"sonar", "A ring of sonars, each the nearest thing in its cone.",
     [](XmlReader& r, const Mount&) -> Made { return makeSonar(SonarOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return makeSonar(SonarOptions::read2005(r, m)); }},
    {"laser", "A level laser scanner, or one beam that turns.",
     [](XmlReader& r, const Mount&) -> Made { return makeLaser(LaserOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return makeLaser(LaserOptions::read2005(r, m)); }},
    {"heat", "The warmth of everything hot within range, one number.",
     [](XmlReader& r, const Mount&) -> Made { return makeHeat(HeatOptions::read(r)); },
     [](XmlReader& r, const Mount& m) -> Made { return makeHeat(HeatOptions::read2005(r, m)); }},
    {"infrared", "Short single beams.",
     [](XmlReader& r, const Mount&) -> Made { return makeInfrared(InfraredOptions::read(r)); }, nullptr},
    {"bumper", "A ring of contact segments.",
     [](XmlReader& r, const Mount& m) -> Made { return makeBumper(BumperOptions::read(r, m)); }, nullptr},
    {"odometry", "The pose since the start as the wheels tell it.",
     [](XmlReader& r, const Mount&) -> Made { return makeOdometry(OdometryOptions::read(r)); }, nullptr},
    {"compass", "The heading in the world.",
     [](XmlReader& r, const Mount&) -> Made { return makeCompass(CompassOptions::read(r)); }, nullptr},
    {"camera", "Colour pictures.",
     [](XmlReader& r, const Mount&) -> Made { return makeCamera(CameraOptions::read(r)); }, nullptr},
    {"battery", "The battery's voltage, which falls with use.",
     [](XmlReader& r, const Mount&) -> Made { return makeBattery(BatteryOptions::read(r)); }, nullptr},
    {"blob_finder", "The largest spot of each of some colours in a camera's picture.", readBlobFinder, nullptr},
};
// clang-format on

const SensorType* find(const std::string& name) {
  for (const auto& type : kTypes) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

std::string names(bool of_2005) {
  std::string all;
  for (const auto& type : kTypes) {
    if (!of_2005 || type.read_2005) all += (all.empty() ? "" : ", ") + std::string(type.name);
  }
  return all;
}

Made read2005(XmlReader& reader, const Mount& mount) {
  reader.number("id", {0, 1e6}, 0);  // 2005 numbered a robot's sensors; nothing refers to it
  const std::string name = reader.word("type");
  const SensorType* type = find(name);
  if (!type || !type->read_2005) {
    if (!name.empty()) reader.errorAt("type", "is unknown; accepted are: " + names(true));
    return nullptr;
  }
  return type->read_2005(reader, mount);
}

}  // namespace

std::span<const SensorType> sensorTypes() { return kTypes; }

std::unique_ptr<Sensor> readSensor(XmlReader& reader, const Mount& mount) {
  Made sensor;
  if (reader.name() == "sensor") {
    sensor = read2005(reader, mount);
  } else if (const SensorType* type = find(reader.name())) {
    sensor = type->read(reader, mount);
  } else {
    reader.error("is no sensor; there are: " + names(false) + ", and 2005's <sensor>");
  }
  if (sensor) reader.finish();
  return sensor;
}

}  // namespace robosim
