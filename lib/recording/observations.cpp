#include "recording/observations.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/random.h"
#include "recording/fan.h"
#include "recording/jpeg_observation.h"
#include "recording/observation_times.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationBatteryState;
using mrpt::obs::CObservationGasSensors;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRange;
using mrpt::obs::CObservationRawDAQ;
using mrpt::obs::CObservationRobotPose;
using mrpt::poses::CPose3D;

/// Grids take a cone of no width for a fault.
constexpr float kThinBeam_rad = 0.001f;

bool isSilence(const SensorInfo& sensor, float range_m) { return range_m >= static_cast<float>(sensor.no_echo_m); }

/// Where a sensor of one number sits.
TPose3D poseOf(const SensorInfo& sensor) {
  return sensor.beams.empty() ? TPose3D::Identity() : sensor.beams[0].robot_from_beam;
}

// One pair of functions for each class: make() it with all that is constant, and fill() in a step's reading.

CObservation::Ptr makeRange(const SensorInfo& sensor) {
  auto range = CObservationRange::Create();
  range->minSensorDistance = static_cast<float>(sensor.range_min_m);
  range->maxSensorDistance = static_cast<float>(sensor.range_max_m);
  range->sensorConeApperture = std::max(static_cast<float>(sensor.beam_width_rad), kThinBeam_rad);
  range->sensedData.resize(sensor.beams.size());
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    range->sensedData[i].sensorID = static_cast<std::uint16_t>(i);
    range->sensedData[i].sensorPose = sensor.beams[i].robot_from_beam;
  }
  return range;
}

void fill(CObservationRange& range, const SensorInfo& sensor, const Echoes& echoes, float pan_rad) {
  assert(echoes.size() == range.sensedData.size());
  const float no_echo_m = recordedNoEcho(sensor);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    auto& sensed = range.sensedData[i];
    sensed.sensedDistance = isSilence(sensor, echoes[i].range_m) ? no_echo_m : echoes[i].range_m;
    if (sensor.pans) sensed.sensorPose = panned(sensor.beams[i].robot_from_beam, pan_rad);
  }
}

CObservation::Ptr makeScan(const SensorInfo& sensor, const Fan& fan) {
  auto scan = CObservation2DRangeScan::Create();
  scan->aperture = static_cast<float>(fan.aperture_rad);
  scan->rightToLeft = fan.step_rad > 0;
  scan->maxRange = static_cast<float>(sensor.range_max_m);
  scan->sensorPose = CPose3D(fan.robot_from_middle);
  scan->beamAperture = static_cast<float>(sensor.beam_width_rad);
  // A noiseless scanner keeps MRPT's 1 cm: an error of 0 would make every likelihood 0.
  if (sensor.noise_std_m > 0) scan->stdError = static_cast<float>(sensor.noise_std_m);
  scan->resizeScanAndAssign(sensor.beams.size(), static_cast<float>(sensor.no_echo_m), false);
  return scan;
}

void fill(CObservation2DRangeScan& scan, const SensorInfo& sensor, const Echoes& echoes, float pan_rad) {
  assert(echoes.size() == scan.getScanSize());
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    scan.setScanRange(i, echoes[i].range_m);
    scan.setScanRangeValidity(i, !isSilence(sensor, echoes[i].range_m));
  }
  if (sensor.pans) scan.sensorPose = CPose3D(panned(fanOf(sensor.beams)->robot_from_middle, pan_rad));
}

CObservation::Ptr makeHeat(const SensorInfo& sensor) {
  auto heat = CObservationGasSensors::Create();
  auto& nose = heat->m_readings.emplace_back();
  nose.eNosePoseOnTheRobot = poseOf(sensor);
  nose.hasTemperature = true;
  nose.isActive = true;
  return heat;
}

CObservation::Ptr makeCompass(const SensorInfo& sensor) {
  auto compass = CObservationIMU::Create();
  compass->sensorPose = CPose3D(poseOf(sensor));
  compass->dataIsPresent.fill(false);
  compass->rawMeasurements.fill(0);
  return compass;
}

CObservation::Ptr makeBattery() {
  auto battery = CObservationBatteryState::Create();
  battery->voltageMainRobotBatteryIsValid = true;
  return battery;
}

