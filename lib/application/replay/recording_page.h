#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/sensor_info.h"
#include "recording/robot_status_record.h"
#include "robots/fleet.h"
#include "robots/robot_selection.h"
#include "robots/view_layers.h"
#include "robots/world_source.h"
#include "run/outputs/run_note.h"
#include "run_page/run_page.h"

namespace robosim {

/// Collects a recording for the page of its run. Poses are ground truth, or else odometry, as in RecordingFigure. The
/// moments are the times of the recording: in a recording by RoboSim, the time steps. In a recording by another program
/// there is neither a world nor states of robots.
class RecordingPage {
 public:
  /// @param recording its name, for errors and the title
  /// @param layers that the page shows at first: paths, names, events @param only robots that it contains
  explicit RecordingPage(std::string recording, const ViewLayers& layers = {}, RobotSelection only = {});

  /// Sets the run of a recording by RoboSim; to be called before the robots' observations are added.
  /// @throws ConfigError when this program cannot read its world, such as without a plugin
  void setRun(const RunNote& note);
  /// Adds the next observation.
  /// @param time_s since the first one @param sensor its description (RecordedSensors); null if unknown
  /// @throws RecordingError for an observation that a recording by RoboSim cannot have
  void add(const mrpt::obs::CObservation& observation, double time_s, const SensorInfo* sensor);
  /// A comment, which may change objects, add a robot, or be the final note. @throws ConfigError for an invalid one
  void addComment(const std::string& text);
  void addRemark(const std::string& text) { page_.addRemark(text); }

  /// @param progress as of RunPage::html()
  /// @throws ConfigError for a recording without observations, and for a name of `only` without a robot
  std::string html(const std::function<void(const std::string&)>& progress);
  /// The data of the page, instead.
  std::vector<PageBlock> blocks(const std::function<void(const std::string&)>& progress);

 private:
  struct Robot {
    bool has_truth = false;
    bool is_absent = false;
    std::optional<mrpt::math::TPose2D> pose;  ///< the last one
    double time_s = 0;                        ///< of that pose
    mrpt::math::TPose2D start_of_odometry;
  };

  void finish();
  /// Its index in the page; nullopt for one that is left out.
  std::optional<std::size_t> robotNamed(const std::string& name);
  std::optional<std::size_t> addRobot(FleetRobot robot);
  void addPose(std::size_t robot, const mrpt::math::TPose2D& pose, bool is_truth, double time_s);
  void addStatus(std::size_t robot, const mrpt::obs::CObservation& observation);
  void addMessages(std::size_t receiver, const mrpt::obs::CObservation& observation);
  void addReadings(std::size_t robot, const std::string& sensor, const mrpt::obs::CObservation& observation,
                   const SensorInfo* info);

  std::string recording_;
  RunPage page_;
  RobotSelection only_;
  Fleet fleet_;  ///< all robots of the recording
  std::optional<LoadedWorld> world_;
  ChangedObjects objects_;
  bool is_of_robosim_ = false, goes_back_ = false;
  std::vector<Robot> robots_;
  std::map<std::string, std::optional<std::size_t>> index_of_;  ///< as robotNamed()
  std::optional<double> time_s_;                                ///< of the last observation
  /// Messages of the present moment: sender and text, with the receivers.
  std::map<std::pair<std::size_t, std::string>, std::vector<std::string>> messages_;
  void writeMessages();
};

}  // namespace robosim
