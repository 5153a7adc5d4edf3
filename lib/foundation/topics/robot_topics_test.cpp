#include "topics/robot_topics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "base/jpeg_file.h"
#include "hardware/gnss_fix.h"
#include "hardware/inertial_reading.h"
#include "topics/sensor_readings.h"
#include "topics/sensor_topics.h"

namespace robosim {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

SensorInfo sensorOf(SensorKind kind, const std::string& label) {
  SensorInfo sensor;
  sensor.kind = kind;
  sensor.label = label;
  return sensor;
}

/// A range sensor of beams at these angles, 0.2 m ahead of the robot's centre, from 0.1 to 5 m.
SensorInfo rangesAt(SensorKind kind, const std::string& label, const std::vector<double>& angles_rad) {
  SensorInfo sensor = sensorOf(kind, label);
  for (const double angle_rad : angles_rad) sensor.beams.push_back({{0.2, 0, 0.3, angle_rad, 0, 0}});
  sensor.range_min_m = 0.1;
  sensor.range_max_m = 5;
  sensor.no_echo_m = 5;
  return sensor;
}

Echoes echoesAt(const std::vector<float>& ranges_m) {
  Echoes echoes;
  for (const float range_m : ranges_m) echoes.push_back({range_m, {range_m, 1, 2}});
  return echoes;
}

/// Messages by topic.
struct Messages final : TopicSink {
  explicit Messages(const RobotTopics& of) : topics(of.topics()) {}
  std::vector<std::uint8_t>& beginMessage(std::size_t topic) override { return by_topic[topics.at(topic).name]; }
  void endMessage() override {}

  template <ros::Message M>
  M at(const std::string& topic) const {
    return ros::decode<M>(by_topic.at(topic));
  }

  const std::vector<Topic>& topics;
  std::map<std::string, std::vector<std::uint8_t>> by_topic;
};

struct RobotTopicsTest : testing::Test {
  Messages messagesOf(const std::vector<SensorInfo>& sensors, const std::vector<Measurement>& measurements) {
    RobotInfo robot;
    robot.name = "Ann 2";
    robot.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
    topics.emplace(robot, form);
    readings.time = {15, 0.1};
    readings.measurements = measurements;
    Messages messages(*topics);
    topics->write(readings, truth, command, kept, messages);
    return messages;
  }

