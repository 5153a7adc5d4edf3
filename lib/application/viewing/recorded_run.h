#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "recording/rawlog_reader.h"
#include "recording/recorded_step.h"
#include "robots/run_snapshot.h"
#include "robots/world_source.h"
#include "run/outputs/run_note.h"
#include "world/changed_objects.h"

namespace robosim {

/// Reads the steps of a recording made by RoboSim as snapshots, with the objects and the robots of each step.
class RecordedRun {
 public:
  /// Whether the measurements of a step are read, which takes most of the time.
  enum class Measurements { read, leave_out };

  /// @throws ConfigError when the world cannot be read, and as RawlogReader does
  RecordedRun(const std::string& file, const RunNote& note, Pictures pictures);

  const std::string& file() const { return file_; }
  double period() const { return period_s_; }  ///< [s]
  /// The recorded world, with the robots that have been added so far, without those that are missing in the first step.
  const LoadedWorld& world() const { return world_; }
  bool hasMissing() const { return has_missing_; }
  const RawlogReader& reader() const { return reader_; }
  RecordedSteps& steps() { return steps_; }

  /// The next step, without the objects; nullopt at the end. Without measurements, only to be followed by others of
  /// these, or by seek(). @throws RecordingError as RecordedSteps does
  std::optional<RunSnapshot> next(Measurements measurements);
  /// Notes what the comments of the last step have made of the objects.
  void noteObjects();
  /// The objects after the last step that was noted.
  const ChangedObjects& objects() const { return objects_; }
  /// Sets those before the next step.
  void setObjects(ChangedObjects objects) { objects_ = std::move(objects); }
  /// Changes them as a comment says. @throws ConfigError for an invalid one
  void change(const std::string& comment);

 private:
  std::optional<RobotInfo> robotOf(const std::string& comment);
  void leaveOutMissing(const std::vector<RecordedRobot>& robots);

  std::string file_;
  double period_s_;
  LoadedWorld world_;
  RawlogReader reader_;
  RecordedSteps steps_;
  ChangedObjects objects_;
  bool is_first_ = true, has_missing_ = false;
};

}  // namespace robosim
