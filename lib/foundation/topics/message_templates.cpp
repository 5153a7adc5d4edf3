#include "topics/message_templates.h"

#include <cmath>
#include <limits>

namespace robosim {
namespace {

constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();

template <ros::Message M, typename... Fields>
ros::MessageTemplate stamped(const M& message, const Fields&... changing) {
  return ros::MessageTemplate(message, message.header.stamp.sec, message.header.stamp.nanosec, changing...);
}

}  // namespace

ros::MessageTemplate scanTemplate(const SensorInfo& sensor, const ScanGeometry& geometry, const std::string& frame) {
  ros::LaserScan scan;
  scan.header.frame_id = frame;
  scan.angle_min = static_cast<float>(-geometry.aperture_rad / 2);
  scan.angle_max = static_cast<float>(geometry.aperture_rad / 2);
  scan.angle_increment = static_cast<float>(std::abs(geometry.step_rad));
  scan.scan_time = sensor.times.rate_hz > 0 ? static_cast<float>(1 / sensor.times.rate_hz) : 0;
  scan.range_min = static_cast<float>(sensor.range_min_m);
  scan.range_max = static_cast<float>(sensor.range_max_m);
  scan.ranges.resize(sensor.beams.size());
  return stamped(scan, scan.ranges);
}

ros::MessageTemplate rangeTemplate(const SensorInfo& sensor, const std::string& frame, RosDistribution distribution) {
  const auto make = [&](auto range) {
    range.header.frame_id = frame;
    range.radiation_type = sensor.kind == SensorKind::sonar ? ros::Range::kUltrasound : ros::Range::kInfrared;
    range.field_of_view = static_cast<float>(sensor.beam_width_rad);
    range.min_range = static_cast<float>(sensor.range_min_m);
    range.max_range = static_cast<float>(sensor.range_max_m);
    return stamped(range, range.range);
  };
  return distribution == RosDistribution::humble ? make(ros::HumbleRange()) : make(ros::Range());
}

ros::MessageTemplate odometryTemplate(const std::string& frame, const std::string& child) {
  ros::Odometry message;
  message.header.frame_id = frame;
  message.child_frame_id = child;
  const auto& [position, orientation] = message.pose.pose;
  const auto& [linear, angular] = message.twist.twist;
  return stamped(message, position.x, position.y, orientation.z, orientation.w, linear.x, angular.z, linear.y);
}

void setPose(ros::MessageTemplate& odometry, const mrpt::math::TPose2D& pose) {
  const ros::Quaternion rotation = rotationOf(pose.phi, 0, 0);
  odometry.set(kX, pose.x);
  odometry.set(kY, pose.y);
  odometry.set(kRotationZ, rotation.z);
  odometry.set(kRotationW, rotation.w);
}

ros::MessageTemplate cloudTemplate(const std::string& frame) {
  ros::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  cloud.height = 1;
  cloud.point_step = 12;
  cloud.fields = {{"x", 0, ros::PointField::kFloat32, 1},
                  {"y", 4, ros::PointField::kFloat32, 1},
                  {"z", 8, ros::PointField::kFloat32, 1}};
  cloud.is_dense = true;
  return stamped(cloud, cloud.width, cloud.row_step);
}

ros::MessageTemplate pictureTemplate(const std::string& frame) {
  ros::CompressedImage picture;
  picture.header.frame_id = frame;
  picture.format = "jpeg";
  return stamped(picture);
}

ros::MessageTemplate cameraTemplate(const CameraInfo& camera, const std::string& frame) {
  const double focal_px = camera.focalLength();
  const double x = camera.width_px / 2.0, y = camera.height_px / 2.0;
  ros::CameraInfo info;
  info.header.frame_id = frame;
  info.height = camera.height_px;
  info.width = camera.width_px;
  info.distortion_model = "plumb_bob";
  info.d = {camera.distortion.k1, camera.distortion.k2, camera.distortion.p1, camera.distortion.p2,
            camera.distortion.k3};
  info.k = {focal_px, 0, x, 0, focal_px, y, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {focal_px, 0, x, 0, 0, focal_px, y, 0, 0, 0, 1, 0};
  return stamped(info);
}

ros::MessageTemplate temperatureTemplate(const std::string& frame) {
  ros::Temperature message;
  message.header.frame_id = frame;
  return stamped(message, message.temperature);
}

ros::MessageTemplate batteryTemplate(const std::string& frame) {
  ros::BatteryState battery;
  battery.header.frame_id = frame;
  for (float* unmeasured : {&battery.temperature, &battery.current, &battery.charge, &battery.capacity,
                            &battery.design_capacity, &battery.percentage}) {
    *unmeasured = kNotMeasured;
  }
  battery.present = true;
  return stamped(battery, battery.voltage);
}

ros::MessageTemplate compassTemplate(const std::string& frame) {
  ros::Imu imu;
  imu.header.frame_id = frame;
  imu.angular_velocity_covariance[0] = imu.linear_acceleration_covariance[0] = -1;
  return stamped(imu, imu.orientation.z, imu.orientation.w);
}

ros::Quaternion product(const ros::Quaternion& a, const ros::Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

ros::Quaternion rotationOf(double yaw, double pitch, double roll) {
  const ros::Quaternion about_z{0, 0, std::sin(yaw / 2), std::cos(yaw / 2)};
  if (pitch == 0 && roll == 0) return about_z;
  return product(product(about_z, {0, std::sin(pitch / 2), 0, std::cos(pitch / 2)}),
                 {std::sin(roll / 2), 0, 0, std::cos(roll / 2)});
}

}  // namespace robosim