  std::optional<RobotTopics> topics;
  Readings readings;
  std::optional<RobotTruth> truth;
  TopicForm form;
  std::optional<Command> command;
  std::vector<std::uint8_t> kept;
};

TEST_F(RobotTopicsTest, PublishesALaserAsAScanByRep117) {
  const auto messages = messagesOf({rangesAt(SensorKind::laser, "laser", {-0.5, 0, 0.5})}, {echoesAt({0.1f, 2, 5})});
  const auto scan = messages.at<ros::LaserScan>("/Ann_2/scan");
  EXPECT_EQ(scan.header, (ros::Header{{1, 500'000'000}, "Ann_2/laser"}));
  EXPECT_FLOAT_EQ(scan.angle_min, -0.5f);
  EXPECT_FLOAT_EQ(scan.angle_max, 0.5f);
  EXPECT_FLOAT_EQ(scan.angle_increment, 0.5f);
  EXPECT_EQ(scan.range_min, 0.1f);
  EXPECT_EQ(scan.range_max, 5);
  EXPECT_EQ(scan.ranges, (std::vector<float>{-kNothing, 2, kNothing}));
  ASSERT_EQ(topics->mounts().size(), 1u);
  EXPECT_EQ(topics->mounts()[0].header.frame_id, "Ann_2/base_link");
  EXPECT_EQ(topics->mounts()[0].child_frame_id, "Ann_2/laser");
  EXPECT_EQ(topics->mounts()[0].transform.translation, (ros::Vector3{0.2, 0, 0.3}));
}

TEST_F(RobotTopicsTest, ReversesAClockwiseScan) {
  const auto messages = messagesOf({rangesAt(SensorKind::laser, "laser_2", {0.5, 0, -0.5})}, {echoesAt({1, 2, 3})});
  const auto scan = messages.at<ros::LaserScan>("/Ann_2/scan_2");
  EXPECT_FLOAT_EQ(scan.angle_min, -0.5f);
  EXPECT_EQ(scan.ranges, (std::vector<float>{3, 2, 1}));
}

TEST_F(RobotTopicsTest, PublishesEachSonarAndTheRing) {
  auto sonar = rangesAt(SensorKind::sonar, "sonar", {0, M_PI / 2});
  sonar.beam_width_rad = 0.5;
  const auto messages = messagesOf({sonar}, {echoesAt({2, 5})});
  const auto first = messages.at<ros::Range>("/Ann_2/sonar/range_0");
  EXPECT_EQ(first.header.frame_id, "Ann_2/sonar_0");
  EXPECT_EQ(first.radiation_type, ros::Range::kUltrasound);
  EXPECT_EQ(first.field_of_view, 0.5f);
  EXPECT_EQ(first.range, 2);
  EXPECT_EQ(messages.at<ros::Range>("/Ann_2/sonar/range_1").range, kNothing);
  const auto cloud = messages.at<ros::PointCloud2>("/Ann_2/sonar/points");
  EXPECT_EQ(cloud.header.frame_id, "Ann_2/base_link");
  EXPECT_EQ(cloud.width, 1u);
  ASSERT_EQ(cloud.data.size(), 12u);
  float x = 0;
  std::memcpy(&x, cloud.data.data(), sizeof x);
  EXPECT_EQ(x, 2);
  EXPECT_NEAR(topics->mounts()[1].transform.rotation.z, std::sqrt(0.5), 1e-12);
}

TEST_F(RobotTopicsTest, PublishesTheEchoesOfALidarAsACloudOnly) {
  const auto messages = messagesOf({rangesAt(SensorKind::lidar, "lidar", {0, 1, 2})}, {echoesAt({2, 5, 3})});
  EXPECT_EQ(messages.by_topic.count("/Ann_2/lidar/range_0"), 0u);
  const auto cloud = messages.at<ros::PointCloud2>("/Ann_2/lidar/points");
  EXPECT_EQ(cloud.header.frame_id, "Ann_2/base_link");
  EXPECT_EQ(cloud.width, 2u) << "one beam has no echo";
  float x = 0;
  std::memcpy(&x, cloud.data.data() + 12, sizeof x);
  EXPECT_EQ(x, 3);
  EXPECT_TRUE(topics->mounts().empty());
}

TEST_F(RobotTopicsTest, PublishesRangesWithoutVarianceForHumble) {
  const auto sonar = rangesAt(SensorKind::sonar, "sonar", {0, 1});
  const auto later = messagesOf({sonar}, {echoesAt({2, 5})});
  form.distribution = RosDistribution::humble;
  const auto humble = messagesOf({sonar}, {echoesAt({2, 5})});
  const std::string topic = "/Ann_2/sonar/range_0";
  EXPECT_EQ(humble.by_topic.at(topic).size() + sizeof(float), later.by_topic.at(topic).size());
  EXPECT_EQ(humble.at<ros::HumbleRange>(topic), later.at<ros::HumbleRange>(topic));
  EXPECT_EQ(humble.at<ros::HumbleRange>(topic).range, 2);
  Measurement read = echoesAt({0, 0});
  readMeasurement(sonar, 1, humble.by_topic.at("/Ann_2/sonar/range_1"), read);
  readMeasurement(sonar, 0, later.by_topic.at(topic), read);
  EXPECT_EQ(std::get<Echoes>(read)[0].range_m, 2);
  EXPECT_EQ(std::get<Echoes>(read)[1].range_m, 5) << "a robot of Humble is read, too";
  const auto& of_topic = topics->topics();
  const auto found =
      std::find_if(of_topic.begin(), of_topic.end(), [&](const Topic& one) { return one.name == topic; });
  EXPECT_EQ(found->type->definition().find("variance"), std::string::npos);
}

TEST_F(RobotTopicsTest, PublishesOdometryAndItsTransform) {
  const auto messages =
      messagesOf({sensorOf(SensorKind::odometry, "odometry")}, {Odometry{{1, 2, M_PI}, 0.5, -0.25, 0.75}});
  const auto odometry = messages.at<ros::Odometry>("/Ann_2/odom");
  EXPECT_EQ(odometry.header.frame_id, "Ann_2/odom");
  EXPECT_EQ(odometry.child_frame_id, "Ann_2/base_link");
  EXPECT_EQ(odometry.pose.pose.position, (ros::Point{1, 2, 0}));
  EXPECT_NEAR(odometry.pose.pose.orientation.z, 1, 1e-12);
  EXPECT_EQ(odometry.twist.twist.linear, (ros::Vector3{0.5, 0.75, 0}));
  EXPECT_EQ(odometry.twist.twist.angular.z, -0.25);
  const auto transforms = messages.at<ros::TFMessage>("/tf").transforms;
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].header, odometry.header);
  EXPECT_EQ(transforms[0].child_frame_id, "Ann_2/base_link");
  EXPECT_EQ(transforms[0].transform.translation, (ros::Vector3{1, 2, 0}));
}

