#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "topics/robot_topics.h"
#include "topics/topic.h"

namespace robosim {

class McapRecording;

enum class RawlogFormat {
  observations,    ///< a row of observations, MRPT's own form today; one file for all robots
  sensory_frames,  ///< pairs of action and sensory frame, required by rbpf-slam and others. One robot per file: of
                   ///< several robots, each is recorded in "<stem>_<robot><extension>"
};

/// Storage of cameras' images.
enum class RawlogImages {
  embedded,  ///< in the rawlog
  external,  ///< in separate files, in the folder "<stem>_Images" beside it
};

/// Records a run as an MRPT rawlog (doc/rawlog.md) of stock observations, in MRPT's format and gzip compression; or, in
/// a file whose name ends in ".mcap", as an MCAP file with the topics of ROS 2 and the content of the rawlog
/// (McapRecording).
///
/// A step's observations are written robot by robot, in the constructor's order; for each robot ground truth, odometry,
/// the other sensors in their order, then RobotStatusRecord. Of a pair, the action is the odometry's increment since
/// the previous pair (0 for the first) with MRPT's default motion model, and the frame has all the robot's
/// observations, including odometry and ground truth. An absent robot (Activity::absent) has only its status.
///
/// Everything except copying the readings is done in a worker thread, so that recording hardly slows a run that leaves
/// a processor idle.
///
/// The file appears under its name in close(), when it is complete (GzipFile). The destructor discards a recording that
/// was not closed. A caller whose run is interrupted or fails calls close() to keep the recording.
class RawlogWriter {
 public:
  /// @param note first entry of each file, a CObservationComment (with sensory_frames, in a separate pair); empty for
  ///        none
  /// @param start time of the note
  /// @param distribution of the messages of an MCAP file
  /// @throws ConfigError when a file cannot be created, a robot has no odometry for its actions, or an MCAP file is to
  ///         have sensory frames or external images
  RawlogWriter(const std::filesystem::path& file, std::span<const RobotInfo> robots,
               RawlogFormat format = RawlogFormat::observations, RawlogImages images = RawlogImages::embedded,
               const std::string& note = "", const SimTime& start = {},
               RosDistribution distribution = RosDistribution::jazzy);
  ~RawlogWriter();

  /// Adds a robot to the steps that follow, the last in their order.
  /// @pre the recording is of observations @throws RecordingError as write()
  void addRobot(const RobotInfo& robot);

  /// Records one time step. Errors of the worker thread are thrown by a later call, at the latest by close(): an
  /// incomplete recording does not appear under its name.
  /// @param readings one per robot, in the constructor's order.
  /// @param world_from_robot true pose of each robot; empty if unknown.
  /// @param commands executed by the robots in this step; empty if unknown.
  /// @param comments texts that precede the step's observations, each as a CObservationComment
  /// @param messages of further topics of an MCAP file
  /// @param velocities of each robot, true ones, which an MCAP file contains; empty if unknown
  /// @throws RecordingError when the disk is full or fails. An earlier file of that name is unchanged.
  void write(std::span<const Readings> readings, std::span<const mrpt::math::TPose2D> world_from_robot,
             std::span<const Command> commands = {}, std::span<const std::string> comments = {},
             std::span<const TopicMessage> messages = {}, std::span<const RobotVelocity> velocities = {});
  /// The MCAP file, for what is not of a step; null for a rawlog. Valid until the next call. @throws as write()
  McapRecording* mcap();
  bool isMcap() const;
  /// Finishes the recording, and renames it to its name.
  /// @param note last entry of each file; empty for none
  /// @param comments texts that precede the note
  /// @throws RecordingError as write() does.
  void close(const std::string& note = "", std::span<const std::string> comments = {});

  /// What a recording of this name would create: its files, and with external images their folders.
  static std::vector<std::filesystem::path> pathsOf(const std::filesystem::path& file,
                                                    std::span<const RobotInfo> robots, RawlogFormat format,
                                                    RawlogImages images);
  /// The recording's files: one, or one per robot.
  std::vector<std::filesystem::path> files() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
