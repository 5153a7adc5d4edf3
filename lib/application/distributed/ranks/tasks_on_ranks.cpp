#include "distributed/ranks/tasks_on_ranks.h"

#include <deque>
#include <exception>

#include "base/error_list.h"
#include "distributed/ranks/agreement.h"

namespace robosim {
namespace {

// Messages. From rank 0: the number of a task, or kEnd. To rank 0: the number, a space and the result; kFailed; and at
// last kEnd.
constexpr const char* kEnd = "end";
constexpr const char* kFailed = "failed";

/// Each rank has so many tasks, so that it need not wait for the next one.
constexpr int kTasksAhead = 2;

/// How long a rank without work sleeps at most [s].
constexpr double kWait_s = 0.05;

/// Rank 0.
class Distributor {
 public:
  Distributor(RankGroup& group, const RankTasks& tasks) : group_(group), tasks_(tasks) {}

  /// @return the error of this rank; null for none
  std::exception_ptr make() {
    for (int i = 0; i < kTasksAhead; ++i) {
      for (int rank = 1; rank < group_.size(); ++rank) sendNext(rank);
    }
    try {
      while (next_ < tasks_.to_do.size() && !isOver()) {
        const std::size_t task = tasks_.to_do[next_++];
        const auto result = tasks_.make(task, [this] {
          serve(0);
          return isOver();
        });
        if (result) tasks_.finished(task, *result);
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
  bool isOver() const { return has_failed_ || error_ || tasks_.is_interrupted(); }

  void sendNext(int rank) {
    if (next_ >= tasks_.to_do.size()) return;
    group_.send(rank, std::to_string(tasks_.to_do[next_++]));
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
        take(message->bytes);
      }
    }
  }

  void take(const std::string& message) {
    const std::size_t space = message.find(' ');
    try {
      tasks_.finished(std::stoul(message.substr(0, space)), message.substr(space + 1));
    } catch (...) {
      if (!error_) error_ = std::current_exception();  // such as a full disk; the other ranks end first
    }
  }

  RankGroup& group_;
  const RankTasks& tasks_;
  std::size_t next_ = 0;
  std::size_t waiting_for_ = 0;
  int ended_ = 0;
  bool has_failed_ = false;
  std::exception_ptr error_;
};

/// Any other rank. @return the error of this rank; null for none
std::exception_ptr makeDistributed(RankGroup& group, const RankTasks& tasks) {
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
      // Also without work: rank 0 waits for the task that was interrupted. Not again after an error, which it may
      // repeat.
      if (!has_given_up && tasks.is_interrupted()) give_up();
      if (to_do.empty() || has_given_up) {
        take(kWait_s);
        continue;
      }
      const std::size_t task = to_do.front();
      const auto result = tasks.make(task, [&] {
        take(0);
        return is_over || tasks.is_interrupted();
      });
      to_do.pop_front();
      if (result) group.send(0, std::to_string(task) + " " + *result);
    } catch (...) {
      error = std::current_exception();
      give_up();
    }
  }
  group.send(0, kEnd);
  return error;
}

}  // namespace

void makeOnRanks(RankGroup& group, const RankTasks& tasks) {
  const std::exception_ptr error = group.isFirst() ? Distributor(group, tasks).make() : makeDistributed(group, tasks);
  agree(group, [&] {
    if (error) std::rethrow_exception(error);
  });
}

void requireSamePlan(RankGroup& group, const std::string& plan) {
  agree(group, [] {});
  std::vector<std::string> plans;
  group.allGather(plan, plans);
  agree(group, [&] {
    if (plan == plans[0]) return;
    throw ConfigError("this process has another plan than rank 0, as when its world files differ; give all machines " +
                      std::string("the same files and the same version of RoboSim"));
  });
}

}  // namespace robosim
