#include "base/memory_bound.h"

#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>
#include <malloc.h>
#include <mrpt/core/aligned_allocator.h>

namespace robosim {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

bool canTake(std::size_t bytes) {
  try {
    const std::vector<char> memory(bytes);
    return memory.size() == bytes;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

TEST(MemoryBound, LimitsAllocationsDuringAHold) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  MemoryBound bound(64 * kMiB);
  malloc_trim(0);  // what the tests before have freed needs no further memory
  bound.measure();
  {
    const MemoryBound::Hold hold(bound);
    EXPECT_TRUE(canTake(48 * kMiB));
    EXPECT_EQ(canTake(96 * kMiB), !MemoryBound::kBounds);
  }
  EXPECT_TRUE(canTake(96 * kMiB));
  rlimit after{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &after), 0);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
  EXPECT_EQ(after.rlim_max, before.rlim_max);
}

TEST(MemoryBound, HasTheLargestLimitOfSeveralHoldsAndTheFormerOneAfterwards) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  MemoryBound small(64 * kMiB), large(256 * kMiB);
  malloc_trim(0);
  small.measure();
  auto first = std::make_unique<MemoryBound::Hold>(small);
  large.measure();  // within the Hold, as of another thread
  auto second = std::make_unique<MemoryBound::Hold>(large);
  first.reset();
  EXPECT_TRUE(canTake(96 * kMiB));
  EXPECT_EQ(canTake(512 * kMiB), !MemoryBound::kBounds);
  second.reset();
  rlimit after{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &after), 0);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
}

TEST(MemoryBound, HasNoLimitBeforeTheFirstMeasurement) {
  const MemoryBound bound(kMiB);
  const MemoryBound::Hold hold(bound);
  EXPECT_TRUE(canTake(64 * kMiB));
}

TEST(MemoryBound, MakesMrptsAllocatorThrowWithoutMemory) {
  if (!MemoryBound::kBounds) GTEST_SKIP() << "the sanitizer would end the program";
  EXPECT_THROW(mrpt::aligned_malloc(std::size_t{1} << 60, 64), std::bad_alloc);
  EXPECT_THROW(mrpt::aligned_malloc(~std::size_t{0}, 64), std::bad_alloc);
  void* const memory = mrpt::aligned_malloc(100, 64);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0U);
  mrpt::aligned_free(memory);
}

}  // namespace
}  // namespace robosim
