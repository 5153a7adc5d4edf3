#include "recording/observations.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPoint3D.h>

#include "hardware/gnss_fix.h"
#include "hardware/inertial_reading.h"
#include "hardware/numbered_quantities.h"
#include "recording/codecs.h"
#include "recording/cone_aperture.h"
#include "recording/jpeg_observation.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationRange;

RobotInfo robotWith(const SensorInfo& sensor) {
  RobotInfo robot;
  robot.name = "rover";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{sensor});
  return robot;
}

/// The observation recorded for a sensor.s measurement.
template <typename Class>
Class recorded(const SensorInfo& sensor, const Measurement& measurement, float pan_rad = 0) {
  Readings readings;
  readings.measurements = {measurement};
  readings.laser_pan_rad = pan_rad;
  RobotObservations observations(robotWith(sensor));
  return dynamic_cast<const Class&>(*observations.of(readings, std::nullopt)[0]);
}

TEST(Observations, AreOrderedGroundTruthOdometryThenAsMounted) {
  const RobotInfo robot = sampleRobot("rover");
  RobotObservations observations(robot);
  std::vector<std::string> labels;
  for (const auto& observation : observations.of(sampleReadings(robot, 1), mrpt::math::TPose2D(1, 2, 3))) {
    labels.push_back(observation->sensorLabel);
  }
  EXPECT_EQ(labels, (std::vector<std::string>{"rover/GROUND_TRUTH", "rover/odometry", "rover/sonar", "rover/laser",
                                              "rover/beam", "rover/infrared", "rover/heat", "rover/bumper",
                                              "rover/compass", "rover/battery", "rover/beacons", "rover/air"}));
}

TEST(Observations, HaveImagesAndBlobsOnlyInStepsWithAnImage) {
  const RobotInfo robot = seeingRobot("rover");
  RobotObservations observations(robot);
  const auto labels = [&](std::uint64_t step) {
    std::vector<std::string> of_step;
    for (const auto& observation : observations.of(sampleReadings(robot, step), std::nullopt)) {
      of_step.push_back(observation->sensorLabel);
    }
    return of_step;
  };
  EXPECT_EQ(labels(2), (std::vector<std::string>{"rover/odometry", "rover/camera", "rover/blob_finder"}));
  EXPECT_EQ(labels(3), std::vector<std::string>{"rover/odometry"});
}

TEST(Observations, OmitAnUnknownGroundTruth) {
  const RobotInfo robot = sampleRobot("rover");
  RobotObservations observations(robot);
  const auto list = observations.of(sampleReadings(robot, 1), std::nullopt);
  ASSERT_EQ(list.size(), 11u);
  EXPECT_EQ(list[0]->sensorLabel, "rover/odometry");
}

TEST(Observations, HaveTimestampsFrom2005On) {
  const RobotInfo robot = sampleRobot("rover");
  RobotObservations observations(robot);
  for (const auto& observation : observations.of(sampleReadings(robot, 3), mrpt::math::TPose2D())) {
    EXPECT_EQ(mrpt::system::dateTimeToString(observation->timestamp), "2005/01/01,00:00:00.300000");
  }
}

TEST(Observations, HaveExactTimestampsAfterAYear) {
  const SimTime year{3153600001, 0.01};
  const auto since_epoch = toTimestamp(year) - toTimestamp({});
  EXPECT_EQ(since_epoch.count(), 315360000100000);
  EXPECT_EQ(secondsSinceStart(toTimestamp(year)), 31536000.01);
}

