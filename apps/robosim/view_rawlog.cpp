#include <algorithm>
#include <cmath>
#include <utility>

#include "recording/recorded_step.h"
#include "robosim/foreign_recording.h"
#include "robosim/progress.h"
#include "robosim/run_note.h"
#include "robosim/text.h"
#include "robosim/view_source.h"

namespace robosim {
namespace {

Shown toShown(std::vector<RecordedRobot> robots) {
  Shown shown;
  for (auto& robot : robots) {
    shown.step = robot.readings.time.step;
    shown.time_s = robot.readings.time.seconds();
    shown.robots.push_back({robot.world_from_robot.value_or(mrpt::math::TPose2D()), robot.readings.laser_pan_rad,
                            robot.readings.stalled, robot.command ? robot.command->activity : Activity::active,
                            std::move(robot.readings)});
  }
  return shown;
}

/// All of it is read at first, so that it can be wound to anywhere.
class RawlogView final : public ViewSource {
 public:
  explicit RawlogView(const std::string& file) : title_(file) {
    if (const auto note = noteIn(file)) {
      readOurs(file, *note);
    } else {
      ForeignRecording foreign = readForeignRecording(file);
      world_ = std::move(foreign.world);
      moments_ = std::move(foreign.moments);
      trouble_ = std::move(foreign.trouble);
    }
    // A damaged recording may go back in time.
    std::stable_sort(moments_.begin(), moments_.end(),
                     [](const Shown& a, const Shown& b) { return a.time_s < b.time_s; });
    if (moments_.empty()) throw ConfigError(file + ": holds no whole step" + (trouble_.empty() ? "" : "; " + trouble_));
  }

  const LoadedWorld& world() const override { return world_; }
  const Shown& shown() const override { return moments_[at_]; }
  std::string title() const override { return title_; }

  bool advance(double wall_s) override {
    if (!is_paused_) time_s_ = std::min(time_s_ + wall_s * speed_, moments_.back().time_s);
    return goTo(time_s_);
  }
  bool isOver() const override { return at_ + 1 == moments_.size(); }
  std::string remark() const override { return trouble_; }

  bool canPlay() const override { return true; }
  bool isPaused() const override { return is_paused_; }
  void pause(bool paused) override { is_paused_ = paused; }
  void step() override {
    is_paused_ = true;
    if (at_ + 1 < moments_.size()) time_s_ = moments_[at_ + 1].time_s;
  }
  double speed() const override { return speed_; }
  void setSpeed(double speed) override { speed_ = speed; }
  std::optional<double> duration() const override { return moments_.back().time_s; }
  void seek(double time_s) override { time_s_ = std::clamp(time_s, 0.0, std::max(0.0, moments_.back().time_s)); }

 private:
  /// nullopt for a recording that is not of RoboSim's, or of a world too large to be kept with it.
  static std::optional<RunNote> noteIn(const std::string& file) {
    try {
      auto note = RunNote::of(file);
      return note.world.text.empty() ? std::nullopt : std::make_optional(std::move(note));
    } catch (const NotOfRoboSim&) {
      return std::nullopt;
    }
  }

  void readOurs(const std::string& file, const RunNote& note) {
    world_ = loadWorld(note.world, {});
    std::vector<RobotInfo> robots;
    for (const auto& robot : world_.fleet.robots) robots.push_back(robot.info);
    RawlogReader reader(file);
    RecordedSteps steps(reader, robots, note.period_s, Pictures::leave_out);
    Progress progress;
    while (auto step = steps.next()) {
      leaveOutAbsent(*step);
      moments_.push_back(toShown(std::move(*step)));
      if (progress.due()) progress.show("reading, " + fixed(moments_.back().time_s, 0) + " s …");
    }
    trouble_ = reader.trouble().value_or("");
  }

  /// Robots of which the recording has nothing are not shown; in the first step they leave the fleet, too.
  void leaveOutAbsent(std::vector<RecordedRobot>& robots) {
    auto& fleet = world_.fleet.robots;
    if (fleet.size() == robots.size()) {
      std::size_t i = 0;
      std::erase_if(fleet, [&](const auto&) { return robots[i++].is_absent; });
    }
    std::erase_if(robots, [](const auto& robot) { return robot.is_absent; });
  }

  /// The last moment that is not later.
  bool goTo(double time_s) {
    const auto after = std::upper_bound(moments_.begin(), moments_.end(), time_s + 1e-9,
                                        [](double t, const Shown& moment) { return t < moment.time_s; });
    const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - moments_.begin() - 1));
    return std::exchange(at_, at) != at;
  }

  std::string title_;
  LoadedWorld world_;
  std::vector<Shown> moments_;
  std::string trouble_;
  std::size_t at_ = 0;
  double time_s_ = 0;
  double speed_ = 1;
  bool is_paused_ = false;
};

}  // namespace

std::unique_ptr<ViewSource> viewRawlog(const std::string& file) { return std::make_unique<RawlogView>(file); }

}  // namespace robosim
