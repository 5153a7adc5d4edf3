#include "serving/robot_drivers.h"

#include <cmath>

#include "remote/orders.h"
#include "topics/topic.h"

namespace robosim {
namespace {

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

}  // namespace

RobotDrivers::RobotDrivers(Access access, const std::function<void(const std::string&)>& log,
                           std::function<Clock::time_point()> now)
    : access_(std::move(access)), now_(std::move(now)), log_(log, now_), audit_(log, now_) {}

void RobotDrivers::begin(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  const std::lock_guard lock(mutex_);
  by_topic_.clear();
  topic_of_.clear();
  wrapNew(run, why_not_driven);
}

void RobotDrivers::addRobots(LocalRun& run, const std::vector<std::string>& why_not_driven) {
  const std::lock_guard lock(mutex_);
  wrapNew(run, why_not_driven);
}

/// @pre holds the mutex
void RobotDrivers::wrapNew(LocalRun& run, const std::vector<std::string>& why_not_driven) {
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
            .now = now_, .log = [this](const std::string& line) { log_.write("robots that programs drive", line); }});
    topic_of_["/" + topicNamePart(name) + "/autonomous"] = topic;
    return std::unique_ptr<Controller>(std::make_unique<DrivenController>(driven.remote, suspended));
  });
}

std::vector<std::pair<std::string, bool>> RobotDrivers::autonomous() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<std::string, bool>> all;
  for (const auto& [parameter, topic] : topic_of_) {
    all.emplace_back(parameter, by_topic_.at(topic).remote->isAutonomous());
  }
  return all;
}

std::vector<std::string> RobotDrivers::topics() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [topic, robot] : by_topic_) {
    if (robot.remote) all.push_back(topic);
  }
  return all;
}

bool RobotDrivers::hasParameter(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return topic_of_.count(name) > 0;
}

/// @pre holds the mutex
const RobotDrivers::Driven* RobotDrivers::find(const std::string& topic) const {
  const auto found = by_topic_.find(topic);
  return found == by_topic_.end() ? nullptr : &found->second;
}

/// Why a program may not drive a robot; empty if it may. @pre holds the mutex
std::string RobotDrivers::fault(const RobotDriver& driver, const Driven* robot) const {
  if (!robot) return "no robot has this topic";
  if (!robot->remote) return robot->why_not;
  if (!driver.identity) return "";
  const auto status = access_.check(*driver.identity, Right::drive, std::span(&robot->name, 1));
  return status.ok() ? "" : status.error_message();
}

/// The same now. @pre holds the mutex
std::string RobotDrivers::refusal(const RobotDriver& driver, const Driven* robot) const {
  if (std::string why = fault(driver, robot); !why.empty()) return why;
  const bool is_other = robot->driver && !robot->driver->isSame(driver);
  if (is_other && now_() - robot->last_message <= DriveCommandFilter::kDeadMan) {
    return robot->name + " is driven by another client, " + robot->driver->name() + " at " + robot->driver->peer;
  }
  return "";
}

std::string RobotDrivers::setAutonomous(const RobotDriver& driver, const std::string& parameter, bool on) {
  const std::lock_guard lock(mutex_);
  const auto topic = topic_of_.find(parameter);
  if (topic == topic_of_.end()) return "there is no such parameter";
  Driven& robot = by_topic_.at(topic->second);
  if (std::string why = refusal(driver, &robot); !why.empty()) return why;
  if (on) {
    robot.remote->release("");
    robot.driver.reset();
  }
  robot.remote->setAutonomous(on);
  return "";
}

std::string RobotDrivers::whyNot(const RobotDriver& driver, const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  return fault(driver, find(topic));
}

std::string RobotDrivers::drive(const RobotDriver& driver, const std::string& topic, const ros::Twist& twist) {
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.linear.y) || !std::isfinite(twist.angular.z))
    return "speeds must be finite";
  const std::lock_guard lock(mutex_);
  if (std::string why = refusal(driver, find(topic)); !why.empty()) return why;
  Driven& robot = by_topic_.at(topic);
  if (!robot.driver || !robot.driver->isSame(driver)) {
    robot.driver = driver;
    robot.remote->take(driver.name(), false);
    audit_.write(driver.identity.value_or(Identity{}), driver.peer, "drive " + robot.name);
  } else if (robot.remote->isAutonomous()) {
    robot.remote->setAutonomous(false);
  }
  robot.last_message = now_();
  robot.remote->obey(driveOrder(twist.linear.x, twist.angular.z, {}, twist.linear.y));
  return "";
}

void RobotDrivers::leave(const RobotDriver& driver, const std::string& topic) {
  const std::lock_guard lock(mutex_);
  const auto found = by_topic_.find(topic);
  if (found == by_topic_.end() || !found->second.driver || !found->second.driver->isSame(driver)) return;
  found->second.remote->release("its driver has left");
  found->second.driver.reset();
}

}  // namespace robosim
