#include "base/portable_pose.h"

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"

namespace robosim::portable {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

TPoint2D compose(const TPose2D& a_from_b, const TPoint2D& in_b) {
  const auto [sin, cos] = sincos(a_from_b.phi);
  return {a_from_b.x + cos * in_b.x - sin * in_b.y, a_from_b.y + sin * in_b.x + cos * in_b.y};
}

TPose2D compose(const TPose2D& a_from_b, const TPose2D& b_from_c) {
  const TPoint2D origin = compose(a_from_b, TPoint2D(b_from_c.x, b_from_c.y));
  return {origin.x, origin.y, mrpt::math::wrapToPi(a_from_b.phi + b_from_c.phi)};
}

TPose2D relative(const TPose2D& a_from_b, const TPose2D& a_from_c) {
  const auto [sin, cos] = sincos(a_from_b.phi);
  const double x = a_from_c.x - a_from_b.x;
  const double y = a_from_c.y - a_from_b.y;
  return {cos * x + sin * y, cos * y - sin * x, mrpt::math::wrapToPi(a_from_c.phi - a_from_b.phi)};
}

}  // namespace robosim::portable
