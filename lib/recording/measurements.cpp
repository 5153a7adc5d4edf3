#include "recording/measurements.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "recording/fan.h"
#include "recording/jpeg_observation.h"
#include "recording/observations.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationBatteryState;
using mrpt::obs::CObservationGasSensors;
using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRange;
using mrpt::obs::CObservationRawDAQ;

Echo echoAlong(const Beam& beam, double pan_rad, float range_m) {
  return {range_m, pointAlong(originOf(beam), directionOf(beam, pan_rad), range_m)};
}

Echo silence(const SensorInfo& sensor, const Beam& beam, double pan_rad) {
  return echoAlong(beam, pan_rad, static_cast<float>(sensor.no_echo_m));
}

[[noreturn]] void refuse(const CObservation& observation, const SensorInfo& sensor, const std::string& why) {
  throw RecordingError("recorded observation \"" + observation.sensorLabel + "\" (" +
                       observation.GetRuntimeClass()->className + ") is not of the " + nameOf(sensor.kind) + " \"" +
                       sensor.label + "\": " + why + "; give the robots that the recording was made with");
}

template <typename Class>
const Class& as(const CObservation& observation, const SensorInfo& sensor) {
  if (const auto* it = dynamic_cast<const Class*>(&observation)) return *it;
  refuse(observation, sensor, std::string("the class should be ") + Class::GetRuntimeClassIdStatic().className);
}

void checkSize(const CObservation& observation, const SensorInfo& sensor, std::size_t recorded, std::size_t expected) {
  if (recorded == expected) return;
  refuse(observation, sensor,
         "it holds " + std::to_string(recorded) + " values in place of " + std::to_string(expected));
}

Echoes echoesFrom(const CObservationRange& range, const SensorInfo& sensor, double pan_rad) {
  checkSize(range, sensor, range.sensedData.size(), sensor.beams.size());
  Echoes echoes;
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    const float range_m = range.sensedData[i].sensedDistance;
    const bool silent = range_m > static_cast<float>(sensor.range_max_m);
    echoes.push_back(silent ? silence(sensor, sensor.beams[i], pan_rad) : echoAlong(sensor.beams[i], pan_rad, range_m));
  }
  return echoes;
}

Echoes echoesFrom(const CObservation2DRangeScan& scan, const SensorInfo& sensor, double pan_rad) {
  checkSize(scan, sensor, scan.getScanSize(), sensor.beams.size());
  Echoes echoes;
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    echoes.push_back(scan.getScanRangeValidity(i) ? echoAlong(sensor.beams[i], pan_rad, scan.getScanRange(i))
                                                  : silence(sensor, sensor.beams[i], pan_rad));
  }
  return echoes;
}

Scalar heatFrom(const CObservationGasSensors& heat, const SensorInfo& sensor) {
  checkSize(heat, sensor, heat.m_readings.size(), 1);
  if (!heat.m_readings[0].hasTemperature) refuse(heat, sensor, "it has no temperature");
  return {heat.m_readings[0].temperature};
}

Scalar yawFrom(const CObservationIMU& compass, const SensorInfo& sensor) {
  if (!compass.has(mrpt::obs::IMU_YAW)) refuse(compass, sensor, "it has no yaw");
  return {compass.get(mrpt::obs::IMU_YAW)};
}

Scalar voltageFrom(const CObservationBatteryState& battery, const SensorInfo& sensor) {
  if (!battery.voltageMainRobotBatteryIsValid) refuse(battery, sensor, "it has no voltage of the main battery");
  return {battery.voltageMainRobotBattery};
}

Contacts contactsFrom(const CObservationRawDAQ& bumper, const SensorInfo& sensor) {
  checkSize(bumper, sensor, bumper.DIN.size(), (sensor.beams.size() + 7) / 8);
  Contacts contacts;
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    contacts.pressed.push_back((bumper.DIN[i / 8] >> (i % 8)) & 1u);
  }
  return contacts;
}

Odometry odometryFrom(const CObservationOdometry& observation) {
  Odometry odometry;
  odometry.odom_from_robot = {observation.odometry.x(), observation.odometry.y(), observation.odometry.phi()};
  if (observation.hasVelocities) {
    odometry.speed_mps = observation.velocityLocal.vx;
    odometry.turn_radps = observation.velocityLocal.omega == kNoTurn_radps ? 0 : observation.velocityLocal.omega;
  }
  return odometry;
}

Image imageFrom(const CObservationImage& observation, const SensorInfo& sensor) {
  if (!observation.image.isExternallyStored() && observation.image.isEmpty()) {
    refuse(observation, sensor, "it has no picture");
  }
  return {jpegOf(observation)};
}

Blobs blobsFrom(const CObservationRawDAQ& observation, const SensorInfo& sensor) {
  constexpr std::size_t kNumbers = 7;
  checkSize(observation, sensor, observation.AIN_double.size(), kNumbers * sensor.colors.size());
  Blobs blobs = blankBlobs(sensor);
  blobs.taken = true;
  for (std::size_t i = 0; i < blobs.of_color.size(); ++i) {
    const double* numbers = &observation.AIN_double[kNumbers * i];
    for (std::size_t n = 0; n < kNumbers; ++n) {
      if (!(numbers[n] >= 0 && numbers[n] <= 1.0 * kPictureSideMax_px * kPictureSideMax_px)) {
        refuse(observation, sensor, "it has a blob that is in no picture");
      }
    }
    Blob& blob = blobs.of_color[i];
    blob.pixels = static_cast<std::uint32_t>(numbers[0]);
    blob.x_px = static_cast<float>(numbers[1]);
    blob.y_px = static_cast<float>(numbers[2]);
    blob.left_px = static_cast<std::uint32_t>(numbers[3]);
    blob.top_px = static_cast<std::uint32_t>(numbers[4]);
    blob.width_px = static_cast<std::uint32_t>(numbers[5]);
    blob.height_px = static_cast<std::uint32_t>(numbers[6]);
  }
  return blobs;
}

}  // namespace

Measurement measurementFrom(const CObservation& observation, const SensorInfo& sensor, float laser_pan_rad) {
  const double pan_rad = sensor.pans ? laser_pan_rad : 0;
  switch (sensor.kind) {
    case SensorKind::laser:
      if (fanOf(sensor.beams)) return echoesFrom(as<CObservation2DRangeScan>(observation, sensor), sensor, pan_rad);
      [[fallthrough]];
    case SensorKind::sonar:
    case SensorKind::infrared:
      return echoesFrom(as<CObservationRange>(observation, sensor), sensor, pan_rad);
    case SensorKind::heat:
      return heatFrom(as<CObservationGasSensors>(observation, sensor), sensor);
    case SensorKind::bumper:
      return contactsFrom(as<CObservationRawDAQ>(observation, sensor), sensor);
    case SensorKind::odometry:
      return odometryFrom(as<CObservationOdometry>(observation, sensor));
    case SensorKind::compass:
      return yawFrom(as<CObservationIMU>(observation, sensor), sensor);
    case SensorKind::battery:
      return voltageFrom(as<CObservationBatteryState>(observation, sensor), sensor);
    case SensorKind::camera:
      return imageFrom(as<CObservationImage>(observation, sensor), sensor);
    case SensorKind::blob_finder:
      return blobsFrom(as<CObservationRawDAQ>(observation, sensor), sensor);
  }
  refuse(observation, sensor, "it is of no known kind");
}

}  // namespace robosim
