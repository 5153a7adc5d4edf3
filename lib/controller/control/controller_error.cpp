#include "control/controller_error.h"

namespace robosim {

void throwControllerError(const std::string& controller, const std::string& robot) {
  const std::string prefix = "robot '" + robot + "': its controller " + controller + " threw an exception: ";
  try {
    throw;
  } catch (const std::exception& error) {
    throw ControllerError(prefix + error.what());
  } catch (...) {
    throw ControllerError(prefix + "an object that is not a std::exception");
  }
}

}  // namespace robosim
