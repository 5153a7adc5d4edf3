#pragma once
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"

namespace robosim {

struct Registration {
  std::vector<mrpt::math::TPose2D> start_from_robot;  ///< at each scan; the first one is the origin
  double residual_m = 0;                              ///< RMS of points from the surfaces of other scans
};

/// Offline SLAM: aligns all scans of a drive with each other (F. Lu, E. Milios, "Globally consistent range scan
/// alignment for environment mapping", Autonomous Robots 4, 1997). Each scan is first aligned with the scans before it,
/// from the pose that the odometry predicts. Then all poses are computed together, by weighted least squares of the
/// distances of points from the surfaces of scans that are near in time or in space, with correspondences that are
/// searched again in each iteration (point-to-line distances: Censi, ICRA 2008; weights of Cauchy's distribution).
/// A scan of which many points contradict the scans next to it, such as one of a tilted robot, is aligned once more
/// from the pose that the odometry predicts.
Registration registerScans(const ScanSeries& series);

}  // namespace robosim
