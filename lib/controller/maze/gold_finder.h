#pragma once
#include <optional>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/explorer.h"
#include "maze/gold_protocol.h"

namespace robosim {

struct GoldFinderOptions {
  double heat_threshold = 10;  ///< heat above this means gold
};

/// The 2005 application: searches a maze for gold, a heat source at an unknown position, and follows its GoldProtocol.
/// Frontier-based exploration (Yamauchi, "A frontier-based approach for autonomous exploration", CIRA 1997), in which
/// a frontier is a cell not yet searched for heat (see Explorer). Robots of a team do not coordinate their search.
class GoldFinder : public Controller {
 public:
  explicit GoldFinder(const ControllerSetup& setup, const GoldFinderOptions& options = {});
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<GoldFinder>(*this); }
  bool hasDrawnRandomNumbers() const override { return explorer_ && explorer_->hasDrawnRandomNumbers(); }

 private:
  ControllerSetup setup_;
  GoldProtocol protocol_;
  std::optional<Explorer> explorer_;  ///< constructed in the first step, since it requires the robot
};

}  // namespace robosim
