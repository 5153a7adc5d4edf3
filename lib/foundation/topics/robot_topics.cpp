#include "topics/robot_topics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "hardware/camera_head.h"
#include "hardware/gnss_fix.h"
#include "hardware/inertial_reading.h"
#include "hardware/measurement_fields.h"
#include "hardware/picture_file.h"
#include "hardware/scan_geometry.h"
#include "topics/message_templates.h"
#include "topics/sensor_topics.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// From a camera's frame to its optical one: z forward, x right, y down (REP 103).
const ros::Quaternion kOpticalRotation{-0.5, 0.5, -0.5, 0.5};

ros::TransformStamped transformOf(const std::string& parent, const std::string& child, const TPose3D& pose,
                                  ros::Time stamp = {}) {
  return {{stamp, parent}, child, {{pose.x, pose.y, pose.z}, rotationOf(pose.yaw, pose.pitch, pose.roll)}};
}

/// Of the messages of a sensor of SensorKind::values; other kinds of this type are arrays, too.
const ros::MessageType& typeOfValues(const SensorInfo& sensor) {
  if (GnssFix::isOf(sensor)) return ros::typeOf<ros::NavSatFix>();
  if (InertialReading::isOf(sensor)) return ros::typeOf<ros::Imu>();
  return ros::typeOf<ros::Float64MultiArray>();
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

const ros::MessageType& rangeType(RosDistribution distribution) {
  return distribution == RosDistribution::humble ? ros::typeOf<ros::HumbleRange>() : ros::typeOf<ros::Range>();
}

/// A one-dimensional array.
ros::MultiArrayLayout layoutOf(const std::string& label, std::size_t size) {
  return {{{label, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size)}}, 0};
}

}  // namespace

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

ros::Pose poseOf(const TPose2D& pose) { return {{pose.x, pose.y, 0}, rotationOf(pose.phi, 0, 0)}; }

