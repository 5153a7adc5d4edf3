#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

/// Composition of planar poses with bit-identical results on every processor (base/portable_math.h): MRPT's operators
/// call libm, and its library may be compiled with fused multiply-add. Headings of results lie within [-π, π].
namespace robosim::portable {

/// a_from_c: MRPT's `a_from_b + b_from_c`.
mrpt::math::TPose2D compose(const mrpt::math::TPose2D& a_from_b, const mrpt::math::TPose2D& b_from_c);
/// The point in frame a: MRPT's `a_from_b.composePoint(in_b)`.
mrpt::math::TPoint2D compose(const mrpt::math::TPose2D& a_from_b, const mrpt::math::TPoint2D& in_b);
/// b_from_c: MRPT's `a_from_c - a_from_b`.
mrpt::math::TPose2D relative(const mrpt::math::TPose2D& a_from_b, const mrpt::math::TPose2D& a_from_c);
/// b_from_a.
inline mrpt::math::TPose2D inverse(const mrpt::math::TPose2D& a_from_b) { return relative(a_from_b, {}); }

}  // namespace robosim::portable
