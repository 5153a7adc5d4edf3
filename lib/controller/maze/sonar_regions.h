#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "maze/surface_point.h"

namespace robosim {

/// Interprets the readings of a ring of noisy, wide sonars: adjacent sonars that receive the echo of one wall measure
/// the same distance, that of the wall's closest point (regions of constant depth: Leonard & Durrant-Whyte, *Directed
/// Sonar Sensing for Mobile Robot Navigation*, 1992). Such a region becomes one point, at the middle of its directions.
/// A sonar that fires in turn keeps its reading; since noise changes each new one, an unchanged reading is an old one,
/// and its echo stays where it was measured.
class SonarRegions {
 public:
  /// A line of sight. Frame: start.
  struct Ray {
    mrpt::math::TPoint2D from, to;
    bool hit = false;      ///< a surface is at its end
    bool is_sure = false;  ///< several sonars have received its echo
  };

  /// Registers new readings; called once per time step.
  void update(const SensorInfo& sensor, const Echoes& echoes, const mrpt::math::TPose2D& start_from_robot);
  /// Moves what was measured so far, as the pose was corrected.
  void correct(const mrpt::math::TPose2D& start_from_before, const mrpt::math::TPose2D& start_from_now);
  /// Interprets the latest readings of all sonars. Regions of several sonars are added to `surfaces`, in the robot
  /// frame; `rays` gets the lines of sight of the readings since the last call.
  void interpret(const SensorInfo& sensor, const mrpt::math::TPose2D& start_from_robot,
                 std::vector<SurfacePoint>& surfaces);
  const std::vector<Ray>& rays() const { return rays_; }

 private:
  struct Reading {
    mrpt::math::TPoint2D from, direction;  ///< frame start; unit length
    float range_m = -1;
    bool hit = false;
    bool is_new = false;    ///< since the last interpret()
    std::uint32_t age = 0;  ///< steps
  };

  /// What adjacent sonars receive as one echo.
  struct Region {
    double distance_m = 0;  ///< from the robot's centre
    std::size_t sonars = 1;
    mrpt::math::TPoint2D direction;  ///< frame start; unit length
    bool is_new = false;
  };

  void order(const SensorInfo& sensor);

  std::vector<Reading> readings_;
  std::vector<std::size_t> by_bearing_;
  std::vector<Region> regions_;
  std::vector<Ray> rays_;
};

}  // namespace robosim
