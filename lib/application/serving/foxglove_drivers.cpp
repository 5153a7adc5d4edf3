#include "serving/foxglove_drivers.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "remote/orders.h"
#include "ros/cdr.h"
#include "ros/messages.h"
#include "topics/topic.h"

namespace robosim {
namespace {

using nlohmann::json;

/// A controller that a driver may suspend.
class DrivenController final : public Controller {
 public:
  explicit DrivenController(std::shared_ptr<RemoteControlRobot> remote, const Controller& suspended)
      : remote_(std::move(remote)), suspended_(suspended) {}
  void step(Robot&) override { remote_->step(); }
  bool hasDrawnRandomNumbers() const override { return suspended_.hasDrawnRandomNumbers(); }

 private:
  std::shared_ptr<RemoteControlRobot> remote_;
  const Controller& suspended_;  ///< of remote_
};

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

FoxgloveDrivers::FoxgloveDrivers(Access access, const std::function<void(const std::string&)>& log,
                                 std::function<Clock::time_point()> now)
    : access_(std::move(access)), now_(std::move(now)), log_(log, now_), audit_(log, now_) {}

void FoxgloveDrivers::begin(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  const std::lock_guard lock(mutex_);
  by_topic_.clear();
  topic_of_.clear();
  wrapNew(run, why_not_driven);
}

void FoxgloveDrivers::addRobots(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  const std::lock_guard lock(mutex_);
  wrapNew(run, why_not_driven);
}

/// @pre holds the mutex
void FoxgloveDrivers::wrapNew(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  const auto& robots = run.environment().fleet().robots;
  const auto topic_for = [](const std::string& name) { return "/" + topicNamePart(name) + "/cmd_vel"; };
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::string& name = robots[i].info.name;
    by_topic_.try_emplace(topic_for(name), Driven{name, why_not_driven[i], nullptr, std::nullopt, {}});
  }
  run.wrapControllers([&](LocalHardware& hardware, std::unique_ptr<Controller> controller) {
    const std::string& name = hardware.info().name;
    const std::string topic = topic_for(name);
    Driven& driven = by_topic_.at(topic);
    // Of robots with one topic, the first is driven.
    if (driven.name != name || driven.remote) return controller;
    const Controller& suspended = *controller;
    driven.remote = std::make_shared<RemoteControlRobot>(
        hardware, std::move(controller),
        RemoteControlRobot::Options{
            .now = now_, .log = [this](const std::string& line) { log_.write("robots that Foxglove drives", line); }});
    topic_of_["/" + topicNamePart(name) + "/autonomous"] = topic;
    return std::unique_ptr<Controller>(std::make_unique<DrivenController>(driven.remote, suspended));
  });
}

std::vector<std::pair<std::string, bool>> FoxgloveDrivers::autonomous() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<std::string, bool>> all;
  for (const auto& [parameter, topic] : topic_of_) {
    all.emplace_back(parameter, by_topic_.at(topic).remote->isAutonomous());
  }
  return all;
}

bool FoxgloveDrivers::hasParameter(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return topic_of_.count(name) > 0;
}

/// Why a client may not drive a robot now; empty if it may. @pre holds the mutex
std::string FoxgloveDrivers::refusal(const foxglove::Client& client, const Driven* robot) const {
  if (!robot) return "no robot has this topic";
  if (!robot->remote) return robot->why_not;
  if (const auto status = access_.check(client.identity, Right::drive, std::span(&robot->name, 1)); !status.ok()) {
    return status.error_message();
  }
  const bool is_other = robot->driver && robot->driver->id != client.id;
  if (is_other && now_() - robot->last_message <= DriveCommandFilter::kDeadMan) {
    return robot->name + " is driven by another client, " + robot->driver->identity.name() + " at " +
           robot->driver->peer;
  }
  return "";
}

std::string FoxgloveDrivers::setAutonomous(const foxglove::Client& client, const std::string& parameter, bool on) {
  const std::lock_guard lock(mutex_);
  const auto topic = topic_of_.find(parameter);
  if (topic == topic_of_.end()) return "there is no such parameter";
  Driven& robot = by_topic_.at(topic->second);
  if (std::string why = refusal(client, &robot); !why.empty()) return why;
  if (on) {
    robot.remote->release("");
    robot.driver.reset();
  }
  robot.remote->setAutonomous(on);
  return "";
}

std::string FoxgloveDrivers::advertised(const foxglove::Client& client, const foxglove::ClientChannel& channel) {
  const std::string type = fullName(channel.schema_name);
  if (type != ros::Twist::kType && type != ros::TwistStamped::kType) {
    return "a message of the type " + channel.schema_name + "; only " + ros::Twist::kType + " and " +
           ros::TwistStamped::kType + " on /<robot>/cmd_vel have an effect";
  }
  if (channel.encoding != "cdr" && channel.encoding != "json") return "the encoding must be cdr or json";
  const std::lock_guard lock(mutex_);
  const auto found = by_topic_.find(channel.topic);
  if (found == by_topic_.end()) return "no robot has this topic";
  if (!found->second.remote) return found->second.why_not;
  const auto status = access_.check(client.identity, Right::drive, std::span(&found->second.name, 1));
  return status.ok() ? "" : status.error_message();
}

std::string FoxgloveDrivers::published(const foxglove::Client& client, const foxglove::Publication& publication) {
  ros::Twist twist;
  try {
    twist = twistOf(publication);
  } catch (const ros::CdrError& error) {
    return error.what();
  }
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z)) return "speeds must be finite";
  const std::lock_guard lock(mutex_);
  const auto found = by_topic_.find(publication.channel.topic);
  Driven* const robot = found == by_topic_.end() ? nullptr : &found->second;
  if (std::string why = refusal(client, robot); !why.empty()) return why;
  if (!robot->driver || robot->driver->id != client.id) {
    robot->driver = client;
    robot->remote->take(client.identity.name() + " by Foxglove", false);
    audit_.write(client.identity, client.peer, "drive " + robot->name);
  } else if (robot->remote->isAutonomous()) {
    robot->remote->setAutonomous(false);
  }
  robot->last_message = now_();
  robot->remote->obey(driveOrder(twist.linear.x, twist.angular.z));
  return "";
}

void FoxgloveDrivers::withdrawn(const foxglove::Client& client, const foxglove::ClientChannel& channel) {
  const std::lock_guard lock(mutex_);
  const auto found = by_topic_.find(channel.topic);
  if (found == by_topic_.end() || !found->second.driver || found->second.driver->id != client.id) return;
  found->second.remote->release("its driver has left");
  found->second.driver.reset();
}

}  // namespace robosim
