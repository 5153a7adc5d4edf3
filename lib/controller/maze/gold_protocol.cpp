#include "maze/gold_protocol.h"

#include <algorithm>

namespace robosim {
namespace {

const std::string kPrefix = "GOLD ";

}  // namespace

std::string GoldMessage::text() const { return kPrefix + source; }

std::optional<GoldMessage> GoldMessage::parse(const std::string& text) {
  if (!text.starts_with(kPrefix) || text.size() == kPrefix.size()) return std::nullopt;
  return GoldMessage{text.substr(kPrefix.size())};
}

void GoldProtocol::step(Robot& robot) {
  if (robot.activity() == Activity::active && robot.heat().value_or(0) > heat_threshold_) {
    robot.halt(Activity::found);
    sendGold(robot.name());
  }
  listen(robot);
  speak(robot);
}

void GoldProtocol::listen(Robot& robot) {
  for (const RobotMessage& message : robot.inbox()) {
    const auto gold = GoldMessage::parse(message.text);
    if (!gold) continue;
    if (robot.activity() == Activity::active) robot.halt();
    if (gold->source != robot.name()) sendGold(gold->source);
  }
}

void GoldProtocol::sendGold(const std::string& source) {
  if (std::find(forwarded_sources_.begin(), forwarded_sources_.end(), source) != forwarded_sources_.end()) return;
  forwarded_sources_.push_back(source);
  to_send_.push_back({source});
}

void GoldProtocol::speak(Robot& robot) {
  if (to_send_.empty()) return;
  if (!robot.info().neighbour.empty()) robot.send(robot.info().neighbour, to_send_.front().text());
  to_send_.pop_front();
}

}  // namespace robosim
