#include "run/seeded_run.h"

#include <gtest/gtest.h>

#include "run/local_run.h"
#include "run/testing/counting_images.h"

namespace robosim {
namespace {

TEST(SeededRun, RendersPicturesOnlyForAControllerOrAnObserverThatReadsThem) {
  const CountedPictures pictures(3);
  const auto& taken = pictures.taken();
  // A picture in every second step of 0.1 s.
  const LoadedWorld world = loadWorldToRun(worldOfCameras(3, 5), "still");
  const RandomStarts starts(world.world, world.fleet);
  const auto run = [&](const std::vector<std::string>& choices) {
    return runSeeded(world, starts, {.controller = "still", .observers = choices, .time_s = 1}, [] { return false; });
  };
  ASSERT_TRUE(run({"effort"}));
  EXPECT_EQ(taken, (std::vector<int>{0, 0, 0}));

  struct Watcher final : Observer {
    void observe(const Environment&) override {}
  };
  observers().add({.name = "picture_watcher",
                   .help = "Reads pictures.",
                   .parameters = {},
                   .make = [](const ObserverSetup&, const ParameterValues&) -> std::unique_ptr<Observer> {
                     return std::make_unique<Watcher>();
                   },
                   .reads_pictures = true});
  ASSERT_TRUE(run({"picture_watcher"}));
  EXPECT_EQ(taken, (std::vector<int>{6, 6, 6})) << "in steps 0, 2, …, 10";
}

}  // namespace
}  // namespace robosim
