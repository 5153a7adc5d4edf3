#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"

namespace robosim {

struct SoccerOptions {
  double goal_x_m = 4.5;  ///< x of the goal that the team attacks, world frame; the own one is at -goal_x_m. Not 0
  double half_width_m = 3;
  double goal_half_width_m = 1;
  double corner_m = 1.2;  ///< length that a wall across each corner cuts off the sides of the pitch
  double ball_radius_m = 0.11;
  double speed_mps = 1.5;
  bool is_keeper = false;
};

/// Soccer player. It detects the ball with two laser scanners (lowObjects()), and its own place by ranges to beacons at
/// the corners of the pitch, with a compass; without beacons by odometry. Players send each other `BALL side x y cost`
/// [mm] in each step in which they see the ball, where `side` is the sign of goal_x_m. The field player of a team with
/// the lowest cost pushes the ball towards the goal, the others stay behind the ball, and the keeper on its line. The
/// pitch is centred at the world's origin.
class SoccerPlayer : public Controller {
 public:
  SoccerPlayer(const ControllerSetup& setup, const SoccerOptions& options);
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<SoccerPlayer>(*this); }

 private:
  struct Sighting {
    mrpt::math::TPoint2D ball;  ///< world frame
    double cost_m = 0;          ///< of a team-mate: way to the ball
    std::uint64_t step = 0;
  };
  void locate(const Robot& robot);
  void lookForBall(Robot& robot);
  void readMessages(const Robot& robot);
  double costOf(const mrpt::math::TPoint2D& ball) const;
  bool isNearestToBall(const Robot& robot) const;
  void chase(Robot& robot);
  void keep(Robot& robot);
  void support(Robot& robot);
  double freeGoal_y_m(const Robot& robot) const;
  mrpt::math::TPoint2D aim(const Robot& robot) const;
  bool isFreeing(Robot& robot);

  double side() const { return options_.goal_x_m > 0 ? 1 : -1; }

  ControllerSetup setup_;
  SoccerOptions options_;
  PoseTracker tracker_;
  mrpt::math::TPose2D world_from_robot_;
  std::optional<Sighting> ball_;             ///< the newest, of this robot or of a team-mate
  mrpt::math::TPoint2D ball_mps_{0, 0};      ///< velocity
  std::map<std::string, Sighting> by_mate_;  ///< by name
  int stalls_ = 0;                           ///< steps in a row
  mrpt::math::TPoint2D rest_{0, 0};          ///< place near which the ball has been since rest_step_, world frame
  std::uint64_t rest_step_ = 0;
  std::uint64_t back_until_ = 0;  ///< step until which it drives back from what it has met
};

}  // namespace robosim
