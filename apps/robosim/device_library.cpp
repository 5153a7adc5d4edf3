#include "robosim/device_library.h"

#include <utility>

#include "base/error_list.h"
#include "base/loaded_function.h"
#include "devices/devices.h"

namespace robosim {
namespace {

template <typename Function>
Function functionForDevice(const char* name, const std::string& option, const std::string& without) {
  try {
    return loadedFunction<Function>("librobosim-devices.so." ROBOSIM_SOVERSION, name);
  } catch (const std::exception& error) {
    throw ConfigError(
        option + ": this installation has no drivers for joysticks and serial laser scanners (" + error.what() +
        "); install RoboSim's Debian packages, or build it, instead of the portable archive; or " + without);
  }
}

}  // namespace

std::unique_ptr<Joystick> loadJoystick(int number) {
  return std::unique_ptr<Joystick>(functionForDevice<decltype(&robosimOpenJoystick)>(
      "robosimOpenJoystick", "--joystick", "drive from the web page, without this option")(number));
}

std::unique_ptr<ScanSource> loadSickLaser(const std::string& device, std::function<void(const std::string&)> log) {
  return std::unique_ptr<ScanSource>(functionForDevice<decltype(&robosimOpenSickLaser)>(
      "robosimOpenSickLaser", "--laser", "drive without a laser scanner")(device, std::move(log)));
}

}  // namespace robosim
