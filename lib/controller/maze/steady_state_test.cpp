// Checks that controllers do not allocate in steady state, by counting calls of this program's operator new.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "maze/controllers.h"
#include "maze/testing/fake_maze.h"

namespace {
std::atomic<long> allocations{0};
}  // namespace

// Not inline: g++ 12 would warn about free() of memory from operator new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// That of std::stable_sort. The sanitizer has its own, whose memory does not suit this delete.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace robosim {
namespace {

TEST(Controllers, AllocateNothingAfterTheMapIsComplete) {
  for (const auto& name : controllers().names()) {
    FakeMaze maze(FakeMaze::room(-2, 2, -2, 2), {99, 99}, 0);
    Robot robot(maze.hardware);
    const auto controller = controllers().make(name, {.seed = 1});
    const auto allocations_in = [&](int steps) {
      long count = 0;
      for (int i = 0; i < steps; ++i) {
        const long before = allocations;
        controller->step(robot);
        count += allocations - before;
        maze.hardware.advance();
      }
      return count;
    };
    allocations_in(10000);
    EXPECT_EQ(allocations_in(4000), 0) << name;
  }
}

}  // namespace
}  // namespace robosim
