#pragma once
#include <string>
#include <string_view>

#include "arcos/protocol/camera_messages.h"
#include "control/robot.h"

namespace robosim {

/// A camera that pans, tilts and zooms at a serial port of the robot's board, simulated: executes the messages of a
/// program on the Robot. It understands those of a Canon VC-C4 and VISCA, whatever the robot's camera is. Angles beyond
/// the limits of its head are limited to these.
class SerialCamera {
 public:
  /// @param robot must outlive this
  explicit SerialCamera(Robot& robot) : robot_(robot) {}

  /// State at the start of a session: on, and a VC-C4 not controlled by the program; its speeds are the head's.
  void startSession();
  /// Executes messages, or a part of one. @return the camera's answers; none for a robot without such a camera
  std::string receive(std::string_view bytes);

 private:
  arcos::vcc4::Error execute(const arcos::vcc4::Command& command, std::string& digits);
  std::string execute(const arcos::visca::Command& command);
  void stopTurning();
  void stopZooming() { robot_.zoomCamera(robot_.cameraAim().zoom); }
  /// The zoom at a position of [0, position_max], in which it is linear, and the inverse.
  double zoomAt(int position, int position_max) const;
  int zoomPosition(int position_max) const;

  Robot& robot_;
  arcos::CameraMessageReader reader_;
  bool is_on_ = true;
  bool is_controlled_ = false;  ///< a VC-C4: by the program
  double pan_radps_ = 0, tilt_radps_ = 0;
};

}  // namespace robosim
