#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "environment/state.h"
#include "hardware/robot_info.h"
#include "robots/fleet.h"

namespace robosim {

/// A part of an agent's observation.
struct ObservationPart {
  std::string name;        ///< as in BatchOptions::observations
  std::size_t slot = 0;    ///< of the robot's measurements; kStalled, kPose
  std::size_t size = 0;    ///< number of values
  std::vector<float> low;  ///< bounds of the values; infinite where there are none
  std::vector<float> high;
  /// Of a ray-cast camera, whose pictures are no part of the vector of numbers (EnvironmentBatch::writePictures()).
  std::optional<CameraInfo> picture = {};
  double range_max_m = 0;  ///< of its depths
  bool operator==(const ObservationPart&) const = default;

  static constexpr std::size_t kStalled = ~std::size_t{0};
  static constexpr std::size_t kPose = kStalled - 1;
};

/// A part of observations that is a picture.
struct ObservedPicture {
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::string name;  ///< as in BatchOptions::observations
  CameraInfo camera;
  double range_max_m = 0;          ///< of its depths
  std::vector<std::size_t> slots;  ///< by agent: of its measurements; kNone for an agent that does not have it
};

/// Converts readings to an observation: a vector of numbers, of the parts in their order. A part that names a sensor
/// has the numbers of its kind's Description (hardware/measurement.h), record by record, in their units and bounds; of
/// echoes the ranges only. For the kinds of RoboSim these are
///  * sonar, laser, lidar, infrared: range of each beam [m]; no_echo_m without an echo
///  * heat, compass, battery: the value [°C, rad, V]
///  * bumper: 0 or 1 for each segment
///  * odometry: x, y [m], heading [rad], speed [m/s], turn rate [rad/s]
///  * beacons: range to each [m]
///  * blob_finder: area, centroid, and bounding box of the region of each colour [pixels]; 0 in a step without a
///  picture
///  * values: each quantity
/// A ray-cast camera has no numbers: its part has the size 0 and its picture's form.
///
/// Further parts are
///  * stalled: 0 or 1
///  * pose: x, y [m] and heading [rad], world frame; the true pose, which no real robot knows
class ObservationLayout {
 public:
  /// The layout of each robot of a team. Each part must be one that at least one of them has; the others leave it out.
  /// @throws ConfigError for a part that none has, and for a robot with none
  static std::vector<ObservationLayout> ofTeam(std::span<const FleetRobot> robots,
                                               const std::vector<std::string>& names);
  /// Of the named parts, those that the robot has.
  static ObservationLayout ofPresent(const RobotInfo& robot, const std::vector<std::string>& names);
  /// @throws ConfigError for a part that the robot does not have, such as an unknown name, and a camera that is not
  /// ray-cast
  ObservationLayout(const RobotInfo& robot, const std::vector<std::string>& names);

  std::span<const ObservationPart> parts() const { return parts_; }
  std::size_t size() const { return size_; }
  /// Whether observations have the same parts of the same size and bounds, measured by the same sensors.
  bool isCompatible(const ObservationLayout& other) const;
  /// Writes the observation of a robot. @param out of size()
  void write(const State& state, std::size_t robot, std::span<float> out) const;

 private:
  std::vector<ObservationPart> parts_;
  std::size_t size_ = 0;
};

}  // namespace robosim
