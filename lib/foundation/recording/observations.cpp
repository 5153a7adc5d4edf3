#include "recording/observations.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include <mrpt/obs/CObservationRobotPose.h>

#include "base/random.h"
#include "hardware/camera_head.h"
#include "hardware/measurement_fields.h"
#include "recording/codecs.h"
#include "recording/jpeg_observation.h"
#include "recording/observation_times.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationRobotPose;
using mrpt::poses::CPose3D;

/// A measurement of random numbers, which do not occur elsewhere in an observation. They are less than range_max_m, so
/// that a range is not recorded as no echo.
Measurement makeProbe(const SensorInfo& sensor, Rng& rng) {
  Measurement probe = blankMeasurement(sensor);
  std::visit(
      [&](auto& kind) {
        forNumbers(kind, [&](const auto& field, auto& number, std::size_t) {
          const double max = sensor.range_max_m > 0 ? std::min(sensor.range_max_m, field.max) : 1;
          number = static_cast<std::remove_reference_t<decltype(number)>>(max * rng.uniform());
        });
      },
      probe);
  return probe;
}

}  // namespace

mrpt::Clock::time_point toTimestamp(const SimTime& time) {
  const auto ticks = static_cast<mrpt::Clock::rep>(std::llround(time.seconds() * mrpt::Clock::period::den));
  return mrpt::Clock::fromDouble(kEpochUnixSeconds) + mrpt::Clock::duration(ticks);
}

double secondsSinceStart(mrpt::Clock::time_point timestamp) {
  return secondsBetween(mrpt::Clock::fromDouble(kEpochUnixSeconds), timestamp);
}

RobotObservations::RobotObservations(const RobotInfo& robot, PictureFolder* pictures)
    : sensors_(robot.sensors), pictures_(pictures), readings_before_(robot.sensors) {
  for (std::size_t i = 0; i < sensors_->size(); ++i) slots_.push_back(i);
  std::stable_partition(slots_.begin(), slots_.end(),
                        [&](std::size_t i) { return (*sensors_)[i].kind == SensorKind::odometry; });

  observations_.push_back(CObservationRobotPose::Create());
  observations_.back()->sensorLabel = Label{robot.name, kGroundTruth, ""}.text();
  stems_.emplace_back();
  for (const std::size_t slot : slots_) {
    codecs_.push_back(&findCodec((*sensors_)[slot]));
    observations_.push_back(codecs_.back()->make((*sensors_)[slot]));
    const std::string label = Label{robot.name, (*sensors_)[slot].label, ""}.text();
    observations_.back()->sensorLabel = label;
    const bool has_files = (*sensors_)[slot].kind == SensorKind::camera && !(*sensors_)[slot].camera.isRaycast();
    stems_.push_back(has_files && pictures_ ? pictures_->stemFor(label) : "");
  }
  forget();
  makeTemplates();
  forget();
}

void RobotObservations::forget() {
  kept_.assign(sensors_->size(), 0);
  readings_before_.forget();
}

std::span<const CObservation::Ptr> RobotObservations::of(const Readings& readings,
                                                         const std::optional<TPose2D>& world_from_robot) {
  assert(readings.measurements.size() == sensors_->size());
  const auto timestamp = toTimestamp(readings.time);
  present_.clear();
  if (world_from_robot) {
    fillGroundTruth(*world_from_robot, timestamp);
    present_.push_back(0);
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    CObservation& observation = *observations_[1 + i];
    const Measurement& measurement = readings.measurements[slots_[i]];
    if (!std::visit([](const auto& kind) { return isPresent(kind); }, measurement)) continue;
    kept_[slots_[i]] = readings_before_.isKept(slots_[i], readings) ? 1 : 0;
    if (kept_[slots_[i]]) continue;
    observation.timestamp = timestamp;
    codecs_[i]->fill(observation, (*sensors_)[slots_[i]], measurement, readings.laser_pan_rad);
    if (const auto aim = aimOf((*sensors_)[slots_[i]], *sensors_, readings.measurements);
        aim && (*sensors_)[slots_[i]].kind == SensorKind::camera) {
      setCamera(observation, aimed((*sensors_)[slots_[i]], *aim));
    }
    if (!stems_[1 + i].empty())
      saveExternally(static_cast<JpegObservation&>(observation), stems_[1 + i], readings.time);
    present_.push_back(1 + i);
  }
  result_.clear();
  for (const std::size_t i : present_) result_.push_back(observations_[i]);
  return result_;
}

/// Saves an image to an external file.
void RobotObservations::saveExternally(JpegObservation& picture, const std::string& stem, const SimTime& time) {
  const std::string step = std::to_string(time.step);
  const std::string name = stem + "_" + std::string(step.size() < 8 ? 8 - step.size() : 0, '0') + step + ".jpg";
  pictures_->write(name, picture.jpeg);
  picture.image.setExternalStorage(name);
}

void RobotObservations::fillGroundTruth(const TPose2D& world_from_robot, mrpt::Clock::time_point timestamp) {
  auto& truth = static_cast<CObservationRobotPose&>(*observations_[0]);
  truth.timestamp = timestamp;
  truth.pose.mean = CPose3D(TPose3D(world_from_robot));
  const CPose3D& pose = truth.pose.mean;
  const auto& turned = pose.getRotationMatrix();
  ground_truth_ = {pose.x(), pose.y(), pose.z()};
  std::copy(turned.begin(), turned.end(), ground_truth_.begin() + 3);
}

void RobotObservations::write(const Readings& readings, const std::optional<TPose2D>& world_from_robot,
                              ByteArchive& archive) {
  of(readings, world_from_robot);
  for (const std::size_t i : present_) {
    const bool turned = i > 0 && (*sensors_)[slots_[i - 1]].pans && readings.laser_pan_rad != 0;
    if (templates_[i] && !turned) {
      templates_[i]->append(archive);
    } else {
      archive << *observations_[i];
    }
  }
}

void RobotObservations::makeTemplates() {
  const auto probe = [this](int which) {
    Rng rng(static_cast<std::uint64_t>(which));
    Readings readings;
    readings.time.step = 1 + rng.below(1'000'000);
    for (const auto& sensor : *sensors_) readings.measurements.push_back(makeProbe(sensor, rng));
    of(readings, TPose2D(rng.uniform(), rng.uniform(), rng.uniform()));
  };
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    auto numbers = changingNumbers(i);
    templates_.push_back(numbers.empty() ? std::nullopt
                                         : SerializedTemplate::of(*observations_[i], std::move(numbers), probe));
  }
}

/// The numbers that change from step to step; none for observations without a template.
std::vector<SerializedTemplate::Number> RobotObservations::changingNumbers(std::size_t i) {
  std::vector<SerializedTemplate::Number> numbers;
  if (i == 0) {
    numbers = {bytesOf(ground_truth_)};  // as MRPT writes a CPose3D
  } else {
    numbers = codecs_[i - 1]->changingNumbers(*observations_[i]);
  }
  if (!numbers.empty()) numbers.push_back(bytesOf(observations_[i]->timestamp));
  return numbers;
}

}  // namespace robosim
