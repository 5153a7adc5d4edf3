#include "aria/pioneer_robot.h"

#include <algorithm>
#include <stdexcept>

#include "aria/key_handler.h"

namespace robosim {
namespace {

/// Result of a range query without any point, as in ARIA.
constexpr double kNoDevices_mm = 30000;

}  // namespace

PioneerRobot::PioneerRobot(Robot& robot)
    : PioneerSensors(robot), drive_(robot), way_limits_(drive_.wayLimits()), turn_limits_(drive_.turnLimits()) {}

PioneerRobot::PioneerRobot(Robot& robot, StepClock& clock) : PioneerRobot(robot) { clock_ = &clock; }

void PioneerRobot::update() {
  announceConnection();
  drive_.update();
  odometer_.update(getEncoderPose(), time());
  if (cycle_ == Cycle::running && stops_if_not_connected_ && !isConnected()) endCycle();
  if (cycle_ == Cycle::ended) return;
  devices_.update();
  sensor_tasks_.run();
  if (direct_since_s_ && precedence_ms_ > 0 && time() - *direct_since_s_ >= precedence_ms_ / 1000) clearDirectMotion();
  if (!direct_since_s_ && !actions_.empty()) obey(actions_.resolve(*this));
  user_tasks_.run();
}

void PioneerRobot::waitForNextStep() {
  if (!clock_) {
    throw std::logic_error(
        "PioneerRobot::waitForNextStep: made without a clock; in a BlockingController's program make it with the clock "
        "that the program is given, in a Controller call update() once a step instead");
  }
  clock_->waitForNextStep();
  update();
}

void PioneerRobot::sleep(double ms) {
  for (std::uint64_t steps = robot_.stepsIn(ms / 1000); steps > 0; --steps) waitForNextStep();
}

void PioneerRobot::runAsync(bool stop_if_not_connected) {
  announceConnection();
  stops_if_not_connected_ = stop_if_not_connected;
  cycle_ = Cycle::running;
}

void PioneerRobot::run(bool stop_if_not_connected) {
  runAsync(stop_if_not_connected);
  waitForRunExit();
}

PioneerRobot::WaitState PioneerRobot::waitForRunExit(double ms) {
  const std::uint64_t limit = robot_.stepsIn(ms / 1000);
  for (std::uint64_t steps = 0; isRunning(); ++steps) {
    if (stops_if_not_connected_ && !isConnected()) {
      endCycle();
      break;
    }
    if (ms > 0 && steps == limit) return WAIT_TIMEDOUT;
    waitForNextStep();
  }
  return WAIT_RUN_EXIT;
}

void PioneerRobot::stopRunning(bool do_disconnect) {
  if (do_disconnect) disconnect();
  endCycle();
}

void PioneerRobot::endCycle() {
  if (cycle_ == Cycle::ended) return;
  cycle_ = Cycle::ended;
  drive_.stop();
  on_run_exit_.call();
}

void PioneerRobot::announceConnection() {
  if (is_announced_ || !isConnected()) return;
  is_announced_ = true;
  on_connect_.call();
}

bool PioneerRobot::blockingConnect() {
  announceConnection();
  return isConnected();
}

bool PioneerRobot::disconnect() {
  if (!isConnected()) return false;
  robot_.halt();
  on_disconnect_.call();
  return true;
}

int PioneerRobot::addConnectCB(Functor functor, ListPos::Pos position) {
  return on_connect_.add(std::move(functor), position);
}

int PioneerRobot::addDisconnectNormallyCB(Functor functor, ListPos::Pos position) {
  return on_disconnect_.add(std::move(functor), position);
}

int PioneerRobot::addRunExitCB(Functor functor, ListPos::Pos position) {
  return on_run_exit_.add(std::move(functor), position);
}

bool PioneerRobot::addUserTask(const std::string& name, int position, Functor functor) {
  return user_tasks_.add(name, position, std::move(functor));
}

bool PioneerRobot::addSensorInterpTask(const std::string& name, int position, Functor functor) {
  return sensor_tasks_.add(name, position, std::move(functor));
}

void PioneerRobot::attachKeyHandler(KeyHandler& keys, bool exit_on_escape) {
  keys_ = &keys;
  if (exit_on_escape) keys.addKeyHandler(KeyHandler::ESCAPE, [this] { stopRunning(); });
  user_tasks_.rem("key handler");
  user_tasks_.add("key handler", 50, [&keys] { keys.checkKeys(); });
}

void PioneerRobot::addAction(Action& action, int priority) {
  actions_.add(action, priority);
  action.setRobot(this);
}

bool PioneerRobot::remAction(Action& action) {
  if (!actions_.remove(action)) return false;
  action.setRobot(nullptr);
  return true;
}

bool PioneerRobot::remAction(const std::string& name) {
  Action* action = findAction(name);
  return action && remAction(*action);
}

void PioneerRobot::moveTo(const PioneerPose& pose, bool do_cumulative) {
  devices_.applyTransform(PioneerTransform(getPose(), pose), do_cumulative);
  setPose(pose);
}

ClosestOfDevices PioneerRobot::currentPolar(double from_deg, double to_deg) const {
  if (devices_.list().empty()) {
    const auto between = [&](double x, double y) { return Math::angleBetween(Math::atan2(y, x), from_deg, to_deg); };
    return {nearestEcho(between), nullptr};
  }
  return devices_.closest([&, pose = getPose()](const RangeDevice& device) {
    return device.getCurrentRangeBuffer().getClosestPolar(from_deg, to_deg, pose);
  });
}

ClosestOfDevices PioneerRobot::currentBox(double x1, double y1, double x2, double y2) const {
  if (devices_.list().empty()) {
    const auto inside = [&](double x, double y) {
      return std::min(x1, x2) <= x && x <= std::max(x1, x2) && std::min(y1, y2) <= y && y <= std::max(y1, y2);
    };
    return {nearestEcho(inside), nullptr};
  }
  return devices_.closest([&, pose = getPose()](const RangeDevice& device) {
    return device.getCurrentRangeBuffer().getClosestBox(x1, y1, x2, y2, pose);
  });
}

namespace {

/// A query's result as ARIA returns it.
double resultOf(const ClosestOfDevices& closest, double if_none, double* angle, PioneerPose* reading_pos,
                const RangeDevice** device) {
  if (!closest.point) return if_none;
  if (angle) *angle = closest.point->angle;
  if (reading_pos) *reading_pos = closest.point->local;
  if (device) *device = closest.device;
  return closest.point->distance;
}

}  // namespace

double PioneerRobot::checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double if_none) const {
  const auto closest = currentPolar(from_deg, to_deg);
  return closest.point && closest.point->distance < if_none ? closest.point->distance : if_none;
}

