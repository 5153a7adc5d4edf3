#include "arcos/board/serial_camera.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"

namespace robosim {
namespace {

namespace vcc4 = arcos::vcc4;
namespace visca = arcos::visca;

/// An angle in units. @param rad to the left for pan, and so negative
int inUnits(double rad, double unit_deg) { return static_cast<int>(std::lround(rad / kRadPerDeg / unit_deg)); }

}  // namespace

void SerialCamera::startSession() {
  reader_ = {};
  is_on_ = true;
  is_controlled_ = false;
  pan_radps_ = tilt_radps_ = 0;
  robot_.limitCameraSpeed(0, 0);
}

std::string SerialCamera::receive(std::string_view bytes) {
  std::string answers;
  if (!robot_.cameraHead()) return answers;
  reader_.add(bytes);
  while (const auto message = reader_.next()) {
    if (const auto of_vcc4 = vcc4::decode(*message)) {
      std::string digits;
      const vcc4::Error error = execute(*of_vcc4, digits);
      answers += vcc4::encodeAnswer(error, digits);
    } else if (const auto of_visca = visca::decode(*message)) {
      answers += execute(*of_visca);
    }
  }
  return answers;
}

vcc4::Error SerialCamera::execute(const vcc4::Command& command, std::string& digits) {
  using vcc4::Error;
  const std::string_view parameters = command.parameters;
  if (command.id == vcc4::command::power) {
    is_on_ = parameters != "0";
    if (!is_on_) robot_.stopCamera();
    return Error::none;
  }
  if (!is_on_) return Error::mode;
  if (command.id == vcc4::command::control) {
    is_controlled_ = parameters == "0";
    return Error::none;
  }
  if (!is_controlled_) return Error::mode;
  const CameraAim aim = robot_.cameraAim();
  const auto number = vcc4::numberOf(parameters);
  switch (command.id) {
    case vcc4::command::pan_speed:
    case vcc4::command::tilt_speed:
      if (!number || parameters.size() != 3) return Error::parameter;
      (command.id == vcc4::command::pan_speed ? pan_radps_ : tilt_radps_) = *number * vcc4::kUnit_deg * kRadPerDeg;
      robot_.limitCameraSpeed(pan_radps_, tilt_radps_);
      return Error::none;
    case vcc4::command::stop:
      stopTurning();
      return Error::none;
    case vcc4::command::init:
      robot_.aimCamera(0, 0);
      return Error::none;
    case vcc4::command::turn_to: {
      const auto pan = vcc4::numberOf(parameters.substr(0, 4));
      const auto tilt = vcc4::numberOf(parameters.substr(std::min<std::size_t>(4, parameters.size())));
      if (!pan || !tilt || parameters.size() != 8) return Error::parameter;
      robot_.aimCamera(-(*pan - vcc4::kZero) * vcc4::kUnit_deg * kRadPerDeg,
                       (*tilt - vcc4::kZero) * vcc4::kUnit_deg * kRadPerDeg);
      return Error::none;
    }
    case vcc4::command::direction_request:
      digits = vcc4::hexadecimal(vcc4::kZero - inUnits(aim.pan_rad, vcc4::kUnit_deg), 4) +
               vcc4::hexadecimal(vcc4::kZero + inUnits(aim.tilt_rad, vcc4::kUnit_deg), 4);
      return Error::none;
    case vcc4::command::zoom_stop:
      if (parameters == "0") stopZooming();
      return Error::none;
    case vcc4::command::zoom_to:
      if (!number || parameters.size() != 4 || *number > vcc4::kZoomMax) return Error::parameter;
      robot_.zoomCamera(zoomAt(*number, vcc4::kZoomMax));
      return Error::none;
    case vcc4::command::zoom_request:
      digits = vcc4::hexadecimal(parameters == "1" ? vcc4::kZoomMax : zoomPosition(vcc4::kZoomMax), 4);
      return Error::none;
    default:
      return Error::none;  // of what is not simulated: ranges, focus, lamps, filters
  }
}

std::string SerialCamera::execute(const visca::Command& command) {
  switch (command.kind) {
    case visca::Kind::turn_to:
      robot_.aimCamera(-command.pan * visca::kPanUnit_deg * kRadPerDeg,
                       command.tilt * visca::kTiltUnit_deg * kRadPerDeg);
      break;
    case visca::Kind::turn_home:
      robot_.aimCamera(0, 0);
      break;
    case visca::Kind::turn_stop:
      stopTurning();
      break;
    case visca::Kind::zoom_to:
      robot_.zoomCamera(zoomAt(command.zoom, visca::kZoomMax));
      break;
    case visca::Kind::zoom_stop:
      stopZooming();
      break;
    case visca::Kind::direction_request: {
      const CameraAim aim = robot_.cameraAim();
      return visca::encodeDirection(-inUnits(aim.pan_rad, visca::kPanUnit_deg),
                                    inUnits(aim.tilt_rad, visca::kTiltUnit_deg));
    }
    case visca::Kind::zoom_request:
      return visca::encodeZoomPosition(zoomPosition(visca::kZoomMax));
    case visca::Kind::other:
      break;
  }
  return visca::encodeDone();
}

void SerialCamera::stopTurning() {
  const CameraAim aim = robot_.cameraAim();
  robot_.aimCamera(aim.pan_rad, aim.tilt_rad);
}

double SerialCamera::zoomAt(int position, int position_max) const {
  const double share = std::clamp(position, 0, position_max) / static_cast<double>(position_max);
  return 1 + share * (robot_.cameraHead()->zoom_max - 1);
}

int SerialCamera::zoomPosition(int position_max) const {
  const double range = robot_.cameraHead()->zoom_max - 1;
  if (range <= 0) return 0;
  return static_cast<int>(std::lround((robot_.cameraAim().zoom - 1) / range * position_max));
}

}  // namespace robosim
