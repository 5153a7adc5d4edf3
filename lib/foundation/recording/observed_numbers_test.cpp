#include "recording/observed_numbers.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

/// "range_0_m=1.5 range_1_m= …"; "none" for an observation without numbers.
std::string textOf(const mrpt::obs::CObservation& observation) {
  const auto numbers = numbersIn(observation);
  if (!numbers) return "none";
  std::string text;
  for (const auto& number : *numbers) {
    text += (text.empty() ? "" : " ") + number.fullName() + '=';
    if (const auto* value = std::get_if<float>(&number.value)) text += mrpt::format("%g", static_cast<double>(*value));
    if (const auto* value = std::get_if<double>(&number.value)) text += mrpt::format("%g", *value);
  }
  return text;
}

TEST(ObservedNumbers, OfRangesBeyondTheMaximumAreAbsent) {
  mrpt::obs::CObservationRange range;
  range.maxSensorDistance = 5;
  range.sensedData.resize(2);
  range.sensedData[0].sensedDistance = 1.5f;
  range.sensedData[1].sensedDistance = 5.005f;
  EXPECT_EQ(textOf(range), "range_0_m=1.5 range_1_m=");
}

TEST(ObservedNumbers, OfOdometryIncludeSpeedsIfRecorded) {
  mrpt::obs::CObservationOdometry odometry;
  odometry.odometry = mrpt::poses::CPose2D(1, 2, 0.5);
  EXPECT_EQ(textOf(odometry), "x_m=1 y_m=2 heading_rad=0.5");
  odometry.hasVelocities = true;
  odometry.velocityLocal = {0.25, 0.5, -1};
  EXPECT_EQ(textOf(odometry), "x_m=1 y_m=2 heading_rad=0.5 speed_mps=0.25 turn_radps=-1 lateral_mps=0.5");
}

TEST(ObservedNumbers, OfGasSensorsAreTemperaturesAndVoltagesOfEachNose) {
  mrpt::obs::CObservationGasSensors heat;
  heat.m_readings.resize(2);
  heat.m_readings[0].hasTemperature = true;
  heat.m_readings[0].temperature = 21.5f;
  heat.m_readings[1].readingsVoltage = {0.5f, 0.25f};
  EXPECT_EQ(textOf(heat), "temperature_0_celsius=21.5 nose_1_0_volt=0.5 nose_1_1_volt=0.25");
}

TEST(ObservedNumbers, OfAnImuAreAllItsValues) {
  mrpt::obs::CObservationIMU imu;
  imu.dataIsPresent.fill(false);
  imu.set(mrpt::obs::IMU_X_ACC, 0.5);
  imu.set(mrpt::obs::IMU_YAW, 1.25);
  imu.set(mrpt::obs::IMU_MAG_Z, -0.5);
  imu.set(mrpt::obs::IMU_Z_ACC_GLOBAL, 9.75);
  EXPECT_EQ(textOf(imu), "acceleration_x_mps2=0.5 yaw_rad=1.25 magnetic_z_gauss=-0.5 global_acceleration_z_mps2=9.75");
}

TEST(ObservedNumbers, OfGpsArePositionAndMotion) {
  mrpt::obs::CObservationGPS gps;
  EXPECT_EQ(textOf(gps), "none");
  mrpt::obs::gnss::Message_NMEA_RMC motion;
  motion.fields.latitude_degrees = 36.5;
  motion.fields.longitude_degrees = -4.25;
  motion.fields.speed_knots = 3600;  // 1,852 m/s
  motion.fields.direction_degrees = 90;
  gps.setMsg(motion);
  EXPECT_EQ(textOf(gps), "latitude_deg=36.5 longitude_deg=-4.25 speed_mps=1852 course_deg=90");
  mrpt::obs::gnss::Message_NMEA_GGA fix;
  fix.fields.latitude_degrees = 36.75;
  fix.fields.altitude_meters = 12.5;
  fix.fields.fix_quality = 4;
  fix.fields.satellitesUsed = 9;
  gps.setMsg(fix);
  EXPECT_EQ(textOf(gps),
            "latitude_deg=36.75 longitude_deg=0 altitude_m=12.5 fix_quality=4 satellites=9 speed_mps=1852 "
            "course_deg=90");
}

TEST(ObservedNumbers, OfBearingsHaveAPitchIfTheSensorSeesOutOfThePlane) {
  mrpt::obs::CObservationBearingRange bearings;
  bearings.fieldOfView_pitch = 0;
  auto& sensed = bearings.sensedData.emplace_back();
  sensed.landmarkID = 3;
  sensed.range = 2;
  sensed.yaw = 0.5;
  sensed.pitch = 0;
  EXPECT_EQ(textOf(bearings), "range_3_m=2 bearing_3_rad=0.5");
  sensed.pitch = 0.25;
  EXPECT_EQ(textOf(bearings), "range_3_m=2 bearing_3_rad=0.5 pitch_3_rad=0.25");
}

TEST(ObservedNumbers, AreUnknownForOtherObservations) {
  EXPECT_EQ(textOf(mrpt::obs::CObservationComment()), "none");
  mrpt::obs::CObservationIMU without_yaw;
  without_yaw.dataIsPresent.fill(false);
  EXPECT_EQ(textOf(without_yaw), "none");
}

TEST(Codecs, RecordEveryKindOfSensor) {
  SensorInfo sensor;
  sensor.beams.resize(1);
  sensor.camera = {320, 240, 1, 10};
  for (std::size_t kind = 0; kind < kSensorKindNames.size(); ++kind) {
    sensor.kind = static_cast<SensorKind>(kind);
    EXPECT_TRUE(findCodec(sensor).make(sensor)) << nameOf(sensor.kind);
  }
}

}  // namespace
}  // namespace robosim
