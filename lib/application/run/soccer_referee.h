#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "run/observer.h"

namespace robosim {

struct SoccerRefereeOptions {
  double goal_x_m = 4.5;  ///< of the eastern goal line; the western one is at -goal_x_m
  double stuck_s = 10;    ///< time after which a ball that has not moved by 0.3 m is put back
  int goals = 0;          ///< of a team, upon which the run ends; 0: never
};

/// Referee of a soccer game on a pitch centred at the world's origin: counts a goal when all of the ball, the object
/// named `Ball`, is behind a goal line. Then, and when the ball is stuck, it makes the kick-off: it puts the ball at
/// the centre, and all robots at their starts.
class SoccerReferee : public Observer {
 public:
  SoccerReferee(const ObserverSetup& setup, const SoccerRefereeOptions& options);

  /// @throws std::runtime_error in a world without a movable object named `Ball`
  void observe(const Environment& environment) override;
  void supervise(Supervisor& supervisor) override;
  /// goals_east, goals_west: of balls in the eastern and the western goal; stuck: kick-offs without a goal.
  std::vector<Metric> metrics() const override;
  std::unique_ptr<Observer> clone(const ObserverSetup& setup) const override;

 private:
  std::string score() const;
  void kickOff(Supervisor& supervisor);

  ObserverSetup setup_;
  SoccerRefereeOptions options_;
  int goals_east_ = 0, goals_west_ = 0, stuck_ = 0;
  bool needs_kick_off_ = false;
  mrpt::math::TPoint2D rest_{0, 0};  ///< place that the ball has not left by 0.3 m
  double rest_since_s_ = 0;
};

ObserverType soccerRefereeType();

}  // namespace robosim
