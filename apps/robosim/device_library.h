#pragma once
#include <functional>
#include <memory>
#include <string>

#include "arcos/client/arcos_hardware.h"
#include "remote/joystick.h"

namespace robosim {

/// @name openJoystick() and openSickLaser() of devices/devices.h, in a library that is loaded when they are called
/// @throws ConfigError when this installation lacks the library
///@{
std::unique_ptr<Joystick> loadJoystick(int number);
std::unique_ptr<ScanSource> loadSickLaser(const std::string& device, std::function<void(const std::string&)> log);
///@}

}  // namespace robosim
