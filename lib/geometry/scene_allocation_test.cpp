// Tests that a scene does not allocate once its arrays have their size, by counting in this program's operator new.
#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/scene.h"
#include "geometry/testing/random_scene.h"

namespace {
std::atomic<long> allocations{0};
}  // namespace

// Not inline: g++ 12 would see the free() and warn about a mismatched deallocation.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace robosim {
namespace {

TEST(Scene, DoesNotAllocateInSteadyState) {
  constexpr std::size_t kMoving = 200;
  Rng rng(1);
  const SolidSpread spread{.size_max_m = 1};
  Scene scene(randomSolids(rng, 100, spread), kMoving, spread.area);
  std::vector<std::vector<Solid>> moments;
  for (int moment = 0; moment < 20; ++moment) moments.push_back(randomSolids(rng, kMoving, spread));
  std::vector<BodyId> near;
  near.reserve(10000);
  const auto live = [&] {
    for (const auto& moment : moments) {
      for (std::size_t i = 0; i < kMoving; ++i) scene.place(i, moment[i]);
      scene.freeze();
      near.clear();
      scene.movingNear(spread.area, near);
      for (int i = 0; i < 50; ++i) {
        const Ray ray = randomPlanarRay(rng, spread.area, 0, 2);
        scene.castRay(ray, 5);
        scene.senseSector(Sector::towards(ray.origin, 1, 0.2), 5);
      }
    }
  };
  live();
  const long before = allocations;
  live();
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace robosim