TEST_F(RobotTopicsTest, PublishesTheOtherSensors) {
  auto heat = sensorOf(SensorKind::heat, "heat");
  heat.beams.push_back({{0, 0, 0.4, 0, 0, 0}});
  auto air = sensorOf(SensorKind::values, "air");
  air.quantities = {{"co2", "ppm"}, {"count", ""}};
  auto beacons = rangesAt(SensorKind::beacons, "beacons", {0, 0});
  const auto messages = messagesOf(
      {heat, sensorOf(SensorKind::battery, "battery"), sensorOf(SensorKind::bumper, "bumper"),
       sensorOf(SensorKind::compass, "compass"), air, beacons},
      {Scalar{30}, Scalar{12.5}, Contacts{{0, 1}}, Scalar{M_PI / 2}, Values{{400, 3}}, BeaconRanges{{2.5f, 5}}});
  EXPECT_EQ(messages.at<ros::Temperature>("/Ann_2/heat"), (ros::Temperature{{{1, 500'000'000}, "Ann_2/heat"}, 30, 0}));
  const auto battery = messages.at<ros::BatteryState>("/Ann_2/battery");
  EXPECT_EQ(battery.voltage, 12.5f);
  EXPECT_TRUE(std::isnan(battery.percentage));
  EXPECT_EQ(messages.at<ros::UInt8MultiArray>("/Ann_2/bumper").data, (std::vector<std::uint8_t>{0, 1}));
  const auto imu = messages.at<ros::Imu>("/Ann_2/compass");
  EXPECT_NEAR(imu.orientation.w, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(imu.angular_velocity_covariance[0], -1);
  const auto values = messages.at<ros::Float64MultiArray>("/Ann_2/air");
  EXPECT_EQ(values.layout.dim.at(0), (ros::MultiArrayDimension{"co2 [ppm],count", 2, 2}));
  EXPECT_EQ(values.data, (std::vector<double>{400, 3}));
  EXPECT_EQ(messages.at<ros::Float64MultiArray>("/Ann_2/beacons").data, (std::vector<double>{2.5, kNothing}));
}

TEST_F(RobotTopicsTest, PublishesFixesAndInertialReadingsAsTheirOwnMessages) {
  auto receiver = sensorOf(SensorKind::values, "gnss");
  receiver.quantities = GnssFix::quantities();
  receiver.beams.push_back({{0.5, 0, 0.25, 0, 0, 0}});
  auto inertial = sensorOf(SensorKind::values, "imu");
  inertial.quantities = InertialReading::quantities();
  const auto messages = messagesOf(
      {receiver, inertial}, {GnssFix{true, 48.5, -11.25, 520}.values(), InertialReading{0.5, 1, -2, 9.75}.values()});
  const auto fix = messages.at<ros::NavSatFix>("/Ann_2/gnss");
  EXPECT_EQ(fix.header, (ros::Header{{1, 500'000'000}, "Ann_2/gnss"}));
  EXPECT_EQ(fix.status, (ros::NavSatStatus{0, 1}));
  EXPECT_EQ(fix.latitude, 48.5);
  EXPECT_EQ(fix.longitude, -11.25);
  EXPECT_EQ(fix.altitude, 520);
  EXPECT_EQ(topics->mounts().at(0).transform.translation, (ros::Vector3{0.5, 0, 0.25}));
  const auto imu = messages.at<ros::Imu>("/Ann_2/imu");
  EXPECT_EQ(imu.header.frame_id, "Ann_2/base_link");
  EXPECT_EQ(imu.orientation_covariance[0], -1);
  EXPECT_EQ(imu.angular_velocity, (ros::Vector3{0, 0, 0.5}));
  EXPECT_EQ(imu.linear_acceleration, (ros::Vector3{1, -2, 9.75}));
}

TEST_F(RobotTopicsTest, PublishesACameraInItsOpticalFrame) {
  auto camera = sensorOf(SensorKind::camera, "camera");
  camera.beams.push_back({{0.1, 0, 0.5, 0, 0, 0}});
  camera.camera = {200, 100, M_PI / 2, 5};
  const auto messages = messagesOf({camera}, {Image{"JPEG"}});
  const auto image = messages.at<ros::CompressedImage>("/Ann_2/camera/image_raw/compressed");
  EXPECT_EQ(image.header.frame_id, "Ann_2/camera_optical");
  EXPECT_EQ(image.format, "jpeg");
  EXPECT_EQ(std::string(image.data.begin(), image.data.end()), "JPEG");
  const auto info = messages.at<ros::CameraInfo>("/Ann_2/camera/camera_info");
  EXPECT_NEAR(info.k[0], 100, 1e-9);
  EXPECT_EQ(info.k[2], 100);
  EXPECT_EQ(info.k[5], 50);
  EXPECT_EQ(topics->mounts().at(0).transform.rotation, (ros::Quaternion{-0.5, 0.5, -0.5, 0.5}));
}

TEST_F(RobotTopicsTest, PublishesTheLayersOfARaycastCamera) {
  auto camera = sensorOf(SensorKind::camera, "camera");
  camera.beams.push_back({{0.1, 0, 0.5, 0, 0, 0}});
  camera.range_max_m = 4;
  camera.camera = {2, 1, M_PI / 2, 5};
  camera.camera.layers = {true, true, true};
  const RawPicture raw{2, 1, 4, {200, 100, 50, 200, 100, 50}, {1.5f, 0}, {7, RawPicture::kSky}};
  const auto messages = messagesOf({camera}, {Image{"", std::make_shared<const RawPicture>(raw)}});
  const auto image = messages.at<ros::CompressedImage>("/Ann_2/camera/image_raw/compressed");
  EXPECT_EQ(jpegFault(std::string(image.data.begin(), image.data.end())), "");
  EXPECT_EQ(messages.at<ros::CameraInfo>("/Ann_2/camera/camera_info").k[2], 1);
  const auto numbers = [](const ros::Image& of, auto... values) {
    std::vector<std::uint8_t> bytes;
    for (const auto value : {values...}) {
      const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
      bytes.insert(bytes.end(), first, first + sizeof value);
    }
    return of.data == bytes;
  };
  const auto depth = messages.at<ros::Image>("/Ann_2/camera/depth/image_raw");
  EXPECT_EQ(depth.encoding, "32FC1");
  EXPECT_EQ(depth.width, 2u);
  EXPECT_EQ(depth.height, 1u);
  EXPECT_EQ(depth.step, 8u);
  EXPECT_EQ(depth.header.frame_id, "Ann_2/camera_optical");
  EXPECT_TRUE(numbers(depth, 1.5f, std::numeric_limits<float>::infinity()));
  const auto identity = messages.at<ros::Image>("/Ann_2/camera/identity/image_raw");
  EXPECT_EQ(identity.encoding, "32SC1");
  EXPECT_TRUE(numbers(identity, 7u, RawPicture::kSky));
}

TEST_F(RobotTopicsTest, PublishesACameraOnAHeadAsItIsAimed) {
  auto head = sensorOf(SensorKind::values, "ptz");
  head.quantities = CameraAim::quantities();
  auto camera = sensorOf(SensorKind::camera, "camera");
  camera.beams.push_back({{0.1, 0, 0.5, 0, 0, 0}});
  camera.camera = {200, 100, M_PI / 2, 5};
  camera.pans = true;
  const double zoom = 1.5;  // a field of view of 60°
  const auto messages = messagesOf({head, camera}, {CameraAim{M_PI / 2, 0, zoom}.values(), Image{"JPEG"}});
  EXPECT_TRUE(topics->mounts().empty());
  const auto info = messages.at<ros::CameraInfo>("/Ann_2/camera/camera_info");
  EXPECT_NEAR(info.k[0], 100 * std::sqrt(3), 1e-9);
  const auto transforms = messages.at<ros::TFMessage>("/tf").transforms;
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].child_frame_id, "Ann_2/camera_optical");
  EXPECT_EQ(transforms[0].transform.translation, (ros::Vector3{0.1, 0, 0.5}));
  // The optical axis, z, points to the robot's left, y; x of the picture, to the right, points ahead, x.
  const auto& turned = transforms[0].transform.rotation;
  EXPECT_NEAR(std::abs(turned.x), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(turned.y, 0, 1e-9);
  EXPECT_NEAR(turned.z, 0, 1e-9);
  EXPECT_NEAR(turned.w, -turned.x, 1e-9);
}

