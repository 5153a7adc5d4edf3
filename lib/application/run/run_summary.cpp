#include "run/run_summary.h"

#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "base/printable_text.h"
#include "base/text_table.h"
#include "environment/run_report.h"

namespace robosim {
namespace {

template <typename T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json lossesJson(const MessageLosses& lost) {
  return {{"out_of_range", lost.out_of_range},
          {"stopped_by_walls", lost.stopped_by_walls},
          {"by_chance", lost.by_chance},
          {"in_bursts", lost.in_bursts},
          {"absent", lost.absent}};
}

/// ", and 12 lost: 10 out of range, 2 in bursts"; empty for none.
std::string textOf(const MessageLosses& lost) {
  std::string causes;
  const std::pair<std::uint64_t, const char*> numbers[] = {{lost.out_of_range, "out of range"},
                                                           {lost.stopped_by_walls, "stopped by walls"},
                                                           {lost.by_chance, "by chance"},
                                                           {lost.in_bursts, "in bursts"},
                                                           {lost.absent, "to absent robots"}};
  for (const auto& [number, cause] : numbers) {
    if (number > 0) causes += (causes.empty() ? "" : ", ") + withCommas(number) + " " + cause;
  }
  return causes.empty() ? "" : ", and " + withCommas(lost.total()) + " lost: " + causes;
}

constexpr const char* kSeedHadNoEffect =
    " (without effect: nothing in this run was random; --random-starts or --noise on make seeds differ)";

/// @param observer_end RunObservers::end()
/// @param intervention_end State::ended
std::string sentenceOn(const GoldOutcome& gold, EndedBy why, const std::optional<ObserverEnd>& observer_end,
                       const std::optional<RunEnd>& intervention_end) {
  std::string text = "no gold found";
  if (gold.won_by) {
    text = *gold.won_by + " has won after " + fixed(*gold.won_s, 1) + " s";
  } else if (gold.found_by) {
    text = "gold found by " + *gold.found_by + " after " + fixed(*gold.found_s, 1) + " s";
  }
  if (gold.all_halted_s) text += "; all robots halted after " + fixed(*gold.all_halted_s, 1) + " s";
  if (why == EndedBy::time_limit) text += "; ended by the time limit";
  if (why == EndedBy::interrupt) text += "; interrupted";
  if (why == EndedBy::control_panel) text += "; ended from a control panel";
  if (why == EndedBy::arcos_program) text += "; ended by an ARCOS program, which has loaded another map";
  if (why == EndedBy::robot_lost) text += "; ended because a robot was lost";
  if (why == EndedBy::window_closed) text += "; ended by closing the window";
  if (why == EndedBy::observer && observer_end) {
    text += "; ended by " + observer_end->observer + ": " + observer_end->reason;
  }
  if (why == EndedBy::intervention && intervention_end) {
    text += "; ended with the outcome " + printableText(intervention_end->outcome);
    if (!intervention_end->text.empty()) text += ": " + printableText(intervention_end->text);
  }
  return text;
}

std::string textOn(const LostRobot& robot) {
  return robot.name + (robot.times == 1 ? ", once" : ", " + withCommas(robot.times) + " times") +
         (robot.is_lost ? ", not back" : ", back") + "; " + withCommas(robot.steps_missed) +
         " steps were taken without it";
}

/// Client statistics in the summary of a served run: lost robots, geometry workers, lost messages.
nlohmann::ordered_json clientsJson(const RunReport& report) {
  nlohmann::ordered_json lost = nlohmann::ordered_json::array();
  for (const auto& robot : report.lost_robots) {
    lost.push_back({{"name", robot.name},
                    {"times", robot.times},
                    {"steps_missed", robot.steps_missed},
                    {"is_lost", robot.is_lost},
                    {"restarts", robot.restarts}});
  }
  nlohmann::ordered_json rejected = nlohmann::ordered_json::array();
  for (const auto& worker : report.rejected_workers) {
    rejected.push_back({{"peer", worker.peer}, {"step", worker.step}, {"reason", worker.reason}});
  }
  return {{"all_robots", report.hasAllRobots()},
          {"restarted_robots", report.restartedRobots()},
          {"on_lost_robot", nameOf(report.on_lost_robot)},
          {"lost_robots", lost},
          {"messages_lost", report.messages_lost},
          {"geometry_workers", report.geometry_workers},
          {"geometry_results", report.geometry_results},
          {"results_checked", report.results_checked},
          {"corrupted_messages", report.corrupted_messages},
          {"trusted", report.isTrusted()},
          {"rejected_workers", rejected}};
}

/// Adds a row for each non-empty statistic.
void addClients(const RunReport& report, Rows& rows) {
  for (const auto& robot : report.lost_robots) rows.push_back({"lost", textOn(robot)});
  if (report.messages_lost > 0) rows.push_back({"lost", withCommas(report.messages_lost) + " messages between robots"});
  if (report.geometry_workers > 0) {
    rows.push_back({"geometry", withCommas(report.geometry_workers) + " workers computed " +
                                    withCommas(report.geometry_results) + " results, of which " +
                                    withCommas(report.results_checked) + " were recomputed to check them"});
  }
  if (report.corrupted_messages > 0) {
    rows.push_back({"corrupted", withCommas(report.corrupted_messages) + " messages of geometry workers, discarded"});
  }
  for (const auto& worker : report.rejected_workers) {
    rows.push_back(
        {"rejected", "geometry worker " + worker.peer + " at step " + withCommas(worker.step) + ": " + worker.reason});
  }
}

}  // namespace

const char* nameOf(EndedBy why) {
  switch (why) {
    case EndedBy::all_halted:
      return "all_halted";
    case EndedBy::time_limit:
      return "time_limit";
    case EndedBy::interrupt:
      return "interrupted";
    case EndedBy::control_panel:
      return "control_panel";
    case EndedBy::arcos_program:
      return "arcos_program";
    case EndedBy::robot_lost:
      return "robot_lost";
    case EndedBy::window_closed:
      return "window_closed";
    case EndedBy::observer:
      return "observer";
    case EndedBy::intervention:
      return "intervention";
    case EndedBy::recording_stopped:
      return "recording_stopped";
  }
  return "";
}

EndedBy endedByItself(const LocalRun& run) {
  if (run.environment().state().ended) return EndedBy::intervention;
  if (run.gold().all_halted_s) return EndedBy::all_halted;
  return run.isOver() ? EndedBy::observer : EndedBy::time_limit;
}

nlohmann::ordered_json metricsJson(const std::vector<Metric>& metrics) {
  auto by_name = nlohmann::ordered_json::object();
  for (const auto& metric : metrics) {
    by_name[metric.name] = std::isfinite(metric.value) ? nlohmann::ordered_json(metric.value) : nullptr;
  }
  return by_name;
}

Rows metricRows(const std::vector<Metric>& metrics) {
  Rows rows;
  for (const auto& metric : metrics) {
    rows.push_back({metric.name, std::isfinite(metric.value) ? fixed(metric.value, 3) : "none"});
  }
  return rows;
}

RunSummary RunSummary::of(const LocalRun& run) {
  const Environment& environment = run.environment();
  const State& state = environment.state();
  RunSummary summary;
  summary.robots = environment.robotCount();
  summary.steps = state.time.step;
  summary.sim_time_s = state.time.seconds();
  summary.digest = environment.digest();
  summary.depends_on_seed = run.dependsOnSeed();
  summary.gold = run.gold();
  summary.driven_m = std::accumulate(state.driven_m.begin(), state.driven_m.end(), 0.0);
  summary.stalls = state.stalls;
  summary.messages = state.messages_delivered;
  summary.messages_sent = messagesSent(state);
  summary.messages_dropped = state.messages_dropped;
  summary.messages_lost = state.messages_lost;
  summary.interventions = state.interventions_applied;
  summary.metrics = run.observers().metrics();
  summary.observer_end = run.observers().end();
  summary.intervention_end = state.ended;
  return summary;
}

nlohmann::ordered_json RunSummary::json() const {
  const bool is_ended_by_observer = ended_by == EndedBy::observer && observer_end;
  const bool is_ended_by_intervention = ended_by == EndedBy::intervention && intervention_end;
  std::optional<std::string> reason;
  if (is_ended_by_observer) reason = observer_end->reason;
  if (is_ended_by_intervention) reason = intervention_end->text;
  return {{"world", world},
          {"seed", seed},
          {"depends_on_seed", depends_on_seed},
          {"robots", robots},
          {"steps", steps},
          {"sim_time_s", sim_time_s},
          {"wall_s", wall_s},
          {"real_time_factor", realTimeFactor()},
          {"ended_by", nameOf(ended_by)},
          {"ended_by_observer", is_ended_by_observer ? nlohmann::ordered_json(observer_end->observer) : nullptr},
          {"end_outcome", is_ended_by_intervention ? nlohmann::ordered_json(intervention_end->outcome) : nullptr},
          {"end_reason", orNull(reason)},
          {"digest", digest},
          {"gold_found", gold.found_s.has_value()},
          {"gold_found_by", orNull(gold.found_by)},
          {"gold_time_s", orNull(gold.found_s)},
          {"won_by", orNull(gold.won_by)},
          {"won_time_s", orNull(gold.won_s)},
          {"all_halted_time_s", orNull(gold.all_halted_s)},
          {"driven_m", driven_m},
          {"stalls", stalls},
          {"messages", messages},
          {"messages_sent", messages_sent},
          {"messages_dropped", messages_dropped},
          {"messages_lost", lossesJson(messages_lost)},
          {"interventions", interventions},
          {"late", orNull(late)},
          {"metrics", metricsJson(metrics)},
          {"clients", report ? clientsJson(*report) : nlohmann::ordered_json(nullptr)}};
}

std::string RunSummary::text() const {
  Rows rows{{"robots", std::to_string(robots)},
            {"simulated", fixed(sim_time_s, 1) + " s in " + withCommas(steps) + " steps"},
            {"took",
             fixed(wall_s, 3) + " s, " + withCommas(static_cast<std::uint64_t>(realTimeFactor())) + " times real time"},
            {"driven", fixed(driven_m, 1) + " m"},
            {"stalls", withCommas(stalls)},
            {"messages", withCommas(messages) +
                             (messages_dropped == 0 ? "" : ", and " + withCommas(messages_dropped) + " dropped") +
                             textOf(messages_lost)}};
  if (interventions > 0) rows.push_back({"interventions", withCommas(interventions)});
  if (late) rows.push_back({"late", withCommas(*late) + " commands, of " + withCommas(steps * robots)});
  rows.push_back({"seed", std::to_string(seed) + (depends_on_seed ? "" : kSeedHadNoEffect)});
  rows.push_back({"digest", digest});
  for (auto& row : metricRows(metrics)) rows.push_back(std::move(row));
  std::string sentence = sentenceOn(gold, ended_by, observer_end, intervention_end);
  if (report) {
    addClients(*report, rows);
    if (!report->hasAllRobots()) sentence += "; INCOMPLETE: steps were taken without some robots, or messages lost";
    if (const auto restarted = report->restartedRobots(); !restarted.empty()) {
      sentence += "; not reproducible: controllers of " + listed(restarted) + " were restarted";
    }
    if (!report->isTrusted()) sentence += "; NOT TRUSTED: a geometry worker returned wrong results";
  }
  return printableText(world + ": " + sentence) + "\n" + listing(rows);
}

}  // namespace robosim