double yawOf(const ros::Quaternion& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

TopicMessage staticTransforms(std::span<const RobotTopics> robots, std::uint64_t time_ns) {
  ros::TFMessage message;
  for (const auto& robot : robots) {
    message.transforms.insert(message.transforms.end(), robot.mounts().begin(), robot.mounts().end());
  }
  for (auto& mount : message.transforms) mount.header.stamp = timeOf(time_ns);
  return topicMessage(robots.empty() ? "/tf_static" : robots[0].staticTopic().name, TopicDelivery::latched, time_ns,
                      message);
}

RobotTopics::RobotTopics(const RobotInfo& robot, const TopicForm& form)
    : distribution_(form.distribution),
      name_(topicNamePart(robot.name)),
      frame_prefix_(form.frames == FrameNames::prefixed ? name_ + "/" : ""),
      base_frame_(frame_prefix_ + "base_link"),
      odom_frame_(frame_prefix_ + "odom"),
      sensors_(robot.sensors) {
  const std::string tree = form.frames == FrameNames::prefixed ? "" : "/" + name_;
  topics_.push_back({tree + "/tf", &ros::typeOf<ros::TFMessage>(), TopicDelivery::transforms});
  static_ = {tree + "/tf_static", &ros::typeOf<ros::TFMessage>(), TopicDelivery::latched};
  truth_ = addTopic("ground_truth", ros::typeOf<ros::Odometry>(), TopicDelivery::steady);
  truth_message_ = odometryTemplate("map", base_frame_);
  command_ = addTopic("cmd_vel", ros::typeOf<ros::Twist>(), TopicDelivery::steady);
  const ros::Twist command;
  command_message_ = ros::MessageTemplate(command, command.linear.x, command.angular.z, command.linear.y);
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
  const auto geometry = sensor.kind == SensorKind::laser ? toScanGeometry(sensor.beams) : std::nullopt;
  if (geometry) {
    addTopic(part, ros::typeOf<ros::LaserScan>(), TopicDelivery::sensor);
    made.robot_from_frame = geometry->robot_from_middle;
    made.is_clockwise = geometry->step_rad < 0;
    made.scan_size = sensor.beams.size();
    made.of_topic.push_back(scanTemplate(sensor, *geometry, made.frame));
    return;
  }
  const std::size_t ranges = sensor.kind == SensorKind::lidar ? 0 : sensor.beams.size();
  for (std::size_t i = 0; i < ranges; ++i) {
    const std::string number = std::to_string(i);
    addTopic(part + "/range_" + number, rangeType(distribution_), TopicDelivery::sensor);
    const std::string frame = made.frame + "_" + number;
    made.of_topic.push_back(rangeTemplate(sensor, frame, distribution_));
    made.frames_of_beams.push_back(frame);
    if (!sensor.pans) addMount(frame, sensor.beams[i].robot_from_beam);
  }
  addTopic(part + "/points", ros::typeOf<ros::PointCloud2>(), TopicDelivery::sensor);
  made.of_topic.push_back(cloudTemplate(base_frame_));
}

void RobotTopics::addSensor(const SensorInfo& sensor) {
  SensorMessages made;
  const std::string part = topicOf(sensor);
  made.topic = topics_.size();
  made.frame = frame_prefix_ + topicNamePart(sensor.label);
  if (!sensor.beams.empty()) made.robot_from_frame = sensor.beams[0].robot_from_beam;
  switch (sensor.kind) {
    case SensorKind::sonar:
    case SensorKind::laser:
    case SensorKind::lidar:
    case SensorKind::infrared:
      addRangeSensor(sensor, part, made);
      break;
    case SensorKind::heat:
      addTopic(part, ros::typeOf<ros::Temperature>(), TopicDelivery::sensor);
      made.of_topic.push_back(temperatureTemplate(made.frame));
      break;
    case SensorKind::bumper:
      addTopic(part, ros::typeOf<ros::UInt8MultiArray>(), TopicDelivery::sensor);
      break;
    case SensorKind::odometry:
      addTopic(part, ros::typeOf<ros::Odometry>(), TopicDelivery::steady);
      made.of_topic.push_back(odometryTemplate(odom_frame_, base_frame_));
      break;
    case SensorKind::compass:
      addTopic(part, ros::typeOf<ros::Imu>(), TopicDelivery::sensor);
      made.of_topic.push_back(compassTemplate(base_frame_));
      break;
    case SensorKind::camera: {
      addTopic(part + "/image_raw/compressed", ros::typeOf<ros::CompressedImage>(), TopicDelivery::sensor);
      addTopic(part + "/camera_info", ros::typeOf<ros::CameraInfo>(), TopicDelivery::sensor);
      made.frame += "_optical";
      made.of_topic.push_back(pictureTemplate(made.frame));
      made.of_topic.push_back(cameraTemplate(sensor.camera, made.frame));
      for (const auto& [is_there, layer] :
           {std::pair(sensor.camera.layers.depth, "depth"), {sensor.camera.layers.identity, "identity"}}) {
        if (is_there) addTopic(part + '/' + layer + "/image_raw", ros::typeOf<ros::Image>(), TopicDelivery::sensor);
      }
      if (sensor.pans) break;
      addMount(made.frame, made.robot_from_frame);
      auto& rotation = mounts_.back().transform.rotation;
      rotation = product(rotation, kOpticalRotation);
      break;
    }
    case SensorKind::battery:
      addTopic(part, ros::typeOf<ros::BatteryState>(), TopicDelivery::steady);
      made.of_topic.push_back(batteryTemplate(base_frame_));
      break;
    case SensorKind::blob_finder:
    case SensorKind::beacons:
    case SensorKind::values:
      addTopic(part, typeOfValues(sensor), TopicDelivery::sensor);
      break;
    case SensorKind::unknown:
      break;
  }
  const bool has_frame = made.scan_size > 0 || sensor.kind == SensorKind::heat || GnssFix::isOf(sensor);
  if (InertialReading::isOf(sensor)) made.frame = base_frame_;  // it is in the middle
  if (has_frame && !sensor.pans) addMount(made.frame, made.robot_from_frame);
  of_sensor_.push_back(std::move(made));
}

/// Encodes the measurements of a step; an overload for each kind.
struct RobotTopics::Encoder {
  RobotTopics& robot;
  TopicSink& sink;
  ros::Time stamp;
  double pan_rad;
  const std::vector<Measurement>& measurements;
  const SensorInfo* sensor = nullptr;
  SensorMessages* made = nullptr;

  template <ros::Message M>
  void put(std::size_t topic, const M& message) {
    if (!sink.wants(topic)) return;
    ros::encode(message, sink.beginMessage(topic));
    sink.endMessage();
  }
  void setStamp(ros::MessageTemplate& message) const {
    message.set(kSeconds, stamp.sec);
    message.set(kNanoseconds, stamp.nanosec);
  }
  void put(std::size_t topic, ros::MessageTemplate& message) {
    if (!sink.wants(topic)) return;
    setStamp(message);
    sink.put(topic, message.bytes());
  }

  void operator()(const Echoes& echoes) {
    if (made->scan_size > 0) return putScan(echoes);
    const std::size_t ranges = made->frames_of_beams.size();  // none of a lidar
    auto& points = robot.points_;
    points.clear();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const float range_m = rangeOf(*sensor, echoes[i].range_m);
      if (i < ranges) {
        made->of_topic[i].set(kFirst, range_m);
        put(made->topic + i, made->of_topic[i]);
        if (sensor->pans) addMoved(i, panned(sensor->beams[i].robot_from_beam, pan_rad));
      }
      if (range_m == kInfinite) continue;
      const auto& point = echoes[i].point_m;
      points.insert(points.end(), {point.x, point.y, point.z});
    }
    putPoints(made->topic + ranges, made->of_topic.back(), std::span(points));
  }
  void operator()(const Scalar& scalar) {
    if (made->of_topic.empty()) return;
    ros::MessageTemplate& message = made->of_topic[0];
    if (sensor->kind == SensorKind::heat) {
      message.set(kFirst, scalar.value);
    } else if (sensor->kind == SensorKind::battery) {
      message.set(kFirst, static_cast<float>(scalar.value));
    } else {
      const ros::Quaternion rotation = rotationOf(scalar.value, 0, 0);
      message.set(kFirst, rotation.z);
      message.set(kFirst + 1, rotation.w);
    }
    put(made->topic, message);
  }
  void operator()(const Contacts& contacts) {
    putArray(std::span(contacts.pressed), [&] {
      return ros::UInt8MultiArray{layoutOf("segment", contacts.pressed.size()), contacts.pressed};
    });
  }
  void operator()(const Odometry& measured) {
    const TPose2D& pose = measured.odom_from_robot;
    ros::MessageTemplate& message = made->of_topic[0];
    setPose(message, pose);
    message.set(kSpeed, measured.speed_mps);
    message.set(kTurn, measured.turn_radps);
    message.set(kLateral, measured.lateral_mps);
    put(made->topic, message);
    addMoved(0, {pose.x, pose.y, 0, pose.phi, 0, 0});
  }
  void operator()(const Image& image) {
    if (sink.wants(made->topic)) {
      setStamp(made->of_topic[0]);
      const auto beginning = made->of_topic[0].bytes();
      auto& bytes = sink.beginMessage(made->topic);
      bytes.insert(bytes.end(), beginning.begin(), beginning.end() - sizeof(std::uint32_t));
      const std::string encoded = image.raw ? jpegOf(image) : "";
      appendSized(bytes, std::as_bytes(std::span(image.raw ? encoded : image.jpeg)));
      sink.endMessage();
    }
    std::size_t topic = made->topic + 2;
    if (sensor->camera.layers.depth) putDepths(topic++, image);
    if (sensor->camera.layers.identity) putIdentities(topic, image);
    if (const auto aim = aimOf(*sensor, *robot.sensors_, measurements)) {
      made->of_topic[1] = cameraTemplate(zoomed(sensor->camera, aim->zoom), made->frame);
      const TPose3D pose = aimed(made->robot_from_frame, *aim);
      addMoved(0, pose, product(rotationOf(pose.yaw, pose.pitch, pose.roll), kOpticalRotation));
    }
    put(made->topic + 1, made->of_topic[1]);
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
    auto& numbers = robot.numbers_;
    numbers.clear();
    for (const float range_m : beacons.range_m) {
      numbers.push_back(range_m >= static_cast<float>(sensor->no_echo_m) ? kInfinite : range_m);
    }
    putArray(std::span<const double>(numbers), [&] {
      return ros::Float64MultiArray{layoutOf("range [m]", numbers.size()), numbers};
    });
  }
  void operator()(const Values& values) {
    if (sensor->kind == SensorKind::unknown) return;
    if (GnssFix::isOf(*sensor)) return put(made->topic, navSatFix(GnssFix::from(values)));
    if (InertialReading::isOf(*sensor)) return put(made->topic, imu(InertialReading::from(values)));
    putArray(std::span(values.values), [&] {
      const std::string names = joined(sensor->quantities, [](const Quantity& quantity) {
        return quantity.unit.empty() ? quantity.name : quantity.name + " [" + quantity.unit + "]";
      });
      return ros::Float64MultiArray{layoutOf(names, values.values.size()), values.values};
    });
  }

 private:
  /// By REP 118: metres, infinite beyond the range.
  void putDepths(std::size_t topic, const Image& image) {
    if (!sink.wants(topic) || !image.raw) return;
    std::vector<float> depths = image.raw->depth_m;
    std::replace(depths.begin(), depths.end(), 0.f, kInfinite);
    put(topic, pixels(*image.raw, "32FC1", std::as_bytes(std::span(depths))));
  }
  void putIdentities(std::size_t topic, const Image& image) {
    if (!sink.wants(topic) || !image.raw) return;
    put(topic, pixels(*image.raw, "32SC1", std::as_bytes(std::span(image.raw->identity))));
  }
  /// @param values of four bytes each
  ros::Image pixels(const RawPicture& raw, const char* encoding, std::span<const std::byte> values) const {
    ros::Image message;
    message.header = {stamp, made->frame};
    message.height = raw.height_px;
    message.width = raw.width_px;
    message.encoding = encoding;
    message.step = raw.width_px * 4;
    const auto* const first = reinterpret_cast<const std::uint8_t*>(values.data());
    message.data.assign(first, first + values.size());
    return message;
  }

  void putScan(const Echoes& echoes) {
    ros::MessageTemplate& message = made->of_topic[0];
    const std::size_t count = std::min(echoes.size(), made->scan_size);
    for (std::size_t i = 0; i < count; ++i) {
      message.set(kFirst, rangeOf(*sensor, echoes[i].range_m), made->is_clockwise ? count - 1 - i : i);
    }
    put(made->topic, message);
    if (sensor->pans) addMoved(0, panned(made->robot_from_frame, pan_rad));
  }

  void putPoints(std::size_t topic, ros::MessageTemplate& cloud, std::span<const float> xyz) {
    if (!sink.wants(topic)) return;
    setStamp(cloud);
    cloud.set(kFirst, static_cast<std::uint32_t>(xyz.size() / 3));
    cloud.set(kFirst + 1, static_cast<std::uint32_t>(xyz.size_bytes()));
    auto& bytes = sink.beginMessage(topic);
    const auto all = cloud.bytes();  // up to the points' bytes, and is_dense
    bytes.insert(bytes.end(), all.begin(), all.end() - sizeof(std::uint32_t) - 1);
    appendSized(bytes, std::as_bytes(xyz));
    bytes.push_back(all.back());
    sink.endMessage();
  }

  ros::NavSatFix navSatFix(const GnssFix& fix) const {
    ros::NavSatFix message;
    message.header = {stamp, made->frame};
    message.status.status = fix.is_valid ? ros::NavSatStatus::kFix : ros::NavSatStatus::kNoFix;
    message.latitude = fix.latitude_deg;
    message.longitude = fix.longitude_deg;
    message.altitude = fix.altitude_m;
    return message;
  }
  ros::Imu imu(const InertialReading& reading) const {
    ros::Imu message;
    message.header = {stamp, made->frame};
    message.orientation_covariance[0] = -1;  // not measured
    message.angular_velocity.z = reading.turn_radps;
    message.linear_acceleration = {reading.ahead_mps2, reading.left_mps2, reading.up_mps2};
    return message;
  }

  /// @param make the message, when the number of values is another one than before
  template <typename T, typename Make>
  void putArray(std::span<T> values, const Make& make) {
    if (made->of_topic.empty() || made->size != values.size()) {
      const auto message = make();
      made->of_topic.assign(1, ros::MessageTemplate(message, message.data));
      made->size = values.size();
    }
    made->of_topic[0].set(0, std::span<const T>(values));
    if (sink.wants(made->topic)) sink.put(made->topic, made->of_topic[0].bytes());
  }

  /// Appends a sequence of bytes, which begins at a multiple of four.
  static void appendSized(std::vector<std::uint8_t>& bytes, std::span<const std::byte> data) {
    const auto size = static_cast<std::uint32_t>(data.size());
    const auto* const digits = reinterpret_cast<const std::uint8_t*>(&size);
    const auto* const first = reinterpret_cast<const std::uint8_t*>(data.data());
    bytes.insert(bytes.end(), digits, digits + sizeof size);
    bytes.insert(bytes.end(), first, first + data.size());
  }

  void addMoved(std::size_t beam, const TPose3D& pose) {
    addMoved(beam, pose, rotationOf(pose.yaw, pose.pitch, pose.roll));
  }
  void addMoved(std::size_t beam, const TPose3D& pose, const ros::Quaternion& rotation) {
    robot.moved_.push_back({static_cast<std::size_t>(made - robot.of_sensor_.data()),
                            beam,
                            {pose.x, pose.y, pose.z, rotation.x, rotation.y, rotation.z, rotation.w}});
  }
};

