#pragma once
#include <string>
#include <string_view>

namespace robosim {

/// @name Parts of labels with a fixed meaning
///@{
inline constexpr const char* kGroundTruth = "GROUND_TRUTH";  ///< sensor: the robot's true pose
inline constexpr const char* kStatus = "STATUS";             ///< sensor: command, stalled, laser pan
inline constexpr const char* kInbox = "INBOX";               ///< sensor: messages from other robots
inline constexpr const char* kPoints = "POINTS";             ///< part: points of a sensor's echoes
///@}

/// Label of an observation in a recording: "<robot>/<sensor>" or "<robot>/<sensor>/<part>". The robot ends at the first
/// '/', the sensor at the next one. World files must not contain robot names or sensor labels with a '/', nor sensors
/// with a reserved label, so that every label is unambiguous.
struct Label {
  std::string robot;   ///< empty in a label without '/'
  std::string sensor;  ///< "sonar", or one of the above
  std::string part;    ///< empty for the sensor's own observation

  /// Parses any label, also of other programs.
  static Label parse(std::string_view text);
  std::string text() const;
  /// Sensor and part: "sonar", "sonar/POINTS".
  std::string withinRobot() const;
  bool operator==(const Label&) const = default;
};

/// Validates the name of a robot of a world file. @return the error and how to fix it; empty for a valid name
std::string robotNameError(std::string_view name);
/// Validates the label of a sensor of a world file, as robotNameError() does.
std::string sensorLabelError(std::string_view label);

}  // namespace robosim