CObservation::Ptr makeBumper(const SensorInfo& sensor) {
  auto bumper = CObservationRawDAQ::Create();
  bumper->DIN.resize((sensor.beams.size() + 7) / 8);
  return bumper;
}

void fill(CObservationRawDAQ& bumper, const Contacts& contacts) {
  assert((contacts.pressed.size() + 7) / 8 == bumper.DIN.size());
  std::fill(bumper.DIN.begin(), bumper.DIN.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < contacts.pressed.size(); ++i) {
    if (contacts.pressed[i]) bumper.DIN[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
  }
}

/// What is optically ahead and to the right of a camera is z and x to MRPT.
const CPose3D& beamFromCamera() {
  static const CPose3D pose(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  return pose;
}

CObservation::Ptr makePicture(const SensorInfo& sensor) {
  auto picture = std::make_shared<JpegObservation>();
  picture->cameraPose = CPose3D(poseOf(sensor)) + beamFromCamera();
  const CameraInfo& camera = sensor.camera;
  const double focal_px = camera.focalLength();
  picture->cameraParams.ncols = camera.width_px;
  picture->cameraParams.nrows = camera.height_px;
  picture->cameraParams.setIntrinsicParamsFromValues(focal_px, focal_px, camera.width_px / 2.0, camera.height_px / 2.0);
  return picture;
}

/// @returns whether there was a picture.
bool fill(CObservationRawDAQ& observation, const Blobs& blobs) {
  observation.AIN_double.clear();
  for (const Blob& blob : blobs.of_color) {
    for (const double number :
         {static_cast<double>(blob.pixels), static_cast<double>(blob.x_px), static_cast<double>(blob.y_px),
          static_cast<double>(blob.left_px), static_cast<double>(blob.top_px), static_cast<double>(blob.width_px),
          static_cast<double>(blob.height_px)}) {
      observation.AIN_double.push_back(number);
    }
  }
  return blobs.taken;
}

CObservation::Ptr makeOdometry() {
  auto odometry = CObservationOdometry::Create();
  odometry->hasVelocities = true;
  return odometry;
}

void fill(CObservationOdometry& observation, const Odometry& odometry) {
  observation.odometry.x(odometry.odom_from_robot.x);
  observation.odometry.y(odometry.odom_from_robot.y);
  observation.odometry.phi(
      odometry.odom_from_robot.phi);  // the constructor would wrap the angle, and lose its last bits
  const double turn_radps = odometry.turn_radps == 0 ? kNoTurn_radps : odometry.turn_radps;
  observation.velocityLocal = {odometry.speed_mps, 0, turn_radps};
}

CObservation::Ptr makeObservation(const SensorInfo& sensor) {
  switch (sensor.kind) {
    case SensorKind::laser:
      if (const auto fan = fanOf(sensor.beams)) return makeScan(sensor, *fan);
      return makeRange(sensor);
    case SensorKind::sonar:
    case SensorKind::infrared:
      return makeRange(sensor);
    case SensorKind::heat:
      return makeHeat(sensor);
    case SensorKind::bumper:
      return makeBumper(sensor);
    case SensorKind::odometry:
      return makeOdometry();
    case SensorKind::compass:
      return makeCompass(sensor);
    case SensorKind::camera:
      return makePicture(sensor);
    case SensorKind::blob_finder:
      return CObservationRawDAQ::Create();
    case SensorKind::battery:
      return makeBattery();
  }
  assert(!"a kind of sensor that no observation has been chosen for");
  return {};
}

/// @returns whether the sensor measured anything in this step.
bool fill(CObservation& observation, const SensorInfo& sensor, const Measurement& measurement, float pan_rad) {
  switch (sensor.kind) {
    case SensorKind::laser:
      if (auto* scan = dynamic_cast<CObservation2DRangeScan*>(&observation)) {
        fill(*scan, sensor, std::get<Echoes>(measurement), pan_rad);
        break;
      }
      [[fallthrough]];
    case SensorKind::sonar:
    case SensorKind::infrared:
      fill(static_cast<CObservationRange&>(observation), sensor, std::get<Echoes>(measurement), pan_rad);
      break;
    case SensorKind::heat:
      static_cast<CObservationGasSensors&>(observation).m_readings[0].temperature =
          static_cast<float>(std::get<Scalar>(measurement).value);
      break;
    case SensorKind::bumper:
      fill(static_cast<CObservationRawDAQ&>(observation), std::get<Contacts>(measurement));
      break;
    case SensorKind::odometry:
      fill(static_cast<CObservationOdometry&>(observation), std::get<Odometry>(measurement));
      break;
    case SensorKind::compass:
      static_cast<CObservationIMU&>(observation).set(mrpt::obs::IMU_YAW, std::get<Scalar>(measurement).value);
      break;
    case SensorKind::camera: {
      auto& jpeg = static_cast<JpegObservation&>(observation).jpeg;
      jpeg = std::get<Image>(measurement).jpeg;
      return !jpeg.empty();
    }
    case SensorKind::blob_finder:
      return fill(static_cast<CObservationRawDAQ&>(observation), std::get<Blobs>(measurement));
    case SensorKind::battery:
      static_cast<CObservationBatteryState&>(observation).voltageMainRobotBattery = std::get<Scalar>(measurement).value;
      break;
  }
  return true;
}

/// A measurement of some numbers that are surely not written anywhere else in an observation.
Measurement probeOf(const SensorInfo& sensor, Rng& rng) {
  switch (sensor.kind) {
    case SensorKind::sonar:
    case SensorKind::laser:
    case SensorKind::infrared: {
      Echoes echoes(sensor.beams.size());
      for (auto& echo : echoes) echo.range_m = static_cast<float>(sensor.range_max_m * rng.uniform());
      return echoes;
    }
    case SensorKind::heat:
    case SensorKind::compass:
    case SensorKind::battery:
      return Scalar{rng.uniform()};
    case SensorKind::bumper:
      return Contacts{std::vector<std::uint8_t>(sensor.beams.size())};
    case SensorKind::odometry:
      return Odometry{{rng.uniform(), rng.uniform(), rng.uniform()}, rng.uniform(), rng.uniform()};
    case SensorKind::camera:
      return Image{};
    case SensorKind::blob_finder:
      return blankBlobs(sensor);
  }
  return {};
}

}  // namespace

mrpt::Clock::time_point timestampOf(const SimTime& time) {
  const auto ticks = static_cast<mrpt::Clock::rep>(std::llround(time.seconds() * mrpt::Clock::period::den));
  return mrpt::Clock::fromDouble(kEpochUnixSeconds) + mrpt::Clock::duration(ticks);
}

double secondsSinceStart(mrpt::Clock::time_point timestamp) {
  return secondsBetween(mrpt::Clock::fromDouble(kEpochUnixSeconds), timestamp);
}

std::string sensorLabel(const std::string& robot, const std::string& sensor) { return robot + "/" + sensor; }

float recordedNoEcho(const SensorInfo& sensor) { return static_cast<float>(sensor.range_max_m * 1.001); }

RobotObservations::RobotObservations(const RobotInfo& robot, PictureFolder* pictures)
    : sensors_(robot.sensors), pictures_(pictures) {
  for (std::size_t i = 0; i < sensors_->size(); ++i) slots_.push_back(i);
  std::stable_partition(slots_.begin(), slots_.end(),
                        [&](std::size_t i) { return (*sensors_)[i].kind == SensorKind::odometry; });

  observations_.push_back(CObservationRobotPose::Create());
  observations_.back()->sensorLabel = sensorLabel(robot.name, kGroundTruth);
  stems_.emplace_back();
  for (const std::size_t slot : slots_) {
    observations_.push_back(makeObservation((*sensors_)[slot]));
    const std::string label = sensorLabel(robot.name, (*sensors_)[slot].label);
    observations_.back()->sensorLabel = label;
    const bool is_camera = (*sensors_)[slot].kind == SensorKind::camera;
    stems_.push_back(is_camera && pictures_ ? pictures_->stemFor(label) : "");
  }
  makeImprints();
}

std::span<const CObservation::Ptr> RobotObservations::of(const Readings& readings,
                                                         const std::optional<TPose2D>& world_from_robot) {
  assert(readings.measurements.size() == sensors_->size());
  const auto timestamp = timestampOf(readings.time);
  told_.clear();
  if (world_from_robot) {
    tellTruth(*world_from_robot, timestamp);
    told_.push_back(0);
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    CObservation& observation = *observations_[1 + i];
    observation.timestamp = timestamp;
    if (!fill(observation, (*sensors_)[slots_[i]], readings.measurements[slots_[i]], readings.laser_pan_rad)) continue;
    if (!stems_[1 + i].empty()) putAway(static_cast<JpegObservation&>(observation), stems_[1 + i], readings.time);
    told_.push_back(1 + i);
  }
  given_.clear();
  for (const std::size_t i : told_) given_.push_back(observations_[i]);
  return given_;
}

/// Puts a picture into a file of its own.
void RobotObservations::putAway(JpegObservation& picture, const std::string& stem, const SimTime& time) {
  const std::string step = std::to_string(time.step);
  const std::string name = stem + "_" + std::string(step.size() < 8 ? 8 - step.size() : 0, '0') + step + ".jpg";
  pictures_->write(name, picture.jpeg);
  picture.image.setExternalStorage(name);
}

void RobotObservations::tellTruth(const TPose2D& world_from_robot, mrpt::Clock::time_point timestamp) {
  auto& truth = static_cast<CObservationRobotPose&>(*observations_[0]);
  truth.timestamp = timestamp;
  truth.pose.mean = CPose3D(TPose3D(world_from_robot));
  const CPose3D& pose = truth.pose.mean;
  const auto& turned = pose.getRotationMatrix();
  truth_ = {pose.x(), pose.y(), pose.z()};
  std::copy(turned.begin(), turned.end(), truth_.begin() + 3);
}

void RobotObservations::write(const Readings& readings, const std::optional<TPose2D>& world_from_robot,
                              ByteArchive& archive) {
  of(readings, world_from_robot);
  for (const std::size_t i : told_) {
    const bool turned = i > 0 && (*sensors_)[slots_[i - 1]].pans && readings.laser_pan_rad != 0;
    if (imprints_[i] && !turned) {
      imprints_[i]->append(archive);
    } else {
      archive << *observations_[i];
    }
  }
}

void RobotObservations::makeImprints() {
  const auto probe = [this](int which) {
    Rng rng(static_cast<std::uint64_t>(which));
    Readings readings;
    readings.time.step = 1 + rng.below(1'000'000);
    for (const auto& sensor : *sensors_) readings.measurements.push_back(probeOf(sensor, rng));
    of(readings, TPose2D(rng.uniform(), rng.uniform(), rng.uniform()));
  };
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    auto numbers = changingNumbers(i);
    imprints_.push_back(numbers.empty() ? std::nullopt : Imprint::of(*observations_[i], std::move(numbers), probe));
  }
}

