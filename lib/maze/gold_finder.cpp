#include "maze/gold_finder.h"

#include <algorithm>

namespace robosim {
namespace {

constexpr double kWarm = 0.2;  // of the threshold: well above the noise of a heat sensor

}  // namespace

GoldFinder::GoldFinder(const ControllerSetup& setup, const GoldFinderOptions& options)
    : setup_(setup), options_(options) {}

void GoldFinder::step(Robot& robot) {
  if (robot.activity() == Activity::active && robot.heat().value_or(0) > options_.heat_threshold) {
    robot.halt(Activity::found);
    sendGold(robot.name());
  }
  listen(robot);
  speak(robot);
  if (robot.activity() != Activity::active) return;
  if (!explorer_) explorer_.emplace(robot, setup_, kWarm * options_.heat_threshold);
  explorer_->step(robot);
}

void GoldFinder::listen(Robot& robot) {
  for (const RobotMessage& message : robot.inbox()) {
    const auto gold = GoldMessage::parse(message.text);
    if (!gold) continue;
    if (robot.activity() == Activity::active) robot.halt();
    if (gold->source != robot.name()) sendGold(gold->source);
  }
}

void GoldFinder::sendGold(const std::string& source) {
  if (std::find(forwarded_sources_.begin(), forwarded_sources_.end(), source) != forwarded_sources_.end()) return;
  forwarded_sources_.push_back(source);
  to_send_.push_back({source});
}

void GoldFinder::speak(Robot& robot) {
  if (to_send_.empty()) return;
  if (!robot.info().neighbour.empty()) robot.send(robot.info().neighbour, to_send_.front().text());
  to_send_.pop_front();
}

}  // namespace robosim
