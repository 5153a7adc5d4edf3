#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "world/world_file.h"

namespace robosim {
namespace {

World readBack(const World& world) {
  ErrorList errors;
  World again = parseWorld(toXml(world), "/some/where/" + world.name + ".xml", errors);
  EXPECT_EQ(errors.errors(), std::vector<std::string>{}) << toXml(world);
  return again;
}

/// Random worlds that use all features of a world file.
class WorldMaker {
 public:
  explicit WorldMaker(std::uint64_t seed) : rng_(seed, RandomPurpose::test) {}

  World make() {
    World world;
    world.name = "made";
    world.surface_type = word();
    const double units[] = {1, 0.1, 0.0254, 1.0 / 3, 10, rng_.uniform(0.01, 100)};
    world.unit_m = units[rng_.below(6)];
    world.bounds = {-size(100), size(100), -size(100), size(100)};
    if (maybe()) world.communication.range_m = size(50);
    if (maybe()) world.communication.loss_probability = rng_.uniform();
    if (maybe() && world.communication.range_m) world.communication.wall_range_m = size(5);
    if (maybe()) world.communication.wall_loss = rng_.uniform();
    if (maybe()) world.communication.burst_gap_s = size(100);
    if (maybe()) world.communication.burst_s = size(10);
    if (maybe()) world.communication.burst_loss = rng_.uniform();
    if (maybe()) world.communication.delay_s = rng_.uniform();
    if (maybe()) world.communication.rate_hz = size(10);
    if (maybe()) world.win_distance_m = size(5);
    if (maybe()) world.start_distance_m = size(5);
    for (auto i = rng_.below(6); i > 0; --i) {
      world.objects.push_back(
          {.name = name(), .body = body(), .movable = maybe() ? std::optional(movable()) : std::nullopt, .line = {}});
      if (!world.objects.back().movable && maybe()) letMove(world.objects.back());
    }
    const auto robots = rng_.below(6);
    for (std::uint32_t i = 0; i < robots; ++i) world.robots.push_back(robot());
    for (std::uint32_t i = 0; i < robots; ++i) {
      if (robots > 1 && maybe()) world.robots[i].neighbour = world.robots[(i + 1) % robots].name;
    }
    return world;
  }

 private:
  bool maybe() { return rng_.below(2) == 1; }
  /// Makes a walker of a cylinder, a door or a conveyor of a box.
  void letMove(WorldObject& object) {
    const auto* cube = std::get_if<Cube>(&object.body.shape);
    if (!cube) {
      Walker walker{.home = {coordinate(), coordinate()}, .speed_mps = size(5), .stops_within_m = size(5)};
      walker.walk = {.leg = rng_.below(3), .is_returning = maybe(), .waited_steps = rng_.below(20)};
      if (maybe()) walker.wanders_within_m = size(9);
      if (walker.wanders_within_m == 0) walker.route = {{coordinate(), coordinate()}, {coordinate(), coordinate()}};
      object.walker = walker;
      return;
    }
    if (maybe()) {
      object.body.center_z_m = -object.body.height_m;
      object.conveyor = Conveyor{maybe() ? size(3) : -size(3)};
      return;
    }
    Door door{.world_from_closed = object.body.world_from_body, .speed = size(5)};
    (maybe() ? door.slide_m : door.turn_rad) = maybe() ? size(3) : -size(3);
    door.opens_within_m = maybe() ? size(3) : 0;
    door.open_to = maybe() ? rng_.uniform() : 0;
    door.share = maybe() ? rng_.uniform() : door.open_to;
    object.door = door;
    object.body.world_from_body = door.poseAt(door.share, cube->length_m);
  }
  Movable movable() { return {.mass_kg = size(1000), .friction = size(2), .restitution = rng_.uniform()}; }
  /// Random positive number of any magnitude up to `max`.
  double size(double max) { return max * std::pow(10, rng_.uniform(-6, 0)); }
  double coordinate() { return maybe() ? rng_.uniform(-100, 100) : static_cast<double>(rng_.below(100)) / 4; }

