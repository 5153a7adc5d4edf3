#include "recording/measurements.h"

#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "base/test_folder.h"
#include "recording/byte_archive.h"
#include "recording/jpeg_observation.h"
#include "recording/observations.h"
#include "recording/recording_error.h"
#include "recording/sample_robot.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

/// Reads back what a ByteArchive wrote.
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
    if (sensorLabel(robot.name, sensor.label) == observation.sensorLabel) return sensor;
  }
  throw std::out_of_range(observation.sensorLabel);
}

std::size_t slotOf(const RobotInfo& robot, const SensorInfo& sensor) {
  return static_cast<std::size_t>(&sensor - robot.sensors->data());
}

TEST(Measurements, ARecordedReadingIsTheReadingForEveryKindOfSensor) {
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

TEST(Measurements, ARobotThatDoesNotTurnDoesNotTurnWhenReadBack) {
  const Odometry straight{{1, 0, 0}, 0.5, 0};
  EXPECT_EQ(std::get<Odometry>(thereAndBack(plainSensor(SensorKind::odometry, "odometry"), straight)), straight);
}

TEST(Measurements, ABatterysVoltageIsTheSameAgain) {
  const Scalar voltage{12.123456789012345};
  EXPECT_EQ(std::get<Scalar>(thereAndBack(plainSensor(SensorKind::battery, "battery"), voltage)), voltage);
}

TEST(Measurements, AnOdometryHeadingBeyondATurnStaysAsItWas) {
  const Odometry turned{{0, 0, 7.123456789012345}, 0, 1};
  EXPECT_EQ(std::get<Odometry>(thereAndBack(plainSensor(SensorKind::odometry, "odometry"), turned)), turned);
}

TEST(Measurements, SilenceIsTheSensorsOwnReadingAgain) {
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0.2, 0, 0, 0)}, 1.5, 1.6);
  const auto echo = std::get<Echoes>(thereAndBack(sonar, Echoes{{1.6f, {1.8f, 0, 0}}}))[0];
  EXPECT_EQ(echo.range_m, 1.6f);
  EXPECT_NEAR(echo.point_m.x, 1.8, 1e-6);
}

TEST(Measurements, AnEchoFromTheSensorsVeryMaximumIsSilence) {
  // As readings.h has it: what is not nearer than the maximum is not told.
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 1.5, 1.5);
  EXPECT_EQ(std::get<Echoes>(thereAndBack(sonar, Echoes{{1.5f, {1.5f, 0, 0}}}))[0].range_m, 1.5f);
}

TEST(Measurements, AWideSonarsPointComesBackOnItsAxis) {
  auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0.5, 0, 0.2, M_PI / 2)}, 5, 5);
  sonar.beam_width_rad = 20 * M_PI / 180;
  const Echo off_axis{2, {0.5f + 2 * 0.1f, 2 * 0.995f, 0.2f}};
  const auto echo = std::get<Echoes>(thereAndBack(sonar, Echoes{off_axis}))[0];
  EXPECT_EQ(echo.range_m, 2.0f);
  EXPECT_NEAR(echo.point_m.x, 0.5, 1e-6);
  EXPECT_NEAR(echo.point_m.y, 2, 1e-6);
  EXPECT_NEAR(echo.point_m.z, 0.2, 1e-6);
}

