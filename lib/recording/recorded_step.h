#pragma once
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "recording/rawlog_reader.h"

namespace robosim {

/// What a recording of ours holds of one robot and one time step.
struct RecordedRobot {
  /// Of a robot that the recording knows nothing of: with several robots, the form of pairs has a file for each. What
  /// else stands here is then blank, with a measurement for each sensor.
  bool is_absent = false;
  Readings readings;
  std::optional<mrpt::math::TPose2D> world_from_robot;  ///< ground truth
  std::optional<Command> command;                       ///< that the step was made with
};

/// Whether the pictures of cameras are read, or left empty. They are most of a recording, and may lie in a folder that
/// is not at hand.
enum class Pictures { keep, leave_out };

/// A recording of ours as it was made: step by step, the readings of every robot, bit for bit.
class RecordedSteps {
 public:
  /// @param robots that it was made with, in any order
  /// @param period_s of its steps
  RecordedSteps(RawlogReader& reader, std::vector<RobotInfo> robots, double period_s,
                Pictures pictures = Pictures::keep);

  /// The next step, robots as given; nullopt at the end. A step that is not whole, at the end of a file that was cut
  /// off, is left out. A robot of which the first step has no observation is absent in all of them.
  /// @throws RecordingError for an observation that such robots would not have recorded, or when all are absent.
  std::optional<std::vector<RecordedRobot>> next();

  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
  /// Where the next step begins, for seek(); kNowhere at the end.
  std::uint64_t position() const { return ahead_position_; }
  /// Goes to a step that next() has given, or would give; the reader must keep places.
  void seek(std::uint64_t position);

  /// The last note so far; empty for none.
  const std::string& note() const { return note_; }

 private:
  /// Of one robot, the observations of a step by the second half of their labels.
  using Observations = std::vector<std::pair<std::string, mrpt::obs::CObservation::Ptr>>;

  std::optional<RecordedRobot> put(const RobotInfo& robot, const Observations& observations, std::uint64_t step) const;
  mrpt::obs::CObservation::Ptr nextOfRobots();

  RawlogReader& reader_;
  std::vector<RobotInfo> robots_;
  double period_s_;
  Pictures pictures_;
  std::vector<std::uint8_t> is_absent_;  ///< by robot; empty before the first step
  std::string note_;
  mrpt::obs::CObservation::Ptr ahead_;  ///< the first of the next step
  std::uint64_t ahead_position_ = 0;
};

}  // namespace robosim
