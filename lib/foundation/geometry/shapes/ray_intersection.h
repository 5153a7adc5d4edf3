#pragma once
#include <cmath>
#include <limits>

namespace robosim {

/// A slope of 0 is replaced by kMinFaceSlope, so that a ray parallel to a pair of the box's faces stays between them
/// forever or never enters. The faces are moved outwards by kMinFaceGap_m, so that a ray along a face counts as inside.
/// Neither changes any other result.
///@{
constexpr double kMinFaceSlope = 1e-300;
constexpr double kMinFaceGap_m = 1e-280;  ///< over kMinFaceSlope it is 1e20 m
///@}

/// @name Distance at which a planar ray enters an outline
/// Distance [m] from the ray's origin; 0 from inside, infinity for a miss. (ox, oy) leads from the ray's origin to the
/// outline's centre; (dx, dy) is the ray's direction, a unit vector. Single rays and batches share these formulas, so
/// that both give bit-identical results. Branch-free, so that loops over rays are vectorised.
///@{
inline double intersectCircle(double ox, double oy, double dx, double dy, double radius) {
  const double along = dx * ox + dy * oy;
  const double across = dx * oy - dy * ox;
  // Computed from the foot of the perpendicular from the centre: more accurate for far circles than the textbook's b² -
  // 4ac.
  const double half = std::sqrt(radius * radius - across * across);  // NaN when the ray misses
  const double near = along - half > 0 ? along - half : 0.0;
  return along + half >= 0 ? near : std::numeric_limits<double>::infinity();
}

/// @param ux,uy unit vector along the box's length
inline double intersectBox(double ox, double oy, double dx, double dy, double ux, double uy, double half_length,
                           double half_width) {
  // The ray in the box's frame, and its interval between each pair of faces (slab method).
  const double a = -(ox * ux + oy * uy);
  const double b = -(oy * ux - ox * uy);
  const double slope_a = dx * ux + dy * uy;
  const double slope_b = dy * ux - dx * uy;
  const double per_a = 1 / (slope_a == 0 ? kMinFaceSlope : slope_a);
  const double per_b = 1 / (slope_b == 0 ? kMinFaceSlope : slope_b);
  const double a1 = (-half_length - a - kMinFaceGap_m) * per_a;
  const double a2 = (half_length - a + kMinFaceGap_m) * per_a;
  const double b1 = (-half_width - b - kMinFaceGap_m) * per_b;
  const double b2 = (half_width - b + kMinFaceGap_m) * per_b;
  const double a_from = a1 < a2 ? a1 : a2;
  const double b_from = b1 < b2 ? b1 : b2;
  // The comparison is inverted on purpose: g++ compiles two selections with the same condition to a branch, but one to
  // a minimum or maximum.
  const double a_to = a2 < a1 ? a1 : a2;
  const double b_to = b2 < b1 ? b1 : b2;
  const double from = a_from > b_from ? a_from : b_from;
  const double to = a_to < b_to ? a_to : b_to;
  const double near = from > 0 ? from : 0.0;
  return near <= to ? near : std::numeric_limits<double>::infinity();
}
///@}

}  // namespace robosim
