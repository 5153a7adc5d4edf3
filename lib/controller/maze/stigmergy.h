#pragma once
#include <optional>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"
#include "maze/straight_step.h"
#include "maze/stuck_recovery.h"
#include "maze/trail_map.h"

namespace robosim {

struct StigmergyOptions {
  double evaporation_s = 300;  ///< time in which pheromone decays to 1/e
  double cell_m = 0.8;         ///< side of a cell of the lattice
};

/// Covers the environment by virtual pheromone (Wagner, Lindenbaum & Bruckstein, "Distributed covering by ant-robots
/// using evaporating traces", IEEE Transactions on Robotics and Automation 15, 1999). A robot marks each cell that it
/// enters, in its own TrailMap and by a TrailMessage to all others, and drives towards the neighbouring cell with the
/// least pheromone among those in free directions; of equal ones it takes a random one ahead. A robot that does not
/// know its start in the world neither sends nor uses messages. StuckRecovery handles lack of progress.
class Stigmergy : public Controller {
 public:
  explicit Stigmergy(const ControllerSetup& setup, const StigmergyOptions& options = {});
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Stigmergy>(*this); }
  bool hasDrawnRandomNumbers() const override { return has_drawn_ || recovery_.hasDrawnRandomNumbers(); }

 private:
  void mark(Robot& robot);
  void choose(const Robot& robot);

  ControllerSetup setup_;
  StigmergyOptions options_;
  StuckRecovery recovery_;
  PoseTracker tracker_;
  std::optional<TrailMap> trails_;  ///< constructed in the first step, since it requires the robot
  std::optional<Cell> last_cell_;
  StraightStep step_;
  bool has_drawn_ = false;
};

/// Clearance [m] of a robot that would drive straight in a direction [rad, robot frame], to the nearest echo of its
/// range sensors in that lane; infinity without an echo.
double clearanceTowards(const Robot& robot, double bearing_rad);

}  // namespace robosim
