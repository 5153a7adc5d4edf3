#pragma once
#include <memory>
#include <utility>

#include "control/controller.h"
#include "maze/gold_protocol.h"

namespace robosim {

/// Turns a controller that only moves into a search for gold: it drives until the GoldProtocol halts the robot.
class GoldSearch : public Controller {
 public:
  /// @param movement must have clone()
  explicit GoldSearch(std::unique_ptr<Controller> movement, double heat_threshold = kGoldHeat_celsius)
      : movement_(std::move(movement)), protocol_(heat_threshold) {}
  GoldSearch(const GoldSearch& other) : movement_(other.movement_->clone()), protocol_(other.protocol_) {}
  GoldSearch& operator=(const GoldSearch&) = delete;

  void step(Robot& robot) override {
    protocol_.step(robot);
    if (robot.activity() == Activity::active) movement_->step(robot);
  }
  std::unique_ptr<Controller> clone() const override { return std::make_unique<GoldSearch>(*this); }
  bool hasDrawnRandomNumbers() const override { return movement_->hasDrawnRandomNumbers(); }

 private:
  std::unique_ptr<Controller> movement_;
  GoldProtocol protocol_;
};

}  // namespace robosim
