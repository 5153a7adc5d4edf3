#pragma once
#include <bit>
#include <cstdint>

namespace robosim {

/// The range that a lidar reads, in single precision rounded to three bits less: within 5.4e-7 of the range (half a
/// unit of the last place of a float, and four of them). The point of an echo in single precision then determines its
/// range exactly, so that recordings need not store both.
inline float roundedLidarRange(double range_m) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(range_m));
  return std::bit_cast<float>((bits + 4u) & ~7u);  // infinity remains
}

}  // namespace robosim