double PioneerRobot::checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, double if_none) const {
  const auto closest = currentBox(x1, y1, x2, y2);
  return closest.point && closest.point->distance < if_none ? closest.point->distance : if_none;
}

double PioneerRobot::checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double* angle,
                                                   const RangeDevice** device) const {
  return resultOf(currentPolar(from_deg, to_deg), devices_.maxRange(kNoDevices_mm), angle, nullptr, device);
}

double PioneerRobot::checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos,
                                                 const RangeDevice** device) const {
  return resultOf(currentBox(x1, y1, x2, y2), devices_.maxRange(kNoDevices_mm), nullptr, reading_pos, device);
}

double PioneerRobot::checkRangeDevicesCumulativePolar(double from_deg, double to_deg, double* angle,
                                                      const RangeDevice** device) const {
  const auto closest = devices_.closest([&, pose = getPose()](const RangeDevice& each) {
    return each.getCumulativeRangeBuffer().getClosestPolar(from_deg, to_deg, pose);
  });
  return resultOf(closest, devices_.maxRange(kNoDevices_mm), angle, nullptr, device);
}

double PioneerRobot::checkRangeDevicesCumulativeBox(double x1, double y1, double x2, double y2,
                                                    PioneerPose* reading_pos, const RangeDevice** device) const {
  const auto closest = devices_.closest([&, pose = getPose()](const RangeDevice& each) {
    return each.getCumulativeRangeBuffer().getClosestBox(x1, y1, x2, y2, pose);
  });
  return resultOf(closest, devices_.maxRange(kNoDevices_mm), nullptr, reading_pos, device);
}

}  // namespace robosim
