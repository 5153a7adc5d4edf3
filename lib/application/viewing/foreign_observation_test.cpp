#include "viewing/foreign_observation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include "viewing/foreign_recording.h"

namespace robosim {
namespace {

TEST(ForeignObservation, ConvertsSatellitePositionsToMetresEastAndNorth) {
  // On the equator a degree of longitude is 2π · 6378137 m / 360, and one of latitude, by the meridian's radius of
  // curvature of 6335439 m, 110574 m. At 60° north the parallel's radius is 6378137 cos 60° / √(1 − e² sin² 60°).
  const auto equator = localMetres({0, 10}, {1e-4, 10.0002});
  EXPECT_NEAR(equator.x, 22.2639, 1e-3);
  EXPECT_NEAR(equator.y, 11.0574, 1e-3);
  const auto north = localMetres({60, -170}, {60, -169.9999});
  EXPECT_NEAR(north.x, 5.5800, 1e-3);
  EXPECT_NEAR(north.y, 0, 1e-3);
  EXPECT_NEAR(localMetres({10, 180}, {10, -180}).norm(), 0, 1e-6) << "the same meridian";
}

TEST(ForeignObservation, TakesTheFixOfAReceiverAsItsPosition) {
  mrpt::obs::CObservationGPS gps;
  EXPECT_EQ(observationKind(gps), ObservationKind::ignored);
  mrpt::obs::gnss::Message_NMEA_GGA fix;
  fix.fields.latitude_degrees = 36.7;
  fix.fields.longitude_degrees = -4.4;
  fix.fields.fix_quality = 0;
  gps.setMsg(fix);
  EXPECT_EQ(observationKind(gps), ObservationKind::ignored) << "without a fix";
  fix.fields.fix_quality = 4;
  gps.setMsg(fix);
  EXPECT_EQ(observationKind(gps), ObservationKind::satellites);
  EXPECT_EQ(observedPosition(gps).latitude_deg, 36.7);
  EXPECT_EQ(observedPosition(gps).longitude_deg, -4.4);
}

TEST(ForeignObservation, ProjectsBearingsWithAPitchOntoTheGround) {
  mrpt::obs::CObservationBearingRange bearings;
  bearings.sensorLocationOnRobot = mrpt::poses::CPose3D(0.3, 0, 0.5, 0, 0, 0);
  bearings.sensedData.resize(1);
  bearings.sensedData[0].range = 2;
  bearings.sensedData[0].yaw = 0.5F;
  bearings.sensedData[0].pitch = static_cast<float>(M_PI / 3);
  bearings.sensedData[0].landmarkID = -1;
  ASSERT_EQ(observationKind(bearings), ObservationKind::bearings);
  const auto values = std::get<Values>(observedMeasurement(bearings)).values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_GE(values[0], 0) << "a landmark without a number is one, too";
  EXPECT_NEAR(values[1], 1, 1e-6);
  EXPECT_NEAR(values[2], 0.5, 1e-6);
  SensorInfo sensor;
  updateDescription(sensor, bearings);
  EXPECT_EQ(sensor.kind, SensorKind::values);
  EXPECT_EQ(sensor.beams.at(0).robot_from_beam.x, 0.3);
}

TEST(ForeignObservation, HasARangeForEachBeacon) {
  mrpt::obs::CObservationBeaconRanges beacons;
  beacons.sensedData.resize(2);
  beacons.sensedData[0].sensedDistance = 3;
  beacons.sensedData[1].sensedDistance = std::nanf("");
  beacons.sensedData[1].sensorLocationOnRobot = mrpt::poses::CPoint3D(1, 2, 0);
  ASSERT_EQ(observationKind(beacons), ObservationKind::beacons);
  SensorInfo sensor;
  updateDescription(sensor, beacons);
  ASSERT_EQ(sensor.beams.size(), 2u);
  EXPECT_EQ(sensor.beams[1].robot_from_beam.y, 2);
  const auto ranges = std::get<BeaconRanges>(observedMeasurement(beacons)).range_m;
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0], 3);
  EXPECT_GE(static_cast<double>(ranges[1]), sensor.no_echo_m) << "is not received";
}

