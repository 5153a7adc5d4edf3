#include "topics/sensor_readings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hardware/gnss_fix.h"
#include "hardware/inertial_reading.h"
#include "hardware/scan_geometry.h"
#include "ros/cdr.h"
#include "topics/robot_topics.h"
#include "topics/sensor_topics.h"

namespace robosim {
namespace {

constexpr std::size_t kBeamsMax = 1 << 16;

/// The echo of a range by REP 117: infinite for none, negative infinite for one below the minimum, NaN if invalid.
Echo echoOf(const SensorInfo& sensor, std::size_t beam, float range_m) {
  const auto min_m = static_cast<float>(sensor.range_min_m), max_m = static_cast<float>(sensor.range_max_m);
  const bool is_none = std::isnan(range_m) || range_m > max_m;
  const float read_m = is_none ? static_cast<float>(sensor.no_echo_m) : std::max(range_m, min_m);
  const Beam& along = sensor.beams[beam];
  return {read_m, pointAlong(originOf(along), directionOf(along), read_m)};
}

/// Reads a message of a sensor's kind; an overload for each kind of measurement.
struct Reading {
  const SensorInfo& sensor;
  std::size_t beam;
  std::span<const std::uint8_t> message;

  void operator()(Echoes& echoes) const {
    if (sensor.kind != SensorKind::laser || !toScanGeometry(sensor.beams)) {
      echoes.at(beam) = echoOf(sensor, beam, ros::decode<ros::HumbleRange>(message).range);
      return;
    }
    const auto scan = ros::decode<ros::LaserScan>(message);
    if (scan.ranges.size() != echoes.size()) {
      throw std::runtime_error("a scan of " + std::to_string(scan.ranges.size()) + " ranges, after one of " +
                               std::to_string(echoes.size()));
    }
    for (std::size_t i = 0; i < echoes.size(); ++i) echoes[i] = echoOf(sensor, i, scan.ranges[i]);
  }
  void operator()(Scalar& scalar) const {
    if (sensor.kind == SensorKind::heat) {
      scalar.value = ros::decode<ros::Temperature>(message).temperature;
    } else if (sensor.kind == SensorKind::battery) {
      const float volts = ros::decode<ros::BatteryState>(message).voltage;
      scalar.value = std::isfinite(volts) ? volts : 0;
    } else {
      scalar.value = yawOf(ros::decode<ros::Imu>(message).orientation);
    }
  }
  void operator()(Contacts& contacts) const {
    const auto array = ros::decode<ros::UInt8MultiArray>(message);
    for (std::size_t i = 0; i < std::min(array.data.size(), contacts.pressed.size()); ++i) {
      contacts.pressed[i] = array.data[i] != 0 ? 1 : 0;
    }
  }
  void operator()(Odometry& odometry) const {
    const auto read = ros::decode<ros::Odometry>(message);
    const auto& pose = read.pose.pose;
    odometry = {{pose.position.x, pose.position.y, yawOf(pose.orientation)},
                read.twist.twist.linear.x,
                read.twist.twist.angular.z,
                read.twist.twist.linear.y};
  }
  void operator()(Image& image) const {
    const auto picture = ros::decode<ros::CompressedImage>(message);
    std::string jpeg(picture.data.begin(), picture.data.end());
    if (const std::string fault = Description<Image>::fileFaultOf(jpeg); !fault.empty()) {
      throw std::runtime_error("a picture in the format '" + picture.format + "': " + fault);
    }
    image.jpeg = std::move(jpeg);
  }
  void operator()(Values& values) const {
    if (GnssFix::isOf(sensor)) {
      const auto fix = ros::decode<ros::NavSatFix>(message);
      values = fix.status.status < ros::NavSatStatus::kFix
                   ? GnssFix{}.values()
                   : GnssFix{true, fix.latitude, fix.longitude, fix.altitude}.values();
    } else if (InertialReading::isOf(sensor)) {
      const auto imu = ros::decode<ros::Imu>(message);
      const auto& force = imu.linear_acceleration;
      values = InertialReading{imu.angular_velocity.z, force.x, force.y, force.z}.values();
    }
  }
  void operator()(auto&) const {}  // no topics
};

}  // namespace

std::vector<SensorSource> sourcesOf(const SensorInfo& sensor) {
  const std::string part = topicOf(sensor);
  switch (sensor.kind) {
    case SensorKind::laser:
      if (toScanGeometry(sensor.beams)) return {{part, &ros::typeOf<ros::LaserScan>()}};
      [[fallthrough]];
    case SensorKind::sonar:
    case SensorKind::infrared: {
      std::vector<SensorSource> sources;
      for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
        sources.push_back({part + "/range_" + std::to_string(i), &ros::typeOf<ros::Range>(), i});
      }
      return sources;
    }
    case SensorKind::heat:
      return {{part, &ros::typeOf<ros::Temperature>()}};
    case SensorKind::bumper:
      return {{part, &ros::typeOf<ros::UInt8MultiArray>()}};
    case SensorKind::odometry:
      return {{part, &ros::typeOf<ros::Odometry>()}};
    case SensorKind::compass:
      return {{part, &ros::typeOf<ros::Imu>()}};
    case SensorKind::camera:
      return {{part + "/image_raw/compressed", &ros::typeOf<ros::CompressedImage>()}};
    case SensorKind::battery:
      return {{part, &ros::typeOf<ros::BatteryState>()}};
    case SensorKind::values:
      if (GnssFix::isOf(sensor)) return {{part, &ros::typeOf<ros::NavSatFix>()}};
      if (InertialReading::isOf(sensor)) return {{part, &ros::typeOf<ros::Imu>()}};
      break;
    case SensorKind::lidar:  // a cloud has no beams
    case SensorKind::blob_finder:
    case SensorKind::beacons:
    case SensorKind::unknown:
      break;
  }
  return {};
}

SensorInfo scannerOf(const ros::LaserScan& scan, const mrpt::math::TPose3D& robot_from_scan, const SensorInfo& like) {
  const std::size_t n = scan.ranges.size();
  if (n < 2 || n > kBeamsMax) throw std::runtime_error("a scan of " + std::to_string(n) + " ranges");
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment))
    throw std::runtime_error("a scan without angles");
  if (!(scan.range_max > 0) || !std::isfinite(scan.range_max) || !(scan.range_min >= 0))
    throw std::runtime_error("a scan without limits of its ranges");
  SensorInfo scanner = like;
  scanner.pans = false;
  scanner.range_min_m = scan.range_min;
  scanner.range_max_m = scanner.no_echo_m = scan.range_max;
  scanner.beams.assign(n, {robot_from_scan});
  for (std::size_t i = 0; i < n; ++i) {
    const double angle_rad = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    scanner.beams[i].robot_from_beam.yaw = std::remainder(robot_from_scan.yaw + angle_rad, 2 * M_PI);
  }
  if (!toScanGeometry(scanner.beams))
    throw std::runtime_error("a scan that is wider than a full turn, or has no angle between its ranges");
  return scanner;
}

void readMeasurement(const SensorInfo& sensor, std::size_t beam, std::span<const std::uint8_t> message,
                     Measurement& measurement) {
  std::visit(Reading{sensor, beam, message}, measurement);
}

}  // namespace robosim
