#include "robosim/foreign_recording.h"

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

#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "robosim/progress.h"
#include "robosim/text.h"
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

/// More points than a picture can show would only make it slow.
constexpr std::size_t kMostBeams = 2000;

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

/// What an observation is to a picture.
enum class Kind : std::uint8_t { nothing, out_of_reach, truth, odometry, scan, ranges, heat };

Kind kindOf(const CObservation& observation) {
  const auto within = [](bool is_within_reach, Kind kind) { return is_within_reach ? kind : Kind::out_of_reach; };
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
    return heat->m_readings.empty() || !heat->m_readings[0].hasTemperature ? Kind::nothing : Kind::heat;
  }
  return Kind::nothing;
}

bool isPose(Kind kind) { return kind == Kind::truth || kind == Kind::odometry; }

TPose2D poseOf(const CObservation& observation) {
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    return odometry->odometry.asTPose();
  }
  const auto& pose = dynamic_cast<const CObservationRobotPose&>(observation).pose.mean;
  return {pose.x(), pose.y(), pose.yaw()};
}

/// With an echo for each beam.
struct Ranges {
  std::vector<Beam> beams;
  Echoes echoes;
};

std::size_t strideOf(const CObservation2DRangeScan& scan) { return 1 + scan.getScanSize() / kMostBeams; }

std::size_t beamsIn(const CObservation2DRangeScan& scan) {
  return (scan.getScanSize() + strideOf(scan) - 1) / strideOf(scan);
}
std::size_t beamsIn(const CObservationRange& range) { return range.sensedData.size(); }

Ranges rangesOf(const CObservation2DRangeScan& scan) {
  Ranges ranges;
  const std::size_t stride = strideOf(scan);
  for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
    TPose3D beam = scan.sensorPose.asTPose();
    // MRPT shares the aperture out between the beams, and so has no angle for a single one.
    if (scan.getScanSize() > 1) beam.yaw += scan.getScanAngle(i);
    const bool heard = scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange;
    ranges.beams.push_back({beam});
    ranges.echoes.push_back(echoOf(beam, heard ? scan.getScanRange(i) : scan.maxRange));
  }
  return ranges;
}

Ranges rangesOf(const CObservationRange& range) {
  Ranges ranges;
  for (const auto& sensed : range) {
    ranges.beams.push_back({sensed.sensorPose});
    const bool heard = sensed.sensedDistance > 0 && sensed.sensedDistance < range.maxSensorDistance;
    ranges.echoes.push_back(echoOf(sensed.sensorPose, heard ? sensed.sensedDistance : range.maxSensorDistance));
  }
  return ranges;
}

Measurement measurementOf(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) return rangesOf(*scan).echoes;
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) return rangesOf(*range).echoes;
  return Scalar{dynamic_cast<const CObservationGasSensors&>(observation).m_readings.at(0).temperature};
}

Measurement silence(const SensorInfo& sensor) {
  return sensor.kind == SensorKind::heat ? Measurement(Scalar{}) : Measurement(Echoes{});
}

/// All observations of one kind and label.
struct Source {
  std::string robot, label;
  Kind kind = Kind::nothing;
  SensorInfo sensor;  ///< as the observations tell of it
  std::size_t robot_index = 0, slot = 0;
};

/// Learns about a sensor from one more of its observations.
void learn(SensorInfo& sensor, const CObservation& observation) {
  const auto learn_ranges = [&](const auto& ranges, double range_max_m) {
    sensor.range_max_m = sensor.no_echo_m = range_max_m;
    // There is a beam for every echo of every moment.
    if (beamsIn(ranges) > sensor.beams.size()) sensor.beams = rangesOf(ranges).beams;
  };
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    sensor.kind = SensorKind::laser;
    learn_ranges(*scan, scan->maxRange);
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    sensor.kind = SensorKind::sonar;
    sensor.beam_width_rad = range->sensorConeApperture;
    learn_ranges(*range, range->maxSensorDistance);
  } else {
    sensor.kind = SensorKind::heat;
  }
}

/// An observation, to be found again.
struct Heard {
  double time_s = 0;
  std::uint64_t place = 0;   ///< in the file; of a pose, in ForeignRecording::poses_
  std::uint32_t within = 0;  ///< its frame
  std::uint32_t source = 0;
};
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct Slot {
  SensorInfo sensor;
  std::size_t latest = kNone;  ///< what the moment has of it, in ForeignRecording::heard_
  std::size_t read = kNone;    ///< of which `measurement` is
  Measurement measurement;
};

