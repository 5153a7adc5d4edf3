#include "viewing/foreign_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "base/progress.h"
#include "base/text_table.h"
#include "recording/cone_aperture.h"
#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "robots/world_source.h"
#include "world/occupancy_grid.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationGasSensors;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRange;
using mrpt::obs::CObservationRobotPose;

/// Maximum number of points per scan; more would only slow down drawing.
constexpr std::size_t kMaxBeams = 2000;

Echo echoOf(const TPose3D& robot_from_beam, float range_m) {
  const auto end = robot_from_beam.composePoint({range_m, 0, 0});
  return {range_m, {static_cast<float>(end.x), static_cast<float>(end.y), static_cast<float>(end.z)}};
}

bool isWithinReach(double x_m, double y_m, double angle_rad) {
  return std::isfinite(angle_rad) && std::abs(x_m) <= kMapReach_m && std::abs(y_m) <= kMapReach_m;
}

bool isWithinReach(const TPose3D& robot_from_sensor, float range_max_m) {
  return isWithinReach(robot_from_sensor.x, robot_from_sensor.y, robot_from_sensor.yaw) &&
         std::isfinite(robot_from_sensor.z) && std::isfinite(robot_from_sensor.pitch) &&
         std::isfinite(robot_from_sensor.roll) && range_max_m >= 0 && range_max_m <= kMapReach_m;
}

/// Classification of an observation for drawing.
enum class Kind : std::uint8_t { ignored, out_of_range, truth, odometry, scan, ranges, heat };

Kind kindOf(const CObservation& observation) {
  const auto within = [](bool is_within_reach, Kind kind) { return is_within_reach ? kind : Kind::out_of_range; };
  if (const auto* truth = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    return within(isWithinReach(pose.x(), pose.y(), pose.yaw()), Kind::truth);
  }
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    const auto& pose = odometry->odometry;
    return within(isWithinReach(pose.x(), pose.y(), pose.phi()), Kind::odometry);
  }
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    return within(isWithinReach(scan->sensorPose.asTPose(), scan->maxRange) && std::isfinite(scan->aperture),
                  Kind::scan);
  }
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    return within(
        std::all_of(range->begin(), range->end(),
                    [&](const auto& sensed) { return isWithinReach(sensed.sensorPose, range->maxSensorDistance); }),
        Kind::ranges);
  }
  if (const auto* heat = dynamic_cast<const CObservationGasSensors*>(&observation)) {
    return heat->m_readings.empty() || !heat->m_readings[0].hasTemperature ? Kind::ignored : Kind::heat;
  }
  return Kind::ignored;
}

bool isPose(Kind kind) { return kind == Kind::truth || kind == Kind::odometry; }

TPose2D poseOf(const CObservation& observation) {
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    return odometry->odometry.asTPose();
  }
  const auto& pose = dynamic_cast<const CObservationRobotPose&>(observation).pose.mean;
  return {pose.x(), pose.y(), pose.yaw()};
}

/// An observation with one echo per beam.
struct Ranges {
  std::vector<Beam> beams;
  Echoes echoes;
};

std::size_t strideOf(const CObservation2DRangeScan& scan) { return 1 + scan.getScanSize() / kMaxBeams; }

std::size_t beamsIn(const CObservation2DRangeScan& scan) {
  return (scan.getScanSize() + strideOf(scan) - 1) / strideOf(scan);
}
std::size_t beamsIn(const CObservationRange& range) { return range.sensedData.size(); }

Ranges rangesOf(const CObservation2DRangeScan& scan) {
  Ranges ranges;
  const std::size_t stride = strideOf(scan);
  for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
    TPose3D beam = scan.sensorPose.asTPose();
    // MRPT divides the aperture among the beams, and so gives no angle for a single beam.
    if (scan.getScanSize() > 1) beam.yaw += scan.getScanAngle(i);
    const bool observed = scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange;
    ranges.beams.push_back({beam});
    ranges.echoes.push_back(echoOf(beam, observed ? scan.getScanRange(i) : scan.maxRange));
  }
  return ranges;
}

Ranges rangesOf(const CObservationRange& range) {
  Ranges ranges;
  for (const auto& sensed : range) {
    ranges.beams.push_back({sensed.sensorPose});
    const bool observed = sensed.sensedDistance > 0 && sensed.sensedDistance < range.maxSensorDistance;
    ranges.echoes.push_back(echoOf(sensed.sensorPose, observed ? sensed.sensedDistance : range.maxSensorDistance));
  }
  return ranges;
}

Measurement measurementOf(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) return rangesOf(*scan).echoes;
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) return rangesOf(*range).echoes;
  return Scalar{dynamic_cast<const CObservationGasSensors&>(observation).m_readings.at(0).temperature};
}

Measurement noEchoes(const SensorInfo& sensor) {
  return sensor.kind == SensorKind::heat ? Measurement(Scalar{}) : Measurement(Echoes{});
}

/// All observations of one kind and label.
struct Source {
  std::string robot, label;
  Kind kind = Kind::ignored;
  SensorInfo sensor;  ///< as described by the observations
  std::size_t robot_index = 0, slot = 0;
};

/// Updates the description of a sensor from a further observation.
void learn(SensorInfo& sensor, const CObservation& observation) {
  const auto learn_ranges = [&](const auto& ranges, double range_max_m) {
    sensor.range_max_m = sensor.no_echo_m = range_max_m;
    // One beam per echo of every moment.
    if (beamsIn(ranges) > sensor.beams.size()) sensor.beams = rangesOf(ranges).beams;
  };
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    sensor.kind = SensorKind::laser;
    learn_ranges(*scan, scan->maxRange);
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    sensor.kind = SensorKind::sonar;
    sensor.beam_width_rad = coneAperture_rad(*range);
    learn_ranges(*range, range->maxSensorDistance);
  } else {
    sensor.kind = SensorKind::heat;
  }
}

