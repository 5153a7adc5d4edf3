#include "tests/stock_tools.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <mrpt/core/Clock.h>
#include <mrpt/core/exceptions.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/wait.h>

#include "recording/observation_writer.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation;

std::string contentOf(const fs::path& file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

void mustRun(const std::string& command, const fs::path& folder) {
  const ToolRun run = runTool(command, folder);
  if (run.exit_code == 0) return;
  throw std::runtime_error(command + " ended with " + std::to_string(run.exit_code) + ":\n" + run.output);
}

std::map<mrpt::Clock::time_point, TPose2D> groundTruthOf(const fs::path& rawlog, const std::string& robot) {
  std::map<mrpt::Clock::time_point, TPose2D> truth;
  forEachObservation(rawlog, [&](const CObservation::Ptr& observation) {
    if (observation->sensorLabel != robot + "/GROUND_TRUTH") return;
    const auto& pose = dynamic_cast<const mrpt::obs::CObservationRobotPose&>(*observation).pose.mean;
    truth[observation->timestamp] = {pose.x(), pose.y(), pose.yaw()};
  });
  return truth;
}

/// icp-slam's log_estimated_path.txt: a line "entry x y phi" for each entry of the rawlog.
std::vector<TPose2D> estimatedPath(const fs::path& file) {
  std::vector<TPose2D> path;
  std::ifstream lines(file);
  std::size_t entry = 0;
  for (TPose2D pose; lines >> entry >> pose.x >> pose.y >> pose.phi;) path.push_back(pose);
  return path;
}

}  // namespace

ToolRun runTool(const std::string& command, const fs::path& folder) {
  const fs::path output = folder / "output.txt";
  const std::string shell =
      "cd '" + folder.string() + "' && { " + command + "; } </dev/null >'" + output.string() + "' 2>&1";
  const int status = std::system(shell.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentOf(output)};
}

void forEachObservation(const fs::path& rawlog, const std::function<void(const CObservation::Ptr&)>& see) {
  mrpt::io::CFileGZInputStream file;
  if (!file.open(rawlog.string())) throw std::runtime_error("cannot open " + rawlog.string());
  auto archive = mrpt::serialization::archiveFrom(file);
  try {
    for (;;) see(archive.ReadObject<CObservation>());
  } catch (const mrpt::serialization::CExceptionEOF&) {
  }
}

PathError icpSlamError(const fs::path& rawlog, const std::string& robot, const std::string& laser,
                       const std::string& settings, const fs::path& folder) {
  const std::string laser_label = robot + "/" + laser;
  const std::string ini = ROBOSIM_SOURCE_DIR "/doc/examples/slam/" + settings;
  fs::create_directories(folder);
  ObservationWriter selected(folder / "slam.rawlog", {});
  forEachObservation(rawlog, [&](const CObservation::Ptr& observation) {
    const std::string& label = observation->sensorLabel;
    if (label == laser_label || label == robot + "/odometry") selected.write(*observation);
  });
  selected.commit();
  mustRun("icp-slam '" + ini + "' slam.rawlog", folder);

  const auto truth = groundTruthOf(rawlog, robot);
  const auto path = estimatedPath(folder / "icp-slam" / "log_estimated_path.txt");
  PathError error;
  std::size_t entry = 0;
  double sum_m2 = 0, odometry_sum_m2 = 0;
  TPose2D odom_from_robot;
  const auto distance = [&](const TPose2D& start_from_robot, const TPose2D& true_pose) {
    const TPose2D world_from_robot = truth.begin()->second + start_from_robot;
    return std::hypot(world_from_robot.x - true_pose.x, world_from_robot.y - true_pose.y);
  };
  forEachObservation(folder / "slam.rawlog", [&](const CObservation::Ptr& observation) {
    const std::size_t i = entry++;
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get())) {
      odom_from_robot = odometry->odometry.asTPose();
    }
    if (observation->sensorLabel != laser_label) return;
    if (i >= path.size()) throw std::runtime_error("icp-slam ended before entry " + std::to_string(i));
    const TPose2D& true_pose = truth.at(observation->timestamp);
    const double off_m = distance(path[i], true_pose);
    odometry_sum_m2 += std::pow(distance(odom_from_robot, true_pose), 2);
    if (!std::isfinite(off_m)) throw std::runtime_error("icp-slam lost itself at entry " + std::to_string(i));
    sum_m2 += off_m * off_m;
    error.worst_m = std::max(error.worst_m, off_m);
    ++error.poses;
  });
  if (error.poses == 0) throw std::runtime_error(rawlog.string() + " has no scan of " + laser_label);
  error.rms_m = std::sqrt(sum_m2 / static_cast<double>(error.poses));
  error.odometry_rms_m = std::sqrt(odometry_sum_m2 / static_cast<double>(error.poses));
  return error;
}

}  // namespace robosim
