#include "viewing/foreign_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <mrpt/obs/CObservationComment.h>

#include "base/progress.h"
#include "base/text_table.h"
#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "robots/world_source.h"
#include "viewing/foreign_observation.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation;

/// Heading of a satellite receiver, which it does not measure: the direction in which it moved last.
class SatelliteTrack {
 public:
  TPose2D poseAt(const mrpt::math::TPoint2D& at) {
    constexpr double kStep_m = 0.3;  // more than the noise of positions that are corrected (RTK)
    const auto way = at - mrpt::math::TPoint2D(turned_.x, turned_.y);
    if (!std::exchange(has_begun_, true)) {
      turned_ = {at.x, at.y, 0};
    } else if (way.norm() >= kStep_m) {
      turned_ = {at.x, at.y, std::atan2(way.y, way.x)};
    }
    return {at.x, at.y, turned_.phi};
  }

 private:
  bool has_begun_ = false;
  TPose2D turned_;  ///< where the heading was found
};

/// All observations of one kind and label.
struct Source {
  std::string robot, label;
  ObservationKind kind = ObservationKind::ignored;
  SensorInfo sensor;  ///< as described by the observations
  std::size_t robot_index = 0, slot = 0;
  SatelliteTrack satellites = {};
};

/// Location of an observation in the file.
struct Observed {
  double time_s = 0;
  std::uint64_t place = 0;   ///< in the file; of a pose, in ForeignRecording::poses_
  std::uint32_t within = 0;  ///< index within its frame
  std::uint32_t source = 0;
  Surroundings around = {};
};
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct Slot {
  SensorInfo sensor;
  std::size_t latest = kNone;  ///< latest observation at the moment, in ForeignRecording::observed_
  std::size_t read = kNone;    ///< observation that `measurement` was read from
  Measurement measurement;
};

struct ForeignRobot {
  std::string name;
  std::vector<Slot> slots;
  bool has_truth = false;
  TPose2D first_pose;
  bool has_first_pose = false;
  /// @name Queries at a moment
  ///@{
  bool is_present = false;
  TPose2D world_from_robot;
  ///@}
};

/// Robots (shown as Pioneers) with the sensors found in the recording.
LoadedWorld worldOf(const std::string& file, const std::vector<ForeignRobot>& robots, const Bounds2D& bounds) {
  WorldSource source;
  source.file = file;
  source.robot_types = robotTypesIn(robotTypeFolders(file));
  source.text = "<world><surface><size><xmin>-1e6</xmin><xmax>1e6</xmax><ymin>-1e6</ymin><ymax>1e6</ymax></size>";
  for (std::size_t i = 0; i < robots.size(); ++i) {
    source.text += "<object><shape><robot><model>pioneer3dx</model><name>robot" + std::to_string(i) + "</name><x>" +
                   std::to_string(2 * i) + "</x><y>0</y></robot></shape></object>";
  }
  source.text += "</surface></world>";
  LoadedWorld world = loadWorld(source, {});
  world.world.bounds = bounds;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    RobotInfo& info = world.fleet.robots[i].info;
    info.name = robots[i].name.empty() ? "robot" : robots[i].name;
    std::vector<SensorInfo> sensors;
    for (const auto& slot : robots[i].slots) sensors.push_back(slot.sensor);
    info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  }
  return world;
}

class ForeignRecording final : public RecordedMoments {
 public:
  explicit ForeignRecording(const std::string& file) : file_(file), reader_(file, RawlogReader::Access::random) {
    readAll();
    if (observed_.empty()) {
      throw ConfigError(
          file +
          ": contains nothing that can be shown: no pose, odometry, satellite position, scan, range, bearing "
          "or points" +
          (read_error_.empty() ? "" : "; " + read_error_));
    }
    assignUnlabelledSources();
    std::stable_sort(observed_.begin(), observed_.end(),
                     [](const Observed& a, const Observed& b) { return a.time_s < b.time_s; });
    const Bounds2D bounds = findRobots();
    findMoments();
    world_ = worldOf(file, robots_, bounds);
  }

  const LoadedWorld& world() const override { return world_; }
  const std::vector<double>& times() const override { return times_; }
  const RunPaths& paths() const override { return paths_; }
  const RunEvents& events() const override { return events_; }
  const std::string& readError() const override { return read_error_; }
  bool isOfOtherProgram() const override { return true; }
  bool isDamaged() const override { return is_damaged_; }

