#include "recording/measurements.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "base/angle_units.h"
#include "base/random.h"
#include "base/testing/test_folder.h"
#include "hardware/lidar_range.h"
#include "recording/byte_archive.h"
#include "recording/codecs.h"
#include "recording/jpeg_observation.h"
#include "recording/observations.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

/// Deserialises the bytes of a ByteArchive.
class ByteReader : public mrpt::serialization::CArchive {
 public:
  explicit ByteReader(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

 protected:
  std::size_t write(const void*, std::size_t) override { return 0; }
  std::size_t read(void* data, std::size_t size) override {
    const std::size_t n = std::min(size, bytes_.size() - at_);
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), n, static_cast<std::uint8_t*>(data));
    at_ += n;
    return n;
  }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

CObservation::Ptr writtenAndRead(const CObservation& observation) {
  ByteArchive archive;
  archive << observation;
  return ByteReader(archive.bytes).ReadObject<CObservation>();
}

const SensorInfo& sensorOf(const RobotInfo& robot, const CObservation& observation) {
  for (const auto& sensor : *robot.sensors) {
    if (Label{robot.name, sensor.label, ""}.text() == observation.sensorLabel) return sensor;
  }
  throw std::out_of_range(observation.sensorLabel);
}

std::size_t slotOf(const RobotInfo& robot, const SensorInfo& sensor) {
  return static_cast<std::size_t>(&sensor - robot.sensors->data());
}

TEST(Measurements, RoundTripReadingsOfEverySensorKindExactly) {
  for (const RobotInfo& robot : {sampleRobot("rover"), seeingRobot("rover")}) {
    RobotObservations observations(robot);
    for (std::uint64_t step = 0; step < 100; ++step) {
      const Readings readings = sampleReadings(robot, step);
      for (const auto& observation : observations.of(readings, std::nullopt)) {
        const auto read = writtenAndRead(*observation);
        const SensorInfo& sensor = sensorOf(robot, *read);
        expectSameReading(measurementFrom(*read, sensor, readings.laser_pan_rad),
                          readings.measurements[slotOf(robot, sensor)], read->sensorLabel);
      }
    }
  }
}

Measurement thereAndBack(const SensorInfo& sensor, const Measurement& measurement) {
  RobotInfo robot;
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{sensor});
  Readings readings;
  readings.measurements = {measurement};
  RobotObservations observations(robot);
  return measurementFrom(*writtenAndRead(*observations.of(readings, std::nullopt)[0]), sensor, 0);
}

TEST(Measurements, RoundTripATurnRateOfZero) {
  const Odometry straight{{1, 0, 0}, 0.5, 0};
  EXPECT_EQ(std::get<Odometry>(thereAndBack(plainSensor(SensorKind::odometry, "odometry"), straight)), straight);
}

TEST(Measurements, RoundTripBatteryVoltages) {
  const Scalar voltage{12.123456789012345};
  EXPECT_EQ(std::get<Scalar>(thereAndBack(plainSensor(SensorKind::battery, "battery"), voltage)), voltage);
}

TEST(Measurements, RoundTripUnwrappedOdometryHeadings) {
  const Odometry turned{{0, 0, 7.123456789012345}, 0, 1};
  EXPECT_EQ(std::get<Odometry>(thereAndBack(plainSensor(SensorKind::odometry, "odometry"), turned)), turned);
}

TEST(Measurements, RoundTripRangesWithoutEcho) {
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0.2, 0, 0, 0)}, 1.5, 1.6);
  const auto echo = std::get<Echoes>(thereAndBack(sonar, Echoes{{1.6f, {1.8f, 0, 0}}}))[0];
  EXPECT_EQ(echo.range_m, 1.6f);
  EXPECT_NEAR(echo.point_m.x, 1.8, 1e-6);
}

TEST(Measurements, RoundTripARangeEqualToTheMaximum) {
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 1.5, 1.6);
  EXPECT_EQ(std::get<Echoes>(thereAndBack(sonar, Echoes{{1.5f, {1.5f, 0, 0}}}))[0].range_m, 1.5f);
}

TEST(Measurements, ReadAnEchoAtTheMaximumRangeAsNoEcho) {
  // As specified in readings.h: only objects nearer than the maximum are reported.
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 1.5, 1.5);
  EXPECT_EQ(std::get<Echoes>(thereAndBack(sonar, Echoes{{1.5f, {1.5f, 0, 0}}}))[0].range_m, 1.5f);
}

