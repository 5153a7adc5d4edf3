#include "viewing/recorded_run.h"

#include <utility>
#include <vector>

#include "run/outputs/intervention_note.h"
#include "run/outputs/recorded_fleet.h"

namespace robosim {
namespace {

RunSnapshot toSnapshot(std::vector<RecordedRobot> robots) {
  RunSnapshot snapshot;
  for (auto& robot : robots) {
    if (robot.is_missing) continue;
    snapshot.step = robot.readings.time.step;
    snapshot.time_s = robot.readings.time.seconds();
    snapshot.robots.push_back({robot.world_from_robot.value_or(mrpt::math::TPose2D()), robot.readings.laser_pan_rad,
                               robot.readings.stalled, robot.command ? robot.command->activity : Activity::active,
                               std::move(robot.readings), robot.command ? robot.command->led_color : 0});
  }
  return snapshot;
}

std::vector<RobotInfo> robotsOf(const LoadedWorld& world) {
  std::vector<RobotInfo> robots;
  for (const auto& robot : world.fleet.robots) robots.push_back(robot.info);
  return robots;
}

}  // namespace

RecordedRun::RecordedRun(const std::string& file, const RunNote& note, Pictures pictures)
    : file_(file),
      period_s_(note.period_s),
      world_(loadWorld(note.world, {})),
      reader_(file, RawlogReader::Access::random),
      steps_(reader_, robotsOf(world_), note.period_s, pictures,
             [this](const std::string& comment) { return robotOf(comment); }) {}

std::optional<RunSnapshot> RecordedRun::next(Measurements measurements) {
  auto step = measurements == Measurements::read ? steps_.next() : steps_.nextWithoutMeasurements();
  if (!step) return std::nullopt;
  if (std::exchange(is_first_, false)) leaveOutMissing(*step);
  return toSnapshot(std::move(*step));
}

void RecordedRun::noteObjects() {
  for (const auto& comment : steps_.comments()) change(comment);
}

void RecordedRun::change(const std::string& comment) {
  if (auto after = objectsAfter(comment, objects_.orThose(world_.world.objects))) objects_ = std::move(*after);
}

/// The robot that a comment adds, also when it is read again.
std::optional<RobotInfo> RecordedRun::robotOf(const std::string& comment) {
  if (auto added = addRecordedRobot(comment, world_.fleet)) return added;
  const auto again = robotAddedBy(comment);
  if (!again) return std::nullopt;
  for (const auto& robot : world_.fleet.robots) {
    if (robot.info.name == again->name) return robot.info;
  }
  return std::nullopt;
}

/// Robots without entries in the recording are not shown.
void RecordedRun::leaveOutMissing(const std::vector<RecordedRobot>& robots) {
  std::size_t i = 0;
  has_missing_ = std::erase_if(world_.fleet.robots, [&](const auto&) {
                   const bool is_missing = i < robots.size() && robots[i].is_missing;  // the others are added later
                   ++i;
                   return is_missing;
                 }) > 0;
}

}  // namespace robosim
