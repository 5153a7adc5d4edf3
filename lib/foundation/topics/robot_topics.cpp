#include "topics/robot_topics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <nlohmann/json.hpp>

#include "hardware/measurement_fields.h"
#include "hardware/scan_geometry.h"
#include "topics/sensor_topics.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();

ros::Quaternion product(const ros::Quaternion& a, const ros::Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// Rotations about z, then the new y, then the new x.
ros::Quaternion rotationOf(double yaw, double pitch, double roll) {
  const ros::Quaternion about_z{0, 0, std::sin(yaw / 2), std::cos(yaw / 2)};
  if (pitch == 0 && roll == 0) return about_z;
  return product(product(about_z, {0, std::sin(pitch / 2), 0, std::cos(pitch / 2)}),
                 {std::sin(roll / 2), 0, 0, std::cos(roll / 2)});
}

/// From a camera's frame to its optical one: z forward, x right, y down (REP 103).
const ros::Quaternion kOpticalRotation{-0.5, 0.5, -0.5, 0.5};

ros::TransformStamped transformOf(const std::string& parent, const std::string& child, const TPose3D& pose,
                                  ros::Time stamp = {}) {
  return {{stamp, parent}, child, {{pose.x, pose.y, pose.z}, rotationOf(pose.yaw, pose.pitch, pose.roll)}};
}

/// "scan" for "laser", "scan_2" for "laser_2"; other labels as they are.
std::string topicOf(const SensorInfo& sensor) {
  const std::string kind = nameOf(sensor.kind);
  const std::string base = sensor.kind == SensorKind::odometry ? "odom"
                           : sensor.kind == SensorKind::laser  ? "scan"
                                                               : kind;
  const std::string& label = sensor.label;
  if (label == kind) return base;
  if (label.starts_with(kind + "_")) return topicNamePart(base + label.substr(kind.size()));
  return topicNamePart(label);
}

/// By REP 117.
float rangeOf(const SensorInfo& sensor, float range_m) {
  if (range_m >= static_cast<float>(sensor.no_echo_m)) return kInfinite;
  if (sensor.range_min_m > 0 && range_m <= static_cast<float>(sensor.range_min_m)) return -kInfinite;
  return range_m;
}

std::string joined(const auto& names, const auto& text) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ",") + text(name);
  return all;
}

/// A one-dimensional array.
ros::MultiArrayLayout layoutOf(const std::string& label, std::size_t size) {
  return {{{label, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size)}}, 0};
}

