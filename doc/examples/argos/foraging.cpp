#include <algorithm>
#include <memory>

#include <robosim/base/random.h>

#include "footbot.h"
#include "types.h"

namespace {

struct Options {
  double speed_mps;
  double step;  ///< by which a rule changes a probability
  double rest_s, search_s;
};

/// Rests in the nest, explores until it has found food or searched in vain, and returns to the nest by the light. How
/// likely it is to leave and to give up changes with its own luck, with collisions, and with what others report.
class Foraging : public robosim::Controller {
 public:
  Foraging(const Options& options, const robosim::ControllerSetup& setup)
      : options_(options),
        random_(setup.seed, robosim::RandomPurpose::controller, setup.robot),
        steering_(options.speed_mps) {}

  void step(robosim::Robot& robot) override {
    const auto& floor = ground(robot);
    const bool in_nest = isGrey(floor[1]) && isGrey(floor[2]);  // both rear sensors: all of the robot
    switch (state_) {
      case State::resting:
        return rest(robot);
      case State::exploring:
        return explore(robot, in_nest, floor[0] < 0.25 || floor[3] < 0.25);
      case State::returning:
        return returnToNest(robot, in_nest);
    }
  }

  std::unique_ptr<robosim::Controller> clone() const override { return std::make_unique<Foraging>(*this); }

 private:
  enum class State { resting, exploring, returning };

  static bool isGrey(double grey) { return grey > 0.25 && grey < 0.75; }

  /// Makes leaving the nest more likely, and giving up less likely; the opposite for a negative sign.
  void encourage(double sign) {
    leave_ = std::clamp(leave_ + sign * options_.step, 0.0, 1.0);
    give_up_ = std::clamp(give_up_ - sign * options_.step, 0.0, 1.0);
  }

  void become(State state, const std::array<float, 3>& leds, robosim::Robot& robot) {
    state_ = state;
    since_s_ = robot.time();
    robot.setLeds(leds);
  }

  void rest(robosim::Robot& robot) {
    robot.stop();
    for (const auto& message : robot.inbox()) encourage(message.text == "food" ? 1 : -1);
    if (robot.time() - since_s_ > options_.rest_s && random_.uniform() < leave_) {
      become(State::exploring, {0, 1, 0}, robot);
    }
  }

  void explore(robosim::Robot& robot, bool in_nest, bool on_food) {
    const bool in_vain = robot.time() - since_s_ > options_.search_s;
    if (on_food || (in_vain && random_.uniform() < give_up_)) {
      has_food_ = on_food;
      if (on_food) encourage(1);
      return become(State::returning, {0, 0, 1}, robot);
    }
    if (in_vain) encourage(-1);
    const Vector near = proximity(robot);
    if (isObstacle(near)) encourage(-1);
    Vector wish = avoid(near);
    if (in_nest) wish = wish + towardsLight(robot) * -0.25;  // out of the nest, away from the light
    steering_.follow(wish * options_.speed_mps, robot);
  }

  void returnToNest(robosim::Robot& robot, bool in_nest) {
    if (!in_nest) entered_s_ = robot.time();
    if (in_nest && robot.time() - entered_s_ > options_.rest_s) {  // a place deep enough inside
      robot.broadcast(has_food_ ? "food" : "none");
      return become(State::resting, {1, 0, 0}, robot);
    }
    steering_.follow((avoid(proximity(robot)) + towardsLight(robot)) * options_.speed_mps, robot);
  }

  static bool isObstacle(const Vector& near) { return std::abs(near.angle()) > 5 * M_PI / 180 || near.length() >= 0.1; }
  /// Straight on where nothing is near, else away from it.
  static Vector avoid(const Vector& near) { return isObstacle(near) ? near.unit() * -1 : Vector{1, 0}; }

  Options options_;
  robosim::Rng random_;
  Steering steering_;
  State state_ = State::resting;
  double since_s_ = 0, entered_s_ = 0;
  double leave_ = 0.1, give_up_ = 0.1;  ///< probabilities per step
  bool has_food_ = false;
};

}  // namespace

robosim::ControllerType argosForagingType() {
  return {"argos_foraging",
          "Searches food, which is black, and carries it to the nest, which is grey and near lights.",
          {robosim::SensorKind::infrared, robosim::SensorKind::values},
          {{"speed_mps", 0.1, 0, 0.3, "m/s", "largest speed of a wheel"},
           {"step", 0.01, 0, 1, "", "by which luck, collisions and messages change probabilities"},
           {"rest_s", 5, 0, 1000, "s", "shortest rest, and time that a robot searches a place in the nest"},
           {"search_s", 60, 0, 10000, "s", "time from which a robot without food may give up"}},
          [](const robosim::ControllerSetup& setup,
             const robosim::ParameterValues& p) -> std::unique_ptr<robosim::Controller> {
            return std::make_unique<Foraging>(Options{p["speed_mps"], p["step"], p["rest_s"], p["search_s"]}, setup);
          }};
}