TEST(ForeignObservation, UnprojectsADepthImageByItsCamera) {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorPose = mrpt::poses::CPose3D(1, 0, 0.5, 0, 0, 0);
  scan.hasRangeImage = true;
  scan.rangeUnits = 0.001F;
  scan.range_is_depth = true;
  scan.rangeImage_setSize(3, 5);
  scan.rangeImage.fill(0);
  scan.rangeImage(1, 0) = 2000;  // 2 m ahead, two pixels to the left of the middle
  scan.rangeImage(0, 2) = 4000;  // 4 m ahead, one pixel above
  scan.cameraParams.setIntrinsicParamsFromValues(4, 4, 2, 1);
  ASSERT_EQ(observationKind(scan), ObservationKind::points);
  const auto points = std::get<Echoes>(observedMeasurement(scan));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].point_m, mrpt::math::TPoint3Df(5, 0, 1.5F)) << "4 m ahead of the sensor, 4 · 1/4 m above it";
  EXPECT_EQ(points[1].point_m, mrpt::math::TPoint3Df(3, 1, 0.5F)) << "2 m ahead, 2 · 2/4 m to the left";
}

TEST(ForeignObservation, ShowsTheMiddleRowOfARotatingScanner) {
  mrpt::obs::CObservationRotatingScan scan;
  scan.rangeImage.setSize(3, 4);
  scan.rangeImage.fill(100);
  for (int i = 0; i < 4; ++i) scan.rangeImage(1, i) = static_cast<std::uint16_t>(1000 * i);
  scan.rangeResolution = 0.002;
  scan.startAzimuth = 0;
  scan.azimuthSpan = 2 * M_PI;
  scan.maxRange = 50;
  ASSERT_EQ(observationKind(scan), ObservationKind::scan);
  const auto echoes = std::get<Echoes>(observedMeasurement(scan));
  ASSERT_EQ(echoes.size(), 4u);
  EXPECT_EQ(echoes[0].range_m, 50) << "no return";
  EXPECT_EQ(echoes[1].range_m, 2);
  EXPECT_NEAR(echoes[1].point_m.y, 2, 1e-6);
  EXPECT_EQ(echoes[3].range_m, 6);
}

TEST(ForeignRecording, ShowsEveryRecordingOfMrpt) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator("/usr/share/mrpt/datasets")) {
    if (entry.path().extension() != ".rawlog") continue;
    const auto recording = readForeignRecording(entry.path().string());
    const RunSnapshot last = recording->at(recording->times().size() - 1);
    EXPECT_FALSE(last.robots.empty()) << entry.path();
  }
}

TEST(ForeignRecording, ShowsTheTrackOfEachSatelliteReceiverInLocalMetres) {
  const auto recording = readForeignRecording("/usr/share/mrpt/datasets/test_rtk_path.rawlog");
  ASSERT_EQ(recording->world().fleet.robots.size(), 3u);
  const RunSnapshot last = recording->at(recording->times().size() - 1);
  const auto place_of = [&](const std::string& name) {
    const auto& robots = recording->world().fleet.robots;
    const auto found =
        std::find_if(robots.begin(), robots.end(), [&](const FleetRobot& robot) { return robot.info.name == name; });
    return last.robots.at(static_cast<std::size_t>(found - robots.begin())).world_from_robot;
  };
  // Both at 76.2 s: latitudes 36.7166300° and 36.7166400°, longitudes −4.4707650° and −4.4707673°. A degree of latitude
  // is 110,966 m there, and one of longitude 89,383 m.
  const auto right = place_of("GPS_RTK_FRONT_R"), left = place_of("GPS_RTK_FRONT_L");
  EXPECT_NEAR(left.x - right.x, -0.21, 0.02);
  EXPECT_NEAR(left.y - right.y, 1.11, 0.02);
  EXPECT_NEAR(left.phi, 0.16, 0.1) << "a course of 81° is 9° from east to north";
  EXPECT_EQ(recording->paths().robots(), 3u);
}

}  // namespace
}  // namespace robosim
