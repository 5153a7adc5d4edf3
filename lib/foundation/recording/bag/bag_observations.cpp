#include "recording/bag/bag_observations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/label.h"
#include "recording/bag/bag_picture.h"
#include "recording/codecs.h"
#include "recording/cone_aperture.h"
#include "recording/echo_ranges.h"
#include "ros/cdr.h"
#include "topics/frame_tree.h"
#include "topics/topic.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;

constexpr std::size_t kMaxBeams = 1 << 20;

constexpr std::array kUses{
    BagUseRow{"sensor_msgs/msg/LaserScan", BagUse::observation, "CObservation2DRangeScan"},
    BagUseRow{"sensor_msgs/msg/Range", BagUse::observation, "CObservationRange"},
    BagUseRow{"nav_msgs/msg/Odometry", BagUse::odometry, "CObservationOdometry"},
    BagUseRow{"sensor_msgs/msg/BatteryState", BagUse::observation, "CObservationBatteryState"},
    BagUseRow{"sensor_msgs/msg/Imu", BagUse::observation, "CObservationIMU"},
    BagUseRow{"sensor_msgs/msg/Temperature", BagUse::observation, "CObservationGasSensors"},
    BagUseRow{"sensor_msgs/msg/CompressedImage", BagUse::observation, "CObservationImage"},
    BagUseRow{"sensor_msgs/msg/Image", BagUse::observation, "CObservationImage"},
    BagUseRow{"sensor_msgs/msg/CameraInfo", BagUse::camera_info, "parameters of CObservationImage"},
    BagUseRow{"tf2_msgs/msg/TFMessage", BagUse::transforms, "poses of sensors; odometry where no topic has it"},
};

}  // namespace

CObservation::Ptr scanObservation(const ros::LaserScan& scan, const CPose3D& robot_from_scanner) {
  const std::size_t count = scan.ranges.size();
  const double increment = static_cast<double>(scan.angle_increment), first = static_cast<double>(scan.angle_min);
  if (count == 0 || count > kMaxBeams) throw std::runtime_error(std::to_string(count) + " ranges");
  if (!std::isfinite(increment) || !std::isfinite(first)) throw std::runtime_error("angles that are not finite");
  // angle_max is the more exact one, unless it is one beam further, as some drivers write it.
  const double between = static_cast<double>(scan.angle_max) - first;
  const double by_increment = increment * static_cast<double>(count - 1);
  const double turned = std::abs(between - by_increment) < std::abs(increment) / 2 ? between : by_increment;
  auto made = mrpt::obs::CObservation2DRangeScan::Create();
  made->aperture = static_cast<float>(std::abs(turned));
  made->rightToLeft = turned >= 0;
  made->maxRange = scan.range_max;
  // MRPT's angles are about the middle of the scan.
  const double middle = first + turned / 2;
  made->sensorPose = std::abs(middle) < 1e-6 ? robot_from_scanner : robot_from_scanner + CPose3D(0, 0, 0, middle, 0, 0);
  made->resizeScan(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float range_m = scan.ranges[i];
    const bool is_valid = range_m >= scan.range_min && range_m <= scan.range_max && range_m > 0;
    made->setScanRange(i, std::isfinite(range_m) ? range_m : scan.range_max);
    made->setScanRangeValidity(i, is_valid);
  }
  return made;
}

namespace {

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::LaserScan& scan) {
  return scanObservation(scan, sensor.robot_from_frame);
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::HumbleRange& range) {
  auto made = mrpt::obs::CObservationRange::Create();
  made->minSensorDistance = range.min_range;
  made->maxSensorDistance = range.max_range;
  coneAperture(*made) = range.field_of_view;
  auto& sensed = made->sensedData.emplace_back();
  sensed.sensorID = sensor.id;
  sensed.sensorPose = sensor.robot_from_frame.asTPose();
  SensorInfo limits;
  limits.range_max_m = static_cast<double>(range.max_range);
  sensed.sensedDistance = std::isnan(range.range)         ? 0  // invalid
                          : range.range > range.max_range ? recordedNoEcho(limits)
                          : range.range < 0               ? range.min_range  // too close (REP 117)
                                                          : range.range;
  return made;
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::Odometry& odometry) {
  const auto& pose = odometry.pose.pose;
  const auto& linear = odometry.twist.twist.linear;
  const auto& angular = odometry.twist.twist.angular;
  if (!isFinite(pose.position, pose.orientation)) throw std::runtime_error("a pose that is not finite");
  if (Label::parse(sensor.label).sensor == kGroundTruth) {
    auto made = mrpt::obs::CObservationRobotPose::Create();
    made->pose.mean = toPose(pose);
    return made;
  }
  auto made = bagOdometry(sensor.label, {{pose.position.x, pose.position.y, pose.position.z}, pose.orientation});
  const double turn_radps = angular.z == 0 ? kNoTurn_radps : angular.z;
  auto& with_speeds = static_cast<mrpt::obs::CObservationOdometry&>(*made);
  with_speeds.hasVelocities = true;
  with_speeds.velocityLocal = {linear.x, linear.y, turn_radps};
  return made;
}

