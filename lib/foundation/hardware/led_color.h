#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace robosim {

/// Largest colour of LEDs and lights as a number, 0xRRGGBB: white.
constexpr std::uint32_t kLedColorMax = 0xffffff;

/// A colour as a number, 0xRRGGBB.
/// @param rgb red, green and blue; values beyond [0, 1] are limited to it, and one that is no number is 0
inline std::uint32_t ledColor(const std::array<float, 3>& rgb) {
  std::uint32_t color = 0;
  for (const float channel : rgb) {
    const float share = channel > 0 ? std::min(channel, 1.0f) : 0.0f;
    color = color << 8 | static_cast<std::uint32_t>(std::floor(share * 255 + 0.5f));
  }
  return color;
}

/// Red, green and blue of a colour, each in [0, 1].
inline std::array<float, 3> rgbOf(std::uint32_t color) {
  const auto channel = [&](int shift) { return static_cast<float>(color >> shift & 0xff) / 255; };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace robosim
