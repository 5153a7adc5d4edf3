#include "base/parallel_executor.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(ParallelExecutor, VisitsEveryIndexOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 4, 7}) {
    const ParallelExecutor workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    for (const std::size_t n : {0u, 1u, 9u, 10u, 11u, 1000u}) {
      std::vector<int> visits(n, 0);
      workers.forEach(n, 10, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads, " << n << " items";
    }
  }
}

TEST(ParallelExecutor, UsesTheSameChunksForAnyNumberOfThreads) {
  for (const int threads : {1, 3}) {
    std::vector<std::size_t> end_of(25, 0);
    ParallelExecutor(threads).forChunks(25, 10, [&](std::size_t begin, std::size_t end) { end_of[begin] = end; });
    std::vector<std::size_t> expected(25, 0);
    expected[0] = 10;
    expected[10] = 20;
    expected[20] = 25;
    EXPECT_EQ(end_of, expected) << threads << " threads";
  }
}

TEST(ParallelExecutor, ReducesToTheSameValueForAnyNumberOfThreads) {
  for (const std::size_t n : {0u, 1u, 4095u, 10'000u, 300'001u}) {
    std::vector<double> numbers(n);
    for (std::size_t i = 0; i < n; ++i) numbers[i] = 1.0 / static_cast<double>(i + 1);
    const auto sum_of = [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i) sum += numbers[i];
      return sum;
    };
    const auto sum = [&](int threads) {
      return ParallelExecutor(threads).reduce(n, 0.0, sum_of, [](double a, double b) { return a + b; });
    };
    const double alone = sum(1);
    EXPECT_NEAR(alone, sum_of(0, n), 1e-9);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(sum(threads), alone) << n << " numbers, " << threads << " threads";
  }
}

TEST(ParallelExecutor, FindsWhetherAnyIsTrue) {
  const ParallelExecutor workers(3);
  for (const std::size_t n : {0u, 5u, 50'000u}) {
    EXPECT_FALSE(workers.anyOf(n, [](std::size_t) { return false; }));
    EXPECT_EQ(workers.anyOf(n, [n](std::size_t i) { return i == n - 1; }), n > 0);
  }
}

TEST(ParallelExecutor, UsesAtLeastOneThread) { EXPECT_EQ(ParallelExecutor(0).threads(), 1); }

TEST(ParallelExecutor, RunsPiecesConcurrently) {
  // Each of two pieces waits until the other has begun. The latch has a timeout, so that a failure ends the test
  // as one; a machine under load only takes longer to succeed.
  std::mutex mutex;
  std::condition_variable both_began;
  int began = 0;
  int met = 0;
  ParallelExecutor(2).forChunks(2, 1, [&](std::size_t, std::size_t) {
    std::unique_lock lock(mutex);
    ++began;
    both_began.notify_all();
    if (both_began.wait_for(lock, std::chrono::minutes(2), [&] { return began == 2; })) ++met;
  });
  EXPECT_EQ(met, 2);
}

TEST(ParallelExecutor, RethrowsExceptionsOfTheWork) {
  for (const int threads : {1, 4}) {
    const ParallelExecutor workers(threads);
    const auto work = [](std::size_t i) {
      if (i == 77) throw std::runtime_error("77");
    };
    EXPECT_THROW(workers.forEach(100, 5, work), std::runtime_error);
  }
}

}  // namespace
}  // namespace robosim
