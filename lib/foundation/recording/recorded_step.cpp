#include "recording/recorded_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "hardware/measurement_fields.h"
#include "recording/measurements.h"
#include "recording/observations.h"
#include "recording/recording_error.h"
#include "recording/robot_status_record.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

CObservation::Ptr find(const std::vector<std::pair<std::string, CObservation::Ptr>>& observations,
                       const std::string& label) {
  const auto at =
      std::find_if(observations.begin(), observations.end(), [&](const auto& o) { return o.first == label; });
  return at == observations.end() ? nullptr : at->second;
}

RecordedRobot blank(const RobotInfo& robot, SimTime time) {
  RecordedRobot recorded;
  recorded.readings.time = time;
  for (const auto& sensor : *robot.sensors) recorded.readings.measurements.push_back(blankMeasurement(sensor));
  return recorded;
}

}  // namespace

RecordedSteps::RecordedSteps(RawlogReader& reader, std::vector<RobotInfo> robots, double period_s, Pictures pictures,
                             RobotOfComment robot_of)
    : reader_(reader), robot_of_(std::move(robot_of)), period_s_(period_s), pictures_(pictures) {
  for (RobotInfo& robot : robots) addRobot(std::move(robot), 0);
  lookahead_ = nextRobotObservation();
}

void RecordedSteps::addRobot(RobotInfo robot, std::uint64_t position) {
  const std::size_t index = robots_.size();
  robots_.push_back(std::move(robot));
  since_.push_back(position);
  kept_.emplace_back();
  forget(index);
  const auto& sensors = *robots_[index].sensors;
  for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
    if (sensors[slot].times.rate_hz > 0) with_rates_.emplace_back(index, slot);
  }
  if (!is_missing_.empty()) is_missing_.push_back(0);
}

void RecordedSteps::forget(std::size_t robot) {
  kept_[robot].clear();
  for (const auto& sensor : *robots_[robot].sensors) kept_[robot].push_back({blankMeasurement(sensor)});
}

/// Notes where the readings are that the sensors keep in a step.
void RecordedSteps::addPlace(std::uint64_t position) {
  if (with_rates_.empty() || (!places_.empty() && places_.back().position >= position)) return;
  Place place{position, position};
  for (const auto& [robot, slot] : with_rates_) place.first = std::min(place.first, kept_[robot][slot].position);
  places_.push_back(place);
}

CObservation::Ptr RecordedSteps::nextRobotObservation() {
  while (auto observation = reader_.next()) {
    if (const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation)) {
      note_ = comment->text;
      comments_of_next_.push_back(comment->text);
      if (auto robot = robot_of_ ? robot_of_(comment->text) : std::nullopt) added_.push_back(std::move(*robot));
    } else if (!Label::parse(observation->sensorLabel).robot.empty()) {
      lookahead_position_ = reader_.position();
      return observation;
    }
  }
  lookahead_position_ = kEnd;
  return {};
}

void RecordedSteps::seek(std::uint64_t position) {
  const auto place = std::lower_bound(places_.begin(), places_.end(), position,
                                      [](const Place& a, std::uint64_t b) { return a.position < b; });
  const bool is_known = place != places_.end() && place->position == position;
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) forget(robot);
  added_.clear();
  reader_.seek(is_known ? place->first : position);
  comments_of_next_.clear();
  lookahead_ = nextRobotObservation();
  while (lookahead_position_ < position && next()) {
  }
}

std::optional<std::vector<RecordedRobot>> RecordedSteps::next() { return next(true); }

std::optional<std::vector<RecordedRobot>> RecordedSteps::nextWithoutMeasurements() { return next(false); }

