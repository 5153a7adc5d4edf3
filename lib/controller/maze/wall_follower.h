#pragma once
#include <cstdint>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/stuck_recovery.h"

namespace robosim {

struct WallFollowerOptions {
  double distance_radii = 1.5;  ///< between the robot's edge and the wall, in robot radii
};

/// Right-hand wall follower: drives ahead to a wall, then along it at a fixed distance, to the right around outer
/// corners and to the left before inner ones. It visits all of a maze whose walls are connected. Obstacles without
/// echo, such as the edge of the surface, are followed by contact: it turns away after each stall, and returns in an
/// arc. If an arc becomes a full circle without a wall, it drives ahead again. StuckRecovery handles lack of progress.
class WallFollower : public Controller {
 public:
  explicit WallFollower(const ControllerSetup& setup = {}, const WallFollowerOptions& options = {})
      : options_(options), recovery_(setup) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<WallFollower>(*this); }
  bool hasDrawnRandomNumbers() const override { return recovery_.hasDrawnRandomNumbers(); }

 private:
  WallFollowerOptions options_;
  StuckRecovery recovery_;
  bool found_wall_ = false;
  double arc_rad_ = 0;             ///< angle turned without a wall
  std::uint64_t turn_until_ = 0;   ///< step until which it turns away after a contact
  std::uint64_t ahead_until_ = 0;  ///< step until which it then drives ahead without an echo
};

}  // namespace robosim
