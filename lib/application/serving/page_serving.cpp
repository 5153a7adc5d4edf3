#include "serving/page_serving.h"

#include <type_traits>
#include <utility>
#include <variant>

#include <mrpt/core/format.h>

#include "live_page/live_messages.h"
#include "world/intervention.h"

namespace robosim {

PageServing::~PageServing() {
  if (!encoding_) return;
  if (is_due_) send();
  control_.is_over = true;
  control_.why_not_operated = control_.why_not_supervised = "the run is over";
  server_.hub().setControl(control_);
}

void PageServing::begin(const Environment& environment, const std::string& id, std::uint64_t seed) {
  environment_ = &environment;
  encoding_.emplace(
      id, environment.world().name, environment.world(), environment.fleet(),
      std::vector<std::pair<std::string, std::string>>{
          {"Seed", std::to_string(seed)}, {"Time step", mrpt::format("%g s", environment.time().period_s)}});
  server_.hub().begin(id, encoding_->description());
  events_.clear();
  send();
}

void PageServing::addRobots() {
  auto items = encoding_->addRobots(environment_->fleet());
  if (items.empty()) return;
  server_.hub().describe(encoding_->description());
  server_.hub().add(std::move(items));
  is_due_ = true;
}

void PageServing::poll(RunControl& control, bool is_over, const Intervene& intervene) {
  for (const auto& request : server_.hub().takeRequests()) {
    server_.hub().answer(request, execute(request, control, intervene));
  }
  addRobots();
  is_due_ |= environment_->poseChanges() != pose_changes_;
  if (is_due_ && Clock::now() - sent_ >= kMomentPeriod) send();
  control_ = {.is_paused = control.is_paused,
              .is_over = is_over,
              .speed = control.speed,
              .why_not_operated = is_over ? "the run is over" : "",
              .why_not_supervised = is_over ? "the run is over" : ""};
  server_.hub().setControl(control_);
}

/// @return why the request has no effect; empty if it has
std::string PageServing::execute(const LiveRequest& request, RunControl& control, const Intervene& intervene) const {
  return std::visit(
      [&](const auto& action) -> std::string {
        using Action = std::decay_t<decltype(action)>;
        if constexpr (std::is_same_v<Action, PauseRun>) {
          control.pause(action.on);
        } else if constexpr (std::is_same_v<Action, StepOnce>) {
          control.step(1);
        } else if constexpr (std::is_same_v<Action, SetRunSpeed>) {
          if (std::string fault = speedFault(action.speed, options_.is_realtime); !fault.empty()) return fault;
          control.speed = action.speed;
        } else {
          return intervene({request.author, action});
        }
        return "";
      },
      request.action);
}

void PageServing::stepped() {
  noteEvents();
  is_due_ = true;
  if (Clock::now() - sent_ >= kMomentPeriod) send();
}

/// The messages that were delivered in the step, and the interventions before it.
void PageServing::noteEvents() {
  const State& state = environment_->state();
  for (const auto& [step, intervention] : state.interventions) {
    if (events_.size() >= LiveEncoding::kMaxEvents) return;
    if (step != state.time.step) continue;
    events_.push_back({"intervention", std::nullopt, intervention.author + ": " + changeText(intervention.change)});
  }
  std::vector<const Readings*> readings;
  readings.reserve(state.readings.size());
  for (const auto& of_robot : state.readings) readings.push_back(&of_robot);
  addMessages(environment_->fleet(), readings, events_);
}

void PageServing::send() {
  const State& state = environment_->state();
  LiveMoment moment{state.time.seconds(), {}, state.objects, std::exchange(events_, {})};
  for (std::size_t i = 0; i < environment_->robotCount(); ++i) {
    moment.robots.push_back({state.world_from_robot[i],
                             {state.activity[i], state.stalled[i] != 0, state.won && state.won->robot == i,
                              state.commands[i].by_driver, state.commands[i].led_color},
                             &state.readings[i]});
  }
  server_.hub().add(encoding_->add(moment));
  pose_changes_ = environment_->poseChanges();
  is_due_ = false;
  sent_ = Clock::now();
}

}  // namespace robosim
