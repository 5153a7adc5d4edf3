#include "console/best_of_day.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/error_list.h"

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxTextBytes = 200;

std::string textOf(const Json& entry, const char* member) {
  const auto text = entry.at(member).get<std::string>();
  if (text.size() > kMaxTextBytes) throw std::out_of_range(member);
  return text;
}

double numberOf(const Json& value) {
  const auto number = value.get<double>();
  if (!std::isfinite(number) || number < 0) throw std::out_of_range("number");
  return number;
}

}  // namespace

void BestOfDay::setDay(const std::string& day) {
  if (std::exchange(day_, day) != day) results_.clear();
}

std::size_t BestOfDay::add(const DayResult& result) {
  const auto slower = std::upper_bound(results_.begin(), results_.end(), result.time_s,
                                       [](double time_s, const DayResult& other) { return time_s < other.time_s; });
  const auto rank = static_cast<std::size_t>(slower - results_.begin()) + 1;
  results_.insert(slower, result);
  if (results_.size() > kMaxResults) results_.pop_back();
  return rank;
}

std::vector<TeamStanding> BestOfDay::standings() const {
  std::vector<TeamStanding> standings;
  for (const auto& result : results_) {  // the best time of each team first
    if (result.team.empty()) continue;
    auto found = std::find_if(standings.begin(), standings.end(),
                              [&](const TeamStanding& standing) { return standing.team == result.team; });
    if (found == standings.end()) found = standings.insert(found, {result.team, 0, result.time_s});
    ++found->wins;
  }
  std::stable_sort(standings.begin(), standings.end(),
                   [](const TeamStanding& a, const TeamStanding& b) { return a.wins > b.wins; });
  return standings;
}

std::string BestOfDay::text() const {
  Json list = Json::array();
  for (const auto& result : results_) {
    list.push_back({{"name", result.name},
                    {"team", result.team},
                    {"time_s", result.time_s},
                    {"distance_m", result.distance_m ? Json(*result.distance_m) : Json(nullptr)}});
  }
  return Json{{"day", day_}, {"results", list}}.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

BestOfDay BestOfDay::parse(std::string_view text, const std::string& file) {
  BestOfDay best;
  try {
    const Json json = Json::parse(text);
    best.setDay(textOf(json, "day"));
    for (const auto& entry : json.at("results")) {
      const Json& distance = entry.at("distance_m");
      best.add({textOf(entry, "name"), textOf(entry, "team"), numberOf(entry.at("time_s")),
                distance.is_null() ? std::nullopt : std::optional(numberOf(distance))});
    }
  } catch (const std::exception&) {
    throw ConfigError(file + ": not a list of results of the day, or damaged; delete the file, or select another");
  }
  return best;
}

}  // namespace robosim
