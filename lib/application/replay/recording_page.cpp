#include "replay/recording_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <mrpt/obs/CObservationRobotPose.h>

#include "base/error_list.h"
#include "base/label.h"
#include "base/log.h"
#include "rendering/run_paths.h"
#include "replay/observation_row.h"
#include "replay/recording_figure.h"
#include "replay/value_text.h"
#include "robots/robot_colors.h"
#include "run/outputs/intervention_note.h"
#include "run/outputs/recorded_fleet.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation;

constexpr double kUnknownHeight_m = 0.3;  ///< of robots of other programs
constexpr std::size_t kNamedReceivers = 3;

FleetRobot unknownRobot(const std::string& name, std::size_t index) {
  FleetRobot robot;
  robot.info.name = name;
  robot.info.radius_m = RecordingFigure::kUnknownRadius_m;
  robot.own_body = Body{.shape = Cylinder{RecordingFigure::kUnknownRadius_m},
                        .world_from_body = {},
                        .center_z_m = kUnknownHeight_m / 2,
                        .height_m = kUnknownHeight_m};
  robot.color = paletteColor(index);
  return robot;
}

std::string listOf(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamedReceivers); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamedReceivers) text += " and " + std::to_string(names.size() - kNamedReceivers) + " others";
  return text;
}

/// "bag" of "runs/bag/" and of "runs/bag.rawlog".
std::string titleOf(const std::string& recording) {
  const std::filesystem::path path(recording);
  return (path.has_filename() ? path : path.parent_path()).stem().string();
}

}  // namespace

RecordingPage::RecordingPage(std::string recording, const ViewLayers& layers, RobotSelection only)
    : recording_(std::move(recording)), page_(titleOf(recording_)), only_(std::move(only)) {
  std::vector<std::string> hidden;
  for (const ViewLayer& layer : viewLayers()) {
    if (layer.is_shown_first && !(layers.*layer.is_shown)) hidden.emplace_back(layer.name);
  }
  page_.setHidden(std::move(hidden));
}

void RecordingPage::setRun(const RunNote& note) {
  is_of_robosim_ = true;
  page_.addFact("Seed", std::to_string(note.seed));
  page_.addFact("Time step", mrpt::format("%g s", note.period_s));
  if (note.first_step > 0) page_.addFact("First recorded step", std::to_string(note.first_step));
  if (note.world.text.empty()) {
    page_.addRemark("The recording does not contain its world, which is larger than 1 MiB.");
    return;
  }
  world_ = loadWorld(note.world, {});
  page_.setWorld(world_->world);
  for (std::size_t i = 0; i < world_->fleet.robots.size(); ++i) {
    FleetRobot robot = world_->fleet.robots[i];
    if (i < note.controllers.size()) robot.controller = note.controllers[i];
    addRobot(std::move(robot));
  }
}

std::optional<std::size_t> RecordingPage::addRobot(FleetRobot robot) {
  fleet_.robots.push_back(robot);
  const auto flags = only_.flagsIn({.robots = {robot}}, RobotSelection::Unmatched::ignored);
  if (!flags.empty() && flags[0] == 0) {
    index_of_.emplace(robot.info.name, std::nullopt);
    return std::nullopt;
  }
  Robot added;
  if (is_of_robosim_) added.start_of_odometry = robot.world_from_start;
  index_of_.emplace(robot.info.name, page_.robots());
  robots_.push_back(added);
  return page_.addRobot(std::move(robot));
}

std::optional<std::size_t> RecordingPage::robotNamed(const std::string& name) {
  const auto known = index_of_.find(name);
  return known != index_of_.end() ? known->second : addRobot(unknownRobot(name, fleet_.robots.size()));
}

void RecordingPage::add(const CObservation& observation, double time_s, const SensorInfo* sensor) {
  if (time_s_ != time_s) {
    writeMessages();
    goes_back_ |= time_s_ && time_s < *time_s_;
    time_s_ = time_s;
    page_.beginMoment(time_s);
  }
  const Label label = Label::parse(observation.sensorLabel);
  const auto shown = robotNamed(label.robot);
  if (!shown) return;
  const std::size_t robot = *shown;
  const auto pose = poseIn(observation);
  const bool is_truth = pose && dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) != nullptr;
  if (pose) addPose(robot, *pose, is_truth, time_s);
  if (is_truth || label.part == kPoints) return;
  if (is_of_robosim_ && label.sensor == kInbox) return addMessages(robot, observation);
  if (is_of_robosim_ && label.sensor == kStatus) addStatus(robot, observation);
  addReadings(robot, observation.sensorLabel.empty() ? classOf(observation) : label.withinRobot(), observation, sensor);
}

