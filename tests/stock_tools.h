#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include <mrpt/obs/CObservation.h>

/// MRPT's own programs, run on our recordings by the tests of several rooms.
namespace robosim {

struct ToolRun {
  int exit_code = 0;
  std::string output;  ///< standard output and errors
};

/// Runs a shell command in `folder`, with nothing to read from standard input: icp-slam would wait for a key.
ToolRun runTool(const std::string& command, const std::filesystem::path& folder);

/// Calls `see` for every observation of a rawlog of observations, in the file's order.
/// @throws std::runtime_error when the file cannot be opened.
void forEachObservation(const std::filesystem::path& rawlog,
                        const std::function<void(const mrpt::obs::CObservation::Ptr&)>& see);

/// How far a path is from the truth, over all poses.
struct PathError {
  std::size_t poses = 0;
  double rms_m = 0;
  double worst_m = 0;
};

/// Has icp-slam map from one robot's laser and odometry, and compares the path it estimates with the recorded ground
/// truth, scan by scan. icp-slam starts at (0, 0, 0); its path is laid at the robot's true start, and not fitted beyond
/// that.
/// @param rawlog of observations, of any robots; must hold the robot's ground truth and odometry.
/// @param laser the label of its scanner on the robot.
/// @param folder for what the tools write.
/// @throws std::runtime_error with the tools' output when one of them fails or loses a scan.
PathError icpSlamError(const std::filesystem::path& rawlog, const std::string& robot, const std::string& laser,
                       const std::filesystem::path& folder);

}  // namespace robosim
