#include "remote/joystick.h"

// First: the next header's class has another size without it.
#include <mrpt/config.h>
#include <mrpt/hwdrivers/CJoystick.h>

namespace robosim {

struct Joystick::Impl {
  int number;
  mrpt::hwdrivers::CJoystick driver{};
};

Joystick::Joystick(int number) : impl_(std::make_unique<Impl>(Impl{number})) {}
Joystick::~Joystick() = default;

std::optional<StickState> Joystick::read() {
  StickState state;
  float x = 0;
  float y = 0;
  float z = 0;
  if (!impl_->driver.getJoystickPosition(impl_->number, x, y, z, state.buttons)) return std::nullopt;
  state.x = x;
  state.y = y;
  return state;
}

}  // namespace robosim