/// Makes the template of /tf with the frames that have moved, unless it is the one.
void RobotTopics::makeTransformMessage() {
  const auto same = [](const MovedFrame& a, const MovedFrame& b) { return a.sensor == b.sensor && a.beam == b.beam; };
  if (std::equal(moved_.begin(), moved_.end(), in_transform_message_.begin(), in_transform_message_.end(), same))
    return;
  in_transform_message_ = moved_;
  ros::TFMessage message;
  for (const auto& frame : moved_) {
    const SensorMessages& of = of_sensor_[frame.sensor];
    const bool is_odometry = (*sensors_)[frame.sensor].kind == SensorKind::odometry;
    message.transforms.push_back(is_odometry ? transformOf(odom_frame_, base_frame_, {})
                                 : of.frames_of_beams.empty()
                                     ? transformOf(base_frame_, of.frame, {})
                                     : transformOf(base_frame_, of.frames_of_beams[frame.beam], {}));
  }
  transform_message_ = ros::MessageTemplate(message);
  for (const auto& [header, child, transform] : message.transforms) {
    transform_message_.add(message, header.stamp.sec);
    transform_message_.add(message, header.stamp.nanosec);
    transform_message_.add(message, transform.translation.x);
  }
}

void RobotTopics::write(const Readings& readings, const std::optional<RobotTruth>& truth,
                        const std::optional<Command>& command, std::span<const std::uint8_t> kept, TopicSink& sink) {
  moved_.clear();
  Encoder encoder{*this, sink, timeOf(nanosecondsOf(readings.time.seconds())), readings.laser_pan_rad,
                  readings.measurements};
  for (std::size_t i = 0; i < readings.measurements.size(); ++i) {
    if (i < kept.size() && kept[i]) continue;
    const Measurement& measurement = readings.measurements[i];
    if (!std::visit([](const auto& kind) { return isPresent(kind); }, measurement)) continue;
    encoder.sensor = &(*sensors_)[i];
    encoder.made = &of_sensor_[i];
    std::visit(encoder, measurement);
  }
  if (truth) {
    setPose(truth_message_, truth->world_from_robot);
    truth_message_.set(kSpeed, truth->velocity.speed_mps);
    truth_message_.set(kTurn, truth->velocity.turn_radps);
    truth_message_.set(kLateral, truth->velocity.lateral_mps);
    encoder.put(truth_, truth_message_);
  }
  if (command && sink.wants(command_)) {
    command_message_.set(0, double{command->speed_mps});
    command_message_.set(1, double{command->turn_radps});
    command_message_.set(2, double{command->lateral_mps});
    sink.put(command_, command_message_.bytes());
  }
  for (const auto& message : readings.inbox) {
    const nlohmann::ordered_json json{{"from", message.from}, {"text", message.text}};
    encoder.put(inbox_, ros::String{json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)});
  }
  if (moved_.empty() || !sink.wants(transform_)) return;
  makeTransformMessage();
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    transform_message_.set(3 * i, encoder.stamp.sec);
    transform_message_.set(3 * i + 1, encoder.stamp.nanosec);
    transform_message_.set(3 * i + 2, std::span<const double>(moved_[i].pose));
  }
  sink.put(transform_, transform_message_.bytes());
}

}  // namespace robosim
