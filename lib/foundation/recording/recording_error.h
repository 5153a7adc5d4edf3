#pragma once
#include <stdexcept>
#include <string>

namespace robosim {

/// A recording cannot be written, or does not match the request; the text has the cause, the place, and how to fix it.
class RecordingError : public std::runtime_error {
 public:
  explicit RecordingError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace robosim
