#include "maze/random_walk.h"

#include <algorithm>
#include <numbers>

#include "base/portable_math.h"
#include "base/random.h"

namespace robosim {

double StepLength::exceededBy(double share) const {
  const double logarithm = -portable::log(share);  // >= 0
  if (exponent_ == 0) return scale_m_ * logarithm;
  return std::min(max_m_, scale_m_ * portable::exp(logarithm / (exponent_ - 1)));
}

void RandomWalk::step(Robot& robot) {
  const bool has_ended = step_.hasEnded(robot);
  if (recovery_.takesOver(robot)) {
    step_.drop();
    return;
  }
  if (has_ended) {
    Rng rng(setup_.seed, RandomPurpose::controller, setup_.robot, 0, robot.stepNumber());
    const double turn_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    step_.begin(turn_rad, length_.exceededBy(1 - rng.uniform()));
  }
  step_.drive(robot);
}

}  // namespace robosim
