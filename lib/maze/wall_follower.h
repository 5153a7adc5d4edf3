#pragma once
#include "control/controller.h"

namespace robosim {

struct WallFollowerOptions {
  double distance_radii = 1.5;  ///< between the robot's edge and the wall, in robot radii
};

/// Drives ahead until it meets a wall, then along it, keeping it on its right at a set distance: round outer corners to
/// the right, before inner ones to the left. In a maze whose walls all hang together it comes everywhere.
class WallFollower : public Controller {
 public:
  explicit WallFollower(const WallFollowerOptions& options = {}) : options_(options) {}
  void step(Robot& robot) override;

 private:
  WallFollowerOptions options_;
  bool found_wall_ = false;
};

}  // namespace robosim