/// Bounding box of the nearest 90 % of an observation's echoes, in the robot's frame; a few distant echoes, as through
/// a window, would enlarge the view too much.
struct Surroundings {
  float x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

Surroundings surroundingsIn(Ranges ranges, double range_max_m) {
  constexpr double kQuantile = 0.9;
  auto& echoes = ranges.echoes;
  std::erase_if(echoes, [&](const Echo& echo) { return echo.range_m >= range_max_m; });
  const auto count = static_cast<std::ptrdiff_t>(std::ceil(kQuantile * static_cast<double>(echoes.size())));
  std::nth_element(echoes.begin(), echoes.begin() + count, echoes.end(),
                   [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  Surroundings box;
  for (auto echo = echoes.begin(); echo != echoes.begin() + count; ++echo) {
    const auto& at = echo->point_m;
    box = {std::min(box.x_min, at.x), std::max(box.x_max, at.x), std::min(box.y_min, at.y), std::max(box.y_max, at.y)};
  }
  return box;
}

Surroundings surroundingsIn(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    return surroundingsIn(rangesOf(*scan), scan->maxRange);
  }
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    return surroundingsIn(rangesOf(*range), range->maxSensorDistance);
  }
  return {};
}

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
      throw ConfigError(file + ": contains nothing that can be shown: no pose, odometry, scan or range" +
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
  const std::string& readError() const override { return read_error_; }

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
        measurements.push_back(slot.latest == kNone ? noEchoes(slot.sensor) : slot.measurement);
      }
      if (!one.readings) one.readings.emplace();
    }
    return snapshot;
  }

 private:
  bool isOfPose(const Observed& observed) const { return isPose(sources_[observed.source].kind); }

  /// Records in the order of the file.
  void readAll() {
    ObservationTimes times;
    std::size_t out_of_range = 0;
    std::uint64_t last_entry = 0;
    std::uint32_t within = 0;
    Progress progress;
    while (const auto observation = reader_.next()) {
      within = reader_.entries() == last_entry ? within + 1 : 0;
      last_entry = reader_.entries();
      if (dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) continue;
      const double time_s = times.of(*observation, reader_.entries());
      const Kind kind = kindOf(*observation);
      if (kind == Kind::out_of_range) ++out_of_range;
      if (kind != Kind::ignored && kind != Kind::out_of_range)
        addObservation(*observation, kind, {time_s, 0, within, 0, {}});
      if (progress.due()) progress.show("reading, " + withCommas(reader_.entries()) + " entries …");
    }
    read_error_ = reader_.readError().value_or("");
    if (out_of_range > 0) {
      read_error_ += (read_error_.empty() ? "" : "; ") + withCommas(out_of_range) +
                     " observations have positions beyond 10,000 km or not finite; omitted";
    }
  }

  void addObservation(const CObservation& observation, Kind kind, Observed observed) {
    const auto [at, is_new] = source_of_label_.try_emplace({observation.sensorLabel, kind}, sources_.size());
    observed.source = static_cast<std::uint32_t>(at->second);
    if (is_new) {
      const Label label = Label::parse(observation.sensorLabel);
      Source& source = sources_.emplace_back();
      source.robot = label.robot;
      source.label = source.sensor.label = label.withinRobot();
      source.kind = kind;
    }
    if (isPose(kind)) {
      observed.place = poses_.size();
      poses_.push_back(poseOf(observation));
    } else {
      observed.place = reader_.position();
      learn(sources_[observed.source].sensor, observation);
      observed.around = surroundingsIn(observation);
    }
    observed_.push_back(observed);
  }

  /// If exactly one robot has a name, unlabelled observations belong to it as well: actions have no label.
  void assignUnlabelledSources() {
    std::string only;
    for (const auto& source : sources_) {
      if (source.robot.empty() || source.robot == only) continue;
      if (!only.empty()) return;
      only = source.robot;
    }
    for (auto& source : sources_) source.robot = only;
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
        robot.has_truth = robot.has_truth || source.kind == Kind::truth;
        // Odometry is ignored for robots with ground truth.
        const bool is_used = source.kind == Kind::truth || !robot.has_truth;
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
      if (!observation || kindOf(*observation) != sources_[observed.source].kind) {
        throw RecordingError(file_ + ": has changed since it was opened; open it again");
      }
      slot->measurement = measurementOf(*observation);
      slot->read = slot->latest;
    }
  }

  std::string file_;
  RawlogReader reader_;
  std::vector<Source> sources_;
  std::map<std::pair<std::string, Kind>, std::size_t> source_of_label_;
  std::vector<Observed> observed_;  ///< in the order of time
  std::vector<TPose2D> poses_;
  std::vector<ForeignRobot> robots_;  ///< in the order in which they appear
  std::vector<double> times_;
  std::vector<std::size_t> ends_;  ///< end index in observed_ of each moment
  std::size_t end_ = 0;            ///< end index in observed_ of the moment applied to robots_
  LoadedWorld world_;
  std::string read_error_;
};

}  // namespace

std::unique_ptr<RecordedMoments> readForeignRecording(const std::string& file) {
  return std::make_unique<ForeignRecording>(file);
}

}  // namespace robosim
