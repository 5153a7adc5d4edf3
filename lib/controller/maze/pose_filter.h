#pragma once
#include <array>
#include <cstddef>

#include <mrpt/math/TPose2D.h>

namespace robosim {

/// Extended Kalman filter (Thrun, Burgard & Fox, *Probabilistic Robotics*, 2005, § 3.3) of a robot's pose, which also
/// estimates the systematic errors of its odometry (scale of turns, curvature of a straight path) and the deviation of
/// its compass, A + B sin ψ + C cos ψ + D sin 2ψ + E cos 2ψ (Bowditch, *The American Practical Navigator*), with ψ the
/// reading. Frame `start`: the pose is (0, 0, 0) at first, without error.
class PoseFilter {
 public:
  /// @param map_from_start pose at first, for another frame than `start`
  explicit PoseFilter(const mrpt::math::TPose2D& map_from_start = {});

  const mrpt::math::TPose2D& startFromRobot() const { return pose_; }
  /// Adds a motion that the odometry measured.
  void move(const mrpt::math::TPose2D& before_from_after);
  /// Adds a reading of the compass [rad].
  void turnTo(double compass_rad);
  /// Adds a measurement of how far the pose is off along x, y [m] and phi [rad]: `off` ≈ slope · error.
  void correct(const std::array<double, 3>& slope, double off, double std);

 private:
  enum State : std::size_t { kX, kY, kPhi, kTurnScale, kCurvature, kA, kB, kC, kD, kE, kStates };
  using Row = std::array<double, kStates>;

  void measure(const Row& slope, double off, double std);

  mrpt::math::TPose2D pose_;
  Row state_{};  ///< its first three are in pose_
  std::array<Row, kStates> covariance_{};
  bool has_compass_ = false;
};

}  // namespace robosim
