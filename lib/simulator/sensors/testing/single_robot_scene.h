#pragma once
#include <memory>
#include <vector>

#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// Test fixture: a single robot among solids, for testing one sensor.
class SingleRobotScene {
 public:
  /// The robot is a disc of 0.2 m radius, 0.3 m high, at `world_from_robot`.
  explicit SingleRobotScene(const std::vector<Solid>& solids, const mrpt::math::TPose2D& world_from_robot = {0, 0, 0});

  /// The sensor's measurement in the next time step.
  Measurement sense(const Sensor& sensor);
  /// The ranges of a sensor whose measurement is Echoes.
  std::vector<double> ranges(const Sensor& sensor);

  std::vector<HeatSource> heat_sources;
  Motion motion, former_motion;
  double driven_m = 0;
  std::optional<Path> path;  ///< of this step
  float laser_pan_rad = 0;
  Command command;
  std::uint64_t seed = 1;
  ImageSource* images = nullptr;
  std::optional<Bounds2D> surface;
  std::vector<float> reflectivity;  ///< by solid
  const GeoReference* georeference = nullptr;
  mrpt::math::TPose2D world_from_robot;

 private:
  Scene scene_;
  std::vector<Readings> readings_;
  SimTime time_;
};

/// A cylinder or a box on the ground.
Solid pillar(double x_m, double y_m, double radius_m, double height_m = 1);
Solid block(double x_m, double y_m, double length_m, double width_m, double turned_rad = 0, double height_m = 1);

/// Reads a sensor from XML text. @throws ConfigError
std::unique_ptr<Sensor> sensorFrom(const std::string& xml, const Mount& mount = {1, 0.2, 0.3});

}  // namespace robosim