TEST_F(RobotTopicsTest, PublishesNothingOfSensorsThatDidNotMeasure) {
  auto camera = sensorOf(SensorKind::camera, "camera");
  camera.camera = {200, 100, 1, 5};
  kept = {1, 0};
  const auto messages = messagesOf({sensorOf(SensorKind::battery, "battery"), camera}, {Scalar{1}, Image{}});
  EXPECT_TRUE(messages.by_topic.empty());
}

TEST_F(RobotTopicsTest, PublishesThePanOfASensorThatTurns) {
  auto laser = rangesAt(SensorKind::laser, "laser", {-0.5, 0, 0.5});
  laser.pans = true;
  readings.laser_pan_rad = 1;
  const auto messages = messagesOf({laser}, {echoesAt({1, 2, 3})});
  EXPECT_TRUE(topics->mounts().empty());
  const auto transforms = messages.at<ros::TFMessage>("/tf").transforms;
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].child_frame_id, "Ann_2/laser");
  EXPECT_NEAR(transforms[0].transform.rotation.z, std::sin(0.5), 1e-7);
}

TEST_F(RobotTopicsTest, PublishesTruthCommandAndMessages) {
  truth = RobotTruth{{3, 4, 0}, {0.4, -0.5}};
  command = Command{.speed_mps = 0.5, .turn_radps = 0.25, .lateral_mps = 0.125};
  readings.inbox.edit() = {{"Bob", "Ann 2", "GOLD \"1\""}};
  const auto messages = messagesOf({}, {});
  const auto odometry = messages.at<ros::Odometry>("/Ann_2/ground_truth");
  EXPECT_EQ(odometry.header.frame_id, "map");
  EXPECT_EQ(odometry.pose.pose.position, (ros::Point{3, 4, 0}));
  EXPECT_EQ(odometry.child_frame_id, "Ann_2/base_link");
  EXPECT_EQ(odometry.twist.twist, (ros::Twist{{0.4, 0, 0}, {0, 0, -0.5}}));
  EXPECT_EQ(messages.at<ros::Twist>("/Ann_2/cmd_vel"), (ros::Twist{{0.5, 0.125, 0}, {0, 0, 0.25}}));
  EXPECT_EQ(messages.at<ros::String>("/Ann_2/messages").data, R"({"from":"Bob","text":"GOLD \"1\""})");
}

