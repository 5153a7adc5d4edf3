#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/error_list.h"
#include "base/testing/test_folder.h"
#include "recording/bag/bag_observations.h"
#include "recording/cone_aperture.h"
#include "recording/jpeg_observation.h"
#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "recording/testing/sample_bag.h"

namespace robosim {
namespace {

using namespace mrpt::obs;

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();

class BagSourceTest : public TestFolder {
 protected:
  const std::filesystem::path file_ = in("bag.mcap");

  std::vector<CObservation::Ptr> all() {
    RawlogReader reader(file_);
    std::vector<CObservation::Ptr> observations;
    while (auto observation = reader.next()) observations.push_back(std::move(observation));
    unread_ = reader.unread();
    assumptions_ = reader.assumptions();
    error_ = reader.readError().value_or("");
    is_damaged_ = reader.isDamaged();
    return observations;
  }
  /// The only observation.
  template <typename Class>
  std::shared_ptr<Class> only() {
    const auto observations = all();
    EXPECT_EQ(observations.size(), 1u);
    return observations.empty() ? nullptr : std::dynamic_pointer_cast<Class>(observations[0]);
  }

  std::vector<std::string> unread_, assumptions_;
  std::string error_;
  bool is_damaged_ = false;
};

/// Beams at -90°, 0° and 90°.
ros::LaserScan sampleScan(double time_s, const std::string& frame = "base_link") {
  ros::LaserScan scan;
  scan.header = headerAt(time_s, frame);
  scan.angle_min = static_cast<float>(-M_PI / 2);
  scan.angle_max = static_cast<float>(M_PI / 2);
  scan.angle_increment = static_cast<float>(M_PI / 2);
  scan.range_min = 0.1F;
  scan.range_max = 8;
  scan.ranges = {1, 2, 3};
  return scan;
}

ros::Odometry sampleOdometry(double time_s, double x_m) {
  ros::Odometry odometry;
  odometry.header = headerAt(time_s, "odom");
  odometry.child_frame_id = "base_link";
  odometry.pose.pose.position = {x_m, 0.5, 0};
  odometry.pose.pose.orientation = {0, 0, std::sin(0.5), std::cos(0.5)};
  odometry.twist.twist.linear.x = 0.25;
  odometry.twist.twist.angular.z = -0.5;
  return odometry;
}

TEST_F(BagSourceTest, ReadsScansWithInvalidRanges) {
  auto scan = sampleScan(2);
  scan.angle_increment /= 4;
  scan.ranges = {1, kInfinity, -kInfinity, kNaN, 0, 0.05F, 8, 8.5F, 2.5F};
  SampleBag(file_).write("/scan", 0, scan);
  const auto read = only<CObservation2DRangeScan>();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensorLabel, "robot/laser");
  EXPECT_TRUE(read->rightToLeft);
  EXPECT_FLOAT_EQ(read->aperture, static_cast<float>(M_PI));
  EXPECT_EQ(read->maxRange, 8);
  std::vector<int> valid;
  for (std::size_t i = 0; i < read->getScanSize(); ++i) valid.push_back(read->getScanRangeValidity(i) ? 1 : 0);
  EXPECT_EQ(valid, (std::vector<int>{1, 0, 0, 0, 0, 0, 1, 0, 1}));
  EXPECT_EQ(read->getScanRange(8), 2.5F);
  EXPECT_EQ(read->sensorPose, mrpt::poses::CPose3D());
  EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(read->timestamp), 2);
}

TEST_F(BagSourceTest, ReadsScansInEitherDirection) {
  auto scan = sampleScan(0);
  std::swap(scan.angle_min, scan.angle_max);
  scan.angle_increment *= -1;
  SampleBag(file_).write("/scan", 0, scan);
  const auto read = only<CObservation2DRangeScan>();
  EXPECT_FALSE(read->rightToLeft);
  EXPECT_FLOAT_EQ(read->aperture, static_cast<float>(M_PI));
}

// From 0° to 270° in steps of 90°, with an angle_max one step too far: MRPT's angles are about the middle, 135°.
TEST_F(BagSourceTest, TurnsScansThatAreNotAboutTheAxis) {
  auto scan = sampleScan(0);
  scan.angle_min = 0;
  scan.angle_max = static_cast<float>(2 * M_PI);
  scan.ranges = {1, 2, 3, 4};
  SampleBag(file_).write("/scan", 0, scan);
  const auto read = only<CObservation2DRangeScan>();
  EXPECT_FLOAT_EQ(read->aperture, static_cast<float>(1.5 * M_PI));
  EXPECT_NEAR(read->sensorPose.yaw(), 0.75 * M_PI, 1e-6);
}

