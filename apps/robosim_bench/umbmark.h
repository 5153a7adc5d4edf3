#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "sensors/wheel_errors.h"

namespace robosim {

/// UMBmark, the square-path experiment for odometry (Borenstein & Feng, "Measurement and correction of systematic
/// odometry errors in mobile robots", IEEE Trans. Robotics and Automation 12(6), 1996, sections III and IV).
struct UmbmarkOptions {
  WheelErrors wheels;
  double side_m = 4;  ///< of the square, (0, 100]
  int runs = 5;       ///< in each direction, at least 1
  /// Random errors besides: 2 mm/√m, 2 mrad/√rad and 1 mrad/√m, a tenth of those of <noise/>, so that the ends of the
  /// runs scatter by about a centimetre.
  bool has_noise = true;
  std::uint64_t seed = 1;   ///< of the first run; the others follow
  double speed_mps = 0.4;   ///< along the sides, (0, 1]
  double turn_radps = 0.7;  ///< at the corners, (0, 1.7]
  double period_s = 0.1;
};

/// Errors at the end of the square: the true position minus that of odometry, in the frame of the start [m].
struct UmbmarkErrors {
  std::vector<mrpt::math::TPoint2D> clockwise, counter_clockwise;  ///< one per run
};

/// Lets a robot drive the square by its odometry in an empty world.
UmbmarkErrors driveUmbmark(const UmbmarkOptions&);

/// Results of the experiment, by the equations of the paper.
struct UmbmarkResult {
  mrpt::math::TPoint2D clockwise_m, counter_clockwise_m;  ///< centres of gravity of the errors
  double error_max_m = 0;                                 ///< E_max,syst: distance of the farther centre from the start
  double alpha_rad = 0;                                   ///< by which the robot turns too little at each corner
  double beta_rad = 0;                                    ///< by which it turns to the left along each side
  double curve_radius_m = 0;                              ///< R of the curved sides; infinite for straight ones
  double diameter_ratio = 1;                              ///< E_d
  double wheelbase_ratio = 1;                             ///< E_b
  /// The same without the paper's approximation of small angles, whose error grows with α and β: the α and β with which
  /// squares of exact arcs end nearest to the four coordinates (Gauss–Newton from those of the paper), and E_d of the
  /// actual wheelbase.
  double exact_diameter_ratio = 1;
  double exact_wheelbase_ratio = 1;

  static UmbmarkResult of(const UmbmarkErrors&, double side_m, double wheelbase_m);
};

}  // namespace robosim