struct Robot {
  std::string name;
  std::vector<Slot> slots;
  bool has_truth = false;
  TPose2D first_place;
  bool has_place = false;
  /// @name Of a moment
  ///@{
  bool is_heard = false;
  TPose2D world_from_robot;
  ///@}
};

/// Robots that look like Pioneers, each with the sensors that were found.
LoadedWorld worldOf(const std::string& file, const std::vector<Robot>& robots, const Bounds2D& bounds) {
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
  explicit ForeignRecording(const std::string& file) : file_(file), reader_(file, RawlogReader::Places::keep) {
    readAll();
    if (heard_.empty()) {
      throw ConfigError(file + ": holds nothing that can be shown: no pose, odometry, scan or range" +
                        (trouble_.empty() ? "" : "; " + trouble_));
    }
    nameTheNameless();
    std::stable_sort(heard_.begin(), heard_.end(), [](const Heard& a, const Heard& b) { return a.time_s < b.time_s; });
    const Bounds2D bounds = findRobots();
    findMoments();
    world_ = worldOf(file, robots_, bounds);
  }

  const LoadedWorld& world() const override { return world_; }
  const std::vector<double>& times() const override { return times_; }
  const std::string& trouble() const override { return trouble_; }

  Shown at(std::size_t moment) override {
    goTo(ends_[moment]);
    readWhatIsNew();
    Shown shown{moment, times_[moment], {}};
    for (const auto& robot : robots_) {
      ShownRobot& one = shown.robots.emplace_back();
      one.world_from_robot = robot.world_from_robot;
      if (!robot.is_heard) continue;
      for (const auto& slot : robot.slots) {
        auto& measurements = one.readings ? one.readings->measurements : one.readings.emplace().measurements;
        measurements.push_back(slot.latest == kNone ? silence(slot.sensor) : slot.measurement);
      }
      if (!one.readings) one.readings.emplace();
    }
    return shown;
  }

 private:
  bool isOfPose(const Heard& heard) const { return isPose(sources_[heard.source].kind); }

  /// In the order of the file.
  void readAll() {
    ObservationTimes times;
    std::size_t out_of_reach = 0;
    std::uint64_t last_entry = 0;
    std::uint32_t within = 0;
    Progress progress;
    while (const auto observation = reader_.next()) {
      within = reader_.entries() == last_entry ? within + 1 : 0;
      last_entry = reader_.entries();
      if (dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) continue;
      const double time_s = times.of(*observation, reader_.entries());
      const Kind kind = kindOf(*observation);
      if (kind == Kind::out_of_reach) ++out_of_reach;
      if (kind != Kind::nothing && kind != Kind::out_of_reach) hear(*observation, kind, {time_s, 0, within, 0});
      if (progress.due()) progress.show("reading, " + withCommas(reader_.entries()) + " entries …");
    }
    trouble_ = reader_.trouble().value_or("");
    if (out_of_reach > 0) {
      trouble_ += (trouble_.empty() ? "" : "; ") + withCommas(out_of_reach) +
                  " observations lie more than 10,000 km away, or nowhere; left out";
    }
  }

  void hear(const CObservation& observation, Kind kind, Heard heard) {
    const auto [at, is_new] = source_of_label_.try_emplace({observation.sensorLabel, kind}, sources_.size());
    heard.source = static_cast<std::uint32_t>(at->second);
    if (is_new) {
      const LabelParts parts = partsOf(observation.sensorLabel);
      Source& source = sources_.emplace_back();
      source.robot = parts.robot;
      source.label = source.sensor.label = parts.sensor;
      source.kind = kind;
    }
    if (isPose(kind)) {
      heard.place = poses_.size();
      poses_.push_back(poseOf(observation));
    } else {
      heard.place = reader_.position();
      learn(sources_[heard.source].sensor, observation);
    }
    heard_.push_back(heard);
  }

  /// Where just one robot has a name, what comes without one is its, too: so actions have none.
  void nameTheNameless() {
    std::string only;
    for (const auto& source : sources_) {
      if (source.robot.empty() || source.robot == only) continue;
      if (!only.empty()) return;
      only = source.robot;
    }
    for (auto& source : sources_) source.robot = only;
  }

  /// In the order of time. @returns where they have been
  Bounds2D findRobots() {
    Bounds2D bounds{-1, 1, -1, 1};
    std::vector<std::uint8_t> is_placed(sources_.size());
    std::vector<Heard> kept;
    for (const auto& heard : heard_) {
      Source& source = sources_[heard.source];
      if (!std::exchange(is_placed[heard.source], 1)) giveSlot(source);
      Robot& robot = robots_[source.robot_index];
      if (isPose(source.kind)) {
        robot.has_truth = robot.has_truth || source.kind == Kind::truth;
        // Whoever tells the truth is not asked what its wheels tell.
        const bool is_told = source.kind == Kind::truth || !robot.has_truth;
        if (is_told) robot.world_from_robot = poses_[heard.place];
        if (is_told && !std::exchange(robot.has_place, true)) robot.first_place = robot.world_from_robot;
        if (!is_told) continue;
      }
      kept.push_back(heard);
      const TPose2D& pose = robot.world_from_robot;
      constexpr double kAround_m = 2;
      bounds = {std::min(bounds.x_min, pose.x - kAround_m), std::max(bounds.x_max, pose.x + kAround_m),
                std::min(bounds.y_min, pose.y - kAround_m), std::max(bounds.y_max, pose.y + kAround_m)};
    }
    heard_ = std::move(kept);
    return bounds;
  }

  void giveSlot(Source& source) {
    auto robot =
        std::find_if(robots_.begin(), robots_.end(), [&](const Robot& one) { return one.name == source.robot; });
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
    const double begin_s = std::min(0.0, heard_.front().time_s);
    for (std::size_t i = 0; i < heard_.size(); ++i) {
      const double time_s = heard_[i].time_s - begin_s;
      if (times_.empty() || times_.back() != time_s) {
        times_.push_back(time_s);
        ends_.push_back(i);
      }
      ends_.back() = i + 1;
    }
    forget();
  }

  /// Before the first moment; robots that appear later stand at their first place from the beginning.
  void forget() {
    end_ = 0;
    for (auto& robot : robots_) {
      robot.is_heard = false;
      robot.world_from_robot = robot.first_place;
      for (auto& slot : robot.slots) slot.latest = kNone;
    }
  }

  /// Tells robots where they are, and which of their observations are the latest.
  void goTo(std::size_t end) {
    if (end < end_) forget();
    for (; end_ < end; ++end_) {
      const Heard& heard = heard_[end_];
      const Source& source = sources_[heard.source];
      Robot& robot = robots_[source.robot_index];
      robot.is_heard = true;
      if (isPose(source.kind)) {
        robot.world_from_robot = poses_[heard.place];
      } else {
        robot.slots[source.slot].latest = end_;
      }
    }
  }

  /// In the order of the file, for it is wound back slowly.
  void readWhatIsNew() {
    std::vector<Slot*> old;
    for (auto& robot : robots_) {
      for (auto& slot : robot.slots) {
        if (slot.latest != kNone && slot.latest != slot.read) old.push_back(&slot);
      }
    }
    std::sort(old.begin(), old.end(),
              [this](const Slot* a, const Slot* b) { return heard_[a->latest].place < heard_[b->latest].place; });
    for (Slot* slot : old) {
      const Heard& heard = heard_[slot->latest];
      reader_.seek(heard.place);
      CObservation::Ptr observation;
      for (std::uint32_t i = 0; i <= heard.within; ++i) observation = reader_.next();
      if (!observation || kindOf(*observation) != sources_[heard.source].kind) {
        throw RecordingError(file_ + ": has changed since it was opened; open it anew");
      }
      slot->measurement = measurementOf(*observation);
      slot->read = slot->latest;
    }
  }

  std::string file_;
  RawlogReader reader_;
  std::vector<Source> sources_;
  std::map<std::pair<std::string, Kind>, std::size_t> source_of_label_;
  std::vector<Heard> heard_;  ///< in the order of time
  std::vector<TPose2D> poses_;
  std::vector<Robot> robots_;  ///< in the order in which they appear
  std::vector<double> times_;
  std::vector<std::size_t> ends_;  ///< in heard_, of the moments
  std::size_t end_ = 0;            ///< of what robots_ know
  LoadedWorld world_;
  std::string trouble_;
};

}  // namespace

std::unique_ptr<RecordedMoments> readForeignRecording(const std::string& file) {
  return std::make_unique<ForeignRecording>(file);
}

}  // namespace robosim