TEST(Observations, RecordASonarRingAsOneObservation) {
  auto sensor = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0.1, 0.2, 0.3, 0.4), beamAt(0, 0, 0, 2)}, 5, 5);
  sensor.range_min_m = 0.15;
  sensor.beam_width_rad = 0.35;
  const auto range = recorded<CObservationRange>(sensor, Echoes{{1.25f, {}}, {4.5f, {}}});
  EXPECT_EQ(range.minSensorDistance, 0.15f);
  EXPECT_EQ(range.maxSensorDistance, 5.0f);
  EXPECT_EQ(coneAperture(range), 0.35f);
  ASSERT_EQ(range.sensedData.size(), 2u);
  EXPECT_EQ(range.sensedData[0].sensorID, 0);
  EXPECT_EQ(range.sensedData[0].sensorPose, mrpt::math::TPose3D(0.1, 0.2, 0.3, 0.4, 0, 0));
  EXPECT_EQ(range.sensedData[0].sensedDistance, 1.25f);
  EXPECT_EQ(range.sensedData[1].sensorID, 1);
  EXPECT_EQ(range.sensedData[1].sensedDistance, 4.5f);
}

TEST(Observations, RecordABatteryAsTheMainVoltage) {
  const auto battery =
      recorded<mrpt::obs::CObservationBatteryState>(plainSensor(SensorKind::battery, "battery"), Scalar{12.75});
  EXPECT_TRUE(battery.voltageMainRobotBatteryIsValid);
  EXPECT_EQ(battery.voltageMainRobotBattery, 12.75);
  EXPECT_FALSE(battery.voltageMainRobotComputerIsValid);
}

TEST(Observations, RecordNoEchoAsSlightlyMoreThanTheMaximumRange) {
  for (const double no_echo_m : {5.0, 6.0}) {
    const auto sensor = rangeSensor(SensorKind::sonar, "sonar", {beamAt(0, 0, 0, 0)}, 5, no_echo_m);
    const auto range = recorded<CObservationRange>(sensor, Echoes{{static_cast<float>(no_echo_m), {}}});
    EXPECT_EQ(range.sensedData[0].sensedDistance, 5.005f) << no_echo_m;
  }
}

TEST(Observations, RecordAThinBeamWithASmallCone) {
  const auto sensor = rangeSensor(SensorKind::infrared, "infrared", {beamAt(0, 0, 0, 0)}, 1, 1);
  const auto range = recorded<CObservationRange>(sensor, Echoes(1));
  EXPECT_EQ(coneAperture(range), 0.001f);
}