TEST_F(BagSourceTest, ReadsTheRangesOfARingAsOneObservation) {
  {
    SampleBag bag(file_);
    ros::Range range;
    range.field_of_view = 0.25F;
    range.min_range = 0.2F;
    range.max_range = 4;
    for (const int step : {0, 1}) {
      for (const int i : {10, 2, 0}) {
        range.header = headerAt(step, "sonar_" + std::to_string(i));
        range.range = i == 10 ? kInfinity : i == 2 ? -kInfinity : 1.5F;
        bag.write("/a/sonar/range_" + std::to_string(i), 0, range);
      }
    }
    ros::TFMessage mounts;
    for (const int i : {0, 2, 10}) {
      mounts.transforms.push_back(transformAt(0, "base_link", "sonar_" + std::to_string(i), 0.1 * i));
    }
    bag.write("/tf_static", 0, mounts);
  }
  const auto read = all();
  ASSERT_EQ(read.size(), 2u);
  const auto& ring = dynamic_cast<const CObservationRange&>(*read[1]);
  EXPECT_EQ(ring.sensorLabel, "a/sonar");
  EXPECT_EQ(coneAperture(ring), 0.25F);
  ASSERT_EQ(ring.sensedData.size(), 3u);
  const int numbers[] = {0, 2, 10};
  const float ranges[] = {1.5F, 0.2F, 4.004F};  // no echo is 1.001 times the maximum
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ring.sensedData[i].sensorID, numbers[i]);
    EXPECT_FLOAT_EQ(ring.sensedData[i].sensedDistance, ranges[i]);
    EXPECT_DOUBLE_EQ(ring.sensedData[i].sensorPose.x, 0.1 * numbers[i]);
  }
  EXPECT_EQ(assumptions_, std::vector<std::string>{});
}

TEST_F(BagSourceTest, ReadsOdometryAndGroundTruth) {
  {
    SampleBag bag(file_);
    bag.write("/r/odom", 0, sampleOdometry(1, 0.75));
    bag.write("/r/ground_truth", 0, sampleOdometry(1, 7));
  }
  const auto read = all();
  ASSERT_EQ(read.size(), 2u);
  const auto& truth = dynamic_cast<const CObservationRobotPose&>(*read[0]);
  EXPECT_EQ(truth.sensorLabel, "r/GROUND_TRUTH");
  EXPECT_EQ(truth.pose.mean.x(), 7);
  const auto& odometry = dynamic_cast<const CObservationOdometry&>(*read[1]);
  EXPECT_EQ(odometry.sensorLabel, "r/odometry");
  EXPECT_EQ(odometry.odometry.x(), 0.75);
  EXPECT_EQ(odometry.odometry.y(), 0.5);
  EXPECT_DOUBLE_EQ(odometry.odometry.phi(), 1);
  ASSERT_TRUE(odometry.hasVelocities);
  EXPECT_EQ(odometry.velocityLocal.vx, 0.25);
  EXPECT_EQ(odometry.velocityLocal.omega, -0.5);
}

TEST_F(BagSourceTest, HasOneOdometryForEachRobot) {
  {
    SampleBag bag(file_);
    bag.write("/odometry/filtered", 0, sampleOdometry(1, 1));
    bag.write("/odom", 0, sampleOdometry(1, 2));
  }
  EXPECT_EQ(only<CObservationOdometry>()->odometry.x(), 2);
  EXPECT_EQ(unread_, (std::vector<std::string>{
                         "/odometry/filtered (nav_msgs/msg/Odometry), 1 message: the robot's odometry is /odom"}));
}

TEST_F(BagSourceTest, TakesTheTransformFromOdomForOdometryWhereNoTopicHasIt) {
  {
    SampleBag bag(file_);
    bag.write("/scan", 0, sampleScan(3));
    bag.write("/tf_static", 0, ros::TFMessage{{transformAt(0, "base_footprint", "base_link", 0)}});
    for (const int second : {1, 2}) {
      bag.write("/tf", 0, ros::TFMessage{{transformAt(second, "odom", "base_footprint", second, 0.5)}});
    }
  }
  const auto read = all();
  ASSERT_EQ(read.size(), 3u);
  for (const std::size_t i : {0u, 1u}) {
    const auto& odometry = dynamic_cast<const CObservationOdometry&>(*read[i]);
    EXPECT_EQ(odometry.sensorLabel, "robot/odometry");
    EXPECT_EQ(odometry.odometry.x(), static_cast<double>(i + 1));
    EXPECT_FALSE(odometry.hasVelocities);
  }
}

