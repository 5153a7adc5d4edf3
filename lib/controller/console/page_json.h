#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "console/map_view.h"
#include "console/run_view.h"
#include "remote/robot_news.h"

namespace robosim {

/// @file
/// Messages of the console to a page, as JSON (protocol: doc/remote_control.md). Lengths are in metres and angles in
/// radians; ranges are in whole millimetres, to keep the messages short.

/// The page's hello was accepted; the page's id.
/// @param may_operate whether its token permits to control the run
/// @param has_rounds whether visitors drive in turn
std::string welcomeJson(std::uint64_t page, bool may_operate, bool has_rounds);
/// Reply to a page's ping of that number.
std::string pongJson(std::uint64_t number);
/// The page's token is not valid. @param text for the user
std::string refusedJson(const std::string& text);

/// Constant properties of the primary robot.
std::string robotJson(const RobotInfo& robot, double period_s);

/// State of the team, and the holder of the control lock.
struct ControlLock {
  std::uint64_t holder = 0;  ///< page that holds the control lock; 0 for none
  std::string name;
  std::size_t pages = 0;  ///< number of admitted pages
};
std::string teamJson(const std::vector<TeamRobot>& robots, const ControlLock& lock);

/// Heat and stall of each robot by its name, at most once per second.
std::string vitalsJson(const std::vector<TeamRobot>& robots);

/// A step of the primary robot; `with_sensors` includes sonar, laser, infrared and heat.
std::string updateJson(const RobotInfo& robot, const RobotUpdate& update, const RobotPicture* picture,
                       bool with_sensors);
/// The requested reading of one sensor.
std::string answerJson(const char* sensor, const RobotAnswer& answer);

/// State of the environment's run.
std::string runJson(const RunView& run);
/// Sent when there is nothing else to send, so that silence means a broken connection.
std::string pulseJson();

std::string mapJson(const MapView& map);
/// Poses of the robots, and places of the objects that have moved.
/// @param sent the view that the page shows; null, or of another world, if the page shows the map as it was sent
std::string posesJson(const MapView& map, const MapView* sent);

/// A line of text for the user.
/// @param is_warning whether it is highlighted
/// @param detail the reason, which pages show to operators on request; empty for none
std::string noteJson(const std::string& text, bool is_warning, const std::string& detail = {});

}  // namespace robosim
