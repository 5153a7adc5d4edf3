#include "benchmark/runs_on_ranks.h"

#include <deque>
#include <exception>

#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "ranks/agreement.h"

namespace robosim {
namespace {

// Messages. From rank 0: an index, or kEnd. To rank 0: a run as JSON, kFailed, and at last kEnd.
constexpr const char* kEnd = "end";
constexpr const char* kFailed = "failed";

/// Each rank has so many runs, so that it need not wait for the next one.
constexpr int kRunsAhead = 2;

/// How long a rank without work sleeps at most [s].
constexpr double kWait_s = 0.05;

/// Rank 0.
class Distributor {
 public:
  Distributor(RankGroup& group, const SearchBenchmark& benchmark, const std::function<bool()>& is_interrupted,
              const std::function<void(const SearchRun&)>& finished, SearchRuns& runs)
      : group_(group),
        benchmark_(benchmark),
        is_interrupted_(is_interrupted),
        finished_(finished),
        runs_(runs),
        to_do_(missing(runs)) {}

  /// @return the error of this rank; null for none
  std::exception_ptr make() {
    for (int i = 0; i < kRunsAhead; ++i) {
      for (int rank = 1; rank < group_.size(); ++rank) sendNext(rank);
    }
    try {
      while (next_ < to_do_.size() && !isOver()) {
        const std::size_t index = to_do_[next_++];
        const auto run = benchmark_.run(index, [this] {
          serve(0);
          return isOver();
        });
        if (run) add(*run);
      }
      while (waiting_for_ > 0 && !isOver()) serve(kWait_s);
    } catch (...) {
      error_ = std::current_exception();
    }
    for (int rank = 1; rank < group_.size(); ++rank) group_.send(rank, kEnd);
    while (ended_ < group_.size() - 1) serve(kWait_s);
    return error_;
  }

 private:
  bool isOver() const { return has_failed_ || error_ || is_interrupted_(); }

  void sendNext(int rank) {
    if (next_ >= to_do_.size()) return;
    group_.send(rank, std::to_string(to_do_[next_++]));
    ++waiting_for_;
  }

  /// Takes the messages that have arrived. @param wait_s for the first one
  void serve(double wait_s) {
    while (const auto message = group_.receive(wait_s)) {
      wait_s = 0;
      if (message->bytes == kEnd) {
        ++ended_;
      } else if (message->bytes == kFailed) {
        has_failed_ = true;
      } else {
        --waiting_for_;
        sendNext(message->from);
        try {
          add(SearchRun::fromJson(nlohmann::ordered_json::parse(message->bytes)));
        } catch (...) {
          if (!error_) error_ = std::current_exception();  // such as a full disk; the other ranks end first
        }
      }
    }
  }

  void add(const SearchRun& run) {
    finished_(run);
    const auto i = static_cast<std::size_t>(run.seed - benchmark_.plan().seed);
    runs_[run.case_index * benchmark_.plan().runs + i] = run;
  }

  RankGroup& group_;
  const SearchBenchmark& benchmark_;
  const std::function<bool()>& is_interrupted_;
  const std::function<void(const SearchRun&)>& finished_;
  SearchRuns& runs_;
  std::vector<std::size_t> to_do_;
  std::size_t next_ = 0;
  std::size_t waiting_for_ = 0;
  int ended_ = 0;
  bool has_failed_ = false;
  std::exception_ptr error_;
};

/// Any other rank. @return the error of this rank; null for none
std::exception_ptr makeDistributed(RankGroup& group, const SearchBenchmark& benchmark,
                                   const std::function<bool()>& is_interrupted) {
  std::deque<std::size_t> to_do;
  bool is_over = false;
  const auto take = [&](double wait_s) {
    while (const auto message = group.receive(wait_s)) {
      wait_s = 0;
      if (message->bytes == kEnd) {
        is_over = true;
      } else {
        to_do.push_back(std::stoul(message->bytes));
      }
    }
  };
  std::exception_ptr error;
  bool has_given_up = false;
  const auto give_up = [&] {
    if (!has_given_up) group.send(0, kFailed);
    has_given_up = true;
  };
  while (!is_over) {
    try {
      // Also without work: rank 0 waits for the run that was interrupted. Not again after an error, which it may
      // repeat.
      if (!has_given_up && is_interrupted()) give_up();
      if (to_do.empty() || has_given_up) {
        take(kWait_s);
        continue;
      }
      const auto run = benchmark.run(to_do.front(), [&] {
        take(0);
        return is_over || is_interrupted();
      });
      to_do.pop_front();
      if (run) group.send(0, run->json().dump());
    } catch (...) {
      error = std::current_exception();
      give_up();
    }
  }
  group.send(0, kEnd);
  return error;
}

}  // namespace

void requireSamePlan(RankGroup& group, const SearchPlan& plan) {
  agree(group, [] {});
  std::vector<std::string> plans;
  group.allGather(plan.json().dump(), plans);
  agree(group, [&] {
    if (plans[static_cast<std::size_t>(group.rank())] == plans[0]) return;
    throw ConfigError("this process has another plan than rank 0, as when its world files differ; give all machines " +
                      std::string("the same files and the same version of RoboSim"));
  });
}

void makeRunsOnRanks(RankGroup& group, const SearchBenchmark& benchmark, const std::function<bool()>& is_interrupted,
                     const std::function<void(const SearchRun&)>& finished, SearchRuns& runs) {
  const std::exception_ptr error = group.isFirst()
                                       ? Distributor(group, benchmark, is_interrupted, finished, runs).make()
                                       : makeDistributed(group, benchmark, is_interrupted);
  agree(group, [&] {
    if (error) std::rethrow_exception(error);
  });
}

}  // namespace robosim
