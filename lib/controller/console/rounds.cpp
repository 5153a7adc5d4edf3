#include "console/rounds.h"

#include <algorithm>
#include <utility>

namespace robosim {
namespace {

/// The first and the last update of a round.
RoundResult resultOf(const Visitor& visitor, bool has_won, const RobotUpdate* first, const RobotUpdate* last) {
  RoundResult result{.visitor = visitor, .has_won = has_won};
  if (!first || !last) return result;
  result.time_s = std::max(0.0, last->readings.time.seconds() - first->readings.time.seconds());
  if (first->state.has_driven_m() && last->state.has_driven_m()) {
    result.distance_m = std::max(0.0, last->state.driven_m() - first->state.driven_m());
  }
  return result;
}

auto ofPage(PageId page) {
  return [page](const Visitor& visitor) { return visitor.page == page; };
}

}  // namespace

const char* nameOf(Rounds::Phase phase) {
  switch (phase) {
    case Rounds::Phase::idle:
      return "idle";
    case Rounds::Phase::called:
      return "called";
    case Rounds::Phase::starting:
      return "starting";
    case Rounds::Phase::driving:
      return "driving";
    case Rounds::Phase::result:
      return "result";
  }
  return "";
}

bool Rounds::join(const Visitor& visitor, Time now) {
  if (visitor_ && visitor_->page == visitor.page && phase_ != Phase::result) return true;
  const auto waiting = std::find_if(queue_.begin(), queue_.end(), ofPage(visitor.page));
  if (waiting != queue_.end()) {
    *waiting = visitor;
    ++revision_;
    return true;
  }
  if (queue_.size() >= kMaxWaiting) return false;
  queue_.push_back(visitor);
  ++revision_;
  if (phase_ != Phase::idle || queue_.size() > 1) return true;
  callNext(now);
  begin(now);
  return true;
}

void Rounds::start(PageId page, Time now) {
  if (phase_ == Phase::called && visitor_->page == page) begin(now);
}

void Rounds::leave(PageId page, Time now) {
  if (std::erase_if(queue_, ofPage(page)) > 0) ++revision_;
  if (visitor_ && visitor_->page == page && phase_ != Phase::result) callNext(now);
}

void Rounds::skip(Time now) {
  if (phase_ == Phase::driving) {
    is_skipped_ = true;  // update() ends the round, which has a result
  } else if (phase_ != Phase::idle) {
    callNext(now);
  }
}

Rounds::Actions Rounds::update(const Inputs& inputs, Time now) {
  Actions actions;
  if (!since_) since_ = now;
  if (phase_ != Phase::starting && !inputs.is_restarting) actions.resumes = std::exchange(is_paused_, false);
  switch (phase_) {
    case Phase::idle:
      actions.explores = now - *since_ >= kExploreAfter;
      break;
    case Phase::called:
      if (now - *since_ >= kCallWithin) callNext(now);
      break;
    case Phase::starting:
      updateStart(inputs, now, actions);
      break;
    case Phase::driving:
      updateRound(inputs, now, actions);
      break;
    case Phase::result:
      if (now - *since_ >= kResultFor) callNext(now);
      break;
  }
  return actions;
}

int Rounds::secondsLeft(Time now) const {
  const auto length = phase_ == Phase::driving  ? options_.length
                      : phase_ == Phase::called ? kCallWithin
                      : phase_ == Phase::result ? kResultFor
                                                : std::chrono::seconds(0);
  return static_cast<int>(std::max<std::int64_t>(
      0, std::chrono::ceil<std::chrono::seconds>(length - (now - since_.value_or(now))).count()));
}

void Rounds::enter(Phase phase, Time now) {
  phase_ = phase;
  since_ = now;
  ++revision_;
}

void Rounds::callNext(Time now) {
  visitor_.reset();
  if (queue_.empty()) return enter(Phase::idle, now);
  visitor_ = std::move(queue_.front());
  queue_.pop_front();
  enter(Phase::called, now);
}

void Rounds::begin(Time now) {
  enter(Phase::starting, now);
  has_begun_ = false;
  is_loading_ = false;
  is_skipped_ = false;
}

/// The robot leaves the previous run, and joins the new one; until then its updates are of the previous run.
void Rounds::updateStart(const Inputs& inputs, Time now, Actions& actions) {
  if (inputs.is_restarting) {
    is_loading_ = true;
    if (now - *since_ >= kLoadWithin) cancelStart(now, actions);
    return;
  }
  if (std::exchange(is_loading_, false)) since_ = now;
  if (!std::exchange(has_begun_, true)) {
    actions.begins = visitor_;
    actions.restarts = is_paused_ = inputs.may_restart;
    is_replaced_ = !actions.restarts;
    before_ = inputs.update;
    return;
  }
  is_replaced_ |= !inputs.is_up;
  if (is_paused_) {
    if (!(is_replaced_ && inputs.is_up) && now - *since_ < kResumeAfter) return;
    is_paused_ = false;
    actions.resumes = true;
    before_ = inputs.update;
    return;
  }
  if (is_replaced_ && inputs.is_up && !inputs.is_run_over && inputs.update != before_) {
    first_ = inputs.update;
    return enter(Phase::driving, now);
  }
  if (now - *since_ >= kStartWithin) cancelStart(now, actions);
}

void Rounds::cancelStart(Time now, Actions& actions) {
  actions.failed = visitor_;
  callNext(now);
}

void Rounds::updateRound(const Inputs& inputs, Time now, Actions& actions) {
  const bool is_over = inputs.has_won || inputs.is_run_over || is_skipped_ || now - *since_ >= options_.length;
  if (!is_over) return;
  actions.ends = resultOf(*visitor_, inputs.has_won, first_.get(), inputs.update.get());
  enter(Phase::result, now);
}

}  // namespace robosim
