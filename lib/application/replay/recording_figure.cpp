#include "replay/recording_figure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <mrpt/obs/CObservationRobotPose.h>

#include "base/error_list.h"
#include "base/log.h"
#include "base/text_table.h"
#include "recording/robot_status_record.h"
#include "rendering/run_figure.h"
#include "rendering/run_paths.h"
#include "replay/value_text.h"
#include "robots/world_source.h"
#include "run/outputs/intervention_note.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation;

constexpr double kPathSpacing_m = 0.05;

}  // namespace

void RecordingFigure::setRun(const RunNote& note) {
  is_of_robosim_ = true;
  if (note.world.text.empty()) {
    logWarning("export", rawlog_ +
                             ": does not contain its world, which is larger than 1 MiB; the figure shows "
                             "trajectories and events only");
    return;
  }
  world_ = loadWorld(note.world, {});
}

std::size_t RecordingFigure::robotNamed(const std::string& name) {
  const auto [known, is_new] = index_of_.try_emplace(name, robots_.size());
  if (is_new) {
    robots_.emplace_back();
    robots_.back().name = name;
  }
  return known->second;
}

void RecordingFigure::add(const CObservation& observation, double time_s) {
  duration_s_ = std::max(duration_s_, time_s);
  const Label label = Label::parse(observation.sensorLabel);
  if (const auto pose = poseIn(observation)) {
    const bool is_truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) != nullptr;
    addPose(robotNamed(label.robot), *pose, is_truth, time_s);
  } else if (is_of_robosim_ && label.sensor == kStatus) {
    addStatus(robotNamed(label.robot), observation, time_s);
  } else if (is_of_robosim_ && label.sensor == kInbox) {
    addMessages(label.robot, observation, time_s);
  }
}

void RecordingFigure::addComment(const std::string& text) {
  if (!world_) return;
  if (auto after = objectsAfter(text, objects_.orThose(world_->world.objects))) objects_ = std::move(*after);
}

void RecordingFigure::addPose(std::size_t index, const TPose2D& pose, bool is_truth, double time_s) {
  Robot& robot = robots_[index];
  if (!(std::abs(pose.x) < kFarthest_m && std::abs(pose.y) < kFarthest_m && std::isfinite(pose.phi))) return;
  if (robot.has_truth && !is_truth) return;
  if (is_truth && !robot.has_truth) {
    robot.path.clear();
    robot.path_times_s.clear();
  }
  robot.has_truth = is_truth;
  const std::optional<TPose2D> before = robot.pose;
  robot.pose = is_truth ? pose : startOfOdometry(robot.name) + pose;
  const double duration_s = time_s - std::exchange(robot.time_s, time_s);
  const TPoint2D at(robot.pose->x, robot.pose->y);
  if (!robot.path.empty() && before && isJump({before->x, before->y}, at, duration_s)) {
    addPoint(robot, {before->x, before->y});
    addPoint(robot, kPathGap);
  }
  const bool begins = robot.path.empty() || isGap(robot.path.back());
  if (begins || (at - robot.path.back()).norm() >= kPathSpacing_m) addPoint(robot, at);
}

/// At the time of the robot's pose.
void RecordingFigure::addPoint(Robot& robot, const TPoint2D& at) {
  robot.path.push_back(at);
  robot.path_times_s.push_back(robot.time_s);
}

void RecordingFigure::addStatus(std::size_t index, const CObservation& observation, double time_s) {
  const RobotStatus status = statusFrom(observation);
  if (status.command.activity == Activity::absent) leave(robots_[index]);
  const bool has_found = status.has_won || status.command.activity == Activity::found;
  events_.addState(index, status.stalled, has_found, placeOf(index), time_s);
}

/// The path of a robot that leaves the world continues where it comes back.
void RecordingFigure::leave(Robot& robot) {
  if (!robot.pose) return;
  addPoint(robot, {robot.pose->x, robot.pose->y});
  addPoint(robot, kPathGap);
  robot.pose.reset();
}

void RecordingFigure::addMessages(const std::string& receiver, const CObservation& observation, double time_s) {
  for (const auto& message : inboxFrom(observation, receiver)) {
    const auto sender = index_of_.find(message.from);
    if (sender != index_of_.end()) events_.addMessage(sender->second, placeOf(sender->second), time_s);
  }
}

std::optional<TPoint2D> RecordingFigure::placeOf(std::size_t robot) const {
  const auto& pose = robots_[robot].pose;
  return pose ? std::make_optional<TPoint2D>(pose->x, pose->y) : std::nullopt;
}

/// In a run of RoboSim, odometry counts from the start.
TPose2D RecordingFigure::startOfOdometry(const std::string& robot) const {
  if (!world_) return {};
  for (const auto& of_world : world_->fleet.robots) {
    if (of_world.info.name == robot) return of_world.world_from_start;
  }
  return {};
}

/// An empty floor under the trajectories.
LoadedWorld RecordingFigure::withoutWorld() const {
  LoadedWorld loaded;
  loaded.world.name = std::filesystem::path(rawlog_).stem().string();
  std::optional<Bounds2D> area;
  for (const auto& robot : robots_) {
    if (robot.path.empty()) continue;
    FleetRobot drawn;
    drawn.info.name = robot.name;
    drawn.info.radius_m = kUnknownRadius_m;
    loaded.fleet.robots.push_back(std::move(drawn));
    for (const auto& p : robot.path) {
      if (isGap(p)) continue;
      if (!area) area = Bounds2D{p.x, p.x, p.y, p.y};
      *area = {std::min(area->x_min, p.x), std::max(area->x_max, p.x), std::min(area->y_min, p.y),
               std::max(area->y_max, p.y)};
    }
  }
  constexpr double kMargin_m = 0.5;
  const Bounds2D paths = area.value_or(Bounds2D());
  loaded.world.bounds = {paths.x_min - kMargin_m, paths.x_max + kMargin_m, paths.y_min - kMargin_m,
                         paths.y_max + kMargin_m};
  return loaded;
}

std::string RecordingFigure::draw(PictureFormat format, const FigurePage& page, ViewLayers layers,
                                  const RobotSelection& only) const {
  const LoadedWorld loaded = world_ ? *world_ : withoutWorld();
  layers.only = only.flagsIn(loaded.fleet, RobotSelection::Unmatched::refused);
  DrawnRun run;
  run.title = loaded.world.name + ", " + fixed(duration_s_, 1) + " s";
  run.objects = objects_;
  bool has_poses = false;
  std::map<std::size_t, std::size_t> drawn_index;  // by index in robots_
  for (const auto& of_world : loaded.fleet.robots) {
    const auto found = index_of_.find(of_world.info.name);
    Robot robot = found == index_of_.end() ? Robot() : robots_[found->second];
    has_poses |= !robot.path.empty();
    if (found != index_of_.end()) drawn_index.emplace(found->second, run.world_from_robot.size());
    run.paths.push_back(std::move(robot.path));
    run.path_times_s.push_back(std::move(robot.path_times_s));
    run.world_from_robot.push_back(robot.pose);
  }
  for (auto [time_s, event] : events_.all()) {
    const auto drawn = drawn_index.find(event.robot);
    if (drawn == drawn_index.end()) continue;
    event.robot = drawn->second;
    run.events.push_back(event);
  }
  if (!has_poses) {
    throw ConfigError(rawlog_ +
                      ": contains neither ground truth nor odometry; a figure requires a recording with poses");
  }
  applyLayers(run, layers, loaded.world, loaded.fleet);
  return runFigure(format, loaded.world, loaded.fleet, run, page);
}

}  // namespace robosim
