#pragma once
#include "control/controller.h"

namespace robosim {

/// Controller without commands, for robots that are obstacles or are driven otherwise.
class Still : public Controller {
 public:
  void step(Robot&) override {}
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Still>(*this); }
};

}  // namespace robosim