TEST_F(BagSourceTest, FindsThePoseOfASensorAtItsTime) {
  {
    SampleBag bag(file_);
    bag.write("/tf_static", 0, ros::TFMessage{{transformAt(0, "head", "laser", 0.5)}});
    for (const int second : {1, 2}) {
      bag.write("/tf", 0, ros::TFMessage{{transformAt(second, "base_link", "head", second)}});
    }
    for (const double time_s : {1.0, 1.5, 2.0}) bag.write("/scan", 0, sampleScan(time_s, "laser"));
  }
  std::vector<double> x_m;
  for (const auto& scan : all()) x_m.push_back(dynamic_cast<const CObservation2DRangeScan&>(*scan).sensorPose.x());
  EXPECT_EQ(x_m, (std::vector{1.5, 1.5, 2.5}));
}

TEST_F(BagSourceTest, SaysWhichSensorsHaveNoPose) {
  {
    SampleBag bag(file_);
    bag.write("/odom", 0, sampleOdometry(1, 1));
    bag.write("/scan", 0, sampleScan(1, "laser"));
    bag.write("/battery", 0, ros::BatteryState());
    bag.write("/imu", 0, ros::Imu());
  }
  all();
  EXPECT_EQ(
      assumptions_,
      (std::vector<std::string>{
          "/imu: no transform from base_link, because it has no frame; its pose on the robot is taken as the origin",
          "/scan: no transform from base_link to laser; its pose on the robot is taken as the origin"}));
}

TEST_F(BagSourceTest, ReadsTheOtherSensors) {
  {
    SampleBag bag(file_);
    ros::BatteryState battery;
    battery.voltage = 12.5F;
    bag.write("/a/battery", 1, battery);
    bag.write("/a/heat", 2, ros::Temperature{{}, 21.5, 0});
    ros::Imu imu;
    imu.orientation = {0, 0, std::sin(0.25), std::cos(0.25)};
    imu.angular_velocity.z = 0.75;
    imu.linear_acceleration_covariance[0] = -1;
    bag.write("/a/compass", 3, imu);
  }
  const auto read = all();
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(dynamic_cast<const CObservationBatteryState&>(*read[0]).voltageMainRobotBattery, 12.5);
  EXPECT_EQ(dynamic_cast<const CObservationGasSensors&>(*read[1]).m_readings[0].temperature, 21.5F);
  const auto& compass = dynamic_cast<const CObservationIMU&>(*read[2]);
  EXPECT_DOUBLE_EQ(compass.get(IMU_YAW), 0.5);
  EXPECT_EQ(compass.get(IMU_YAW_VEL), 0.75);
  EXPECT_FALSE(compass.has(IMU_PITCH));
  EXPECT_FALSE(compass.has(IMU_X_ACC));
}

