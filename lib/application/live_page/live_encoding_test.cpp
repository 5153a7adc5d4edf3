#include "live_page/live_encoding.h"

#include <cmath>

#include <gtest/gtest.h>

#include "live_page/live_messages.h"

namespace robosim {
namespace {

using nlohmann::json;

WorldObject object(const std::string& name, double x_m) {
  WorldObject made;
  made.name = name;
  made.body.shape = Cylinder{0.5};
  made.body.world_from_body = {x_m, 0, 0};
  return made;
}

FleetRobot robot(const std::string& name, int beams, const std::string& sensor = "LASER") {
  FleetRobot made;
  made.info.name = name;
  made.own_body.emplace().shape = Cylinder{0.2};
  SensorInfo laser;
  laser.kind = SensorKind::laser;
  laser.label = sensor;
  laser.beams.resize(static_cast<std::size_t>(beams));
  made.info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector{laser});
  return made;
}

/// A box that robots push, and one that stays.
struct LiveEncodingTest : testing::Test {
  World world;
  Fleet fleet;

  LiveEncodingTest() {
    world.objects = {object("stays", 1), object("pushed", 2)};
    world.objects[1].movable.emplace();
    fleet.robots = {robot("Ann", 2)};
  }
  static LiveMoment moment(double time_s, const mrpt::math::TPose2D& pose) {
    LiveMoment made;
    made.time_s = time_s;
    made.robots.push_back({pose, {Activity::halted, true, false, false, 0x102030}});
    return made;
  }
};

TEST_F(LiveEncodingTest, DescribesTheRun) {
  const json run = json::parse(LiveEncoding("7", "maze", world, fleet, {{"Seed", "4"}}).description());
  EXPECT_EQ(run["type"], "run");
  EXPECT_EQ(run["id"], "7");
  EXPECT_EQ(run["title"], "maze");
  EXPECT_EQ(run["robots"][0]["name"], "Ann");
  EXPECT_EQ(run["sensors"], json::parse(R"([{"name":"LASER","columns":["range_0_m","range_1_m"]}])"));
  EXPECT_EQ(run["facts"], json::parse(R"([["Seed","4"]])"));
}

TEST_F(LiveEncodingTest, EncodesPosesInTenthsOfMillimetresAndStatesAsNumbers) {
  LiveEncoding encoding("7", "maze", world, fleet);
  const auto items = encoding.add(moment(0.1, {1.5, -0.25, M_PI / 2}));
  ASSERT_EQ(items.size(), 2U);
  const json objects = json::parse(items[0].text), poses = json::parse(items[1].text);
  EXPECT_EQ(items[0].kind, LiveItemKind::objects);
  EXPECT_EQ(objects["k"], "o");
  EXPECT_EQ(objects["moving"], json::parse("[1]"));
  EXPECT_EQ(items[1].kind, LiveItemKind::moment);
  EXPECT_EQ(poses["k"], "m");
  EXPECT_EQ(poses["t"], 100'000);
  // halted: 1, stalled: 4
  EXPECT_EQ(poses["r"], json::parse("[15000,-2500,157080,5,1056816]"));
  EXPECT_EQ(poses["o"], json::parse("[20000,0,0]"));
}

TEST_F(LiveEncodingTest, SendsThePlacesOfMovingObjectsWithEachMomentAndOtherChangesAsANewList) {
  LiveEncoding encoding("7", "maze", world, fleet);
  encoding.add(moment(0, {}));
  auto objects = world.objects;
  objects[1].body.world_from_body.x = 3;
  LiveMoment next = moment(0.1, {});
  next.objects = ChangedObjects(objects);
  auto items = encoding.add(next);
  ASSERT_EQ(items.size(), 1U) << "the box was pushed";
  EXPECT_EQ(json::parse(items[0].text)["o"], json::parse("[30000,0,0]"));
  objects[0].body.world_from_body.x = 9;
  next.objects = ChangedObjects(objects);
  items = encoding.add(next);
  ASSERT_EQ(items.size(), 2U) << "an object was placed that never moves by itself";
  EXPECT_EQ(json::parse(items[0].text)["objects"][0]["at"][0], 9);
}

TEST_F(LiveEncodingTest, SendsRangesAndNullForNumbersThatAreNotFinite) {
  LiveEncoding encoding("7", "maze", world, fleet);
  Readings readings;
  readings.measurements = {Echoes{{1.25F, {}}, {std::nanf(""), {}}}};
  LiveMoment first = moment(0, {});
  first.robots[0].readings = &readings;
  const auto items = encoding.add(first);
  EXPECT_EQ(json::parse(items.back().text)["v"], json::parse("[[0,0,1.25,null]]"));
}

TEST_F(LiveEncodingTest, LeavesOutReadingsThatAreTooMany) {
  fleet.robots.push_back(robot("Bob", static_cast<int>(LiveEncoding::kMaxReadings)));
  LiveEncoding encoding("7", "maze", world, fleet);
  EXPECT_FALSE(encoding.hasReadings());
  const json run = json::parse(encoding.description());
  EXPECT_TRUE(run["sensors"].empty());
  EXPECT_NE(run["remarks"][0].get<std::string>().find("3002 numbers"), std::string::npos);
}

TEST_F(LiveEncodingTest, DescribesRobotsThatWereAdded) {
  LiveEncoding encoding("7", "maze", world, fleet);
  EXPECT_TRUE(encoding.addRobots(fleet).empty());
  fleet.robots.push_back(robot("Bob", 2));
  const auto items = encoding.addRobots(fleet);
  ASSERT_EQ(items.size(), 1U);
  const json added = json::parse(items[0].text);
  EXPECT_EQ(added["from"], 1);
  EXPECT_EQ(added["robots"][0]["name"], "Bob");
  EXPECT_EQ(json::parse(encoding.description())["robots"].size(), 2U);
}

TEST_F(LiveEncodingTest, DescribesTheSensorsOfRobotsThatWereAdded) {
  LiveEncoding encoding("7", "maze", world, fleet);
  fleet.robots.push_back(robot("Bob", 3));  // the same sensor with more columns
  fleet.robots.push_back(robot("Eve", 1, "SONAR"));
  const json added = json::parse(encoding.addRobots(fleet).at(0).text);
  EXPECT_EQ(added["sensors"], json::parse(R"([{"name":"LASER","columns":["range_0_m","range_1_m","range_2_m"]},
                                              {"name":"SONAR","columns":["range_0_m"]}])"));
  EXPECT_TRUE(added["remarks"].empty());
}

TEST_F(LiveEncodingTest, StatesThatReadingsEndWhenTheAddedRobotsHaveTooMany) {
  LiveEncoding encoding("7", "maze", world, fleet);
  fleet.robots.push_back(robot("Bob", static_cast<int>(LiveEncoding::kMaxReadings)));
  const json added = json::parse(encoding.addRobots(fleet).at(0).text);
  EXPECT_NE(added["remarks"][0].get<std::string>().find("since robots were added"), std::string::npos);
  // Later pages receive the readings of the time before.
  EXPECT_EQ(json::parse(encoding.description())["sensors"].size(), 1U);
}

TEST_F(LiveEncodingTest, CanBeOfTheSameWorldWithMoreRobotsOnly) {
  const LiveEncoding encoding("7", "maze", world, fleet);
  Fleet more = fleet;
  more.robots.push_back(robot("Bob", 2));
  EXPECT_TRUE(encoding.canBeOf(world, more));
  EXPECT_FALSE(encoding.canBeOf(world, {}));
  std::swap(more.robots[0], more.robots[1]);
  EXPECT_FALSE(encoding.canBeOf(world, more));
  World other = world;
  other.name = "other";
  EXPECT_FALSE(encoding.canBeOf(other, fleet));
}

TEST_F(LiveEncodingTest, NamesEachMessageOnceWithItsReceivers) {
  fleet.robots = {robot("Ann", 1), robot("Bob", 1), robot("Eve", 1)};
  Readings received;
  received.inbox.edit() = {{"Ann", "", "gold!"}};
  std::vector<LiveEvent> events;
  addMessages(fleet, {nullptr, &received, &received}, events);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, "message");
  EXPECT_EQ(events[0].robot, 0U);
  EXPECT_EQ(events[0].text, "to Bob, Eve: gold!");
}

}  // namespace
}  // namespace robosim
