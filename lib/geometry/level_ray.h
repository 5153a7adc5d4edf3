#pragma once
#include <cmath>
#include <limits>

namespace robosim {

/// A ray along a pair of a box's faces is given a slope so small that it stays between them for ever, or never comes
/// there; and the faces lie so little further out that a ray along a face itself counts as between. Neither changes any
/// other sum.
///@{
constexpr double kLeastFaceSlope = 1e-300;
constexpr double kLeastFaceGap_m = 1e-280;  ///< over kLeastFaceSlope it is 1e20 m
///@}

/// @name Where a level ray enters an outline
/// Distance [m] from the ray's origin, 0 from inside, infinity for a miss. (ox, oy) leads from the ray's origin to the
/// outline's centre; (dx, dy) is the ray's direction, a unit vector. One formula for a ray alone and for rays in a
/// batch, so that both give the same bits; without branches, so that loops over rays become vector instructions.
///@{
inline double enterCircle(double ox, double oy, double dx, double dy, double radius) {
  const double along = dx * ox + dy * oy;
  const double across = dx * oy - dy * ox;
  // From the foot of the centre on the line: more exact for far circles than the textbook's b² - 4ac.
  const double left = radius * radius - across * across;
  const double half = std::sqrt(left > 0 ? left : 0.0);
  const double near = along - half > 0 ? along - half : 0.0;
  return left >= 0 && along + half >= 0 ? near : std::numeric_limits<double>::infinity();
}

/// @param ux,uy unit vector along the box's length
inline double enterBox(double ox, double oy, double dx, double dy, double ux, double uy, double half_length,
                       double half_width) {
  // The ray in the box's own frame, and the stretch of it between each pair of faces.
  const double a = -(ox * ux + oy * uy);
  const double b = -(oy * ux - ox * uy);
  const double slope_a = dx * ux + dy * uy;
  const double slope_b = dy * ux - dx * uy;
  const double per_a = 1 / (slope_a == 0 ? kLeastFaceSlope : slope_a);
  const double per_b = 1 / (slope_b == 0 ? kLeastFaceSlope : slope_b);
  const double a1 = (-half_length - a - kLeastFaceGap_m) * per_a;
  const double a2 = (half_length - a + kLeastFaceGap_m) * per_a;
  const double b1 = (-half_width - b - kLeastFaceGap_m) * per_b;
  const double b2 = (half_width - b + kLeastFaceGap_m) * per_b;
  const double a_from = a1 < a2 ? a1 : a2;
  const double b_from = b1 < b2 ? b1 : b2;
  // Asked the other way round: of two choices by one question g++ makes a branch, of one a minimum or a maximum.
  const double a_to = a2 < a1 ? a1 : a2;
  const double b_to = b2 < b1 ? b1 : b2;
  const double from = a_from > b_from ? a_from : b_from;
  const double to = a_to < b_to ? a_to : b_to;
  const double near = from > 0 ? from : 0.0;
  return near <= to ? near : std::numeric_limits<double>::infinity();
}
///@}

}  // namespace robosim
