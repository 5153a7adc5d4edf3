#pragma once
#include <functional>
#include <memory>
#include <string>

#include "arcos/client/arcos_hardware.h"
#include "remote/joystick.h"

namespace robosim {

/// A joystick of this computer (Linux: /dev/input/jsN), by mrpt::hwdrivers::CJoystick. Supports hot-plugging.
/// @param number of the joystick, 0 for the first
std::unique_ptr<Joystick> openJoystick(int number);

/// A SICK LMS200 at a serial line of this computer, by MRPT's driver: 181 beams over 180°, in millimetres. Scans are
/// received by a thread. When the scanner fails, the log states it, and there is no scan any more.
/// @param device "/dev/ttyUSB1" @param log takes one line; also called by the thread
/// @throws RobotLinkError when the scanner does not answer
std::unique_ptr<ScanSource> openSickLaser(const std::string& device, std::function<void(const std::string&)> log);

}  // namespace robosim

/// @name The same for dlsym(). The caller owns the result.
///@{
extern "C" robosim::Joystick* robosimOpenJoystick(int number);
extern "C" robosim::ScanSource* robosimOpenSickLaser(const std::string& device,
                                                     std::function<void(const std::string&)> log);
///@}
