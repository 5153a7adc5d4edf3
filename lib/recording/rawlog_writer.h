#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"

namespace robosim {

enum class RawlogFormat {
  observations,    ///< a row of observations, MRPT's own form today; one file for all robots
  sensory_frames,  ///< pairs of action and sensory frame, which rbpf-slam and others want. One robot a file: of several
                   ///< robots, each is recorded in "<stem>_<robot><extension>"
};

/// Where the pictures of cameras go.
enum class RawlogImages {
  embedded,  ///< into the rawlog
  external,  ///< into files of their own, in the folder "<stem>_Images" beside it
};

/// Records a run as an MRPT rawlog (doc/rawlog.md), of stock observations in MRPT's own format, compressed as MRPT
/// does.
///
/// A step's observations are written robot by robot, as the robots were given; of each robot ground truth, odometry,
/// its other sensors in their order, then what no sensor measures (Unsensed). Of a pair, the action is the odometry's
/// increment since the pair before (0 for the first) under MRPT's default motion model, and the frame holds all the
/// robot's observations, odometry and ground truth too.
///
/// All but copying the readings happens in a thread in the background, so that a run that has a processor to spare is
/// hardly slower for being recorded.
///
/// The file has its name only from close() on, and is then whole (GzipFile). The destructor without close() drops the
/// recording. A caller that is interrupted, or whose run fails, calls close() to keep what there is.
class RawlogWriter {
 public:
  /// @param note stands first in each file, as a CObservationComment; empty for none
  /// @throws ConfigError when a file cannot be made, or a robot has no odometry for its actions.
  RawlogWriter(const std::filesystem::path& file, std::span<const RobotInfo> robots,
               RawlogFormat format = RawlogFormat::observations, RawlogImages images = RawlogImages::embedded,
               const std::string& note = "");
  ~RawlogWriter();

  /// Records one time step. What goes wrong in the background is thrown by a later call, and by close() in any
  /// case: a recording with a hole gets no name.
  /// @param readings one per robot, in the order of the constructor's.
  /// @param world_from_robot where each robot really is; empty when nobody knows.
  /// @param commands that the robots obeyed in this step; empty when nobody knows.
  /// @throws RecordingError when the disk is full, or fails. Whatever had the file's name before is still there.
  void write(std::span<const Readings> readings, std::span<const mrpt::math::TPose2D> world_from_robot,
             std::span<const Command> commands = {});
  /// Finishes the recording, and gives it its name.
  /// @param note stands last in each file; empty for none
  /// @throws RecordingError as write() does.
  void close(const std::string& note = "");

  /// The recording's files: one, or one per robot.
  std::vector<std::filesystem::path> files() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
