// Calls that the tests portable.rejects_* must detect: a function of libm, and an MRPT function that calls libm.
#include <cmath>

#include <mrpt/math/TPose2D.h>

double distanceTo(const mrpt::math::TPose2D& pose) { return std::hypot(pose.x, pose.y); }
mrpt::math::TPose2D twice(const mrpt::math::TPose2D& pose) { return pose + pose; }
