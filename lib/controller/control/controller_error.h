#pragma once
#include <stdexcept>
#include <string>

namespace robosim {

/// An exception of a controller.
class ControllerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// To be called in a catch block: replaces the exception of a controller's code, of any type, by a ControllerError.
/// @param controller its choice, @param robot name of its robot
[[noreturn]] void throwControllerError(const std::string& controller, const std::string& robot);

}  // namespace robosim
