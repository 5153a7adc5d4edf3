#include "distributed/ranks/tasks_on_ranks.h"

#include <atomic>
#include <map>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "distributed/ranks/testing/thread_ranks.h"

namespace robosim {
namespace {

TEST(TasksOnRanks, AreEachMadeOnceAndCollectedAtRankZero) {
  std::vector<std::size_t> to_do(100);
  std::iota(to_do.begin(), to_do.end(), std::size_t{7});
  std::atomic<int> made = 0;
  std::map<std::size_t, std::string> results;
  runThreadRanks(3, [&](RankGroup& group) {
    RankTasks tasks;
    if (group.isFirst()) tasks.to_do = to_do;
    tasks.make = [&](std::size_t task, const auto&) {
      ++made;
      return std::optional<std::string>("a result with a zero byte" + std::string(1, '\0') + std::to_string(2 * task));
    };
    tasks.finished = [&](std::size_t task, const std::string& result) { results[task] = result; };
    tasks.is_interrupted = [] { return false; };
    makeOnRanks(group, tasks);
  });
  EXPECT_EQ(made, 100);
  ASSERT_EQ(results.size(), 100u);
  for (const std::size_t task : to_do) {
    EXPECT_EQ(results[task], "a result with a zero byte" + std::string(1, '\0') + std::to_string(2 * task));
  }
}

TEST(TasksOnRanks, EndWithTheErrorOfOneThatFails) {
  for (const int failing : {0, 2}) {
    std::atomic<int> errors = 0;
    EXPECT_THROW(runThreadRanks(3,
                                [&](RankGroup& group) {
                                  RankTasks tasks;
                                  if (group.isFirst()) tasks.to_do.resize(1000);
                                  tasks.make = [&](std::size_t, const auto&) -> std::optional<std::string> {
                                    if (group.rank() == failing) throw ConfigError("no room");
                                    return "done";
                                  };
                                  tasks.finished = [](std::size_t, const std::string&) {};
                                  tasks.is_interrupted = [] { return false; };
                                  try {
                                    makeOnRanks(group, tasks);
                                  } catch (const ConfigError&) {
                                    ++errors;
                                    throw;
                                  }
                                }),
                 ConfigError);
    EXPECT_EQ(errors, 3);
  }
}

}  // namespace
}  // namespace robosim
