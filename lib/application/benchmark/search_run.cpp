#include "benchmark/search_run.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <typename T>
std::optional<T> readOptional(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

}  // namespace

SearchRun SearchRun::of(std::size_t case_index, const RunSummary& summary) {
  SearchRun run;
  run.case_index = case_index;
  run.seed = summary.seed;
  run.robots = summary.robots;
  run.sim_time_s = summary.sim_time_s;
  run.ended_by = nameOf(summary.ended_by);
  if (summary.observer_end) run.end_reason = summary.observer_end->reason;
  run.found_by = summary.gold.found_by;
  run.found_s = summary.gold.found_s;
  run.all_halted_s = summary.gold.all_halted_s;
  run.driven_m = summary.driven_m;
  run.stalls = summary.stalls;
  run.messages_sent = summary.messages_sent;
  run.messages_delivered = summary.messages;
  run.messages_lost = summary.messages_lost.total();
  run.metrics = summary.metrics;
  run.digest = summary.digest;
  run.wall_s = summary.wall_s;
  return run;
}

double SearchRun::metric(const std::string& name) const {
  for (const auto& metric : metrics) {
    if (metric.name == name) return metric.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Json SearchRun::json() const {
  Json values = Json::object();
  for (const auto& metric : metrics) values[metric.name] = std::isfinite(metric.value) ? Json(metric.value) : Json();
  return {{"case", case_index},
          {"seed", seed},
          {"robots", robots},
          {"sim_time_s", sim_time_s},
          {"ended_by", ended_by},
          {"end_reason", end_reason},
          {"found_by", orNull(found_by)},
          {"found_s", orNull(found_s)},
          {"all_halted_s", orNull(all_halted_s)},
          {"driven_m", driven_m},
          {"stalls", stalls},
          {"messages_sent", messages_sent},
          {"messages_delivered", messages_delivered},
          {"messages_lost", messages_lost},
          {"metrics", values},
          {"digest", digest}};
}

SearchRun SearchRun::fromJson(const Json& json) {
  SearchRun run;
  run.case_index = json.at("case").get<std::size_t>();
  run.seed = json.at("seed").get<std::uint64_t>();
  run.robots = json.at("robots").get<std::size_t>();
  run.sim_time_s = json.at("sim_time_s").get<double>();
  run.ended_by = json.at("ended_by").get<std::string>();
  run.end_reason = json.at("end_reason").get<std::string>();
  run.found_by = readOptional<std::string>(json.at("found_by"));
  run.found_s = readOptional<double>(json.at("found_s"));
  run.all_halted_s = readOptional<double>(json.at("all_halted_s"));
  run.driven_m = json.at("driven_m").get<double>();
  run.stalls = json.at("stalls").get<std::uint64_t>();
  run.messages_sent = json.at("messages_sent").get<std::uint64_t>();
  run.messages_delivered = json.at("messages_delivered").get<std::uint64_t>();
  run.messages_lost = json.at("messages_lost").get<std::uint64_t>();
  for (const auto& [name, value] : json.at("metrics").items()) {
    run.metrics.push_back({name, value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>()});
  }
  run.digest = json.at("digest").get<std::string>();
  return run;
}

}  // namespace robosim
