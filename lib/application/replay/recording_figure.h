#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include "base/label.h"
#include "rendering/drawn_run.h"
#include "rendering/figure_page.h"
#include "rendering/picture_format.h"
#include "robots/fleet.h"
#include "robots/robot_selection.h"
#include "robots/view_layers.h"
#include "run/outputs/run_note.h"

namespace robosim {

/// Collects the trajectories and events of a recording, and draws them on the plan of its world. Trajectories are
/// ground truth, or else odometry. In a recording by another program they are drawn without a world, and without
/// events.
class RecordingFigure {
 public:
  static constexpr double kFarthest_m =
      1e6;  ///< poses beyond are not shown; those of a run are within a world's bounds
  static constexpr double kUnknownRadius_m = 0.2;  ///< of robots of other programs

  /// @param rawlog its name, for errors and the title
  explicit RecordingFigure(std::string rawlog) : rawlog_(std::move(rawlog)) {}

  /// Sets the run of a recording by RoboSim; to be called before the robots' observations are added.
  /// @throws ConfigError when this program cannot read its world, such as without a plugin
  void setRun(const RunNote& note);
  /// Adds the next observation. @param time_s since the first one
  /// @throws RecordingError for an observation that a recording by RoboSim cannot have
  void add(const mrpt::obs::CObservation& observation, double time_s);
  /// A comment, which may say where objects are. @throws ConfigError for an invalid one
  void addComment(const std::string& text);

  /// @return the file @throws ConfigError for a recording without poses, and for a selection without a robot
  /// @param layers of which the sensors have no effect @param only the robots that are drawn
  std::string draw(PictureFormat format, const FigurePage& page = {}, ViewLayers layers = {},
                   const RobotSelection& only = {}) const;

 private:
  /// Poses and events of a robot.
  struct Robot {
    std::string name;
    bool has_truth = false;  ///< whether the poses are ground truth
    std::vector<mrpt::math::TPoint2D> path;
    std::vector<double> path_times_s;         ///< of the points of the path
    std::optional<mrpt::math::TPose2D> pose;  ///< the last one; nullopt while the robot is absent
    double time_s = 0;                        ///< of that pose
  };

  static void addPoint(Robot& robot, const mrpt::math::TPoint2D& at);
  std::size_t robotNamed(const std::string& name);
  void addPose(std::size_t robot, const mrpt::math::TPose2D& pose, bool is_truth, double time_s);
  static void leave(Robot& robot);
  void addStatus(std::size_t robot, const mrpt::obs::CObservation& observation, double time_s);
  void addMessages(const std::string& receiver, const mrpt::obs::CObservation& observation, double time_s);
  std::optional<mrpt::math::TPoint2D> placeOf(std::size_t robot) const;
  mrpt::math::TPose2D startOfOdometry(const std::string& robot) const;
  LoadedWorld withoutWorld() const;

  std::string rawlog_;
  std::optional<LoadedWorld> world_;  ///< of a recording by RoboSim that contains it
  ChangedObjects objects_;            ///< at the end, instead of those of the world
  bool is_of_robosim_ = false;
  std::vector<Robot> robots_;  ///< in the order of their first appearance
  std::map<std::string, std::size_t> index_of_;
  RunEvents events_;
  double duration_s_ = 0;
};

}  // namespace robosim
