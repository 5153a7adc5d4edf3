#include "viewing/recorded_moments.h"

#include <algorithm>
#include <utility>

#include "base/progress.h"
#include "base/text_table.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "rendering/snapshot_run.h"
#include "run/outputs/intervention_note.h"
#include "run/outputs/recorded_fleet.h"
#include "run/outputs/run_note.h"
#include "viewing/foreign_recording.h"
#include "viewing/recorded_objects.h"

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
                               std::move(robot.readings)});
  }
  return snapshot;
}

/// A recording made by RoboSim.
class RobosimRecording final : public RecordedMoments {
 public:
  RobosimRecording(const std::string& file, const RunNote& note)
      : file_(file),
        world_(loadWorld(note.world, {})),
        reader_(file, RawlogReader::Access::random),
        steps_(reader_, robotsOf(world_), note.period_s, Pictures::leave_out,
               [this](const std::string& comment) { return addRecordedRobot(comment, world_.fleet); }) {
    Progress progress;
    for (;;) {
      const std::uint64_t place = steps_.position();
      auto step = steps_.nextWithoutMeasurements();
      if (!step) break;
      if (moments_.empty()) leaveOutMissing(*step);
      noteObjects();
      const RunSnapshot snapshot = toSnapshot(std::move(*step));
      paths_.add(snapshot);
      addEvents(events_, world_.fleet, snapshot);
      recorded_objects_.add(objects_);
      moments_.push_back({snapshot.time_s, place, moments_.size()});
      if (progress.due()) progress.show("reading, " + fixed(moments_.back().time_s, 0) + " s …");
    }
    read_error_ = reader_.readError().value_or("");
    is_damaged_ = reader_.isDamaged();
    if (moments_.empty())
      throw ConfigError(file + ": contains no complete step" + (read_error_.empty() ? "" : "; " + read_error_));
    // A damaged recording may go back in time.
    std::stable_sort(moments_.begin(), moments_.end(),
                     [](const Moment& a, const Moment& b) { return a.time_s < b.time_s; });
    for (const auto& moment : moments_) times_.push_back(moment.time_s);
  }

  const LoadedWorld& world() const override { return world_; }
  const std::vector<double>& times() const override { return times_; }
  const RunPaths& paths() const override { return paths_; }
  const RunEvents& events() const override { return events_; }
  const std::string& readError() const override { return read_error_; }
  bool isDamaged() const override { return is_damaged_; }

  RunSnapshot at(std::size_t moment) override {
    const Moment& requested = moments_[moment];
    if (steps_.position() != requested.place) steps_.seek(requested.place);
    auto step = steps_.next();
    if (step) {
      RunSnapshot snapshot = toSnapshot(std::move(*step));
      snapshot.objects = recorded_objects_.at(requested.number);
      if (snapshot.time_s == requested.time_s) return snapshot;
    }
    throw RecordingError(file_ + ": has changed since it was opened; open it again");
  }

 private:
  struct Moment {
    double time_s;
    std::uint64_t place;  ///< in the file
    std::size_t number;   ///< in RecordedObjects
  };

  /// Notes what robots and the interventions before the last step that was read have made of the objects.
  void noteObjects() {
    for (const auto& comment : steps_.comments()) {
      if (auto after = objectsAfter(comment, objects_.orThose(world_.world.objects))) objects_ = std::move(*after);
    }
  }

  static std::vector<RobotInfo> robotsOf(const LoadedWorld& world) {
    std::vector<RobotInfo> robots;
    for (const auto& robot : world.fleet.robots) robots.push_back(robot.info);
    return robots;
  }

  /// Robots without entries in the recording are not shown.
  void leaveOutMissing(const std::vector<RecordedRobot>& robots) {
    std::size_t i = 0;
    std::erase_if(world_.fleet.robots, [&](const auto&) {
      const bool is_missing = i < robots.size() && robots[i].is_missing;  // the others are added later
      ++i;
      return is_missing;
    });
  }

  std::string file_;
  LoadedWorld world_;
  RawlogReader reader_;
  RecordedSteps steps_;
  std::vector<Moment> moments_;
  std::vector<double> times_;
  ChangedObjects objects_;  ///< after the last moment
  RecordedObjects recorded_objects_{world_.world.objects};
  RunPaths paths_;
  RunEvents events_;
  std::string read_error_;
  bool is_damaged_ = false;
};

/// nullopt for a recording made by another program, or of a world too large to be stored in it.
std::optional<RunNote> noteIn(const std::string& file) {
  try {
    auto note = RunNote::of(file);
    return note.world.text.empty() ? std::nullopt : std::make_optional(std::move(note));
  } catch (const NotOfRoboSim&) {
    return std::nullopt;
  }
}

}  // namespace

std::unique_ptr<RecordedMoments> readMoments(const std::string& file) {
  if (const auto note = noteIn(file)) return std::make_unique<RobosimRecording>(file, *note);
  return readForeignRecording(file);
}

}  // namespace robosim