void RecordingPage::addPose(std::size_t index, const TPose2D& pose, bool is_truth, double time_s) {
  Robot& robot = robots_[index];
  if (!(std::abs(pose.x) < RecordingFigure::kFarthest_m && std::abs(pose.y) < RecordingFigure::kFarthest_m &&
        std::isfinite(pose.phi)))
    return;
  // The first ground truth of a robot that returns comes before its status.
  if (!is_truth && (robot.is_absent || robot.has_truth)) return;
  if (is_truth && !robot.has_truth) page_.clearPoses(index);
  robot.has_truth = is_truth;
  const TPose2D at = is_truth ? pose : robot.start_of_odometry + pose;
  const double duration_s = time_s - std::exchange(robot.time_s, time_s);
  if (robot.pose && isJump({robot.pose->x, robot.pose->y}, {at.x, at.y}, duration_s)) page_.interruptPath(index);
  robot.pose = at;
  page_.setPose(index, at);
}

void RecordingPage::addStatus(std::size_t index, const CObservation& observation) {
  const RobotStatus status = statusFrom(observation);
  const bool is_absent = status.command.activity == Activity::absent;
  if (is_absent) page_.interruptPath(index);
  robots_[index].is_absent = is_absent;
  page_.setState(index, {status.command.activity, status.stalled, status.has_won, status.command.by_driver,
                         status.command.led_color});
}

void RecordingPage::addMessages(std::size_t receiver, const CObservation& observation) {
  const std::string name = Label::parse(observation.sensorLabel).robot;
  for (const auto& message : inboxFrom(observation, name)) {
    const auto sender = index_of_.find(message.from);
    const auto from = sender == index_of_.end() ? receiver : sender->second;
    if (from) messages_[{*from, message.text}].push_back(name);
  }
}

void RecordingPage::writeMessages() {
  for (const auto& [message, receivers] : std::exchange(messages_, {})) {
    page_.addEvent("message", message.first, "to " + listOf(receivers) + ": " + message.second);
  }
}

void RecordingPage::addReadings(std::size_t robot, const std::string& sensor, const CObservation& observation,
                                const SensorInfo* info) {
  if (!page_.readings().keepsNext(robot, sensor)) return;
  const ObservationRow row = ObservationRow::of(observation, info);
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<std::uint8_t> is_whole;
  for (std::size_t i = 0; i < row.names.size(); ++i) {
    const ColumnValue& value = row.values[i];
    if (std::holds_alternative<std::string>(value)) continue;
    names.push_back(row.names[i]);
    is_whole.push_back(std::holds_alternative<std::int64_t>(value));
    values.push_back(std::visit(
        [](const auto& number) {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(number)>>) {
            return static_cast<double>(number);
          } else {
            return std::numeric_limits<double>::quiet_NaN();
          }
        },
        value));
  }
  if (!names.empty()) page_.readings().add(robot, sensor, page_.moment(), names, values, is_whole);
}

void RecordingPage::addComment(const std::string& text) {
  if (const auto note = RunNote::parse(text); note && note->outcome.is_object()) {
    for (const auto& [key, name] : {std::pair("ended_by", "Ended by"), std::pair("digest", "Digest")}) {
      const auto value = note->outcome.find(key);
      if (value != note->outcome.end() && value->is_string()) page_.addFact(name, value->get<std::string>());
    }
    return;
  }
  if (!world_) return;
  if (const auto note = InterventionNote::parse(text)) {
    page_.addEvent("intervention", std::nullopt,
                   note->intervention.author + ": " + changeText(note->intervention.change), true);
  }
  if (addRecordedRobot(text, world_->fleet)) {
    if (const auto added = addRobot(world_->fleet.robots.back())) page_.addEvent("added", *added, "", true);
  }
  if (auto after = objectsAfter(text, objects_.orThose(world_->world.objects))) {
    objects_ = std::move(*after);
    page_.setObjects(objects_);
  }
}

std::string RecordingPage::html(const std::function<void(const std::string&)>& progress) {
  finish();
  return page_.html(progress);
}

std::vector<PageBlock> RecordingPage::blocks(const std::function<void(const std::string&)>& progress) {
  finish();
  return page_.blocks(progress);
}

/// Adds what is known after the last observation.
void RecordingPage::finish() {
  writeMessages();
  if (page_.moments() == 0) throw ConfigError(recording_ + ": contains no observations, of which a page could be made");
  only_.flagsIn(fleet_, RobotSelection::Unmatched::refused);
  if (page_.robots() < fleet_.robots.size()) {
    page_.addRemark("The page contains " + std::to_string(page_.robots()) + " of the " +
                    std::to_string(fleet_.robots.size()) + " robots of the recording.");
  }
  if (goes_back_)
    page_.addRemark("Times of the recording go back; the page shows such observations at the nearest time in order.");
  if (!is_of_robosim_) {
    page_.addRemark("A recording of another program: there is no world, and the robots' sizes are unknown.");
  }
}

}  // namespace robosim