TEST_F(RobotTopicsTest, WritesNothingOfTheStepBefore) {
  auto sonar = rangesAt(SensorKind::sonar, "sonar", {0, 1});
  auto laser = rangesAt(SensorKind::laser, "laser", {-0.5, 0, 0.5});
  laser.pans = true;
  auto air = sensorOf(SensorKind::values, "air");
  air.quantities = {{"co2", "ppm"}, {"count", ""}};
  auto camera = sensorOf(SensorKind::camera, "camera");
  camera.camera = {200, 100, 1, 5};
  const std::vector<SensorInfo> sensors{sonar,
                                        laser,
                                        sensorOf(SensorKind::odometry, "odometry"),
                                        sensorOf(SensorKind::battery, "battery"),
                                        sensorOf(SensorKind::compass, "compass"),
                                        sensorOf(SensorKind::bumper, "bumper"),
                                        air,
                                        camera};
  const std::vector<Measurement> second{echoesAt({5, 3}),  echoesAt({3, 2, 1}), Odometry{{-1, 0, 0}, 0, 0.5},
                                        Scalar{11},        Scalar{-1},          Contacts{{1, 0, 0}},
                                        Values{{1, 2, 3}}, Image{"J"}};
  truth = RobotTruth{{0, -4, 2}, {-1, 3}};
  command = Command{.speed_mps = -1};
  const Messages expected = messagesOf(sensors, second);

  messagesOf(sensors, {echoesAt({1, 2}), echoesAt({1, 2, 5}), Odometry{{1, 2, 3}, 0.5, 0}, Scalar{12}, Scalar{1},
                       Contacts{{0, 1}}, Values{{400, 3}}, Image{"JPEG"}});
  readings.measurements = second;
  Messages messages(*topics);
  topics->write(readings, truth, command, kept, messages);
  EXPECT_EQ(messages.by_topic, expected.by_topic);

  // Without the transform of the odometry, that of the laser is left.
  kept = {0, 0, 1};
  Messages fewer(*topics);
  topics->write(readings, truth, command, kept, fewer);
  const auto transforms = fewer.at<ros::TFMessage>("/tf").transforms;
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].child_frame_id, "Ann_2/laser");
}