ros::CameraInfo infoOf(const CameraInfo& camera) {
  const double focal_px = camera.focalLength();
  const double x = camera.width_px / 2.0, y = camera.height_px / 2.0;
  ros::CameraInfo info;
  info.height = camera.height_px;
  info.width = camera.width_px;
  info.distortion_model = "plumb_bob";
  info.d = {camera.distortion.k1, camera.distortion.k2, camera.distortion.p1, camera.distortion.p2,
            camera.distortion.k3};
  info.k = {focal_px, 0, x, 0, focal_px, y, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {focal_px, 0, x, 0, 0, focal_px, y, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace

ros::Pose poseOf(const TPose2D& pose) { return {{pose.x, pose.y, 0}, rotationOf(pose.phi, 0, 0)}; }

TopicMessage staticTransforms(std::span<const RobotTopics> robots, std::uint64_t time_ns) {
  ros::TFMessage message;
  for (const auto& robot : robots) {
    message.transforms.insert(message.transforms.end(), robot.mounts().begin(), robot.mounts().end());
  }
  for (auto& mount : message.transforms) mount.header.stamp = timeOf(time_ns);
  return topicMessage("/tf_static", TopicDelivery::latched, time_ns, message);
}

RobotTopics::RobotTopics(const RobotInfo& robot)
    : name_(topicNamePart(robot.name)),
      base_frame_(name_ + "/base_link"),
      odom_frame_(name_ + "/odom"),
      sensors_(robot.sensors) {
  topics_.push_back({"/tf", &ros::typeOf<ros::TFMessage>(), TopicDelivery::transforms});
  truth_ = addTopic("ground_truth", ros::typeOf<ros::Odometry>(), TopicDelivery::steady);
  command_ = addTopic("cmd_vel", ros::typeOf<ros::Twist>(), TopicDelivery::steady);
  inbox_ = addTopic("messages", ros::typeOf<ros::String>(), TopicDelivery::steady);
  for (const auto& sensor : *sensors_) addSensor(sensor);
}

std::size_t RobotTopics::addTopic(const std::string& name, const ros::MessageType& type, TopicDelivery delivery) {
  topics_.push_back({"/" + name_ + "/" + name, &type, delivery});
  return topics_.size() - 1;
}

void RobotTopics::addMount(const std::string& frame, const TPose3D& pose) {
  mounts_.push_back(transformOf(base_frame_, frame, pose));
}

void RobotTopics::addRangeSensor(const SensorInfo& sensor, const std::string& part, SensorMessages& made) {
  const auto range_min = static_cast<float>(sensor.range_min_m), range_max = static_cast<float>(sensor.range_max_m);
  const auto geometry = sensor.kind == SensorKind::laser ? toScanGeometry(sensor.beams) : std::nullopt;
  if (geometry) {
    addTopic(part, ros::typeOf<ros::LaserScan>(), TopicDelivery::sensor);
    made.robot_from_frame = geometry->robot_from_middle;
    made.is_clockwise = geometry->step_rad < 0;
    ros::LaserScan& scan = made.scan.emplace();
    scan.header.frame_id = made.frame;
    scan.angle_min = static_cast<float>(-geometry->aperture_rad / 2);
    scan.angle_max = static_cast<float>(geometry->aperture_rad / 2);
    scan.angle_increment = static_cast<float>(std::abs(geometry->step_rad));
    scan.scan_time = sensor.times.rate_hz > 0 ? static_cast<float>(1 / sensor.times.rate_hz) : 0;
    scan.range_min = range_min;
    scan.range_max = range_max;
    scan.ranges.resize(sensor.beams.size());
    return;
  }
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    const std::string number = std::to_string(i);
    addTopic(part + "/range_" + number, ros::typeOf<ros::Range>(), TopicDelivery::sensor);
    ros::Range range;
    range.header.frame_id = made.frame + "_" + number;
    range.radiation_type = sensor.kind == SensorKind::sonar ? ros::Range::kUltrasound : ros::Range::kInfrared;
    range.field_of_view = static_cast<float>(sensor.beam_width_rad);
    range.min_range = range_min;
    range.max_range = range_max;
    made.ranges.push_back(range);
    if (!sensor.pans) addMount(range.header.frame_id, sensor.beams[i].robot_from_beam);
  }
  addTopic(part + "/points", ros::typeOf<ros::PointCloud2>(), TopicDelivery::sensor);
}

void RobotTopics::addSensor(const SensorInfo& sensor) {
  SensorMessages made;
  const std::string part = topicOf(sensor);
  made.topic = topics_.size();
  made.frame = name_ + "/" + topicNamePart(sensor.label);
  if (!sensor.beams.empty()) made.robot_from_frame = sensor.beams[0].robot_from_beam;
  switch (sensor.kind) {
    case SensorKind::sonar:
    case SensorKind::laser:
    case SensorKind::infrared:
      addRangeSensor(sensor, part, made);
      break;
    case SensorKind::heat:
      addTopic(part, ros::typeOf<ros::Temperature>(), TopicDelivery::sensor);
      break;
    case SensorKind::bumper:
      addTopic(part, ros::typeOf<ros::UInt8MultiArray>(), TopicDelivery::sensor);
      break;
    case SensorKind::odometry:
      addTopic(part, ros::typeOf<ros::Odometry>(), TopicDelivery::steady);
      break;
    case SensorKind::compass:
      addTopic(part, ros::typeOf<ros::Imu>(), TopicDelivery::sensor);
      break;
    case SensorKind::camera: {
      addTopic(part + "/image_raw/compressed", ros::typeOf<ros::CompressedImage>(), TopicDelivery::sensor);
      addTopic(part + "/camera_info", ros::typeOf<ros::CameraInfo>(), TopicDelivery::sensor);
      made.frame += "_optical";
      made.camera = infoOf(sensor.camera);
      made.camera.header.frame_id = made.frame;
      addMount(made.frame, made.robot_from_frame);
      auto& rotation = mounts_.back().transform.rotation;
      rotation = product(rotation, kOpticalRotation);
      break;
    }
    case SensorKind::battery:
      addTopic(part, ros::typeOf<ros::BatteryState>(), TopicDelivery::steady);
      break;
    case SensorKind::blob_finder:
    case SensorKind::beacons:
    case SensorKind::values:
      addTopic(part, ros::typeOf<ros::Float64MultiArray>(), TopicDelivery::sensor);
      break;
    case SensorKind::unknown:
      break;
  }
  const bool has_frame = made.scan || sensor.kind == SensorKind::heat;
  if (has_frame && !sensor.pans) addMount(made.frame, made.robot_from_frame);
  of_sensor_.push_back(std::move(made));
}

/// Encodes the measurements of a step; an overload for each kind.
struct RobotTopics::Encoder {
  const RobotTopics& robot;
  TopicSink& sink;
  ros::Time stamp;
  double pan_rad;
  std::vector<ros::TransformStamped>& transforms;
  const SensorInfo* sensor = nullptr;
  SensorMessages* made = nullptr;

  template <ros::Message M>
  void put(std::size_t topic, const M& message) {
    if (!sink.wants(topic)) return;
    ros::encode(message, sink.beginMessage(topic));
    sink.endMessage();
  }
  ros::Header header(const std::string& frame) const { return {stamp, frame}; }

  void operator()(const Echoes& echoes) {
    if (made->scan) {
      ros::LaserScan& scan = *made->scan;
      scan.header.stamp = stamp;
      const std::size_t count = std::min(echoes.size(), scan.ranges.size());
      for (std::size_t i = 0; i < count; ++i) {
        scan.ranges[made->is_clockwise ? count - 1 - i : i] = rangeOf(*sensor, echoes[i].range_m);
      }
      put(made->topic, scan);
      if (sensor->pans) addPanned(made->frame, made->robot_from_frame);
      return;
    }
    ros::PointCloud2 cloud;
    const std::size_t count = std::min(echoes.size(), made->ranges.size());
    for (std::size_t i = 0; i < count; ++i) {
      ros::Range& range = made->ranges[i];
      range.header.stamp = stamp;
      range.range = rangeOf(*sensor, echoes[i].range_m);
      put(made->topic + i, range);
      if (sensor->pans) addPanned(range.header.frame_id, sensor->beams[i].robot_from_beam);
      if (range.range == kInfinite) continue;
      const auto& point = echoes[i].point_m;
      const float xyz[3] = {point.x, point.y, point.z};
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(xyz);
      cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof xyz);
    }
    cloud.header = header(robot.base_frame_);
    cloud.height = 1;
    cloud.point_step = 12;
    cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
    cloud.width = cloud.row_step / cloud.point_step;
    cloud.fields = {{"x", 0, ros::PointField::kFloat32, 1},
                    {"y", 4, ros::PointField::kFloat32, 1},
                    {"z", 8, ros::PointField::kFloat32, 1}};
    cloud.is_dense = true;
    put(made->topic + count, cloud);
  }
  void operator()(const Scalar& scalar) {
    if (sensor->kind == SensorKind::heat) {
      put(made->topic, ros::Temperature{header(made->frame), scalar.value, 0});
    } else if (sensor->kind == SensorKind::battery) {
      ros::BatteryState battery;
      battery.header = header(robot.base_frame_);
      battery.voltage = static_cast<float>(scalar.value);
      for (float* unmeasured : {&battery.temperature, &battery.current, &battery.charge, &battery.capacity,
                                &battery.design_capacity, &battery.percentage}) {
        *unmeasured = kNotMeasured;
      }
      battery.present = true;
      put(made->topic, battery);
    } else if (sensor->kind == SensorKind::compass) {
      ros::Imu imu;
      imu.header = header(robot.base_frame_);
      imu.orientation = rotationOf(scalar.value, 0, 0);
      imu.angular_velocity_covariance[0] = imu.linear_acceleration_covariance[0] = -1;
      put(made->topic, imu);
    }
  }
  void operator()(const Contacts& contacts) {
    put(made->topic, ros::UInt8MultiArray{layoutOf("segment", contacts.pressed.size()), contacts.pressed});
  }
  void operator()(const Odometry& measured) {
    const TPose2D& pose = measured.odom_from_robot;
    ros::Odometry odometry;
    odometry.header = header(robot.odom_frame_);
    odometry.child_frame_id = robot.base_frame_;
    odometry.pose.pose = poseOf(pose);
    odometry.twist.twist.linear.x = measured.speed_mps;
    odometry.twist.twist.angular.z = measured.turn_radps;
    put(made->topic, odometry);
    transforms.push_back(transformOf(robot.odom_frame_, robot.base_frame_, {pose.x, pose.y, 0, pose.phi, 0, 0}, stamp));
  }
  void operator()(const Image& image) {
    if (sink.wants(made->topic)) {
      put(made->topic, ros::CompressedImage{header(made->frame), "jpeg", {image.jpeg.begin(), image.jpeg.end()}});
    }
    made->camera.header.stamp = stamp;
    put(made->topic + 1, made->camera);
  }
  void operator()(const Blobs& blobs) {
    constexpr std::uint32_t kNumbers = 7;
    const auto colors = static_cast<std::uint32_t>(blobs.of_color.size());
    ros::Float64MultiArray array;
    array.layout.dim = {
        {joined(blobs.of_color, [](const Blob& blob) { return blob.color; }), colors, colors * kNumbers},
        {"pixels,x,y,left,top,width,height", kNumbers, kNumbers}};
    forNumbers(blobs, [&](const auto&, auto number, std::size_t) { array.data.push_back(number); });
    put(made->topic, array);
  }
  void operator()(const BeaconRanges& beacons) {
    ros::Float64MultiArray array{layoutOf("range [m]", beacons.range_m.size()), {}};
    for (const float range_m : beacons.range_m) {
      array.data.push_back(range_m >= static_cast<float>(sensor->no_echo_m) ? kInfinite : range_m);
    }
    put(made->topic, array);
  }
  void operator()(const Values& values) {
    if (sensor->kind == SensorKind::unknown) return;
    const std::string names = joined(sensor->quantities, [](const Quantity& quantity) {
      return quantity.unit.empty() ? quantity.name : quantity.name + " [" + quantity.unit + "]";
    });
    put(made->topic, ros::Float64MultiArray{layoutOf(names, values.values.size()), values.values});
  }

 private:
  void addPanned(const std::string& frame, const TPose3D& robot_from_frame) {
    transforms.push_back(transformOf(robot.base_frame_, frame, panned(robot_from_frame, pan_rad), stamp));
  }
};

void RobotTopics::write(const Readings& readings, const std::optional<TPose2D>& world_from_robot,
                        const std::optional<Command>& command, std::span<const std::uint8_t> kept, TopicSink& sink) {
  ros::TFMessage transforms;
  Encoder encoder{*this, sink, timeOf(nanosecondsOf(readings.time.seconds())), readings.laser_pan_rad,
                  transforms.transforms};
  for (std::size_t i = 0; i < readings.measurements.size(); ++i) {
    if (i < kept.size() && kept[i]) continue;
    const Measurement& measurement = readings.measurements[i];
    if (!std::visit([](const auto& kind) { return isPresent(kind); }, measurement)) continue;
    encoder.sensor = &(*sensors_)[i];
    encoder.made = &of_sensor_[i];
    std::visit(encoder, measurement);
  }
  if (world_from_robot) {
    ros::Odometry truth;
    truth.header = encoder.header("map");
    truth.child_frame_id = base_frame_;
    truth.pose.pose = poseOf(*world_from_robot);
    encoder.put(truth_, truth);
  }
  if (command) {
    ros::Twist twist;
    twist.linear.x = command->speed_mps;
    twist.angular.z = command->turn_radps;
    encoder.put(command_, twist);
  }
  for (const auto& message : readings.inbox) {
    const nlohmann::ordered_json json{{"from", message.from}, {"text", message.text}};
    encoder.put(inbox_, ros::String{json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)});
  }
  if (!transforms.transforms.empty()) encoder.put(transform_, transforms);
}

}  // namespace robosim