TEST(Observations, RecordAScanningLaserAsA2dScan) {
  auto sensor = rangeSensor(SensorKind::laser, "laser",
                            {beamAt(0.2, 0, 0.3, -0.5), beamAt(0.2, 0, 0.3, 0.5), beamAt(0.2, 0, 0.3, 1.5)}, 8, 8);
  sensor.noise_std_m = 0.03;
  const auto scan = recorded<CObservation2DRangeScan>(sensor, Echoes{{1, {}}, {8, {}}, {3, {}}});
  EXPECT_EQ(scan.aperture, 2.0f);
  EXPECT_TRUE(scan.rightToLeft);
  EXPECT_EQ(scan.maxRange, 8.0f);
  EXPECT_EQ(scan.stdError, 0.03f);
  EXPECT_NEAR(scan.sensorPose.yaw(), 0.5, 1e-12);
  EXPECT_EQ(scan.sensorPose.x(), 0.2);
  EXPECT_EQ(scan.sensorPose.z(), 0.3);
  ASSERT_EQ(scan.getScanSize(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(scan.getScanAngle(i), static_cast<double>(i) - 1, 1e-6);
  EXPECT_EQ(scan.getScanRange(0), 1.0f);
  EXPECT_TRUE(scan.getScanRangeValidity(0));
  EXPECT_FALSE(scan.getScanRangeValidity(1));
  EXPECT_TRUE(scan.getScanRangeValidity(2));
}

TEST(Observations, KeepTheExactDirectionOfAForwardScanner) {
  EXPECT_EQ(recorded<CObservation2DRangeScan>(sampleScanner(), Echoes(181)).sensorPose.yaw(), 0);
}

TEST(Observations, SupportScansAcrossTheRobotsBack) {
  std::vector<Beam> beams;
  for (int i = 0; i < 5; ++i) beams.push_back(beamAt(0, 0, 0, std::remainder(M_PI - 0.2 + 0.1 * i, 2 * M_PI)));
  const auto scan = recorded<CObservation2DRangeScan>(rangeSensor(SensorKind::laser, "laser", beams, 8, 8), Echoes(5));
  EXPECT_NEAR(scan.aperture, 0.4, 1e-6);
  EXPECT_NEAR(std::abs(scan.sensorPose.yaw()), M_PI, 1e-9);
}

TEST(Observations, RecordAClockwiseScannerFromLeftToRight) {
  const auto sensor = rangeSensor(SensorKind::laser, "laser", {beamAt(0, 0, 0, 1), beamAt(0, 0, 0, -1)}, 8, 8);
  const auto scan = recorded<CObservation2DRangeScan>(sensor, Echoes(2));
  EXPECT_FALSE(scan.rightToLeft);
  EXPECT_EQ(scan.aperture, 2.0f);
  EXPECT_NEAR(scan.getScanAngle(0), 1, 1e-6);
}

TEST(Observations, RecordALaserWithIrregularBeamsAsRanges) {
  const auto one = rangeSensor(SensorKind::laser, "laser", {beamAt(0, 0, 0, 0)}, 8, 8);
  const auto uneven =
      rangeSensor(SensorKind::laser, "laser", {beamAt(0, 0, 0, 0), beamAt(0, 0, 0, 1), beamAt(0, 0, 0, 1.5)}, 8, 8);
  const auto apart = rangeSensor(SensorKind::laser, "laser", {beamAt(0, 0, 0, 0), beamAt(0, 0.1, 0, 1)}, 8, 8);
  EXPECT_EQ(recorded<CObservationRange>(one, Echoes(1)).sensedData.size(), 1u);
  EXPECT_EQ(recorded<CObservationRange>(uneven, Echoes(3)).sensedData.size(), 3u);
  EXPECT_EQ(recorded<CObservationRange>(apart, Echoes(2)).sensedData.size(), 2u);
}

TEST(Observations, RecordALaserWithTiltedBeamsAsRanges) {
  std::vector<Beam> beams;
  for (const double yaw_rad : {-0.5, 0.0, 0.5}) beams.push_back({mrpt::math::TPose3D(0.1, 0, 0.2, yaw_rad, 0.1, 0)});
  const auto tilted = rangeSensor(SensorKind::laser, "laser", beams, 8, 8);
  EXPECT_EQ(recorded<CObservationRange>(tilted, Echoes(3)).sensedData.size(), 3u);
}

TEST(Observations, RecordAPanningSensorWithItsPose) {
  auto sensor = rangeSensor(SensorKind::laser, "laser", {beamAt(0.3, 0, 0, 0.25)}, 8, 8);
  sensor.pans = true;
  const auto range = recorded<CObservationRange>(sensor, Echoes(1), 0.5f);
  EXPECT_EQ(range.sensedData[0].sensorPose.yaw, 0.75);
  EXPECT_EQ(range.sensedData[0].sensorPose.x, 0.3);
  auto scanner = sampleScanner();
  scanner.pans = true;
  EXPECT_NEAR(recorded<CObservation2DRangeScan>(scanner, Echoes(181), 0.5f).sensorPose.yaw(), 0.5, 1e-9);
}

TEST(Observations, RecordHeatAsATemperatureWithTheSensorsPose) {
  const auto sensor = plainSensor(SensorKind::heat, "heat", {beamAt(0, 0, 0.4, 0)});
  const auto heat = recorded<mrpt::obs::CObservationGasSensors>(sensor, Scalar{12.5});
  ASSERT_EQ(heat.m_readings.size(), 1u);
  EXPECT_TRUE(heat.m_readings[0].hasTemperature);
  EXPECT_EQ(heat.m_readings[0].temperature, 12.5f);
  EXPECT_EQ(heat.m_readings[0].eNosePoseOnTheRobot.z, 0.4);
}

TEST(Observations, RecordBumperSegmentsAsDigitalInputs) {
  const auto sensor = plainSensor(SensorKind::bumper, "bumper", std::vector<Beam>(10));
  const auto bumper = recorded<mrpt::obs::CObservationRawDAQ>(sensor, Contacts{{1, 0, 1, 0, 0, 0, 0, 0, 0, 1}});
  EXPECT_EQ(bumper.DIN, (std::vector<std::uint8_t>{0b00000101, 0b00000010}));
}

TEST(Observations, ClearReleasedBumperSegments) {
  RobotObservations observations(robotWith(plainSensor(SensorKind::bumper, "bumper", std::vector<Beam>(1))));
  Readings readings;
  readings.measurements = {Contacts{{1}}};
  observations.of(readings, std::nullopt);
  readings.measurements = {Contacts{{0}}};
  const auto& bumper = dynamic_cast<const mrpt::obs::CObservationRawDAQ&>(*observations.of(readings, std::nullopt)[0]);
  EXPECT_EQ(bumper.DIN, std::vector<std::uint8_t>{0});
}

TEST(Observations, RecordACompassAsAYawOnly) {
  const auto compass = recorded<mrpt::obs::CObservationIMU>(plainSensor(SensorKind::compass, "compass"), Scalar{-2.5});
  EXPECT_EQ(compass.get(mrpt::obs::IMU_YAW), -2.5);
  EXPECT_EQ(std::count(compass.dataIsPresent.begin(), compass.dataIsPresent.end(), true), 1);
}

TEST(Observations, RecordTheLensOfACamera) {
  SensorInfo camera = sampleCamera();
  EXPECT_EQ(recorded<JpegObservation>(camera, Image{sampleJpeg(camera, 200)}).cameraParams.distortion,
            mrpt::img::DistortionModel::none);
  camera.camera.distortion = {-0.2, 0.05, 0.001, 0.002, 0.01};
  const auto picture = recorded<JpegObservation>(camera, Image{sampleJpeg(camera, 200)});
  EXPECT_EQ(picture.cameraParams.distortion, mrpt::img::DistortionModel::plumb_bob);
  EXPECT_EQ(picture.cameraParams.k1(), -0.2);
  EXPECT_EQ(picture.cameraParams.k2(), 0.05);
  EXPECT_EQ(picture.cameraParams.p1(), 0.001);
  EXPECT_EQ(picture.cameraParams.p2(), 0.002);
  EXPECT_EQ(picture.cameraParams.k3(), 0.01);
}

TEST(Observations, RecordAnImageWithTheCamerasPoseAndDepthAlongZ) {
  const auto picture = recorded<JpegObservation>(sampleCamera(), Image{sampleJpeg(sampleCamera(), 200)});
  EXPECT_EQ(picture.cameraParams.ncols, 48u);
  EXPECT_EQ(picture.cameraParams.nrows, 32u);
  EXPECT_NEAR(picture.cameraParams.fx(), 24 / std::tan(0.6), 1e-9);
  EXPECT_EQ(picture.cameraParams.fx(), picture.cameraParams.fy());
  EXPECT_EQ(picture.cameraParams.cx(), 24);
  EXPECT_EQ(picture.cameraParams.cy(), 16);
  const auto ahead = picture.cameraPose + mrpt::poses::CPoint3D(0, 0, 1);
  EXPECT_NEAR(ahead.x(), 0.15 + std::cos(0.1), 1e-9);
  EXPECT_NEAR(ahead.y(), std::sin(0.1), 1e-9);
  EXPECT_NEAR(ahead.z(), 0.3, 1e-9);
  const auto right = picture.cameraPose + mrpt::poses::CPoint3D(1, 0, 0);
  EXPECT_NEAR(right.y(), -std::cos(0.1), 1e-9);
}

TEST(Observations, RecordABlobAsSevenAnalogueInputs) {
  const SensorInfo finder = (*seeingRobot("rover").sensors)[2];
  const auto observation =
      recorded<mrpt::obs::CObservationRawDAQ>(finder, Blobs{true, {{"gold", 12, 10.5f, 20.25f, 8, 19, 6, 3}, {"red"}}});
  EXPECT_EQ(observation.AIN_double, (std::vector<double>{12, 10.5, 20.25, 8, 19, 6, 3, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Observations, RecordTheReceivedBeaconsWithTheirNumbers) {
  auto sensor = rangeSensor(SensorKind::beacons, "beacons", std::vector<Beam>(3, beamAt(0.1, 0.2, 0.3, 0)), 50, 50);
  sensor.noise_std_m = 0.25;
  const auto ranges = recorded<mrpt::obs::CObservationBeaconRanges>(sensor, BeaconRanges{{2.5f, 50, 7}});
  EXPECT_EQ(ranges.maxSensorDistance, 50);
  EXPECT_EQ(ranges.stdError, 0.25f);
  ASSERT_EQ(ranges.sensedData.size(), 2u) << "the one at the maximum range is not received";
  EXPECT_EQ(ranges.sensedData[0].beaconID, 0);
  EXPECT_EQ(ranges.sensedData[0].sensedDistance, 2.5f);
  EXPECT_EQ(ranges.sensedData[1].beaconID, 2);
  EXPECT_EQ(ranges.sensedData[1].sensedDistance, 7);
  EXPECT_EQ(ranges.sensedData[1].sensorLocationOnRobot.y(), 0.2);
}

TEST(Observations, RecordValuesAsAnalogueInputs) {
  auto air = plainSensor(SensorKind::values, "air");
  air.quantities = {{"co2", "ppm"}, {"humidity", "%"}};
  EXPECT_EQ(recorded<mrpt::obs::CObservationRawDAQ>(air, Values{{412.5, 0.1}}).AIN_double,
            (std::vector<double>{412.5, 0.1}));
}

TEST(Observations, RecordRangesAndBearingsOfNeighboursByTheirNumbers) {
  auto board = plainSensor(SensorKind::values, "range_and_bearing", {beamAt(0, 0, 0.1, 0)});
  board.range_max_m = 3;
  board.noise_std_m = 0.125;
  board.bearing_std_rad = 0.0625;
  board.quantities = neighbourQuantities(3);
  const Values measured{{7, 1.5, -0.25, 2, 2.5, 3, -1, 0, 0}};  // robots 7 and 2, and a free place
  const auto neighbours = recorded<mrpt::obs::CObservationBearingRange>(board, measured);
  ASSERT_EQ(neighbours.sensedData.size(), 2u);
  EXPECT_EQ(neighbours.sensedData[0].landmarkID, 7);
  EXPECT_EQ(neighbours.sensedData[0].range, 1.5f);
  EXPECT_EQ(neighbours.sensedData[0].yaw, -0.25f);
  EXPECT_EQ(neighbours.sensedData[1].landmarkID, 2);
  EXPECT_EQ(neighbours.maxSensorDistance, 3);
  EXPECT_EQ(neighbours.sensor_std_range, 0.125f);
  EXPECT_EQ(neighbours.sensor_std_yaw, 0.0625f);
  EXPECT_NEAR(neighbours.sensorLocationOnRobot.z(), 0.1, 1e-9);
  EXPECT_EQ(findCodec(board).measurementFrom(neighbours, board, 0, ""), Measurement(measured));
}

TEST(Observations, RecordFixesOfSatelliteReceiversAsGgaMessages) {
  auto receiver = plainSensor(SensorKind::values, "gnss", {beamAt(0.5, 0, 0.25, 0)});
  receiver.quantities = GnssFix::quantities();
  const Measurement measured = GnssFix{true, 48.123456789, -11.5, 519.75}.values();
  const auto fix = recorded<mrpt::obs::CObservationGPS>(receiver, measured);
  EXPECT_EQ(fix.sensorPose.x(), 0.5);
  const auto& gga = fix.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
  EXPECT_EQ(gga.fix_quality, 1);
  EXPECT_EQ(gga.latitude_degrees, 48.123456789);
  EXPECT_EQ(gga.longitude_degrees, -11.5);
  EXPECT_EQ(gga.altitude_meters, 519.75);
  EXPECT_EQ(findCodec(receiver).measurementFrom(fix, receiver, 0, ""), measured);
  EXPECT_THROW(findCodec(receiver).measurementFrom(mrpt::obs::CObservationGPS(), receiver, 0, ""), RecordingError);
}

TEST(Observations, RecordInertialReadingsByTheirAxes) {
  auto inertial = plainSensor(SensorKind::values, "imu");
  inertial.quantities = InertialReading::quantities();
  const Measurement measured = InertialReading{0.5, 1, -2, 9.75}.values();
  const auto imu = recorded<mrpt::obs::CObservationIMU>(inertial, measured);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_YAW_VEL), 0.5);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_X_ACC), 1);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_Y_ACC), -2);
  EXPECT_EQ(imu.get(mrpt::obs::IMU_Z_ACC), 9.75);
  EXPECT_FALSE(imu.has(mrpt::obs::IMU_YAW));
  EXPECT_EQ(findCodec(inertial).measurementFrom(imu, inertial, 0, ""), measured);
}