/// A red and a blue pixel.
std::string sampleJpeg() {
  mrpt::img::CImage image(2, 1, mrpt::img::CH_RGB);
  mrpt::io::CMemoryStream stream;
  image.saveToStreamAsJPEG(stream, 90);
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

TEST_F(BagSourceTest, ReadsPicturesWithTheirCamera) {
  const std::string jpeg = sampleJpeg();
  // One red pixel, by ImageMagick.
  const unsigned char png[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                               0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
                               0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x08,
                               0xd7, 0x63, 0xf8, 0xcf, 0xc0, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0x18, 0xdd, 0x8d,
                               0xb0, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  {
    SampleBag bag(file_);
    ros::CameraInfo info;
    info.header = headerAt(1, "optical");
    info.width = 2;
    info.height = 1;
    info.distortion_model = "plumb_bob";
    info.d = {0.1, 0.2, 0, 0, 0};
    info.k = {300, 0, 1, 0, 310, 0.5, 0, 0, 1};
    bag.write("/a/camera/camera_info", 0, info);
    bag.write("/a/camera/image_raw/compressed", 0,
              ros::CompressedImage{headerAt(1, "optical"), "jpeg", {jpeg.begin(), jpeg.end()}});
    bag.write("/a/png/compressed", 0,
              ros::CompressedImage{headerAt(2, "optical"), "png", {std::begin(png), std::end(png)}});
    ros::Image raw{headerAt(3, "optical"), 1, 2, "rgb8", 0, 8, {255, 0, 0, 0, 0, 254, 9, 9}};
    bag.write("/a/raw/image_raw", 0, raw);
    raw.encoding = "16UC1";
    bag.write("/a/depth/image_raw", 0, raw);
  }
  const auto read = all();
  ASSERT_EQ(read.size(), 3u);
  const auto& camera = dynamic_cast<const CObservationImage&>(*read[0]);
  EXPECT_EQ(camera.sensorLabel, "a/camera");
  EXPECT_EQ(extractJpeg(camera, {}), jpeg) << "unchanged";
  EXPECT_EQ(camera.image.getWidth(), 2u);
  EXPECT_EQ(camera.cameraParams.fx(), 300);
  EXPECT_EQ(camera.cameraParams.cy(), 0.5);
  EXPECT_EQ(camera.cameraParams.k2(), 0.2);
  const auto pixel = [](const CObservation& observation, int x) {
    const auto* const bgr = dynamic_cast<const CObservationImage&>(observation).image.ptr<std::uint8_t>(x, 0);
    return std::vector<int>{bgr[0], bgr[1], bgr[2]};
  };
  EXPECT_EQ(pixel(*read[1], 0), (std::vector{0, 0, 255}));
  EXPECT_EQ(pixel(*read[2], 0), (std::vector{0, 0, 255}));
  EXPECT_EQ(pixel(*read[2], 1), (std::vector{254, 0, 0}));
  EXPECT_EQ(unread_, (std::vector<std::string>{
                         "/a/depth/image_raw (sensor_msgs/msg/Image), 1 message: pixels in the encoding \"16UC1\""}));
  EXPECT_FALSE(is_damaged_);
}

TEST_F(BagSourceTest, LeavesOutDamagedPicturesAndMessages) {
  {
    SampleBag bag(file_);
    bag.write("/a/scan", 0, sampleScan(1));
    bag.write("/a/scan", ros::LaserScan::kType, 0, {0, 1, 0, 0, 9});
    const std::string jpeg = sampleJpeg();
    bag.write("/a/camera/compressed", 0,
              ros::CompressedImage{headerAt(2, ""), "jpeg", {jpeg.begin(), jpeg.begin() + 100}});
  }
  EXPECT_EQ(all().size(), 1u);
  EXPECT_TRUE(is_damaged_);
  EXPECT_EQ(error_, file_.string() +
                        ": 2 messages are damaged and left out, the first of /a/scan: the message has 4 bytes at byte "
                        "4, which cannot be: it has 5 bytes");
}

TEST_F(BagSourceTest, ReadsBigEndianMessages) {
  // Header (time 1 s, empty frame), temperature 21.5, variance 0.
  SampleBag(file_).write("/heat", ros::Temperature::kType, 0,
                         {0, 0, 0,    0,    0,    0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0,
                          0, 0, 0x40, 0x35, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  const auto heat = only<CObservationGasSensors>();
  EXPECT_EQ(heat->m_readings[0].temperature, 21.5F);
  EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(heat->timestamp), 1);
}

TEST_F(BagSourceTest, OrdersByTheTimeOfTheHeaderOrOfRecordingWithoutOne) {
  {
    SampleBag bag(file_);
    bag.write("/scan", 7'000'000'000, sampleScan(3));
    bag.write("/scan", 8'000'000'000, sampleScan(1));
    bag.write("/heat", 2'000'000'000, ros::Temperature());
  }
  std::vector<double> times_s;
  for (const auto& observation : all()) times_s.push_back(mrpt::Clock::toDouble(observation->timestamp));
  EXPECT_EQ(times_s, (std::vector{1.0, 2.0, 3.0}));
}

TEST_F(BagSourceTest, ContinuesAtAnyObservation) {
  {
    SampleBag bag(file_);
    for (int i = 0; i < 20; ++i) {
      auto scan = sampleScan((i * 7) % 20);
      scan.ranges[0] = static_cast<float>(1 + (i * 7) % 20) / 4;
      bag.write("/scan", 0, scan);
    }
  }
  RawlogReader reader(file_, RawlogReader::Access::random);
  std::vector<std::uint64_t> positions;
  while (reader.next()) positions.push_back(reader.position());
  ASSERT_EQ(positions.size(), 20u);
  for (const std::size_t i : {19u, 3u, 0u, 12u}) {
    reader.seek(positions[i]);
    const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(reader.next());
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->getScanRange(0), static_cast<float>(1 + i) / 4);
  }
}

TEST_F(BagSourceTest, HasTimesAlsoOfMessagesThatAreRecordedInAnInstant) {
  {
    SampleBag bag(file_);
    for (int i = 0; i < 20; ++i) bag.write("/heat", 1'000'000'000 + 100 * i, ros::Temperature());
  }
  ObservationTimes times(file_);
  RawlogReader reader(file_);
  double last_s = -1;
  while (const auto observation = reader.next()) last_s = times.of(*observation, reader.entries());
  EXPECT_NEAR(last_s, 1.9e-6, 1e-9);
}

TEST(BagUses, AreThoseOfTheDocumentation) {
  std::ifstream in(ROBOSIM_SOURCE_DIR "/doc/ros2.md");
  std::stringstream page;
  page << in.rdbuf();
  std::string table = "| message | observation |\n|---|---|\n";
  for (const auto& row : bagUses()) table += std::string("| ") + row.type + " | " + row.content + " |\n";
  EXPECT_NE(page.str().find(table + "\n"), std::string::npos) << table;
}

}  // namespace
}  // namespace robosim
