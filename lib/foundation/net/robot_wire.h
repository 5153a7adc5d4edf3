#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "net/wire_error.h"
#include "robosim/v1/robots.pb.h"

namespace robosim {

/// @file
/// Conversion of the robots' messages (robots.proto) between value types and protobuf. Encoding fills a message that
/// may have been used before, to reuse its memory. Decoding validates every field, and throws WireError.

/// Length of RobotsHello.process.
constexpr std::size_t kProcessIdBytes = 16;

/// A robot's index in the RobotsHello of its process, of another type than its index in the world.
enum class ProcessRobotIndex : std::uint32_t {};
constexpr std::size_t indexOf(ProcessRobotIndex robot) { return static_cast<std::size_t>(robot); }

/// A process's answer to one step.
struct RobotsAnswer {
  struct Order {
    ProcessRobotIndex robot;
    Command command;
  };
  struct Message {
    ProcessRobotIndex robot;  ///< the sender
    std::string to, text;
    bool to_all = false;  ///< to every other robot; `to` is empty
  };
  std::uint64_t step = 0;
  std::vector<Order> orders;
  std::vector<Message> messages;              ///< at most kMaxMessagesSent of each robot
  std::vector<ProcessRobotIndex> win_checks;  ///< robots that request CheckWin
  std::uint64_t messages_dropped = 0;         ///< not sent because of that limit; at most 2^32
  std::vector<ProcessRobotIndex> pictures;    ///< robots whose cameras take pictures from the next step on
};

v1::Activity encode(Activity activity);
/// nullopt for an unknown or unspecified activity.
std::optional<Activity> decode(v1::Activity activity);

void encode(const Command& command, v1::Command& out);
/// @param robot index of the robot, for errors
/// @throws WireError for a number that is not finite, or an unknown activity.
Command decode(const v1::Command& in, std::uint32_t robot);

/// @param robots number of robots of the process
/// @throws WireError as decode() of a command; for a robot index out of range; for a message longer than
/// kMaxMessageBytes, or to all robots that also names one; for more messages of a robot than kMaxMessagesSent; for more
/// than 2^32 dropped messages.
void decode(const v1::StepAnswer& in, std::size_t robots, RobotsAnswer& out);

/// Encodes a measurement without its step.
void encode(const Measurement& measurement, v1::Measurement& out);
/// Replaces `out`, which holds a measurement of the expected kind and size.
/// @throws WireError when the message has another number of values than this kind, or one that is not permitted.
void decode(const v1::Measurement& in, Measurement& out);

/// Encodes readings with their step: every sensor measures in every step, except those without a measurement.
/// @param sent_step step of the robot's last readings in the same stream, whose measurements are not new; nullopt for
/// none
void encode(const Readings& readings, v1::RobotReadings& out, std::optional<std::uint64_t> sent_step = std::nullopt);
/// Replaces the inbox.
void encodeInbox(const std::vector<RobotMessage>& messages, v1::RobotReadings& out);
/// Decodes everything except the winner, which a process receives once for all its robots.
/// @param to the robot's name, for its inbox
/// @param out holds measurements of the expected kinds and sizes, blankReadings(), and the step of the message
void decode(const v1::RobotReadings& in, const std::string& to, Readings& out);
/// Checks the pictures that a controller's process decoded. Those for remote controls and viewers are always JPEG
/// files.
/// @throws WireError for one that its camera cannot have taken (pictureFaultOf())
void checkPictures(const Readings& readings, const std::vector<SensorInfo>& sensors);

/// Readings before the first step, with a measurement of the correct kind and size for each sensor.
Readings blankReadings(const std::vector<SensorInfo>& sensors);

/// Description of the run and of a process's robots, sent when the process joins. Robots of one model share a set of
/// sensors.
struct RobotsWelcome {
  struct Robot {
    RobotInfo info;
    std::uint32_t world_robot = 0;                             ///< index in the world's list of robots
    std::string controller;                                    ///< named in the world file; empty if none
    std::uint64_t next_answer = 0;                             ///< the first step whose response has not been received
    std::optional<mrpt::math::TPose2D> world_from_start = {};  ///< nullopt if unknown
  };
  std::string world, world_version;
  std::string run;  ///< identifies the run
  std::uint64_t seed = 0;
  double period_s = 0;
  std::vector<Robot> robots;
  std::vector<std::string> all_robots;  ///< all robots of the world
  bool takes_broadcasts = false;        ///< the environment takes v1::RobotMessage::to_all
};

void encode(const RobotsWelcome& welcome, v1::RobotsWelcome& out);
/// A sensor of a kind that this version does not have becomes SensorKind::unknown.
/// @throws WireError for an invalid message.
RobotsWelcome decode(const v1::RobotsWelcome& in);

}  // namespace robosim