/// What fill() changes, as far as MRPT writes it as it lies in memory; none for what is not worth the trouble.
std::vector<Imprint::Number> RobotObservations::changingNumbers(std::size_t i) {
  const auto number = [](const auto& value) { return std::as_bytes(std::span(&value, 1)); };
  CObservation& observation = *observations_[i];
  std::vector<Imprint::Number> numbers{number(observation.timestamp)};
  if (i == 0) {
    numbers.push_back(number(truth_));  // as MRPT writes a CPose3D
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    for (const auto& sensed : *range) numbers.push_back(number(sensed.sensedDistance));
  } else if (const auto* heat = dynamic_cast<const CObservationGasSensors*>(&observation)) {
    numbers.push_back(number(heat->m_readings[0].temperature));
  } else if (auto* odometry = dynamic_cast<CObservationOdometry*>(&observation)) {
    for (const double* value : {&odometry->odometry.x(), &odometry->odometry.y(), &odometry->odometry.phi(),
                                &odometry->velocityLocal.vx, &odometry->velocityLocal.omega}) {
      numbers.push_back(number(*value));
    }
  } else if (const auto* compass = dynamic_cast<const CObservationIMU*>(&observation)) {
    numbers.push_back(number(compass->rawMeasurements[mrpt::obs::IMU_YAW]));
  } else if (const auto* battery = dynamic_cast<const CObservationBatteryState*>(&observation)) {
    numbers.push_back(number(battery->voltageMainRobotBattery));
  } else {
    numbers.clear();
  }
  return numbers;
}

}  // namespace robosim
