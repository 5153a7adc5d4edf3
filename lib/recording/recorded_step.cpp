#include "recording/recorded_step.h"

#include <algorithm>
#include <cmath>

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "hardware/blank_measurement.h"
#include "recording/measurements.h"
#include "recording/observations.h"
#include "recording/recording_error.h"
#include "recording/unsensed.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

CObservation::Ptr find(const std::vector<std::pair<std::string, CObservation::Ptr>>& observations,
                       const std::string& label) {
  const auto at =
      std::find_if(observations.begin(), observations.end(), [&](const auto& o) { return o.first == label; });
  return at == observations.end() ? nullptr : at->second;
}

RecordedRobot absent(const RobotInfo& robot, SimTime time) {
  RecordedRobot recorded;
  recorded.is_absent = true;
  recorded.readings.time = time;
  for (const auto& sensor : *robot.sensors) recorded.readings.measurements.push_back(blankMeasurement(sensor));
  return recorded;
}

/// Whether a recording has nothing of a sensor in steps in which it told nothing.
bool tellsNowAndThen(SensorKind kind) { return kind == SensorKind::camera || kind == SensorKind::blob_finder; }

}  // namespace

RecordedSteps::RecordedSteps(RawlogReader& reader, std::vector<RobotInfo> robots, double period_s, Pictures pictures)
    : reader_(reader), robots_(std::move(robots)), period_s_(period_s), pictures_(pictures) {
  ahead_ = nextOfRobots();
}

CObservation::Ptr RecordedSteps::nextOfRobots() {
  while (auto observation = reader_.next()) {
    if (const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation)) {
      note_ = comment->text;
    } else if (!partsOf(observation->sensorLabel).robot.empty()) {
      ahead_position_ = reader_.position();
      return observation;
    }
  }
  ahead_position_ = kNowhere;
  return {};
}

void RecordedSteps::seek(std::uint64_t position) {
  reader_.seek(position);
  ahead_ = nextOfRobots();
}

std::optional<std::vector<RecordedRobot>> RecordedSteps::next() {
  if (!ahead_) return std::nullopt;
  const auto time = ahead_->timestamp;
  const double steps = secondsSinceStart(time) / period_s_;
  if (!(steps > -0.5 && steps < 1e18))
    throw RecordingError(ahead_->sensorLabel + ": is of no time of a run of RoboSim's");
  const auto step = static_cast<std::uint64_t>(std::llround(steps));

  std::vector<Observations> by_robot(robots_.size());
  std::size_t robot = 0;
  for (; ahead_ && ahead_->timestamp == time; ahead_ = nextOfRobots()) {
    // They come robot by robot, so it is the one of the observation before, or the next.
    const std::string& label = ahead_->sensorLabel;
    std::size_t tries = 0;
    while (tries < robots_.size() && label.rfind(robots_[robot].name + "/", 0) != 0) {
      robot = (robot + 1) % robots_.size();
      ++tries;
    }
    if (tries == robots_.size()) continue;
    by_robot[robot].emplace_back(label.substr(robots_[robot].name.size() + 1), ahead_);
  }
  // Of a file that was cut off nobody knows what the last step would have had.
  if (!ahead_ && reader_.trouble()) return std::nullopt;
  if (is_absent_.empty()) {
    for (const auto& observations : by_robot) is_absent_.push_back(observations.empty() ? 1 : 0);
    if (std::find(is_absent_.begin(), is_absent_.end(), 0) == is_absent_.end()) {
      throw RecordingError("none of these robots is in the recording; give the world that it was made with");
    }
  }
  std::vector<RecordedRobot> robots;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (is_absent_[i]) {
      robots.push_back(absent(robots_[i], {step, period_s_}));
      continue;
    }
    auto whole = put(robots_[i], by_robot[i], step);
    if (!whole) {
      throw RecordingError("robot \"" + robots_[i].name + "\" is not whole in step " + std::to_string(step) +
                           " of the recording; give the world that it was made with");
    }
    robots.push_back(std::move(*whole));
  }
  // Everyone is told who has won.
  const auto winner =
      std::find_if(robots.begin(), robots.end(), [](const auto& r) { return !r.readings.winner.empty(); });
  if (winner != robots.end()) {
    for (auto& one : robots) one.readings.winner = winner->readings.winner;
  }
  return robots;
}

std::optional<RecordedRobot> RecordedSteps::put(const RobotInfo& robot, const Observations& observations,
                                                std::uint64_t step) const {
  RecordedRobot recorded;
  Readings& readings = recorded.readings;
  readings.time = {step, period_s_};
  if (const auto status = find(observations, kStatus)) {
    const RobotStatus told = statusFrom(*status);
    recorded.command = told.command;
    readings.laser_pan_rad = told.laser_pan_rad;
    readings.stalled = told.stalled;
    readings.is_too_far = told.is_too_far;
    if (told.has_won) readings.winner = robot.name;
  }
  for (const auto& sensor : *robot.sensors) {
    const auto observation = find(observations, sensor.label);
    if (!observation) {
      if (!tellsNowAndThen(sensor.kind)) return std::nullopt;
      readings.measurements.push_back(blankMeasurement(sensor));
      continue;
    }
    if (sensor.kind == SensorKind::camera && pictures_ == Pictures::leave_out) {
      readings.measurements.emplace_back(Image{});
      continue;
    }
    readings.measurements.push_back(measurementFrom(*observation, sensor, readings.laser_pan_rad));
    auto* const echoes = std::get_if<Echoes>(&readings.measurements.back());
    const auto points = find(observations, sensor.label + "/" + kPoints);
    if (echoes && points) takePoints(*points, *echoes);
  }
  if (const auto inbox = find(observations, kInbox)) readings.inbox = inboxFrom(*inbox, robot.name);
  if (const auto truth =
          std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(find(observations, kGroundTruth))) {
    const auto& pose = truth->pose.mean;
    recorded.world_from_robot = mrpt::math::TPose2D(pose.x(), pose.y(), pose.yaw());
  }
  return recorded;
}

}  // namespace robosim