TEST(Measurements, PlaceAWideSonarsPointOnItsAxis) {
  auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0.5, 0, 0.2, M_PI / 2)}, 5, 5);
  sonar.beam_width_rad = toRadians(20);
  const Echo off_axis{2, {0.5f + 2 * 0.1f, 2 * 0.995f, 0.2f}};
  const auto echo = std::get<Echoes>(thereAndBack(sonar, Echoes{off_axis}))[0];
  EXPECT_EQ(echo.range_m, 2.0f);
  EXPECT_NEAR(echo.point_m.x, 0.5, 1e-6);
  EXPECT_NEAR(echo.point_m.y, 2, 1e-6);
  EXPECT_NEAR(echo.point_m.z, 0.2, 1e-6);
}

TEST(Measurements, ComputePointsOfInclinedBeams) {
  const auto infrared = rangeSensor(SensorKind::infrared, "infrared", {Beam{{0, 0, 1, 0, M_PI / 6, 0}}}, 5, 5);
  const auto echo = std::get<Echoes>(thereAndBack(infrared, Echoes{{1, {}}}))[0];
  EXPECT_NEAR(echo.point_m.x, std::cos(M_PI / 6), 1e-6);
  EXPECT_NEAR(echo.point_m.z, 0.5, 1e-6);
}

/// Three layers of 40 beams, 0.7 m ahead of the robot's centre.
SensorInfo sampleLidar() {
  std::vector<Beam> beams;
  for (const double pitch : {0.3, 0.0, -0.5}) {
    for (int i = 0; i < 40; ++i) beams.push_back({{0.7, -0.1, 0.4, i * 0.15 - 3, pitch, 0}});
  }
  return rangeSensor(SensorKind::lidar, "lidar", beams, 100, 100);
}

TEST(Measurements, RoundTripALidarByThePointsOfItsEchoes) {
  const SensorInfo lidar = sampleLidar();
  Rng rng(1);
  for (int scan = 0; scan < 100; ++scan) {
    Echoes echoes;
    for (std::size_t i = 0; i < lidar.beams.size(); ++i) {
      const bool has_echo = rng.below(5) > 0;
      const float range_m = has_echo ? roundedLidarRange(std::pow(10, rng.uniform(-2, 1.99))) : 100;
      echoes.push_back({range_m, pointAlong(originOf(lidar.beams[i]), directionOf(lidar.beams[i]), range_m)});
    }
    ASSERT_EQ(std::get<Echoes>(thereAndBack(lidar, echoes)), echoes) << scan;
  }
}

TEST(Measurements, RecordALidarAsACloudInTheFrameOfItsBeams) {
  const SensorInfo lidar = sampleLidar();
  Echoes echoes(lidar.beams.size(), Echo{100, {}});
  echoes[40 + 20].range_m = 2;  // level, straight ahead
  const Codec& codec = findCodec(lidar);
  const auto observation = codec.make(lidar);
  codec.fill(*observation, lidar, echoes, 0);
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*observation);
  ASSERT_EQ(scan.points3D_x, std::vector<float>{2});
  EXPECT_EQ(scan.points3D_z, std::vector<float>{0});
  EXPECT_EQ(scan.points3D_idxs_x, std::vector<std::uint16_t>{20});
  EXPECT_EQ(scan.points3D_idxs_y, std::vector<std::uint16_t>{1});
  EXPECT_EQ(scan.sensorPose.x(), 0.7);
  auto damaged = scan;
  damaged.points3D_idxs_y[0] = 3;
  EXPECT_THROW(codec.measurementFrom(damaged, lidar, 0, {}), RecordingError);
}

TEST(Measurements, RoundTripBeaconsOfWhichOneIsNotReceived) {
  const auto sensor = rangeSensor(SensorKind::beacons, "beacons", std::vector<Beam>(3), 50, 50);
  const BeaconRanges ranges{{2.5f, 50, 7}};
  EXPECT_EQ(std::get<BeaconRanges>(thereAndBack(sensor, ranges)), ranges);
}

TEST(Measurements, HeatKeepsSinglePrecision) {
  EXPECT_EQ(std::get<Scalar>(thereAndBack(plainSensor(SensorKind::heat, "heat"), Scalar{0.1})).value,
            static_cast<double>(0.1f));
}

