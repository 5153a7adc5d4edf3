#include "robosim/recorded_moments.h"

#include <algorithm>

#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "robosim/foreign_recording.h"
#include "robosim/progress.h"
#include "robosim/run_note.h"
#include "robosim/text.h"

namespace robosim {
namespace {

Shown toShown(std::vector<RecordedRobot> robots) {
  Shown shown;
  for (auto& robot : robots) {
    if (robot.is_absent) continue;
    shown.step = robot.readings.time.step;
    shown.time_s = robot.readings.time.seconds();
    shown.robots.push_back({robot.world_from_robot.value_or(mrpt::math::TPose2D()), robot.readings.laser_pan_rad,
                            robot.readings.stalled, robot.command ? robot.command->activity : Activity::active,
                            std::move(robot.readings)});
  }
  return shown;
}

/// A recording of RoboSim's.
class OurRecording final : public RecordedMoments {
 public:
  OurRecording(const std::string& file, const RunNote& note)
      : file_(file),
        world_(loadWorld(note.world, {})),
        reader_(file, RawlogReader::Places::keep),
        steps_(reader_, robotsOf(world_), note.period_s, Pictures::leave_out) {
    Progress progress;
    for (;;) {
      const std::uint64_t place = steps_.position();
      auto step = steps_.next();
      if (!step) break;
      if (moments_.empty()) leaveOutAbsent(*step);
      moments_.push_back({toShown(std::move(*step)).time_s, place});
      if (progress.due()) progress.show("reading, " + fixed(moments_.back().time_s, 0) + " s …");
    }
    trouble_ = reader_.trouble().value_or("");
    if (moments_.empty()) throw ConfigError(file + ": holds no whole step" + (trouble_.empty() ? "" : "; " + trouble_));
    // A damaged recording may go back in time.
    std::stable_sort(moments_.begin(), moments_.end(),
                     [](const Moment& a, const Moment& b) { return a.time_s < b.time_s; });
    for (const auto& moment : moments_) times_.push_back(moment.time_s);
  }

  const LoadedWorld& world() const override { return world_; }
  const std::vector<double>& times() const override { return times_; }
  const std::string& trouble() const override { return trouble_; }

  Shown at(std::size_t moment) override {
    const Moment& wanted = moments_[moment];
    if (steps_.position() != wanted.place) steps_.seek(wanted.place);
    auto step = steps_.next();
    if (step) {
      Shown shown = toShown(std::move(*step));
      if (shown.time_s == wanted.time_s) return shown;
    }
    throw RecordingError(file_ + ": has changed since it was opened; open it anew");
  }

 private:
  struct Moment {
    double time_s;
    std::uint64_t place;  ///< in the file
  };

  static std::vector<RobotInfo> robotsOf(const LoadedWorld& world) {
    std::vector<RobotInfo> robots;
    for (const auto& robot : world.fleet.robots) robots.push_back(robot.info);
    return robots;
  }

  /// Robots of which the recording has nothing are not shown.
  void leaveOutAbsent(const std::vector<RecordedRobot>& robots) {
    std::size_t i = 0;
    std::erase_if(world_.fleet.robots, [&](const auto&) { return robots[i++].is_absent; });
  }

  std::string file_;
  LoadedWorld world_;
  RawlogReader reader_;
  RecordedSteps steps_;
  std::vector<Moment> moments_;
  std::vector<double> times_;
  std::string trouble_;
};

/// nullopt for a recording that is not of RoboSim's, or of a world too large to be kept with it.
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
  if (const auto note = noteIn(file)) return std::make_unique<OurRecording>(file, *note);
  return readForeignRecording(file);
}

}  // namespace robosim
