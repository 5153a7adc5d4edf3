#include "viewing/recorded_objects.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using mrpt::math::TPose2D;

std::vector<WorldObject> pucks(std::size_t count) {
  std::vector<WorldObject> objects(count);
  for (std::size_t i = 0; i < count; ++i) {
    objects[i].name = "puck" + std::to_string(i);
    objects[i].body = {Cylinder{0.1}, {static_cast<double>(i), 0, 0}, 0.1, 0.2};
  }
  return objects;
}

ChangedObjects placed(const ChangedObjects& before, const std::vector<WorldObject>& of_world, const std::string& name,
                      const TPose2D& at) {
  return ChangedObjects(withChange(before.orThose(of_world), PlaceBody{name, at.x, at.y, at.phi}));
}

/// The place of an object at a moment.
TPose2D placeAt(RecordedObjects& recorded, const std::vector<WorldObject>& of_world, std::size_t moment,
                std::size_t object) {
  return recorded.at(moment).orThose(of_world)[object].body.world_from_body;
}

TEST(RecordedObjects, AreThoseOfEachMomentInAnyOrder) {
  const auto world = pucks(3);
  RecordedObjects recorded(world);
  ChangedObjects now;
  recorded.add(now);  // 0
  now = placed(now, world, "puck1", {1, 0.5, 0.25});
  recorded.add(now);  // 1
  recorded.add(now);  // 2: nothing has moved
  now = ChangedObjects(withChange(now.orThose(world), RemoveBody{"puck0"}));
  recorded.add(now);  // 3
  now = placed(now, world, "puck2", {2, -1, 0});
  recorded.add(now);  // 4
  EXPECT_EQ(placeAt(recorded, world, 4, 1), TPose2D(2, -1, 0));
  EXPECT_EQ(placeAt(recorded, world, 4, 0), TPose2D(1, 0.5, 0.25));
  EXPECT_EQ(recorded.at(3).orThose(world).size(), 2u);
  EXPECT_EQ(placeAt(recorded, world, 3, 1), TPose2D(2, 0, 0));
  EXPECT_EQ(placeAt(recorded, world, 2, 1), TPose2D(1, 0.5, 0.25));
  EXPECT_TRUE(recorded.at(2).isSameList(recorded.at(1))) << "views draw them again only when they have changed";
  EXPECT_FALSE(recorded.at(0).areChanged());
  EXPECT_EQ(recorded.listCount(), 2u);
  EXPECT_EQ(recorded.placeCount(), 2u);
}

TEST(RecordedObjects, KeepOnlyThePlacesThatHaveChanged) {
  // One of 100 pucks rolls by 0.01 m per step, for 10,000 steps: a complete list after each 3,200 places.
  const auto world = pucks(100);
  RecordedObjects recorded(world);
  ChangedObjects now;
  recorded.add(now);
  for (int step = 1; step <= 10'000; ++step) {
    now = placed(now, world, "puck7", {7, 0.01 * step, 0});
    recorded.add(now);
  }
  EXPECT_EQ(recorded.listCount(), 4u);
  EXPECT_LE(recorded.placeCount(), 10'000u);
  for (const std::size_t step : {1, 3'200, 3'201, 3'202, 9'999, 5}) {
    EXPECT_EQ(placeAt(recorded, world, step, 7).y, 0.01 * static_cast<double>(step)) << step;
    EXPECT_EQ(placeAt(recorded, world, step, 8), TPose2D(8, 0, 0)) << step;
  }
}

TEST(RecordedObjects, KeepHowFarDoorsAreOpen) {
  auto world = pucks(1);
  world[0].body.shape = Cube{1, 0.1};
  world[0].door = Door{.slide_m = 1};
  RecordedObjects recorded(world);
  recorded.add({});
  auto open = world;
  open[0].door->share = 0.5;
  open[0].body.world_from_body = {0.5, 0, 0};
  recorded.add(ChangedObjects(open));
  EXPECT_EQ(recorded.at(1).orThose(world)[0], open[0]);
  EXPECT_EQ(recorded.listCount(), 1u);
}

}  // namespace
}  // namespace robosim
