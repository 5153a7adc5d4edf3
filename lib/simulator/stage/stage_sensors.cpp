#include "stage/stage_sensors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/angle_units.h"
#include "stage/stage_colors.h"
#include "stage/stage_robot.h"
#include "stage/stage_shape.h"

namespace robosim::stage {
namespace {

/// Rays of a ranger.
struct Rays {
  Pose robot_from_rays;
  double range_min_m = 0, range_max_m = 5;
  double fov_rad = 0.1;
  int samples = 1;
  double std_m = 0, std_per_m = 0;
  double period_s = 0;  ///< 0: not given
};

void setPose(XmlElement& element, const Pose& pose) {
  const auto within = [](double value) { return std::clamp(value, -100.0, 100.0); };
  setNumber(element, "x_m", within(pose.plan.x));
  setNumber(element, "y_m", within(pose.plan.y));
  setNumber(element, "z_m", within(pose.z_m));
}

void setNoise(const Rays& rays, XmlElement& element) {
  if (rays.std_m == 0 && rays.std_per_m == 0) return;
  XmlElement& noise = element.add("noise");
  setNumber(noise, "std_m", std::min(rays.std_m, 1.0));
  setNumber(noise, "std_per_m", std::min(rays.std_per_m, 1.0));
}

class SensorTranslator {
 public:
  SensorTranslator(SensorMount& mount, XmlElement& sensors)
      : mount_(mount), reader_(*mount.reader), sensors_(sensors) {}

  bool translate() {
    const std::string& kind = reader_.entity().kind;
    if (kind == "ranger" || kind == "sonar") {
      addRays(readRanger());
    } else if (kind == "laser") {
      addRays({readLaser()});
    } else if (kind == "blobfinder") {
      addBlobfinder();
    } else if (kind == "camera") {
      addCamera();
    } else if (kind == "fiducial") {
      addFiducial();
    } else if (kind == "gripper") {
      addGripper();
    } else if (kind == "bumper") {
      XmlElement& bumper = sensors_.add("bumper");
      setNumber(bumper, "segments", std::clamp(std::floor(reader_.number("bcount", 12)), 3.0, 360.0));
    } else {
      return false;
    }
    return true;
  }

 private:
  void note(const std::string& text) { mount_.notes->add(reader_.entity().place, text); }

  /// The period of a property update_interval; 0 without one.
  double period_s() const { return reader_.number("update_interval", 0) / 1000; }

  std::vector<Rays> readRanger() {
    std::vector<Rays> all;
    for (const auto& child : reader_.entity().children) {
      if (child.kind == "sensor") all.push_back(readSensor(PropertyReader(child, reader_.units())));
    }
    readOldSensors(all);
    if (all.empty()) note("'" + reader_.entity().type + "' has no sensor( ), and so measures nothing");
    return all;
  }

  Rays readSensor(const PropertyReader& sensor) {
    Rays rays;
    const Size size = sensor.size(defaultSize("sensor"));
    rays.robot_from_rays = compose(mount_.robot_from_device, sensor.pose("pose"));
    rays.robot_from_rays.z_m += size.z / 2;
    if (const auto range = sensor.numbers("range", 2); !range.empty()) {
      rays.range_min_m = range[0] * sensor.lengthUnit_m();
      rays.range_max_m = range[1] * sensor.lengthUnit_m();
    }
    rays.fov_rad = sensor.angle("fov", rays.fov_rad);
    rays.samples = samplesOf(sensor, 1);
    if (const auto noise = sensor.numbers("noise", 1); !noise.empty()) {
      // Stage adds a normal error of variance `c`, and a uniform one of ± `p` of the range.
      rays.std_m = std::sqrt(std::max(0.0, noise[0]));
      if (noise.size() > 1) rays.std_per_m = std::abs(noise[1]) / std::sqrt(3.0);
      if (noise.size() > 2 && noise[2] != 0) {
        mount_.notes->add(sensor.find("noise")->place, "the error of the angle in 'noise' has no equivalent");
      }
    }
    rays.period_s = period_s();
    return rays;
  }

