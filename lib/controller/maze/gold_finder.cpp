#include "maze/gold_finder.h"

namespace robosim {

GoldFinder::GoldFinder(const ControllerSetup& setup, const GoldFinderOptions& options)
    : setup_(setup), protocol_(options.heat_threshold) {}

void GoldFinder::step(Robot& robot) {
  protocol_.step(robot);
  if (robot.activity() != Activity::active) return;
  if (!explorer_) explorer_.emplace(robot, setup_, protocol_.warm());
  explorer_->step(robot);
}

}  // namespace robosim
