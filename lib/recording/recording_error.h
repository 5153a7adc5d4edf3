#pragma once
#include <stdexcept>
#include <string>

namespace robosim {

/// A recording cannot be written on, or holds something other than what was asked of it: what, where, and the mend.
class RecordingError : public std::runtime_error {
 public:
  explicit RecordingError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace robosim