  static int samplesOf(const PropertyReader& reader, int otherwise) {
    const double samples = reader.number("samples", otherwise);
    if (!(samples >= 1 && samples <= 10'000)) PropertyReader::fail(*reader.find("samples"), "must be from 1 to 10,000");
    return static_cast<int>(samples);
  }

  /// scount, spose[n], ssize and sview of Stage 2 and 3.
  void readOldSensors(std::vector<Rays>& all) {
    const double count = reader_.number("scount", 0);
    const auto view = reader_.numbers("sview", 3);
    reader_.numbers("ssize", 2);
    for (std::size_t i = 0; static_cast<double>(i) < std::min(count, 1000.0); ++i) {
      if (!reader_.has(indexed("spose", i))) continue;
      Rays rays;
      rays.robot_from_rays = compose(mount_.robot_from_device, reader_.pose(indexed("spose", i)));
      rays.robot_from_rays.z_m += mount_.size.z / 2;
      if (!view.empty()) {
        rays.range_min_m = view[0] * reader_.lengthUnit_m();
        rays.range_max_m = view[1] * reader_.lengthUnit_m();
        rays.fov_rad = view[2] * reader_.angleUnit_rad();
      }
      all.push_back(rays);
    }
  }

  Rays readLaser() {
    Rays rays;
    rays.robot_from_rays = mount_.robot_from_device;
    rays.robot_from_rays.z_m += mount_.size.z / 2;
    rays.range_min_m = reader_.length("range_min", 0);
    rays.range_max_m = reader_.length("range_max", 8);
    rays.fov_rad = reader_.angle("fov", 180 * kRadPerDeg);
    rays.samples = samplesOf(reader_, 180);
    rays.period_s = period_s();
    return rays;
  }

  void addRays(const std::vector<Rays>& all) {
    std::map<std::tuple<double, double, double, double, double>, std::vector<const Rays*>> single;
    for (const auto& rays : all) {
      mount_.highest_m = std::max(mount_.highest_m, rays.robot_from_rays.z_m);
      if (!(rays.range_max_m > 0)) {
        note("a sensor of '" + reader_.entity().type + "' with a range of 0 is left out");
      } else if (rays.samples > 1 && rays.fov_rad > 0) {
        addLaser(rays);
      } else {
        single[{rays.range_min_m, rays.range_max_m, rays.fov_rad, rays.std_m, rays.std_per_m}].push_back(&rays);
      }
    }
    for (const auto& [settings, group] : single) addSonar(group);
  }

  void addLaser(const Rays& rays) {
    XmlElement& laser = sensors_.add("laser");
    setPose(laser, rays.robot_from_rays);
    setNumber(laser, "angle_deg", degrees(rays.robot_from_rays.plan.phi));
    setNumber(laser, "beams", rays.samples);
    setNumber(laser, "field_of_view_deg", std::min(toDegrees(rays.fov_rad), 360.0));
    setRange(laser, rays, 1000);
    if (rays.period_s > 0) setNumber(laser, "rate_hz", std::min(1 / rays.period_s, 1000.0));
    setNoise(rays, laser);
  }

  /// Sensors of one ray each.
  void addSonar(const std::vector<const Rays*>& group) {
    XmlElement& sonar = sensors_.add("sonar");
    sonar.attributes = {{"model", "rays"}, {"rays", "1"}};
    setNumber(sonar, "beam_width_deg", std::clamp(toDegrees(group[0]->fov_rad), 0.1, 120.0));
    setRange(sonar, *group[0], 100);
    setNoise(*group[0], sonar);
    // Every surface returns an echo, at any angle.
    for (auto& noise : sonar.children) setNumber(noise, "specular_deg", 180);
    for (const Rays* rays : group) {
      XmlElement& at = sonar.add("at");
      setPose(at, rays->robot_from_rays);
      setNumber(at, "angle_deg", degrees(rays->robot_from_rays.plan.phi));
    }
  }

  static double degrees(double angle_rad) { return std::clamp(toDegrees(angle_rad), -360.0, 360.0); }

  void setRange(XmlElement& element, const Rays& rays, double largest_m) {
    const double range_max_m = std::min(rays.range_max_m, largest_m);
    if (range_max_m < rays.range_max_m)
      note("a range of '" + reader_.entity().type + "' is limited to " + toText(largest_m) + " m");
    setNumber(element, "range_max_m", range_max_m);
    if (rays.range_min_m > 0) setNumber(element, "range_min_m", std::min(rays.range_min_m, range_max_m));
  }

  XmlElement& addPictures(const Pose& pose, double width_px, double height_px, double fov_rad) {
    XmlElement& camera = sensors_.add("camera");
    setPose(camera, {pose.plan, pose.z_m + mount_.size.z / 2 + 0.01});
    setNumber(camera, "angle_deg", degrees(pose.plan.phi));
    setNumber(camera, "width_px", std::clamp(std::floor(width_px), 1.0, 2048.0));
    setNumber(camera, "height_px", std::clamp(std::floor(height_px), 1.0, 2048.0));
    setNumber(camera, "field_of_view_deg", std::clamp(toDegrees(fov_rad), 1.0, 170.0));
    if (const double period = period_s(); period > 0) setNumber(camera, "rate_hz", std::min(1 / period, 1000.0));
    return camera;
  }

  void addCamera() {
    auto size = reader_.numbers("resolution", 2);
    if (size.empty()) size = {32, 32};
    const auto fov = reader_.numbers("fov", 1);
    const auto pan_tilt = reader_.numbers("pantilt", 2);
    const double unit = reader_.angleUnit_rad();
    Pose pose = mount_.robot_from_device;
    if (!pan_tilt.empty()) pose.plan.phi += pan_tilt[0] * unit;
    XmlElement& camera = addPictures(pose, size[0], size[1], fov.empty() ? 70 * kRadPerDeg : fov[0] * unit);
    if (pan_tilt.empty() || pan_tilt[1] == 0) return;
    setNumber(camera, "tilt_deg", std::clamp(toDegrees(pan_tilt[1] * unit), -90.0, 90.0));
  }

  void addBlobfinder() {
    reader_.number("colors_count", 0);
    std::vector<std::pair<std::string, std::array<float, 3>>> colors;
    for (const auto& name : reader_.texts("colors")) {
      const auto rgb = colorNamed(name);
      const bool is_grey = rgb && (*rgb)[0] == (*rgb)[1] && (*rgb)[1] == (*rgb)[2];
      const bool is_repeated =
          std::any_of(colors.begin(), colors.end(), [&](const auto& one) { return one.first == name; });
      if (!rgb || is_grey) {
        mount_.notes->add(reader_.find("colors")->place, "blobs of the colour \"" + name + "\" are not found: it " +
                                                             (rgb ? "has no hue" : "is not known"));
      } else if (!is_repeated && colors.size() < 32) {
        colors.emplace_back(name, *rgb);
      }
    }
    if (colors.empty()) {
      note("'" + reader_.entity().type + "' without colors is left out, because a blob finder looks for colours");
      return;
    }
    auto size = reader_.numbers("image", 2);
    if (size.empty()) size = {80, 60};
    Pose pose = mount_.robot_from_device;
    pose.plan.phi += reader_.angle("pan", 0);
    addPictures(pose, size[0], size[1], reader_.angle("fov", 60 * kRadPerDeg));
    XmlElement& finder = sensors_.add("blob_finder");
    for (const auto& [name, rgb] : colors) {
      std::string text;
      for (const float channel : rgb)
        text += (text.empty() ? "" : " ") + toText(std::floor(channel * 1000 + 0.5) / 1000);
      finder.add("color").attributes = {{"name", name}, {"rgb", text}};
    }
  }

  void addFiducial() {
    reader_.number("ignore_zloc", 0);
    if (reader_.length("range_min", 0) > 0)
      note("'" + reader_.entity().type + "' sees marks nearer than its range_min, too");
    XmlElement& sensor = sensors_.add("fiducial");
    setPose(sensor, {mount_.robot_from_device.plan, mount_.robot_height_m / 2});
    setNumber(sensor, "angle_deg", degrees(mount_.robot_from_device.plan.phi));
    setNumber(sensor, "range_max_m", std::clamp(reader_.length("range_max", 8), 0.001, 100.0));
    setNumber(sensor, "id_range_max_m", std::clamp(reader_.length("range_max_id", 5), 0.001, 100.0));
    setNumber(sensor, "field_of_view_deg", std::clamp(toDegrees(reader_.angle("fov", 180 * kRadPerDeg)), 0.1, 360.0));
    setNumber(sensor, "count", 64);
  }

  void addGripper() {
    const auto& all = sensors_.children;
    if (std::any_of(all.begin(), all.end(), [](const auto& sensor) { return sensor.name == "gripper"; })) {
      note("a robot has one gripper, without its second one");
      return;
    }
    auto paddle = reader_.numbers("paddle_size", 2);
    if (paddle.empty()) paddle = {0.66, 0.1, 0.4};
    XmlElement& gripper = sensors_.add("gripper");
    setNumber(gripper, "opening_m", std::clamp(mount_.size.y * (1 - 2 * paddle[1]), 0.001, 10.0));
    setNumber(gripper, "reach_m", std::clamp(mount_.size.x * paddle[0], 0.001, 10.0));
    setNumber(gripper, "z_m", std::clamp(mount_.robot_from_device.z_m, 0.01, 10.0));
  }

  SensorMount& mount_;
  const PropertyReader& reader_;
  XmlElement& sensors_;
};

}  // namespace

bool addSensor(SensorMount& mount, XmlElement& sensors) { return SensorTranslator(mount, sensors).translate(); }

}  // namespace robosim::stage