TEST(Topic, OffersLatchedTopicsToLateReaders) {
  const Topic map{"/map", &ros::typeOf<ros::OccupancyGrid>(), TopicDelivery::latched};
  EXPECT_TRUE(map.offeredQos().starts_with("- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n"));
  const Topic scan{"/scan", &ros::typeOf<ros::LaserScan>(), TopicDelivery::sensor};
  EXPECT_TRUE(scan.offeredQos().starts_with("- history: 1\n  depth: 5\n  reliability: 1\n  durability: 2\n"));
}

TEST(Topic, MakesNamesThatRosAllows) {
  EXPECT_EQ(topicNamePart("Ann-2"), "Ann_2");
  EXPECT_EQ(topicNamePart("2nd"), "_2nd");
  EXPECT_EQ(topicNamePart("é"), "__");
  EXPECT_EQ(topicNamePart(""), "_");
}

TEST(SensorTopics, AreThoseOfTheDocumentation) {
  std::ifstream in(ROBOSIM_SOURCE_DIR "/doc/ros2.md");
  std::stringstream page;
  page << in.rdbuf();
  for (const auto& row : kSensorTopicRows) {
    if (row.kind == SensorKind::unknown) continue;
    const std::string line = std::string("| ") + nameOf(row.kind) + " | `" + row.topics + "` | " + row.messages +
                             " | " + row.content + " |\n";
    EXPECT_NE(page.str().find(line), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace robosim
