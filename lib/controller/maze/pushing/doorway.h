#pragma once
#include <cstdint>
#include <optional>

#include <mrpt/math/TPoint2D.h>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"

namespace robosim {

struct DoorwayOptions {
  mrpt::math::TPoint2D place{0, 0};  ///< world frame [m]
  double speed_mps = 0.5;
  bool is_holder = false;
};

/// One of two robots at a door that closes by itself. The holder drives straight to a place in the doorway, so that the
/// door stops at it, sends `OPEN` in each step until it receives `PASSED`, and drives back to its start. The other one
/// waits for `OPEN`, drives straight to its place behind the door, sends `PASSED`, and halts. Both know their start
/// poses in the world, and use their own odometry and compass.
class Doorway : public Controller {
 public:
  Doorway(const ControllerSetup& setup, const DoorwayOptions& options);
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Doorway>(*this); }

 private:
  void hold(Robot& robot);
  void pass(Robot& robot);

  DoorwayOptions options_;
  mrpt::math::TPoint2D start_;
  PoseTracker tracker_;
  bool has_heard_ = false;  ///< OPEN or PASSED
};

}  // namespace robosim
