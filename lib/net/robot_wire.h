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
/// The robots' conversation between our values and protobuf's (robots.proto). Encoding fills a message that may have
/// been used before, so that its memory is used again. Decoding takes nothing on trust: it throws WireError.

/// A process's answer to one step. Robots are told by their place among the process's own.
struct RobotsAnswer {
  struct Order {
    std::uint32_t robot;
    Command command;
  };
  struct Letter {
    std::uint32_t robot;  ///< who sends it
    std::string to, text;
  };
  std::uint64_t step = 0;
  std::vector<Order> orders;
  std::vector<Letter> letters;
  std::vector<std::uint32_t> win_checks;  ///< who asks whether it has won
};

void encode(const Command& command, std::uint32_t robot, wire::RobotCommand& out);
/// @param robots how many there are to name
/// @throws WireError for a robot that is none of these, a number that is not finite, an unknown activity.
Command decode(const wire::RobotCommand& in, std::size_t robots);

/// @param robots how many the process carries
/// @throws WireError besides what decode() of a command refuses, for too long a letter.
void decode(const wire::FromRobots& in, std::size_t robots, RobotsAnswer& out);

void encode(const Measurement& measurement, wire::Measurement& out);
/// Replaces `out`, which holds a measurement of the right kind and size.
/// @throws WireError when the message is of another kind or size, or has a number that is no number.
void decode(const wire::Measurement& in, Measurement& out);

void encode(const Readings& readings, wire::RobotReadings& out);
/// Puts these letters before the ones that are in the inbox.
void encodeInbox(const std::vector<RobotMessage>& letters, wire::RobotReadings& out);
/// @param out holds measurements of the right kinds and sizes: blankReadings()
/// All but the winner, which a process is told once for all its robots.
/// @param to the robot's name, for its inbox
void decode(const wire::RobotReadings& in, const std::string& to, Readings& out);

/// Readings as before the first step, with a measurement of the right kind and size for each sensor.
Readings blankReadings(const std::vector<SensorInfo>& sensors);

/// What a process is told of its robots when it joins. Robots of one model share a set of sensors.
struct RobotsWelcome {
  struct Seat {
    RobotInfo info;
    std::uint32_t place = 0;  ///< in the world's list
    std::string controller;   ///< what the world would have it run; empty when it does not say
  };
  std::string world, world_version;
  std::uint64_t seed = 0;
  double period_s = 0;
  std::vector<Seat> seats;
  std::vector<std::string> everyone;  ///< all robots of the world
};

void encode(const RobotsWelcome& welcome, wire::RobotsWelcome& out);
/// @throws WireError for what no environment would send.
RobotsWelcome decode(const wire::RobotsWelcome& in);

}  // namespace robosim
