#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include <mrpt/obs/CObservation.h>

/// Runs MRPT's programs on recordings, for tests of several modules.
namespace robosim {

struct ToolRun {
  int exit_code = 0;
  std::string output;  ///< standard output and errors
};

/// Runs a shell command in `folder` with empty standard input, because icp-slam would wait for a key.
ToolRun runTool(const std::string& command, const std::filesystem::path& folder);

/// Calls `see` for every observation of a rawlog of observations, in the file's order.
/// @throws std::runtime_error when the file cannot be opened.
void forEachObservation(const std::filesystem::path& rawlog,
                        const std::function<void(const mrpt::obs::CObservation::Ptr&)>& see);

/// Deviation of a path from the truth, over all poses.
struct PathError {
  std::size_t poses = 0;
  double rms_m = 0;
  double worst_m = 0;
  double odometry_rms_m = 0;  ///< of the odometry path
};

/// Runs icp-slam on one robot's laser and odometry, and compares the estimated path with the recorded ground truth,
/// scan by scan. icp-slam starts at (0, 0, 0); its path is transformed to the robot's true start, without further
/// alignment.
/// @param rawlog of observations, of any robots; must hold the robot's ground truth and odometry.
/// @param laser label of the scanner on the robot.
/// @param settings configuration of icp-slam, a file in doc/examples/slam.
/// @param folder for output files of the tools.
/// @throws std::runtime_error with the tools' output when one of them fails or loses a scan.
PathError icpSlamError(const std::filesystem::path& rawlog, const std::string& robot, const std::string& laser,
                       const std::string& settings, const std::filesystem::path& folder);

}  // namespace robosim
