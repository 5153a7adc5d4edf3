#include "arcos/protocol/bumpers.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/wrap2pi.h>

namespace robosim::arcos {

BumperPlace bumperAt(double direction_rad, const Parameters& parameters) {
  const double from_left_rad = mrpt::math::wrapTo2Pi(M_PI_2 - direction_rad);
  const bool is_front = from_left_rad <= M_PI;
  const int count = is_front ? parameters.front_bumpers : parameters.rear_bumpers;
  if (count == 0) return {is_front, 0};
  const double along = (is_front ? from_left_rad : from_left_rad - M_PI) / M_PI;
  return {is_front, static_cast<std::uint8_t>(2u << std::min(static_cast<int>(along * count), count - 1))};
}

}  // namespace robosim::arcos