  RunSnapshot at(std::size_t moment) override {
    goTo(ends_[moment]);
    readNewMeasurements();
    RunSnapshot snapshot{moment, times_[moment], {}};
    for (const auto& robot : robots_) {
      RobotSnapshot& one = snapshot.robots.emplace_back();
      one.world_from_robot = robot.world_from_robot;
      if (!robot.is_present) continue;
      for (const auto& slot : robot.slots) {
        auto& measurements = one.readings ? one.readings->measurements : one.readings.emplace().measurements;
        measurements.push_back(slot.latest == kNone ? emptyMeasurement(slot.sensor) : slot.measurement);
      }
      if (!one.readings) one.readings.emplace();
    }
    return snapshot;
  }

 private:
  bool isOfPose(const Observed& observed) const { return isPose(sources_[observed.source].kind); }

  /// Records in the order of the file.
  void readAll() {
    ObservationTimes times(file_);
    std::size_t out_of_range = 0;
    std::uint64_t last_entry = 0;
    std::uint32_t within = 0;
    Progress progress;
    while (const auto observation = reader_.next()) {
      within = reader_.entries() == last_entry ? within + 1 : 0;
      last_entry = reader_.entries();
      if (dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) continue;
      const double time_s = times.of(*observation, reader_.entries());
      const ObservationKind kind = observationKind(*observation);
      if (kind == ObservationKind::out_of_range) ++out_of_range;
      if (kind != ObservationKind::ignored && kind != ObservationKind::out_of_range)
        addObservation(*observation, kind, {time_s, 0, within, 0, {}});
      if (progress.due()) progress.show("reading, " + withCommas(reader_.entries()) + " entries …");
    }
    read_error_ = reader_.readError().value_or("");
    is_damaged_ = reader_.isDamaged();
    if (out_of_range > 0) {
      read_error_ += (read_error_.empty() ? "" : "; ") + withCommas(out_of_range) +
                     " observations have positions beyond 10,000 km or not finite; omitted";
    }
  }

  void addObservation(const CObservation& observation, ObservationKind kind, Observed observed) {
    const auto [at, is_new] = source_of_label_.try_emplace({observation.sensorLabel, kind}, sources_.size());
    observed.source = static_cast<std::uint32_t>(at->second);
    if (is_new) {
      const Label label = Label::parse(observation.sensorLabel);
      Source& source = sources_.emplace_back();
      source.robot = label.robot;
      source.label = source.sensor.label = label.withinRobot();
      source.kind = kind;
      // Each receiver has a track of its own: their antennas are at different places of the vehicle.
      if (kind == ObservationKind::satellites && !observation.sensorLabel.empty()) {
        source.robot = observation.sensorLabel;
      }
    }
    if (kind == ObservationKind::satellites) {
      const Geodetic position = observedPosition(observation);
      if (!origin_) origin_ = position;
      observed.place = poses_.size();
      poses_.push_back(sources_[observed.source].satellites.poseAt(localMetres(*origin_, position)));
    } else if (isPose(kind)) {
      observed.place = poses_.size();
      poses_.push_back(observedPose(observation));
    } else {
      observed.place = reader_.position();
      updateDescription(sources_[observed.source].sensor, observation);
      observed.around = observedSurroundings(observation);
    }
    observed_.push_back(observed);
  }

  /// If exactly one robot has a name, unlabelled observations belong to it as well: actions have no label.
  void assignUnlabelledSources() {
    std::string only;
    for (const auto& source : sources_) {
      if (source.robot.empty() || source.robot == only || source.kind == ObservationKind::satellites) continue;
      if (!only.empty()) return;
      only = source.robot;
    }
    for (auto& source : sources_) {
      if (source.kind != ObservationKind::satellites) source.robot = only;
    }
  }

  /// Records in the order of time. @returns the area of the robots and their echoes
  Bounds2D findRobots() {
    Bounds2D bounds{-1, 1, -1, 1};
    std::vector<std::uint8_t> is_placed(sources_.size());
    std::vector<Observed> kept;
    for (const auto& observed : observed_) {
      Source& source = sources_[observed.source];
      if (!std::exchange(is_placed[observed.source], 1)) addSlot(source);
      ForeignRobot& robot = robots_[source.robot_index];
      if (isPose(source.kind)) {
        robot.has_truth = robot.has_truth || source.kind == ObservationKind::truth;
        // Odometry is ignored for robots with ground truth.
        const bool is_used = source.kind == ObservationKind::truth || !robot.has_truth;
        if (is_used) robot.world_from_robot = poses_[observed.place];
        if (is_used && !std::exchange(robot.has_first_pose, true)) robot.first_pose = robot.world_from_robot;
        if (!is_used) continue;
      }
      kept.push_back(observed);
      const TPose2D& pose = robot.world_from_robot;
      constexpr double kMargin_m = 2;
      bounds = {std::min(bounds.x_min, pose.x - kMargin_m), std::max(bounds.x_max, pose.x + kMargin_m),
                std::min(bounds.y_min, pose.y - kMargin_m), std::max(bounds.y_max, pose.y + kMargin_m)};
      for (const float x : {observed.around.x_min, observed.around.x_max}) {
        for (const float y : {observed.around.y_min, observed.around.y_max}) {
          const auto at = pose.composePoint(mrpt::math::TPoint2D(x, y));
          bounds = {std::min(bounds.x_min, at.x), std::max(bounds.x_max, at.x), std::min(bounds.y_min, at.y),
                    std::max(bounds.y_max, at.y)};
        }
      }
    }
    observed_ = std::move(kept);
    return bounds;
  }