TEST(Measurements, ABeamThatLooksDownHitsBelow) {
  const auto infrared = rangeSensor(SensorKind::infrared, "infrared", {Beam{{0, 0, 1, 0, M_PI / 6, 0}}}, 5, 5);
  const auto echo = std::get<Echoes>(thereAndBack(infrared, Echoes{{1, {}}}))[0];
  EXPECT_NEAR(echo.point_m.x, std::cos(M_PI / 6), 1e-6);
  EXPECT_NEAR(echo.point_m.z, 0.5, 1e-6);
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

TEST(Measurements, AnObservationOfAnotherSensorIsRefused) {
  mrpt::obs::CObservationComment comment;
  comment.sensorLabel = "rover/heat";
  EXPECT_EQ(
      refusal(comment, plainSensor(SensorKind::heat, "heat")),
      "recorded observation \"rover/heat\" (mrpt::obs::CObservationComment) is not of the heat \"heat\": the class "
      "should be mrpt::obs::CObservationGasSensors; give the robots that the recording was made with");
}

TEST(Measurements, TheJpegFileItselfStandsInTheRecording) {
  JpegObservation observation;
  observation.jpeg = sampleJpeg(sampleCamera(), 77);
  ByteArchive archive;
  archive << observation;
  const std::string bytes(archive.bytes.begin(), archive.bytes.end());
  EXPECT_NE(bytes.find(observation.jpeg), std::string::npos);
}

TEST(Measurements, AnObservationWithoutAPictureOrWithBlobsOfOtherColoursIsRefused) {
  EXPECT_NE(refusal(mrpt::obs::CObservationImage(), sampleCamera()).find("it has no picture"), std::string::npos);
  const SensorInfo finder = (*seeingRobot("rover").sensors)[2];
  mrpt::obs::CObservationRawDAQ blobs;
  EXPECT_NE(refusal(blobs, finder).find("holds 0 values in place of 14"), std::string::npos);
  blobs.AIN_double.assign(14, -1);
  EXPECT_NE(refusal(blobs, finder).find("it has a blob that is in no picture"), std::string::npos);
}

class PictureFileTest : public TestFolder {
 protected:
  PictureFileTest() {
    std::filesystem::create_directories(in("run_Images/folder"));
    mrpt::img::CImage::setImagesPathBase(in("run_Images").string());
    std::ofstream(in("beside.jpg")) << "not for us";
  }
  ~PictureFileTest() override { mrpt::img::CImage::setImagesPathBase("."); }

  static std::string refusalOf(const std::string& name) {
    mrpt::obs::CObservationImage observation;
    observation.image.setExternalStorage(name);
    return refusal(observation, sampleCamera());
  }
};

TEST_F(PictureFileTest, APictureLiesInTheRecordingsFolderAndNowhereElse) {
  for (const std::string& name : {in("beside.jpg").string(), std::string("../beside.jpg"),
                                  std::string("folder/../../beside.jpg"), std::string("/dev////zero")}) {
    EXPECT_EQ(refusalOf(name), name + ": is no picture of the recording's own folder; it is not opened");
  }
  std::ofstream(in("run_Images/folder/in.jpg")) << "a picture";
  mrpt::obs::CObservationImage observation;
  observation.image.setExternalStorage("folder/in.jpg");
  EXPECT_EQ(jpegOf(observation), "a picture");
}

TEST_F(PictureFileTest, APictureIsAFileOfBearableSize) {
  EXPECT_EQ(refusalOf("folder"), in("run_Images/folder").string() + ": is no file, let alone a picture");
  std::ofstream(in("run_Images/large.jpg")) << "a";
  std::filesystem::resize_file(in("run_Images/large.jpg"), (64 << 20) + 1);
  EXPECT_EQ(refusalOf("large.jpg"),
            in("run_Images/large.jpg").string() + ": is larger than 64 MiB, so it is no picture");
  EXPECT_EQ(refusalOf("none.jpg"),
            in("run_Images/none.jpg").string() + ": cannot be read; is the folder of pictures beside the recording?");
}

TEST(Measurements, AnObservationOfAnotherSizeIsRefused) {
  const auto sonar = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 5, 5);
  EXPECT_NE(refusal(mrpt::obs::CObservationRange(), sonar).find("holds 0 values in place of 1"), std::string::npos);
  EXPECT_NE(refusal(mrpt::obs::CObservationGasSensors(), plainSensor(SensorKind::heat, "heat")).find("0 values"),
            std::string::npos);
}

}  // namespace
}  // namespace robosim
