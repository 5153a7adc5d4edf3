#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"

namespace robosim {

struct BoxPusherOptions {
  double distance_m = 2;  ///< by which the box is to be pushed
  double speed_mps = 0.2;
  int team = 2;  ///< robots that push, this one included
};

/// Pushes a box together with other robots. It drives straight on until it is at the box, sends `READY`, and waits
/// until the whole team is there. Then it pushes by the distance, sends `PUSHED distance` [mm] in each step, waits
/// where it is ahead of another robot by more than a centimetre, so that the box does not turn, and halts.
class BoxPusher : public Controller {
 public:
  explicit BoxPusher(const BoxPusherOptions& options) : options_(options) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<BoxPusher>(*this); }

 private:
  void approach(Robot& robot);
  void push(Robot& robot);

  BoxPusherOptions options_;
  PoseTracker tracker_;  ///< its x axis is the direction of the push
  bool is_at_box_ = false;
  double box_x_m_ = 0;                      ///< of the robot where it met the box
  std::map<std::string, double> pushed_m_;  ///< by the name of each other robot at the box
};

}  // namespace robosim
