#pragma once
#include <limits>

namespace robosim {

/// Unit of a number.
struct Unit {
  const char* suffix;  ///< as it ends a name: "mps" in speed_mps; empty for a number without unit
  const char* symbol;  ///< in texts: "m/s"
};

inline constexpr Unit kNoUnit{"", ""};
inline constexpr Unit kMetre{"m", "m"};
inline constexpr Unit kMetrePerSecond{"mps", "m/s"};
inline constexpr Unit kRadian{"rad", "rad"};
inline constexpr Unit kRadianPerSecond{"radps", "rad/s"};
inline constexpr Unit kPixel{"px", "px"};
inline constexpr Unit kCelsius{"celsius", "°C"};
inline constexpr Unit kVolt{"volt", "V"};

/// Description of one number of a record, known at compile time.
template <typename Get>
struct Field {
  const char* name;  ///< without unit: "range"
  Unit unit;
  Get get;  ///< get(record) returns a reference to the number
  /// Smallest and largest permitted value. Every number must be finite.
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
};

/// clang 14 does not deduce the arguments of aggregates.
template <typename Get>
Field(const char*, Unit, Get, double = 0, double = 0) -> Field<Get>;

/// Returns a reference to a member, or a member of a member, of its argument; without members, to the argument.
template <auto... members>
inline constexpr auto kGet = [](auto& record) -> auto& {
  return (record.*....*members);
};

}  // namespace robosim
