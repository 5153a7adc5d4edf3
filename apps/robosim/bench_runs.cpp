#include "robosim/bench_runs.h"

#include <chrono>
#include <iostream>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "benchmark/runs_on_ranks.h"
#include "distributed/ranks/agreement.h"
#include "distributed/ranks/tasks_on_ranks.h"

namespace robosim {
namespace {

/// "run 12 of 400, 3 min left"
class RunProgress {
 public:
  RunProgress(std::size_t done, std::size_t planned) : done_before_(done), planned_(planned) {}
  void show(std::size_t done) {
    if (!progress_.due()) return;
    const double elapsed_s = secondsSince(start_);
    progress_.show("run " + std::to_string(done) + " of " + std::to_string(planned_) +
                   commaRemainingTime(elapsed_s, static_cast<double>(done - done_before_),
                                      static_cast<double>(planned_ - done_before_)));
  }

 private:
  std::size_t done_before_, planned_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Progress progress_;
};

}  // namespace

void refuseThreadsOnRanks(int threads) {
  if (rankGroup().size() == 1 || threads == 1) return;
  throw ConfigError("--threads " + std::to_string(threads) +
                    ": each process of mpirun makes one run at a time; start more processes instead");
}

void helpFirstRank(const NumberedRuns& source) {
  RankGroup& group = rankGroup();
  const Interrupt interrupt;
  requireSamePlan(group, source.planText());
  agree(group, [] {});
  SearchRuns none;
  makeRunsOnRanks(
      group, source, [&] { return interrupt.isRequested(); }, [](const SearchRun&) {}, none);
}

void makeBenchRuns(const NumberedRuns& source, int threads, const std::function<bool()>& is_interrupted,
                   const std::function<void(const SearchRun&)>& finished, SearchRuns& runs) {
  std::size_t done = runs.size() - missing(runs).size();
  RunProgress progress(done, runs.size());
  const auto of_one = [&](const SearchRun& run) {
    finished(run);
    progress.show(++done);
  };
  RankGroup& group = rankGroup();
  if (group.size() > 1) {
    makeRunsOnRanks(group, source, is_interrupted, of_one, runs);
  } else {
    makeRuns(source, threads, is_interrupted, of_one, runs);
  }
}

void printBenchSpeed(const std::vector<std::string>& worlds, const SearchRuns& runs) {
  const std::size_t runs_per_world = runs.size() / worlds.size();
  for (std::size_t world = 0; world < worlds.size(); ++world) {
    double simulated_s = 0, busy_s = 0;
    for (std::size_t i = world * runs_per_world; i < (world + 1) * runs_per_world; ++i) {
      if (!runs[i] || runs[i]->wall_s <= 0) continue;  // of a journal
      simulated_s += runs[i]->sim_time_s;
      busy_s += runs[i]->wall_s;
    }
    if (busy_s <= 0) continue;
    std::cerr << printableText(worlds[world]) << ": " << withCommas(static_cast<std::uint64_t>(simulated_s / busy_s))
              << " simulated seconds per second on one thread\n";
  }
}

}  // namespace robosim
