#include "devices/devices.h"

// Included first: without it the class of the next header has another size.
#include <mrpt/config.h>
#include <mrpt/hwdrivers/CJoystick.h>

namespace robosim {
namespace {

/// MRPT 2.14 (Debian 13) returns the axes in a struct; 2.5 (Debian 12) has a parameter for each.
template <typename Driver>
std::optional<StickState> readStick(Driver& driver, int number) {
  StickState stick;
  if constexpr (requires { typename Driver::State; }) {
    typename Driver::State state;
    if (!driver.getJoystickPosition(number, state)) return std::nullopt;
    if (state.axes.size() > 0) stick.x = state.axes[0];
    if (state.axes.size() > 1) stick.y = state.axes[1];
    stick.buttons = state.buttons;
  } else {
    float x = 0;
    float y = 0;
    float z = 0;
    if (!driver.getJoystickPosition(number, x, y, z, stick.buttons)) return std::nullopt;
    stick.x = x;
    stick.y = y;
  }
  return stick;
}

class MrptJoystick final : public Joystick {
 public:
  explicit MrptJoystick(int number) : number_(number) {}
  std::optional<StickState> read() override { return readStick(driver_, number_); }

 private:
  int number_;
  mrpt::hwdrivers::CJoystick driver_{};
};

}  // namespace

std::unique_ptr<Joystick> openJoystick(int number) { return std::make_unique<MrptJoystick>(number); }

}  // namespace robosim

robosim::Joystick* robosimOpenJoystick(int number) { return robosim::openJoystick(number).release(); }
