#pragma once
#include "control/controller.h"

namespace robosim {

/// Does nothing: a robot that stands in the way, or one that something else drives.
class Still : public Controller {
 public:
  void step(Robot&) override {}
};

}  // namespace robosim
