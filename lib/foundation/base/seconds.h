#pragma once
#include <chrono>
#include <cstdint>

namespace robosim {

/// The one conversion between durations of clocks and numbers of seconds.
using Seconds = std::chrono::duration<double>;

constexpr double toSeconds(Seconds duration) { return duration.count(); }

/// @return rounded towards zero to whole ticks
constexpr std::chrono::steady_clock::duration fromSeconds(double duration_s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(Seconds(duration_s));
}

/// @return [s]
inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return toSeconds(std::chrono::steady_clock::now() - start);
}

/// @return rounded towards zero
constexpr std::int64_t wholeMilliseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

}  // namespace robosim
