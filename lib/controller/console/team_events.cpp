#include "console/team_events.h"

#include <algorithm>

namespace robosim {

std::string winnerOf(const std::vector<TeamRobot>& robots) {
  const bool is_any_up =
      std::any_of(robots.begin(), robots.end(), [](const TeamRobot& robot) { return robot.news.is_up; });
  std::string winner;
  for (const auto& robot : robots) {
    if (robot.news.is_up == is_any_up && !robot.news.state.winner().empty()) winner = robot.news.state.winner();
  }
  return winner;
}

std::vector<TeamEvents::Note> TeamEvents::news(const std::vector<TeamRobot>& robots) {
  std::vector<Note> notes;
  for (const auto& robot : robots) {
    RobotNews& before = previous_[robot.name];
    const RobotNews& now = robot.news;
    const bool was_reported_down = !before.is_up && !before.is_over && !before.problem.empty();
    if (now.is_up && was_reported_down) notes.push_back({Kind::up, robot.name + " is up."});
    if (!now.is_up && before.is_up && !now.is_over) {
      notes.push_back({Kind::down, robot.name + " is down.", now.problem});
    }
    if (now.state.why_stopped() != before.state.why_stopped() && !now.state.why_stopped().empty()) {
      notes.push_back({Kind::stopped, robot.name + " stopped: " + now.state.why_stopped() + "."});
    }
    if (before.is_up && now.state.win_refusals() > before.state.win_refusals()) {
      notes.push_back({Kind::too_far, robot.name + " is too far from the gold to have won."});
    }
    const bool is_primary = &robot == &robots.front();
    if (is_primary && now.state.winner() != before.state.winner() && !now.state.winner().empty()) {
      notes.push_back({Kind::won, now.state.winner() + " has won"});
    }
    before = now;
  }
  return notes;
}

}  // namespace robosim