TEST(Observations, RecordOdometryWithPoseAndSpeeds) {
  const auto odometry = recorded<mrpt::obs::CObservationOdometry>(plainSensor(SensorKind::odometry, "odometry"),
                                                                  Odometry{{1, 2, 3}, 0.5, -0.25});
  EXPECT_EQ(odometry.odometry.x(), 1);
  EXPECT_EQ(odometry.odometry.y(), 2);
  EXPECT_EQ(odometry.odometry.phi(), 3);
  EXPECT_TRUE(odometry.hasVelocities);
  EXPECT_EQ(odometry.velocityLocal, mrpt::math::TTwist2D(0.5, 0, -0.25));
}

TEST(Observations, NeverHaveAnAngularSpeedOfZeroBecauseOfIcpSlam) {
  const auto odometry = recorded<mrpt::obs::CObservationOdometry>(plainSensor(SensorKind::odometry, "odometry"),
                                                                  Odometry{{0, 0, 0}, 0.5, 0});
  EXPECT_EQ(odometry.velocityLocal.omega, 1e-6);
}

TEST(Observations, RecordGroundTruthWithoutUncertainty) {
  const RobotInfo robot = sampleRobot("rover");
  RobotObservations observations(robot);
  const auto list = observations.of(sampleReadings(robot, 0), mrpt::math::TPose2D(1, -2, 3));
  const auto& truth = dynamic_cast<const mrpt::obs::CObservationRobotPose&>(*list[0]);
  EXPECT_EQ(truth.pose.mean.x(), 1);
  EXPECT_EQ(truth.pose.mean.y(), -2);
  EXPECT_NEAR(truth.pose.mean.yaw(), 3, 1e-12);
  EXPECT_EQ(truth.pose.cov.sum(), 0);
}

TEST(Observations, AreSerialisedExactlyAsByMrpt) {
  const RobotInfo robot = sampleRobot("rover");
  RobotObservations observations(robot);
  for (std::uint64_t step = 0; step < 200; ++step) {
    Readings readings = sampleReadings(robot, step);
    if (step % 2) readings.laser_pan_rad = 0;  // the pan angle of templates
    std::optional<mrpt::math::TPose2D> truth;
    if (step % 3)
      truth = {0.1 * static_cast<double>(step), -2, std::remainder(0.1 * static_cast<double>(step), 2 * M_PI)};
    ByteArchive written, expected;
    for (const auto& observation : observations.of(readings, truth)) expected << *observation;
    observations.write(readings, truth, written);
    EXPECT_EQ(written.bytes, expected.bytes) << "step " << step;
  }
}

}  // namespace
}  // namespace robosim
