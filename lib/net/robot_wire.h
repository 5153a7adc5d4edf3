#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "net/robots.pb.h"
#include "net/wire_error.h"

namespace robosim {

/// @file
/// Conversion of the robots' messages (robots.proto) between value types and protobuf. Encoding fills a message that
/// may have been used before, to reuse its memory. Decoding validates every field, and throws WireError.

/// Length of RobotsHello.process.
constexpr std::size_t kProcessIdBytes = 16;

/// A process's response to one step. Robots are indexed by their position in the process's RobotsHello.
struct RobotsAnswer {
  struct Order {
    std::uint32_t robot;
    Command command;
  };
  struct Message {
    std::uint32_t robot;  ///< the sender
    std::string to, text;
  };
  std::uint64_t step = 0;
  std::vector<Order> orders;
  std::vector<Message> messages;
  std::vector<std::uint32_t> win_checks;  ///< robots that request CheckWin
};

void encode(const Command& command, std::uint32_t robot, wire::RobotCommand& out);
/// @param robots number of robots of the process
/// @throws WireError for a robot index out of range, a number that is not finite, or an unknown activity.
Command decode(const wire::RobotCommand& in, std::size_t robots);

/// @param robots number of robots of the process
/// @throws WireError as decode() of a command, and for a message longer than kMaxMessageBytes.
void decode(const wire::DriveRequest& in, std::size_t robots, RobotsAnswer& out);

void encode(const Measurement& measurement, wire::Measurement& out);
/// Replaces `out`, which holds a measurement of the expected kind and size.
/// @throws WireError when the message has another number of values than this kind, or one that is not permitted.
void decode(const wire::Measurement& in, Measurement& out);

void encode(const Readings& readings, wire::RobotReadings& out);
/// Replaces the inbox.
void encodeInbox(const std::vector<RobotMessage>& messages, wire::RobotReadings& out);
/// Decodes everything except the winner, which a process receives once for all its robots.
/// @param to the robot's name, for its inbox
/// @param out holds measurements of the expected kinds and sizes: blankReadings()
void decode(const wire::RobotReadings& in, const std::string& to, Readings& out);

/// Readings before the first step, with a measurement of the correct kind and size for each sensor.
Readings blankReadings(const std::vector<SensorInfo>& sensors);

/// Description of the run and of a process's robots, sent when the process joins. Robots of one model share a set of
/// sensors.
struct RobotsWelcome {
  struct Robot {
    RobotInfo info;
    std::uint32_t place = 0;        ///< index in the world's list of robots
    std::string controller;         ///< named in the world file; empty if none
    std::uint64_t next_answer = 0;  ///< the first step whose response has not been received
  };
  std::string world, world_version;
  std::string run;  ///< identifies the run
  std::uint64_t seed = 0;
  double period_s = 0;
  std::vector<Robot> robots;
  std::vector<std::string> all_robots;  ///< all robots of the world
};

void encode(const RobotsWelcome& welcome, wire::RobotsWelcome& out);
/// @throws WireError for an invalid message.
RobotsWelcome decode(const wire::RobotsWelcome& in);

}  // namespace robosim
