#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"

namespace robosim {

/// @file
/// Writing and reading of the values in a saved state (state_bytes.h), and of those that processes exchange, in the
/// machine's byte order.

/// What is wrong with bytes that StateWriter cannot have written, without where they are from and how to fix it.
struct InvalidContents : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @throws InvalidContents unless the contents are valid
inline void requireContents(bool are_valid, const char* fault) {
  if (!are_valid) throw InvalidContents(fault);
}

/// Appends values to bytes.
class StateWriter {
 public:
  template <typename T>
  void addNumber(T value) {
    static_assert(std::is_arithmetic_v<T>);
    addBytes(&value, sizeof value);
  }
  void addPose(const mrpt::math::TPose2D& pose) {
    for (const double value : {pose.x, pose.y, pose.phi}) addNumber(value);
  }
  void addText(const std::string& text) {
    addNumber(static_cast<std::uint32_t>(text.size()));
    addBytes(text.data(), text.size());
  }
  void addBytes(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }

  std::string bytes;
};

/// Takes values from bytes. Every function throws InvalidContents when too few bytes are left or a value is invalid.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : left_(bytes) {}

  template <typename T>
  T takeNumber() {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    T value;
    std::memcpy(&value, takeBytes(sizeof value).data(), sizeof value);
    return value;
  }
  bool takeFlag() {
    const auto value = takeNumber<std::uint8_t>();
    requireContents(value <= 1, "a flag is neither 0 nor 1");
    return value != 0;
  }
  double takeFinite() {
    const auto value = takeNumber<double>();
    requireContents(std::isfinite(value), "a number is not finite");
    return value;
  }
  mrpt::math::TPose2D takePose() {
    const double x = takeFinite(), y = takeFinite(), phi = takeFinite();
    return {x, y, phi};
  }
  Activity takeActivity() {
    const auto value = takeNumber<std::uint8_t>();
    requireContents(value <= static_cast<std::uint8_t>(Activity::absent), "an activity is unknown");
    return static_cast<Activity>(value);
  }
  std::string takeText(std::size_t bytes_max) {
    const auto size = takeNumber<std::uint32_t>();
    requireContents(size <= bytes_max, "a text is too long");
    return std::string(takeBytes(size));
  }
  std::string_view takeBytes(std::size_t size) {
    requireContents(size <= left_.size(), "they end too early");
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }
  bool isAtEnd() const { return left_.empty(); }

 private:
  std::string_view left_;
};

}  // namespace robosim