  std::string word() {
    const std::vector<std::string> letters{"a",  "B", "7",  "-",  "_",    "<",     ">",  "&", "\"",
                                           "'",  " ", "ä",  "€",  "]]>",  "&amp;", "%",  "/", "\\",
                                           "<!", "?", "漢", "\n", "<!--", "-->",   "#;", "\t"};
    std::string text = "w";  // white space at either end is not kept
    for (auto i = rng_.below(8); i > 0; --i) text += letters[rng_.below(static_cast<std::uint32_t>(letters.size()))];
    return text + "w";
  }
  std::string name() { return word() + std::to_string(++names_); }
  /// Without '/', which robot names must not contain.
  std::string robotName() {
    std::string text = name();
    std::replace(text.begin(), text.end(), '/', '|');
    return text;
  }
  std::array<float, 3> color() {
    const auto part = [this] { return static_cast<float>(rng_.uniform()); };
    return {part(), part(), part()};
  }
  mrpt::math::TPose2D pose() { return {coordinate(), coordinate(), rng_.uniform(-4, 4)}; }

  Body body() {
    Body body;
    if (maybe()) {
      body.shape = Cylinder{size(5)};
    } else {
      body.shape = Cube{size(50), size(5)};
    }
    body.world_from_body = pose();
    body.center_z_m = coordinate();
    body.height_m = size(10);
    body.color = color();
    if (maybe()) body.heat_celsius = size(100);
    if (maybe()) body.reflectivity = rng_.uniform();
    if (maybe()) body.light_cd = size(100);
    if (maybe()) body.fiducial = 1 + rng_.below(65535);
    return body;
  }

  XmlElement element(const std::string& tag, int depth) {
    XmlElement made;
    made.name = tag;
    if (maybe()) made.attributes.emplace_back("label", word());
    if (maybe()) made.attributes.emplace_back("range_max_m", toText(size(10)));
    if (depth == 0 || maybe()) {
      made.text = word();
    } else {
      for (auto i = rng_.below(3); i > 0; --i) made.children.push_back(element("x-relative", depth - 1));
    }
    return made;
  }

  RobotPlacement robot() {
    RobotPlacement robot;
    robot.name = robotName();
    if (maybe()) robot.model = word();
    robot.world_from_robot = pose();
    if (robot.model.empty() || maybe()) {
      robot.body = body();
      robot.body->world_from_body = robot.world_from_robot;
    } else if (maybe()) {
      robot.color = color();
    }
    const bool only_2005 = maybe();
    for (auto i = rng_.below(4); i > 0; --i) {
      robot.sensors.push_back(element(only_2005 || maybe() ? "sensor" : "sonar", 2));
    }
    if (maybe()) robot.controller = maybe() ? "wander" : "flocking cohesion=0.3 radius_m=1e-3";
    return robot;
  }

  Rng rng_;
  int names_ = 0;
};

TEST(WorldWriter, RoundTripsThroughTheReader) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const World world = WorldMaker(seed).make();
    ASSERT_EQ(readBack(world), world) << "seed " << seed << "\n" << toXml(world);
  }
}

TEST(WorldWriter, WritesThe2005FormOfA2005World) {
  ErrorList errors;
  const World world = readWorld(ROBOSIM_SOURCE_DIR "/tests/data/legacy_world.xml", errors);
  EXPECT_EQ(readBack(world), world);
  const std::string text = toXml(world);
  EXPECT_NE(text.find(R"(          <cylinder>
            <name>Gold1</name>
            <x>24</x>
            <y>-6</y>
            <direction>0</direction>
            <z>1.5</z>
            <radius>1</radius>
            <height>3</height>
            <color>1 0.85 0</color>
            <hot>70</hot>
            <stationary>1</stationary>
          </cylinder>
)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("unit_m"), std::string::npos);
  EXPECT_EQ(text.find("<sensors>"), std::string::npos);
}

TEST(WorldWriter, KeepsTheDecimalTextOfNumbers) {
  ErrorList errors;
  const World world = parseWorld(
      "<world unit_m='0.1'><surface><size><xmin>-101</xmin><xmax>200.9</xmax><ymin>-0.45</ymin><ymax>38</ymax></size>"
      "</surface></world>",
      "a.xml", errors);
  const std::string text = toXml(world);
  for (const char* part : {"unit_m=\"0.1\"", "<xmin>-101<", "<xmax>200.9<", "<ymin>-0.45<", "<ymax>38<"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

}  // namespace
}  // namespace robosim