  void addSlot(Source& source) {
    auto robot =
        std::find_if(robots_.begin(), robots_.end(), [&](const ForeignRobot& one) { return one.name == source.robot; });
    if (robot == robots_.end()) {
      robot = robots_.emplace(robot);
      robot->name = source.robot;
    }
    source.robot_index = static_cast<std::size_t>(robot - robots_.begin());
    if (isPose(source.kind)) return;
    source.slot = robot->slots.size();
    robot->slots.emplace_back().sensor = source.sensor;
  }

  void findMoments() {
    const double begin_s = std::min(0.0, observed_.front().time_s);
    for (std::size_t i = 0; i < observed_.size(); ++i) {
      const double time_s = observed_[i].time_s - begin_s;
      if (times_.empty() || times_.back() != time_s) {
        times_.push_back(time_s);
        ends_.push_back(i);
      }
      ends_.back() = i + 1;
    }
    reset();
    std::vector<TPose2D> poses;
    for (std::size_t moment = 0; moment < times_.size(); ++moment) {
      goTo(ends_[moment]);
      poses.clear();
      for (const auto& robot : robots_) poses.push_back(robot.world_from_robot);
      paths_.add(moment, times_[moment], poses);
    }
    reset();
  }

  /// Initial poses; robots that appear later stand at their first pose from the beginning.
  void reset() {
    end_ = 0;
    for (auto& robot : robots_) {
      robot.is_present = false;
      robot.world_from_robot = robot.first_pose;
      for (auto& slot : robot.slots) slot.latest = kNone;
    }
  }

  /// Applies a moment: sets the robots' poses and latest observations.
  void goTo(std::size_t end) {
    if (end < end_) reset();
    for (; end_ < end; ++end_) {
      const Observed& observed = observed_[end_];
      const Source& source = sources_[observed.source];
      ForeignRobot& robot = robots_[source.robot_index];
      robot.is_present = true;
      if (isPose(source.kind)) {
        robot.world_from_robot = poses_[observed.place];
      } else {
        robot.slots[source.slot].latest = end_;
      }
    }
  }

  /// Reads in file order, because seeking backwards is slow.
  void readNewMeasurements() {
    std::vector<Slot*> old;
    for (auto& robot : robots_) {
      for (auto& slot : robot.slots) {
        if (slot.latest != kNone && slot.latest != slot.read) old.push_back(&slot);
      }
    }
    std::sort(old.begin(), old.end(),
              [this](const Slot* a, const Slot* b) { return observed_[a->latest].place < observed_[b->latest].place; });
    for (Slot* slot : old) {
      const Observed& observed = observed_[slot->latest];
      reader_.seek(observed.place);
      CObservation::Ptr observation;
      for (std::uint32_t i = 0; i <= observed.within; ++i) observation = reader_.next();
      if (!observation || observationKind(*observation) != sources_[observed.source].kind) {
        throw RecordingError(file_ + ": has changed since it was opened; open it again");
      }
      slot->measurement = observedMeasurement(*observation);
      slot->read = slot->latest;
    }
  }

  std::string file_;
  RawlogReader reader_;
  std::vector<Source> sources_;
  std::map<std::pair<std::string, ObservationKind>, std::size_t> source_of_label_;
  std::vector<Observed> observed_;  ///< in the order of time
  std::vector<TPose2D> poses_;
  std::optional<Geodetic> origin_;    ///< of local metres: the first position of a satellite receiver
  std::vector<ForeignRobot> robots_;  ///< in the order in which they appear
  std::vector<double> times_;
  std::vector<std::size_t> ends_;  ///< end index in observed_ of each moment
  std::size_t end_ = 0;            ///< end index in observed_ of the moment applied to robots_
  LoadedWorld world_;
  RunPaths paths_;
  RunEvents events_;  ///< none
  std::string read_error_;
  bool is_damaged_ = false;
};

}  // namespace

std::unique_ptr<RecordedMoments> readForeignRecording(const std::string& file) {
  return std::make_unique<ForeignRecording>(file);
}

}  // namespace robosim