std::string refusal(const CObservation& observation, const SensorInfo& sensor) {
  try {
    measurementFrom(observation, sensor, 0);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "none";
}

TEST(Measurements, RejectObservationsOfOtherSensors) {
  mrpt::obs::CObservationComment comment;
  comment.sensorLabel = "rover/heat";
  EXPECT_EQ(
      refusal(comment, plainSensor(SensorKind::heat, "heat")),
      "recorded observation \"rover/heat\" (mrpt::obs::CObservationComment) is not of the heat \"heat\": the class "
      "should be mrpt::obs::CObservationGasSensors; give the robots that the recording was made with");
}

TEST(Measurements, RejectBeaconsOfOtherNumbers) {
  const auto sensor = rangeSensor(SensorKind::beacons, "beacons", std::vector<Beam>(3), 50, 50);
  for (const int number : {-1, 3}) {
    mrpt::obs::CObservationBeaconRanges observation;
    observation.sensedData.emplace_back().beaconID = number;
    EXPECT_NE(refusal(observation, sensor).find("it has a beacon of another number"), std::string::npos) << number;
  }
}

TEST(Measurements, EmbedTheJpegFileUnchanged) {
  JpegObservation observation;
  observation.jpeg = sampleJpeg(sampleCamera(), 77);
  ByteArchive archive;
  archive << observation;
  const std::string bytes(archive.bytes.begin(), archive.bytes.end());
  EXPECT_NE(bytes.find(observation.jpeg), std::string::npos);
}

TEST(Measurements, RejectMissingImagesAndBlobsOfOtherColours) {
  EXPECT_NE(refusal(mrpt::obs::CObservationImage(), sampleCamera()).find("it has no picture"), std::string::npos);
  const SensorInfo finder = (*seeingRobot("rover").sensors)[2];
  mrpt::obs::CObservationRawDAQ blobs;
  EXPECT_NE(refusal(blobs, finder).find("holds 0 values in place of 14"), std::string::npos);
  blobs.AIN_double.assign(14, -1);
  EXPECT_NE(refusal(blobs, finder).find("it has blob 0: a pixels of -1 px; it must lie in [0, 4194304 px]"),
            std::string::npos);
}

class PictureFileTest : public TestFolder {
 protected:
  PictureFileTest() {
    std::filesystem::create_directories(in("run_Images/folder"));
    std::ofstream(in("beside.jpg")) << "not for us";
  }

  std::string pictureNamed(const std::string& name, const std::string& folder = "run_Images") {
    mrpt::obs::CObservationImage observation;
    observation.image.setExternalStorage(name);
    return extractJpeg(observation, in(folder));
  }
  std::string refusalOf(const std::string& name) {
    try {
      pictureNamed(name);
    } catch (const RecordingError& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(PictureFileTest, IsReadFromTheRecordingsFolderOnly) {
  for (const std::string& name : {in("beside.jpg").string(), std::string("../beside.jpg"),
                                  std::string("folder/../../beside.jpg"), std::string("/dev////zero")}) {
    EXPECT_EQ(refusalOf(name), name + ": is outside the recording's folder of images; it is not opened");
  }
  std::ofstream(in("run_Images/folder/in.jpg")) << "a picture";
  EXPECT_EQ(pictureNamed("folder/in.jpg"), "a picture");
}

TEST_F(PictureFileTest, FollowsLinksWithinTheRecordingsFolderOnly) {
  namespace fs = std::filesystem;
  std::ofstream(in("run_Images/real.jpg")) << "a picture";
  fs::create_symlink("real.jpg", in("run_Images/link.jpg"));
  EXPECT_EQ(pictureNamed("link.jpg"), "a picture");
  fs::create_directories(in("run_Images_of_others"));
  std::ofstream(in("run_Images_of_others/a.jpg")) << "not for us";
  fs::create_symlink("../beside.jpg", in("run_Images/out.jpg"));
  fs::create_directory_symlink("../run_Images_of_others", in("run_Images/others"));
  for (const std::string name : {"out.jpg", "others/a.jpg"}) {
    EXPECT_EQ(refusalOf(name), name + ": is outside the recording's folder of images; it is not opened");
  }
  fs::create_directory_symlink("run_Images", in("moved_Images"));
  EXPECT_EQ(pictureNamed("real.jpg", "moved_Images"), "a picture") << "the folder itself may be a link";
}

TEST_F(PictureFileTest, RejectsTooLargeFiles) {
  EXPECT_EQ(refusalOf("folder"), in("run_Images/folder").string() + ": is not a regular file");
  std::ofstream(in("run_Images/large.jpg")) << "a";
  std::filesystem::resize_file(in("run_Images/large.jpg"), (64 << 20) + 1);
  EXPECT_EQ(refusalOf("large.jpg"),
            in("run_Images/large.jpg").string() + ": is larger than 64 MiB, so it is no picture");
  EXPECT_EQ(refusalOf("none.jpg"),
            in("run_Images/none.jpg").string() + ": cannot be read; is the folder of pictures beside the recording?");
}

TEST(Measurements, RejectObservationsOfOtherSizes) {
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 5, 5);
  EXPECT_NE(refusal(mrpt::obs::CObservationRange(), sonar).find("holds 0 values in place of 1"), std::string::npos);
  EXPECT_NE(refusal(mrpt::obs::CObservationGasSensors(), plainSensor(SensorKind::heat, "heat")).find("0 values"),
            std::string::npos);
}

}  // namespace
}  // namespace robosim
