#include "serving/foxglove_commands.h"

#include <span>

#include <nlohmann/json.hpp>

#include "ros/cdr.h"
#include "ros/messages.h"

namespace robosim {
namespace {

using nlohmann::json;

/// "geometry_msgs/msg/Twist" for "geometry_msgs/Twist".
std::string fullName(const std::string& schema) {
  const auto slash = schema.find('/');
  return slash == std::string::npos || schema.find('/', slash + 1) != std::string::npos
             ? schema
             : schema.substr(0, slash) + "/msg" + schema.substr(slash);
}

/// An absent number is 0. @throws ros::CdrError
double numberOf(const json& twist, const char* part, const char* axis) {
  const auto vector = twist.find(part);
  if (vector == twist.end()) return 0;
  if (!vector->is_object()) throw ros::CdrError(std::string(part) + " is no object");
  const auto number = vector->find(axis);
  if (number == vector->end()) return 0;
  if (!number->is_number()) throw ros::CdrError(std::string(part) + "." + axis + " is no number");
  return number->get<double>();
}

/// Decodes a message. @throws ros::CdrError
ros::Twist twistOf(const foxglove::Publication& publication) {
  const bool is_stamped = fullName(publication.channel.schema_name) == ros::TwistStamped::kType;
  if (publication.channel.encoding == "json") {
    const json message = json::parse(publication.payload, nullptr, false);
    if (!message.is_object()) throw ros::CdrError("the message is no JSON object");
    const json twist = is_stamped ? message.value("twist", json()) : message;
    if (!twist.is_object()) throw ros::CdrError("twist is no object");
    ros::Twist made;
    made.linear.x = numberOf(twist, "linear", "x");
    made.angular.z = numberOf(twist, "angular", "z");
    return made;
  }
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(publication.payload.data()), publication.payload.size());
  return is_stamped ? ros::decode<ros::TwistStamped>(bytes).twist : ros::decode<ros::Twist>(bytes);
}

}  // namespace

RobotDriver driverOf(const foxglove::Client& client) { return {"Foxglove", client.id, client.peer, client.identity}; }

std::string FoxgloveCommands::advertised(const foxglove::Client& client, const foxglove::ClientChannel& channel) {
  const std::string type = fullName(channel.schema_name);
  if (type != ros::Twist::kType && type != ros::TwistStamped::kType) {
    return "a message of the type " + channel.schema_name + "; only " + ros::Twist::kType + " and " +
           ros::TwistStamped::kType + " on /<robot>/cmd_vel have an effect";
  }
  if (channel.encoding != "cdr" && channel.encoding != "json") return "the encoding must be cdr or json";
  return drivers_.whyNot(driverOf(client), channel.topic);
}

std::string FoxgloveCommands::published(const foxglove::Client& client, const foxglove::Publication& publication) {
  try {
    return drivers_.drive(driverOf(client), publication.channel.topic, twistOf(publication));
  } catch (const ros::CdrError& error) {
    return error.what();
  }
}

void FoxgloveCommands::withdrawn(const foxglove::Client& client, const foxglove::ClientChannel& channel) {
  drivers_.leave(driverOf(client), channel.topic);
}

}  // namespace robosim
