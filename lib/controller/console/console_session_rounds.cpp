// Rounds of visitors, and results of the day: connects Rounds and BestOfDay with the control lock, the robot and the
// run.
#include <algorithm>
#include <utility>

#include "console/console_session.h"

namespace robosim {
namespace {

/// Minimum between two attempts to let the robot explore, for which the run may have to be replaced first.
constexpr std::chrono::seconds kExplorePeriod{3};

}  // namespace

void ConsoleSession::join(Page& page, const PageMessage& message, Time now) {
  if (!rounds_) return;
  const auto& teams = rounds_->options().teams;
  if (!message.team.empty() && std::find(teams.begin(), teams.end(), message.team) == teams.end()) {
    throw WireError("a team that this console does not offer");
  }
  const std::string name = message.name.empty() ? pageName(page.id) : message.name;
  if (std::exchange(page.name, name) != name) publishTeam();
  if (!rounds_->join({page.id, page.name, message.team}, now)) {
    reply(page, noteJson("The queue is full. Try again in a minute.", true));
    return;
  }
  may_explore_ = true;
}

/// The page leaves the queue, or loses its round.
void ConsoleSession::leaveRounds(Page& page) {
  rounds_->leave(page.id, now_);
  release(page, page.name + " has left the round");
}

/// An operator ends the round, calls the next visitor, or stops the robot that explores.
void ConsoleSession::skipRound(Page& page) {
  if (!rounds_) return;
  audit(page, "skip");
  if (rounds_->phase() == Rounds::Phase::idle) {
    may_explore_ = false;
    act(SendOrder{stopOrder("")});
  }
  rounds_->skip(now_);
  revokeEndedRound();
}

/// Only the visitor of a round that starts or lasts has the control lock.
void ConsoleSession::revokeEndedRound() {
  Page* const page = find(lock_.holder);
  const auto phase = rounds_->phase();
  const bool is_round = phase == Rounds::Phase::starting || phase == Rounds::Phase::driving;
  if (page && !(is_round && rounds_->visitor()->page == page->id)) release(*page, page->name + "'s round is over");
}

Rounds::Inputs ConsoleSession::roundInputs() const {
  const RobotNews& robot = feed_.primary;
  return {.may_restart = run_.may_restart || run_.may_replace,
          .is_restarting = run_.is_restarting,
          .is_run_over = run_.phase == RunView::Phase::ended || robot.is_over || !winner_.empty(),
          .is_up = robot.is_up && !robot.is_over,
          .has_won = !winner_.empty() && winner_ == primary(),
          .update = robot.update};
}

void ConsoleSession::updateRounds(Time now) {
  if (!rounds_ || robots_.empty()) return;
  const Rounds::Actions actions = rounds_->update(roundInputs(), now);
  if (actions.begins) {
    Page* page = find(actions.begins->page);
    if (page && !page->is_leaving && mayDrive(access_, page->client, primary())) {
      giveControl(*page);
    } else {
      rounds_->leave(actions.begins->page, now);  // it has left, or its token was revoked
    }
  }
  if (actions.restarts) act(RestartRun{.paused = true});
  if (actions.resumes) act(ResumeRun{});
  if (actions.failed) {
    if (Page* page = find(actions.failed->page)) {
      reply(*page, noteJson("The round could not be started. Try again.", true));
      release(*page, page->name + "'s round could not be started");
    }
  }
  if (actions.ends) {
    addResult(*actions.ends);
    if (Page* page = find(actions.ends->visitor.page)) release(*page, page->name + "'s round is over");
  }
  revokeEndedRound();
  if (actions.explores && may_explore_) explore(now);
}

/// Lets the robot explore by itself, in a new run if the last one is over.
void ConsoleSession::explore(Time now) {
  if (now - explored_ < kExplorePeriod || lock_.holder != 0) return;
  const Rounds::Inputs inputs = roundInputs();
  const v1::RobotState& state = feed_.primary.state;
  if (inputs.is_run_over) {
    if (!inputs.may_restart || inputs.is_restarting) return;
    act(RestartRun{});
  } else {
    const bool has_other_driver = !state.driver().empty() && !state.is_yours();
    const bool is_active = state.activity() == v1::ACTIVITY_ACTIVE;
    if (!inputs.is_up || state.autonomous() || has_other_driver || !is_active || pending_switch_) return;
    act(SendOrder{modeOrder(true)});
  }
  explored_ = now;
}

/// Without rounds, the result of a run that the page with the control lock has won.
void ConsoleSession::takeWin() {
  winner_ = winnerOf(robots_);
  const Rounds::Inputs inputs = roundInputs();
  if (winner_.empty() && inputs.is_up && !inputs.is_run_over) is_win_listed_ = false;  // of the run before
  if (rounds_ || winner_.empty() || winner_ != primary() || is_win_listed_) return;
  const Page* const page = find(lock_.holder);
  const auto& update = feed_.primary.update;
  if (!page || !update) return;
  RoundResult result{.visitor = {page->id, page->name}, .has_won = true, .time_s = update->readings.time.seconds()};
  if (update->state.has_driven_m()) result.distance_m = update->state.driven_m();
  is_win_listed_ = true;
  addResult(result);
}

void ConsoleSession::addResult(const RoundResult& result) {
  game_result_ = {game_result_ ? game_result_->number + 1 : 1, result, 0};
  if (!result.has_won || result.time_s <= 0) return;
  game_result_->rank = best_.add({result.visitor.name, result.visitor.team, result.time_s, result.distance_m});
  act(SaveResults{best_.text()});
}

void ConsoleSession::publishGame(Time now) {
  const Rounds* const rounds = rounds_ ? &*rounds_ : nullptr;
  const GameResult* const result = game_result_ ? &*game_result_ : nullptr;
  const GameVersion version{rounds ? rounds->revision() : 0, result ? result->number : 0,
                            rounds ? rounds->secondsLeft(now) : 0, today_};
  if (game_version_ == version) return;
  game_version_ = version;
  if (feed_.game.set(gameJson(rounds, now, result, best_))) wakeAdmittedPages();
}

}  // namespace robosim