CObservation::Ptr observationOf(const BagSensor&, const ros::BatteryState& battery) {
  auto made = mrpt::obs::CObservationBatteryState::Create();
  made->voltageMainRobotBattery = static_cast<double>(battery.voltage);
  made->voltageMainRobotBatteryIsValid = std::isfinite(battery.voltage);
  return made;
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::Imu& imu) {
  auto made = mrpt::obs::CObservationIMU::Create();
  made->sensorPose = sensor.robot_from_frame;
  made->dataIsPresent.fill(false);
  made->rawMeasurements.fill(0);
  const auto& turn = imu.orientation;
  const bool has_length = turn.x != 0 || turn.y != 0 || turn.z != 0 || turn.w != 0;
  if (imu.orientation_covariance[0] != -1 && has_length && isFinite(ros::Point(), turn)) {
    const CPose3D pose = toPose(ros::Vector3(), turn);
    made->set(mrpt::obs::IMU_YAW, pose.yaw());
    if (turn.x != 0 || turn.y != 0) {
      made->set(mrpt::obs::IMU_PITCH, pose.pitch());
      made->set(mrpt::obs::IMU_ROLL, pose.roll());
    }
  }
  if (imu.angular_velocity_covariance[0] != -1) {
    made->set(mrpt::obs::IMU_WX, imu.angular_velocity.x);
    made->set(mrpt::obs::IMU_WY, imu.angular_velocity.y);
    made->set(mrpt::obs::IMU_WZ, imu.angular_velocity.z);
  }
  if (imu.linear_acceleration_covariance[0] != -1) {
    made->set(mrpt::obs::IMU_X_ACC, imu.linear_acceleration.x);
    made->set(mrpt::obs::IMU_Y_ACC, imu.linear_acceleration.y);
    made->set(mrpt::obs::IMU_Z_ACC, imu.linear_acceleration.z);
  }
  return made;
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::Temperature& temperature) {
  auto made = mrpt::obs::CObservationGasSensors::Create();
  auto& nose = made->m_readings.emplace_back();
  nose.eNosePoseOnTheRobot = sensor.robot_from_frame.asTPose();
  nose.hasTemperature = true;
  nose.isActive = true;
  nose.temperature = static_cast<float>(temperature.temperature);
  return made;
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::CompressedImage& picture) {
  return pictureObservation(picture, sensor.camera, sensor.robot_from_frame);
}

CObservation::Ptr observationOf(const BagSensor& sensor, const ros::Image& picture) {
  return pictureObservation(picture, sensor.camera, sensor.robot_from_frame);
}

/// Decodes the message as M, if M is of the sensor's type.
template <typename M>
bool tryAs(const BagSensor& sensor, std::span<const std::uint8_t> data, CObservation::Ptr& made) {
  if (sensor.type != M::kType) return false;
  made = observationOf(sensor, ros::decode<M>(data));
  return true;
}

template <typename... M>
CObservation::Ptr observationOfOneOf(const BagSensor& sensor, std::span<const std::uint8_t> data) {
  CObservation::Ptr made;
  (tryAs<M>(sensor, data, made) || ...);
  return made;
}

}  // namespace

std::span<const BagUseRow> bagUses() { return kUses; }

BagUse bagUseOf(const std::string& type) {
  const auto row = std::find_if(kUses.begin(), kUses.end(), [&](const BagUseRow& one) { return one.type == type; });
  return row == kUses.end() ? BagUse::none : row->use;
}

mrpt::Clock::time_point timestampOf(std::int64_t time_ns) {
  constexpr std::int64_t kNsPerTick = 1'000'000'000 / mrpt::Clock::period::den;
  return mrpt::Clock::fromDouble(0) + mrpt::Clock::duration(time_ns / kNsPerTick);
}

BagHeader bagHeaderOf(const std::string& type, std::span<const std::uint8_t> data) {
  ros::CdrReader reader(data);
  ros::Header header;
  reader.read(header);
  BagHeader read{nanosecondsOf(header.stamp), frameName(header.frame_id), {}};
  if (type != ros::Odometry::kType) return read;
  reader.read(read.child_frame);
  read.child_frame = frameName(read.child_frame);
  return read;
}

CObservation::Ptr bagObservation(const BagSensor& sensor, std::span<const std::uint8_t> data) {
  const auto made = observationOfOneOf<ros::LaserScan, ros::HumbleRange, ros::Odometry, ros::BatteryState, ros::Imu,
                                       ros::Temperature, ros::CompressedImage, ros::Image>(sensor, data);
  if (!made) throw std::runtime_error("the type " + sensor.type);
  made->sensorLabel = sensor.label;
  return made;
}

bool addBagRange(CObservation& all, const CObservation& range) {
  auto* const to = dynamic_cast<mrpt::obs::CObservationRange*>(&all);
  const auto* const from = dynamic_cast<const mrpt::obs::CObservationRange*>(&range);
  if (!to || !from || from->maxSensorDistance != to->maxSensorDistance) return false;
  to->sensedData.insert(to->sensedData.end(), from->sensedData.begin(), from->sensedData.end());
  return true;
}

CObservation::Ptr bagOdometry(const std::string& label, const ros::Transform& odom_from_robot) {
  auto made = mrpt::obs::CObservationOdometry::Create();
  made->sensorLabel = label;
  const CPose3D pose = toPose(odom_from_robot.translation, odom_from_robot.rotation);
  made->odometry.x(odom_from_robot.translation.x);
  made->odometry.y(odom_from_robot.translation.y);
  made->odometry.phi(pose.yaw());
  return made;
}

}  // namespace robosim
