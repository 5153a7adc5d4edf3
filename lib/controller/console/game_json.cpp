#include "console/game_json.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxBest = 5;
constexpr std::size_t kMaxStandings = 6;

double tenths(double value) { return std::round(value * 10) / 10; }

Json distanceJson(const std::optional<double>& distance_m) {
  return distance_m ? Json(tenths(*distance_m)) : Json(nullptr);
}

Json toJson(const Visitor& visitor) { return {{"page", visitor.page}, {"name", visitor.name}, {"team", visitor.team}}; }

Json toJson(const Rounds& rounds, Rounds::Time now) {
  Json queue = Json::array();
  for (const auto& visitor : rounds.queue()) queue.push_back(toJson(visitor));
  return {{"phase", nameOf(rounds.phase())},
          {"length_s", rounds.options().length.count()},
          {"left_s", rounds.secondsLeft(now)},
          {"visitor", rounds.visitor() ? toJson(*rounds.visitor()) : Json(nullptr)},
          {"queue", queue},
          {"teams", rounds.options().teams}};
}

Json toJson(const GameResult& game) {
  const RoundResult& result = game.result;
  Json json = toJson(result.visitor);
  json["number"] = game.number;
  json["won"] = result.has_won;
  json["time_s"] = tenths(result.time_s);
  json["distance_m"] = distanceJson(result.distance_m);
  json["rank"] = game.rank;
  return json;
}

}  // namespace

std::string gameJson(const Rounds* rounds, Rounds::Time now, const GameResult* result, const BestOfDay& best) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(kMaxBest, best.results().size()); ++i) {
    const DayResult& each = best.results()[i];
    list.push_back({{"name", each.name},
                    {"team", each.team},
                    {"time_s", tenths(each.time_s)},
                    {"distance_m", distanceJson(each.distance_m)}});
  }
  Json standings = Json::array();
  for (const auto& standing : best.standings()) {
    if (standings.size() == kMaxStandings) break;
    standings.push_back({{"team", standing.team}, {"wins", standing.wins}, {"best_s", tenths(standing.best_s)}});
  }
  return Json{{"type", "game"},
              {"rounds", rounds ? toJson(*rounds, now) : Json(nullptr)},
              {"result", result ? toJson(*result) : Json(nullptr)},
              {"best", list},
              {"standings", standings}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace robosim
