#include "base/parallel.h"

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Workers, VisitEveryIndexExactlyOnceWhateverTheirNumber) {
  for (const int threads : {1, 2, 4, 7}) {
    const Workers workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    for (const std::size_t n : {0u, 1u, 9u, 10u, 11u, 1000u}) {
      std::vector<int> visits(n, 0);
      workers.forEach(n, 10, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads, " << n << " items";
    }
  }
}

TEST(Workers, CutTheWorkAtTheSamePlacesWhateverTheirNumber) {
  for (const int threads : {1, 3}) {
    std::vector<std::size_t> end_of(25, 0);
    Workers(threads).forChunks(25, 10, [&](std::size_t begin, std::size_t end) { end_of[begin] = end; });
    std::vector<std::size_t> expected(25, 0);
    expected[0] = 10;
    expected[10] = 20;
    expected[20] = 25;
    EXPECT_EQ(end_of, expected) << threads << " threads";
  }
}

TEST(Workers, OfANumberBelowOneAreOne) { EXPECT_EQ(Workers(0).threads(), 1); }

TEST(Workers, ReallyWorkAtTheSameTime) {
  // Each piece waits for the other: with one thread this would never end.
  std::atomic<int> arrived{0};
  Workers(2).forChunks(2, 1, [&](std::size_t, std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(Workers, PassOnWhatTheWorkThrows) {
  for (const int threads : {1, 4}) {
    const Workers workers(threads);
    const auto work = [](std::size_t i) {
      if (i == 77) throw std::runtime_error("77");
    };
    EXPECT_THROW(workers.forEach(100, 5, work), std::runtime_error);
  }
}

}  // namespace
}  // namespace robosim
