#include "benchmark/runs_on_ranks.h"

#include <nlohmann/json.hpp>

#include "distributed/ranks/tasks_on_ranks.h"

namespace robosim {

void makeRunsOnRanks(RankGroup& group, const NumberedRuns& source, const std::function<bool()>& is_interrupted,
                     const std::function<void(const SearchRun&)>& finished, SearchRuns& runs) {
  RankTasks tasks;
  if (group.isFirst()) tasks.to_do = missing(runs);
  tasks.is_interrupted = is_interrupted;
  tasks.make = [&](std::size_t index, const std::function<bool()>& is_over) -> std::optional<std::string> {
    const auto run = source.run(index, is_over);
    if (!run) return std::nullopt;
    auto json = run->json();
    json["wall_s"] = run->wall_s;
    return json.dump();
  };
  tasks.finished = [&](std::size_t index, const std::string& result) {
    const auto json = nlohmann::ordered_json::parse(result);
    SearchRun run = SearchRun::fromJson(json);
    run.wall_s = json.at("wall_s").get<double>();
    finished(run);
    runs[index] = std::move(run);
  };
  makeOnRanks(group, tasks);
}

}  // namespace robosim