std::optional<std::vector<RecordedRobot>> RecordedSteps::next(bool has_measurements) {
  comments_ = std::exchange(comments_of_next_, {});
  if (!lookahead_) return std::nullopt;
  const auto time = lookahead_->timestamp;
  const double steps = secondsSinceStart(time) / period_s_;
  if (!(steps > -0.5 && steps < 1e18))
    throw RecordingError(lookahead_->sensorLabel + ": has a timestamp that is not of a run of RoboSim");
  const auto step = static_cast<std::uint64_t>(std::llround(steps));
  const std::uint64_t position = lookahead_position_;
  for (RobotInfo& added : std::exchange(added_, {})) {
    const bool is_known =
        std::any_of(robots_.begin(), robots_.end(), [&](const RobotInfo& robot) { return robot.name == added.name; });
    if (!is_known) addRobot(std::move(added), position);
  }

  std::vector<Observations> by_robot(robots_.size());
  std::size_t robot = 0;
  for (; lookahead_ && lookahead_->timestamp == time; lookahead_ = nextRobotObservation()) {
    // Observations are ordered by robot, so it is the previous observation's robot or the next one.
    const Label label = Label::parse(lookahead_->sensorLabel);
    std::size_t tries = 0;
    while (tries < robots_.size() && label.robot != robots_[robot].name) {
      robot = (robot + 1) % robots_.size();
      ++tries;
    }
    if (tries == robots_.size()) continue;
    by_robot[robot].emplace_back(label.withinRobot(), lookahead_);
  }
  // The last step of a truncated file may be incomplete.
  if (!lookahead_ && reader_.endsEarly()) return std::nullopt;
  if (is_missing_.empty()) {
    for (const auto& observations : by_robot) is_missing_.push_back(observations.empty() ? 1 : 0);
    if (std::find(is_missing_.begin(), is_missing_.end(), 0) == is_missing_.end()) {
      throw RecordingError("none of these robots is in the recording; give the world that it was made with");
    }
  }
  std::vector<RecordedRobot> robots;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (is_missing_[i]) {
      robots.push_back(blank(robots_[i], {step, period_s_}));
      robots.back().is_missing = true;
      continue;
    }
    if (position < since_[i]) {
      robots.push_back(blank(robots_[i], {step, period_s_}));
      robots.back().command = Command{.activity = Activity::absent};
      continue;
    }
    auto complete = assemble(i, by_robot[i], step, position, has_measurements);
    if (!complete) {
      throw RecordingError("robot \"" + robots_[i].name + "\" is incomplete in step " + std::to_string(step) +
                           " of the recording; give the world that it was made with");
    }
    robots.push_back(std::move(*complete));
  }
  // All robots receive the winner.
  const auto winner =
      std::find_if(robots.begin(), robots.end(), [](const auto& r) { return !r.readings.winner.empty(); });
  if (winner != robots.end()) {
    for (auto& one : robots) one.readings.winner = winner->readings.winner;
  }
  addPlace(position);
  return robots;
}

std::optional<RecordedRobot> RecordedSteps::assemble(std::size_t index, const Observations& observations,
                                                     std::uint64_t step, std::uint64_t position,
                                                     bool has_measurements) {
  const RobotInfo& robot = robots_[index];
  RecordedRobot recorded;
  Readings& readings = recorded.readings;
  readings.time = {step, period_s_};
  if (const auto status = find(observations, kStatus)) {
    const RobotStatus recorded_status = statusFrom(*status);
    recorded.command = recorded_status.command;
    readings.laser_pan_rad = recorded_status.laser_pan_rad;
    readings.stalled = recorded_status.stalled;
    readings.is_too_far = recorded_status.is_too_far;
    if (recorded_status.has_won) readings.winner = robot.name;
    if (recorded_status.command.activity == Activity::absent) {
      forget(index);
      RecordedRobot absent = blank(robot, readings.time);
      absent.command = recorded_status.command;
      return absent;
    }
  }
  for (std::size_t slot = 0; slot < robot.sensors->size(); ++slot) {
    const SensorInfo& sensor = (*robot.sensors)[slot];
    Kept& kept = kept_[index][slot];
    const auto observation = find(observations, sensor.label);
    if (!observation) {
      if (!isIntermittent(sensor) && sensor.times.isDue(readings.time)) return std::nullopt;
      readings.measurements.push_back(kept.measurement);
      continue;
    }
    if (!has_measurements) {
      readings.measurements.push_back(kept.measurement);
      if (sensor.times.rate_hz > 0) kept.position = position;
      continue;
    }
    // Exact pictures are compared with those of the same run; others are not.
    if (sensor.kind == SensorKind::camera && !sensor.camera.isRaycast() && pictures_ == Pictures::leave_out) {
      readings.measurements.emplace_back(Image{});
      continue;
    }
    readings.measurements.push_back(
        measurementFrom(*observation, sensor, readings.laser_pan_rad, reader_.pictureFolder()));
    auto* const echoes = std::get_if<Echoes>(&readings.measurements.back());
    const auto points = find(observations, Label{"", sensor.label, kPoints}.withinRobot());
    if (echoes && points) restorePoints(*points, *echoes);
    if (sensor.times.rate_hz > 0) kept = {readings.measurements.back(), position};
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
