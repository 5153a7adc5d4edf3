#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/rawlog_reader.h"

namespace robosim {

/// Recorded data of one robot and one time step.
struct RecordedRobot {
  /// Whether the recording does not contain this robot (RawlogFormat::sensory_frames has a file for each robot). The
  /// other members are then blank, with a measurement for each sensor.
  bool is_missing = false;
  Readings readings;
  std::optional<mrpt::math::TPose2D> world_from_robot;  ///< ground truth
  std::optional<Command> command;                       ///< executed in this step; of an absent robot, only that it is
};

/// Whether the robot was not in the world in this step.
inline bool isAbsent(const RecordedRobot& robot) {
  return robot.command && robot.command->activity == Activity::absent;
}

/// Whether cameras' images are read or left empty. Images are most of a recording's size, and external images may be
/// unavailable.
enum class Pictures { keep, leave_out };

/// Reads a recording of RoboSim step by step, with the exact readings of every robot. In steps in which a sensor keeps
/// its reading (SensorInfo::times), it has no observation; next() returns the last one before.
class RecordedSteps {
 public:
  /// The robot that a comment adds to the recording, from the step that follows it on; nullopt: none.
  using RobotOfComment = std::function<std::optional<RobotInfo>(const std::string& comment)>;

  /// @param robots of the recorded world, in any order
  /// @param period_s length of its steps
  /// @param robot_of null: no robots are added, and observations of others are ignored
  RecordedSteps(RawlogReader& reader, std::vector<RobotInfo> robots, double period_s,
                Pictures pictures = Pictures::keep, RobotOfComment robot_of = {});

  /// The next step, with robots in the constructor's order, then those added, which are absent in steps before; nullopt
  /// at the end. An incomplete step at the end of a truncated file is skipped. A robot without observations in the
  /// first step is missing in all steps.
  /// @throws RecordingError for an observation that does not match these robots, or when all robots are missing.
  std::optional<std::vector<RecordedRobot>> next();
  /// The same without measurements, which are blank: what takes most of the time is left out. Continue with seek()
  /// before next().
  std::optional<std::vector<RecordedRobot>> nextWithoutMeasurements();

  static constexpr std::uint64_t kEnd = ~std::uint64_t{0};
  /// Position of the next step, for seek(); kEnd at the end.
  std::uint64_t position() const { return lookahead_position_; }
  /// Continues at a step that next() has returned or would return next; requires a reader with random access. If
  /// sensors keep readings in that step, it reads them in the steps before.
  void seek(std::uint64_t position);

  /// The last note read so far; empty for none.
  const std::string& note() const { return note_; }
  /// Texts of the comments between the step that next() has returned last and the one before; after the end of the
  /// recording, of those behind the last step.
  const std::vector<std::string>& comments() const { return comments_; }

 private:
  /// Observations of one robot and one step, by the sensor part of their labels.
  using Observations = std::vector<std::pair<std::string, mrpt::obs::CObservation::Ptr>>;

  /// A reading that a sensor keeps, and where it is in the file.
  struct Kept {
    Measurement measurement;
    std::uint64_t position = kEnd;  ///< of its step; kEnd for a blank measurement
  };
  /// A step that next() has returned.
  struct Place {
    std::uint64_t position = 0;
    std::uint64_t first = 0;  ///< position of the first step that contains a reading kept in this one
  };

  std::optional<std::vector<RecordedRobot>> next(bool has_measurements);
  std::optional<RecordedRobot> assemble(std::size_t robot, const Observations& observations, std::uint64_t step,
                                        std::uint64_t position, bool has_measurements);
  void forget(std::size_t robot);
  void addRobot(RobotInfo robot, std::uint64_t position);
  void addPlace(std::uint64_t position);
  mrpt::obs::CObservation::Ptr nextRobotObservation();

  RawlogReader& reader_;
  std::vector<RobotInfo> robots_;
  RobotOfComment robot_of_;
  std::vector<RobotInfo> added_;      ///< from the next step on
  std::vector<std::uint64_t> since_;  ///< by robot: position of its first step
  double period_s_;
  Pictures pictures_;
  std::vector<std::uint8_t> is_missing_;  ///< by robot; empty before the first step
  std::vector<std::vector<Kept>> kept_;   ///< by robot and sensor
  std::vector<std::pair<std::size_t, std::size_t>>
      with_rates_;             ///< robots and sensors that do not measure in every step
  std::vector<Place> places_;  ///< ascending; empty if no sensor has a rate
  std::string note_;
  std::vector<std::string> comments_, comments_of_next_;
  mrpt::obs::CObservation::Ptr lookahead_;  ///< first observation of the next step
  std::uint64_t lookahead_position_ = 0;
};

}  // namespace robosim
