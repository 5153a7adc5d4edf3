#include "run/soccer_referee.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/portable_math.h"
#include "base/text_table.h"

namespace robosim {
namespace {

constexpr const char* kBallName = "Ball";
constexpr double kStuck_m = 0.3;

const WorldObject& ballOf(const Environment& environment) {
  const auto& objects = environment.objects();
  const auto ball = std::find_if(objects.begin(), objects.end(),
                                 [](const WorldObject& object) { return object.movable && object.name == kBallName; });
  if (ball == objects.end()) {
    throw std::runtime_error("the world has no movable object named Ball; run the world soccer, or name the ball so");
  }
  return *ball;
}

}  // namespace

SoccerReferee::SoccerReferee(const ObserverSetup& setup, const SoccerRefereeOptions& options)
    : setup_(setup), options_(options) {}

void SoccerReferee::observe(const Environment& environment) {
  const Body& ball = ballOf(environment).body;
  const auto& place = ball.world_from_body;
  const double now_s = environment.time().seconds();
  if (portable::hypot(place.x - rest_.x, place.y - rest_.y) > kStuck_m) {
    rest_ = {place.x, place.y};
    rest_since_s_ = now_s;
  }
  if (needs_kick_off_) return;
  const double over_line_m = options_.goal_x_m + ball.coveringRadius();
  if (std::abs(place.x) > over_line_m) {
    ++(place.x > 0 ? goals_east_ : goals_west_);
    needs_kick_off_ = true;
    if (setup_.log) setup_.log("a goal in the " + std::string(place.x > 0 ? "east" : "west") + ": " + score());
  } else if (now_s - rest_since_s_ >= options_.stuck_s) {
    ++stuck_;
    needs_kick_off_ = true;
    if (setup_.log) setup_.log("the ball is stuck at (" + fixed(place.x, 1) + ", " + fixed(place.y, 1) + ") m");
  }
}

std::string SoccerReferee::score() const { return std::to_string(goals_east_) + " : " + std::to_string(goals_west_); }

void SoccerReferee::supervise(Supervisor& supervisor) {
  if (!needs_kick_off_) return;
  if (options_.goals > 0 && std::max(goals_east_, goals_west_) >= options_.goals) {
    const std::string fault =
        supervisor.apply(EndRun{goals_east_ > goals_west_ ? "west_team_won" : "east_team_won", score()});
    if (!fault.empty()) throw std::runtime_error(fault);
    return;
  }
  kickOff(supervisor);
}

/// Takes all robots out of the world first, so that no start is occupied.
void SoccerReferee::kickOff(Supervisor& supervisor) {
  const auto apply = [&](const Change& change) {
    const std::string fault = supervisor.apply(change);
    if (!fault.empty()) throw std::runtime_error("no kick-off is possible: " + fault);
  };
  const auto& robots = supervisor.environment().fleet().robots;
  const auto& state = supervisor.environment().state();
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!state.isAbsent(i)) present.push_back(i);
  }
  for (const std::size_t i : present) apply(RemoveBody{robots[i].info.name});
  apply(PlaceBody{kBallName, 0, 0, 0});
  for (const std::size_t i : present) {
    const auto& start = robots[i].world_from_start;
    apply(PlaceBody{robots[i].info.name, start.x, start.y, start.phi});
  }
  needs_kick_off_ = false;
  rest_ = {0, 0};
  rest_since_s_ = supervisor.environment().time().seconds();
}

std::vector<Metric> SoccerReferee::metrics() const {
  return {{"goals_east", static_cast<double>(goals_east_)},
          {"goals_west", static_cast<double>(goals_west_)},
          {"stuck", static_cast<double>(stuck_)}};
}

std::unique_ptr<Observer> SoccerReferee::clone(const ObserverSetup& setup) const {
  auto copy = std::make_unique<SoccerReferee>(*this);
  copy->setup_ = setup;
  return copy;
}

ObserverType soccerRefereeType() {
  return {"soccer",
          "Referee of a soccer game: counts goals, and makes the kick-offs.",
          {{"goal_x_m", SoccerRefereeOptions{}.goal_x_m, 0.1, 1000, "m", "x of the eastern goal line in the world"},
           {"stuck_s", SoccerRefereeOptions{}.stuck_s, 1, 1e6, "s", "time after which a ball at rest is put back"},
           {"goals", 0, 0, 1000, "", "ends the run at this number of goals in one goal; 0: never"}},
          [](const ObserverSetup& setup, const ParameterValues& p) -> std::unique_ptr<Observer> {
            return std::make_unique<SoccerReferee>(
                setup, SoccerRefereeOptions{p["goal_x_m"], p["stuck_s"], static_cast<int>(p["goals"])});
          },
          true};
}

}  // namespace robosim
