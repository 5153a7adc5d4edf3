#pragma once
#include <array>

namespace robosim {

/// Distortion of a lens, the model of Brown ("Close-range camera calibration", Photogrammetric Engineering 37, 1971)
/// with the coefficients and order of OpenCV and of MRPT's `TCamera` (DistortionModel::plumb_bob). Points are in the
/// picture plane at a distance of 1, x to the right and y down, from the optical axis.
struct LensDistortion {
  double k1 = 0, k2 = 0;  ///< radial
  double p1 = 0, p2 = 0;  ///< tangential
  double k3 = 0;          ///< radial
  bool operator==(const LensDistortion&) const = default;

  struct Point {
    double x = 0, y = 0;
  };
  bool isNone() const { return *this == LensDistortion{}; }
  std::array<double, 5> coefficients() const { return {k1, k2, p1, p2, k3}; }
  /// Where a lens shows what a pinhole shows at `ideal`.
  Point distort(const Point& ideal) const;
  /// The inverse of distort(), by fixed-point iteration. @return false where it does not converge
  bool undistort(const Point& shown, Point& ideal) const;
};

}  // namespace robosim
