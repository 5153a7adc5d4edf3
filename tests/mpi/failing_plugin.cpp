// A controller and a sensor that fail on the last robot of a world, which is not on rank 0.
#include <stdexcept>

#include "run/plugin.h"

namespace {

struct FailingAtTheEnd : robosim::Controller {
  void step(robosim::Robot& robot) override {
    if (robot.name() == robot.robots().back() && robot.stepNumber() == 5) throw std::runtime_error("lost the flock");
  }
};

}  // namespace

ROBOSIM_PLUGIN(registry) {
  registry.controllers.add(
      {"failing_at_the_end", "Throws an exception in step 5 of the last robot.", {}, {}, [](const auto&, const auto&) {
         return std::make_unique<FailingAtTheEnd>();
       }});
}
