#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/temporary_directory.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

const std::string kSurface = "<type>smooth</type><size><xmin>0</xmin><xmax>9</xmax><ymin>0</ymin><ymax>9</ymax></size>";

/// A world of these objects, each on its own line, the first on line 2.
std::string worldOf(const std::vector<std::string>& objects, const std::string& after_surface = "") {
  std::string text = "<world><surface>" + kSurface;
  for (const auto& object : objects) text += "\n<object><shape>" + object + "</shape></object>";
  return text + "\n</surface>" + after_surface + "</world>";
}

std::string pillar(const std::string& name, const std::string& radius = "1", const std::string& more = "") {
  return "<primitive><cylinder><name>" + name + "</name><x>1</x><y>2</y><z>3</z><radius>" + radius +
         "</radius><height>4</height>" + more + "</cylinder></primitive>";
}

std::string scout(const std::string& name, const std::string& more = "") {
  return "<robot><model>scout</model><name>" + name + "</name><x>1</x><y>2</y>" + more + "</robot>";
}

World parsed(const std::string& text) {
  ErrorList errors;
  const World world = parseWorld(text, "a.xml", errors);
  EXPECT_EQ(errors.errors(), Lines{});
  return world;
}

Lines faults(const std::string& text) {
  ErrorList errors;
  parseWorld(text, "a.xml", errors);
  return errors.errors();
}

TEST(WorldReader, ReadsThe2005FileUnchanged) {
  ErrorList errors;
  const World world = readWorld(ROBOSIM_SOURCE_DIR "/tests/data/legacy_world.xml", errors);
  EXPECT_EQ(errors.errors(), Lines{});
  EXPECT_EQ(world.name, "legacy_world");
  EXPECT_EQ(world.surface_type, "smooth");
  EXPECT_EQ(world.unit_m, 1);
  EXPECT_EQ(world.bounds, (Bounds2D{-60, 60, -40, 40}));
  EXPECT_EQ(world.communication, Communication{});
  EXPECT_EQ(world.win_distance_m, 0.5);

  ASSERT_EQ(world.objects.size(), 2u);
  const WorldObject& wall = world.objects[0];
  EXPECT_EQ(wall.name, "NorthWall");
  EXPECT_EQ(std::get<Cube>(wall.body.shape), (Cube{116, 2}));
  EXPECT_EQ(wall.body.world_from_body, mrpt::math::TPose2D(0, 38, 0));
  EXPECT_EQ(wall.body.heights(), (HeightSpan{0, 10}));
  EXPECT_EQ(wall.body.color, (std::array<float, 3>{0.5f, 0.3f, 0.1f}));
  EXPECT_FALSE(wall.movable);
  const WorldObject& gold = world.objects[1];
  EXPECT_EQ(std::get<Cylinder>(gold.body.shape), Cylinder{1});
  EXPECT_EQ(gold.body.heat_celsius, 70);

  ASSERT_EQ(world.robots.size(), 1u);
  const RobotPlacement& finder = world.robots[0];
  EXPECT_EQ(finder.name, "Finder1");
  EXPECT_EQ(finder.model, "");
  EXPECT_EQ(finder.controller, "");
  EXPECT_EQ(finder.neighbour, "");
  EXPECT_EQ(finder.world_from_robot, mrpt::math::TPose2D(-20, -10, 1.5707963));
  ASSERT_TRUE(finder.body);
  EXPECT_EQ(finder.body->world_from_body, finder.world_from_robot);
  EXPECT_EQ(std::get<Cylinder>(finder.body->shape), Cylinder{3});
  EXPECT_EQ(finder.body->center_z_m, 5);
  ASSERT_EQ(finder.sensors.size(), 3u);
  EXPECT_EQ(finder.sensors[1].name, "sensor");
  EXPECT_EQ(finder.sensors[1].children[3].name, "position");
}

TEST(WorldReader, ConvertsLengthsToMetresButNotAnglesOrTemperatures) {
  const World world = parsed(
      "<world "
      "unit_m='0.1' "
      "start_distance='12'><win_distance>8</win_distance><surface><size><xmin>-10</xmin><xmax>10</xmax><ymin>-20</"
      "ymin><ymax>20</ymax></size>"
      "<object><shape><primitive><cube><name>w</name><x>1</x><y>2</y><z>5</z><length>30</length><width>1</width>"
      "<height>10</height><direction>0.5</direction><hot>20</hot></cube></primitive></shape></object></surface>"
      "<communication><range>50</range><loss>0.25</loss></communication></world>");
  EXPECT_EQ(world.bounds, (Bounds2D{-1, 1, -2, 2}));
  const Body& body = world.objects[0].body;
  EXPECT_EQ(body.world_from_body, mrpt::math::TPose2D(0.1, 0.2, 0.5));
  EXPECT_EQ(body.heights(), (HeightSpan{0, 1}));
  EXPECT_EQ(std::get<Cube>(body.shape), (Cube{3, 0.1}));
  EXPECT_EQ(body.heat_celsius, 20);
  EXPECT_EQ(world.communication, (Communication{5, 0.25}));
  EXPECT_EQ(world.win_distance_m, 0.8);
  EXPECT_DOUBLE_EQ(world.start_distance_m.value(), 1.2);
}

TEST(WorldReader, AppliesDefaults) {
  const World world = parsed(worldOf({pillar("p")}));
  EXPECT_EQ(world.objects[0].body.world_from_body.phi, 0);
  EXPECT_EQ(world.objects[0].body.heat_celsius, 0);
  EXPECT_EQ(world.objects[0].body.color, (std::array<float, 3>{0.5f, 0.5f, 0.5f}));
  EXPECT_FALSE(world.objects[0].movable);
}

TEST(WorldReader, PlacesARobotByItsModel) {
  const World world =
      parsed(worldOf({scout("A",
                            "<direction>0.5</direction><color>1 0 0</color><controller>wander</controller>"
                            "<neighbour>B</neighbour><sensors><compass/><sonar model='rays'/></sensors>"),
                      scout("B")}));
  const RobotPlacement& a = world.robots[0];
  EXPECT_EQ(a.model, "scout");
  EXPECT_EQ(a.world_from_robot, mrpt::math::TPose2D(1, 2, 0.5));
  EXPECT_FALSE(a.body);
  EXPECT_EQ(*a.color, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(a.controller, "wander");
  EXPECT_EQ(a.neighbour, "B");
  ASSERT_EQ(a.sensors.size(), 2u);
  EXPECT_EQ(a.sensors[0].name, "compass");
  EXPECT_EQ(a.sensors[1].attributes.size(), 1u);
  EXPECT_FALSE(world.robots[1].color);
}

TEST(WorldReader, ReadsAControllerWithParametersAsAttributesOrAsText) {
  const World world = parsed(worldOf({scout("A", R"(<controller name="flocking" cohesion="0.3" radius_m="2"/>)"),
                                      scout("B", "<controller>flocking cohesion=0.3</controller>"),
                                      scout("C", R"(<controller name="flocking"/>)"), scout("D")}));
  EXPECT_EQ(world.robots[0].controller, "flocking cohesion=0.3 radius_m=2");
  EXPECT_EQ(world.robots[1].controller, "flocking cohesion=0.3");
  EXPECT_EQ(world.robots[2].controller, "flocking");
  EXPECT_EQ(world.robots[3].controller, "");
}

TEST(WorldReader, RejectsAControllerWithoutNameOrWithWordsAsParameters) {
  EXPECT_EQ(
      faults(worldOf({scout("A", "\n<controller cohesion=\"0.3\"/>"), scout("B", "<controller name='a' b='1 2'/>"),
                      scout("C", "<controller>very fast</controller>")})),
      (Lines{"a.xml:3: <controller>: <name> is missing; add it",
             "a.xml:4: <controller b=\"1 2\">: must be a single number",
             "a.xml:5: <controller>very fast</controller>: controller 'very': 'fast' is no parameter; write "
             "PARAMETER=VALUE"}));
}

TEST(WorldReader, AcceptsABodyBesidesAModel) {
  const World world =
      parsed(worldOf({"<robot><model>scout</model><cylinder><name>A</name><x>1</x><y>2</y><z>3</z><radius>1</radius>"
                      "<height>4</height></cylinder></robot>"}));
  EXPECT_EQ(world.robots[0].model, "scout");
  EXPECT_EQ(std::get<Cylinder>(world.robots[0].body->shape), Cylinder{1});
}

TEST(WorldReader, ReadsLightsMarksAndAreasOfTheFloor) {
  const World world = parsed(worldOf({pillar("a", "1", "<light>12.5</light><fiducial>7</fiducial>"),
                                      "<primitive><cylinder><name>b</name><x>1</x><y>2</y><z>-2</z><radius>1</radius>"
                                      "<height>4</height></cylinder></primitive>"}));
  const Body& body = world.objects[0].body;
  EXPECT_EQ(body.light_cd, 12.5);
  EXPECT_EQ(body.fiducial, 7);
  EXPECT_FALSE(body.isFloor());
  EXPECT_TRUE(world.objects[1].body.isFloor());
  EXPECT_EQ(faults(worldOf({pillar("p", "1", "<fiducial>1.5</fiducial>")})),
            Lines{"a.xml:2: <fiducial>1.5</fiducial>: is no whole number; write one"});
  EXPECT_EQ(faults(worldOf({pillar("p", "1", "<light>-1</light>")})).size(), 1u);
}

TEST(WorldReader, RejectsUnknownTags) {
  EXPECT_EQ(faults("<worlds/>"),
            Lines{"a.xml:1: <worlds>: is not a world; the first element of a world file is <world>"});
  EXPECT_EQ(faults(worldOf({pillar("p", "1", "<colour>1 0 0</colour>")})),
            Lines{"a.xml:2: <colour>: unknown tag in <cylinder>; accepted here are: color, conveyor, direction, door, "
                  "fiducial, height, hot, light, "
                  "movable, name, radius, reflectivity, stationary, walker, x, y, z"});
  EXPECT_EQ(faults(worldOf({"<primitve/>"})),
            (Lines{"a.xml:2: <shape>: contains neither a <primitive> nor a <robot>; add one",
                   "a.xml:2: <primitve>: unknown tag in <shape>; accepted here are: primitive, robot"}));
  EXPECT_EQ(faults("<world size='3'><surface>" + kSurface + "<objekt/></surface></world>"),
            (Lines{"a.xml:1: <objekt>: unknown tag in <surface>; accepted here are: include, map, object, scatter, "
                   "size, type",
                   "a.xml:1: <world>: unknown attribute size=\"3\"; accepted here are: at, communication, "
                   "georeference, surface, unit_m, "
                   "win_distance"}));
}

TEST(WorldReader, RejectsMissingAndMalformedValues) {
  EXPECT_EQ(faults("<world/>"), Lines{"a.xml:1: <world>: <surface> is missing; add it"});
  EXPECT_EQ(faults("<world><surface/></world>"), Lines{"a.xml:1: <surface>: <size> is missing; add it"});
  EXPECT_EQ(faults(worldOf({"<primitive><cylinder/></primitive>"})),
            (Lines{"a.xml:2: <cylinder>: <name> is missing; add it", "a.xml:2: <cylinder>: <radius> is missing; add it",
                   "a.xml:2: <cylinder>: <x> is missing; add it", "a.xml:2: <cylinder>: <y> is missing; add it",
                   "a.xml:2: <cylinder>: <z> is missing; add it", "a.xml:2: <cylinder>: <height> is missing; add it"}));
  EXPECT_EQ(
      faults(worldOf({"<primitive><cube><name>w</name><x>1</x><y/><z>a</z><height>1</height></cube></primitive>"})),
      (Lines{"a.xml:2: <cube>: <length> is missing; add it", "a.xml:2: <cube>: <width> is missing; add it",
             "a.xml:2: <y></y>: a number is missing; write a number there",
             "a.xml:2: <z>a</z>: is not a number; write a number there"}));
  EXPECT_EQ(faults(worldOf({"<robot><model>scout</model></robot>"})),
            (Lines{"a.xml:2: <robot>: <name> is missing; add it", "a.xml:2: <robot>: <x> is missing; add it",
                   "a.xml:2: <robot>: <y> is missing; add it"}));
  EXPECT_EQ(faults(worldOf({"<robot></robot>"})),
            Lines{"a.xml:2: <robot>: has no body; add a <cylinder> or <cube>, or a <model> that has one"});
  EXPECT_EQ(faults(worldOf({"<primitive/>"})),
            Lines{"a.xml:2: <primitive>: contains neither a <cylinder> nor a <cube>; add one"});
}

TEST(WorldReader, RejectsNonFiniteNumbers) {
  EXPECT_EQ(faults(worldOf({pillar("p", "nan"), pillar("q", "inf")})),
            (Lines{"a.xml:2: <radius>nan</radius>: must be a finite number; write a number there",
                   "a.xml:3: <radius>inf</radius>: must be a finite number; write a number there"}));
}

TEST(WorldReader, RejectsSizesThatAreNotPositive) {
  EXPECT_EQ(faults(worldOf({pillar("p", "0"), pillar("q", "-1")})),
            (Lines{"a.xml:2: <radius>0</radius>: must be above 0; write a number there",
                   "a.xml:3: <radius>-1</radius>: must be above 0; write a number there"}));
  EXPECT_EQ(faults(worldOf({"<primitive><cube><name>w</name><x>1</x><y>1</y><z>1</z><length>0</length><width>-0</width>"
                            "<height>-3</height></cube></primitive>"})),
            (Lines{"a.xml:2: <length>0</length>: must be above 0; write a number there",
                   "a.xml:2: <width>-0</width>: must be above 0; write a number there",
                   "a.xml:2: <height>-3</height>: must be above 0; write a number there"}));
}

TEST(WorldReader, RejectsValuesOutOfBounds) {
  EXPECT_EQ(faults(worldOf({pillar("p", "1", "<color>1 0 1.5</color><hot>-3</hot><stationary>2</stationary>")})),
            (Lines{"a.xml:2: <color>1 0 1.5</color>: '1.5' is no number that fits; it must lie in [0, 1]",
                   "a.xml:2: <hot>-3</hot>: must be at least 0; drop it for the default, 0",
                   "a.xml:2: <stationary>2</stationary>: is unknown; accepted are: 0, 1"}));
  EXPECT_EQ(faults("<world unit_m='0'><surface>" + kSurface + "</surface></world>"),
            Lines{"a.xml:1: <world unit_m=\"0\">: must lie in (0, 1000] metres; drop it for the default, 1"});
  EXPECT_EQ(faults("<world unit_m='0.1' win_distance='0'><surface>" + kSurface + "</surface></world>"),
            Lines{"a.xml:1: <world win_distance=\"0\">: must be above 0; drop it for the default, 5"});
  EXPECT_EQ(faults(worldOf({}, "<communication><range>0</range><loss>2</loss></communication>")),
            (Lines{"a.xml:2: <range>0</range>: must be above 0; write a number there",
                   "a.xml:2: <loss>2</loss>: must lie in [0, 1]; drop it for the default, 0"}));
  EXPECT_EQ(
      faults(worldOf({}, "<communication wall_range='1' delay_s='61' burst_s='0'/>")),
      (Lines{"a.xml:2: <communication wall_range=\"1\">: shortens the range, and there is none; add <range>",
             "a.xml:2: <communication burst_s=\"0\">: must lie in (0, 3600] seconds; drop it for the default, 1",
             "a.xml:2: <communication delay_s=\"61\">: must lie in [0, 60] seconds; drop it for the default, 0"}));
}

TEST(WorldReader, LimitsBurstsOfTheRadioToAnHour) {
  EXPECT_EQ(faults(worldOf({}, "<communication burst_gap_s='3600' burst_s='3600'/>")), Lines{});
  EXPECT_EQ(faults(worldOf({}, "<communication burst_gap_s='3601' burst_s='1e9'/>")),
            (Lines{"a.xml:2: <communication burst_gap_s=\"3601\">: must lie in [0, 3600] seconds; drop it for the "
                   "default, 0",
                   "a.xml:2: <communication burst_s=\"1e9\">: must lie in (0, 3600] seconds; drop it for the default, "
                   "1"}));
}

TEST(WorldReader, ReadsTheErrorsOfTheRadio) {
  const World world = parsed("<world unit_m='0.1'><surface>" + kSurface +
                             "</surface><communication range='50' wall_range='10' wall_loss='0.5' burst_gap_s='20' "
                             "burst_s='2' burst_loss='0.9' "
                             "delay_s='0.3' rate_hz='5'/></world>");
  Communication expected{.range_m = 5, .wall_range_m = 1, .wall_loss = 0.5, .burst_gap_s = 20, .burst_s = 2};
  expected.burst_loss = 0.9;
  expected.delay_s = 0.3;
  expected.rate_hz = 5;
  EXPECT_EQ(world.communication, expected);
}

TEST(WorldReader, RejectsASurfaceWithoutWidth) {
  EXPECT_EQ(faults("<world><surface><size>\n<xmin>9</xmin>\n<xmax>9</xmax>\n<ymin>1</ymin>\n<ymax>0</ymax>\n</size>"
                   "</surface></world>"),
            (Lines{"a.xml:2: <xmin>9</xmin>: is not below <xmax>; the size of the surface must be positive; fix one of "
                   "them",
                   "a.xml:4: <ymin>1</ymin>: is not below <ymax>; the size of the surface must be positive; fix one of "
                   "them"}));
}

TEST(WorldReader, RejectsDuplicateNames) {
  EXPECT_EQ(
      faults(worldOf({pillar("p"), pillar("q"), pillar("p"), scout("q")})),
      (Lines{"a.xml:4: <name>p</name>: is taken already, in line 2; give each object and robot a name of its own",
             "a.xml:5: <name>q</name>: is taken already, in line 3; give each object and robot a name of its own"}));
}

TEST(WorldReader, RejectsASlashInTheNameOfARobotButNotOfAnObject) {
  EXPECT_EQ(faults(worldOf({pillar("a/b"), scout("c/d")})),
            Lines{"a.xml:3: <name>c/d</name>: must not contain '/', which separates robot and sensor in a recording; "
                  "choose another name"});
}

TEST(WorldReader, RejectsANeighbourThatIsNotAnotherRobot) {
  EXPECT_EQ(faults(worldOf({pillar("p"), scout("A", "<neighbour>p</neighbour>"), scout("B", "<neighbour>C</neighbour>"),
                            scout("D", "<neighbour>D</neighbour>")})),
            (Lines{"a.xml:3: <neighbour>p</neighbour>: is not the name of a robot; the robots are: A, B, D",
                   "a.xml:4: <neighbour>C</neighbour>: is not the name of a robot; the robots are: A, B, D",
                   "a.xml:5: <neighbour>D</neighbour>: is the robot itself; name another one, or drop it"}));
}

TEST(WorldReader, AcceptsANeighbourThatComesLaterInTheFile) {
  EXPECT_EQ(parsed(worldOf({scout("A", "<neighbour>B</neighbour>"), scout("B")})).robots[0].neighbour, "B");
}

TEST(WorldReader, RejectsTwoShapesInOneElement) {
  EXPECT_EQ(faults(worldOf({pillar("p") + scout("A")})),
            Lines{"a.xml:2: <robot>: is given beside a <primitive>; put each in its own <object>"});
  EXPECT_EQ(faults(worldOf({pillar("p") + pillar("q")})),
            Lines{"a.xml:2: <primitive>: is given twice in <shape>; keep one"});
}

TEST(WorldReader, ReportsAllFaultsInTheFilesOrder) {
  EXPECT_EQ(faults(worldOf({pillar("p", "-1"), scout("A", "<modell/>"), pillar("p", "x")})),
            (Lines{"a.xml:2: <radius>-1</radius>: must be above 0; write a number there",
                   "a.xml:3: <modell>: unknown tag in <robot>; accepted here are: color, controller, cube, cylinder, "
                   "direction, drive, model, name, neighbour, sensor, sensors, x, y",
                   "a.xml:4: <name>p</name>: is taken already, in line 2; give each object and robot a name of its own",
                   "a.xml:4: <radius>x</radius>: is not a number; write a number there"}));
}

TEST(WorldReader, RejectsFilesThatAreNotXml) {
  EXPECT_EQ(faults(""), Lines{"a.xml:1: the file is empty; an XML document was expected"});
  EXPECT_EQ(faults("These are no worlds."),
            Lines{"a.xml:1: this is not XML, or the file was cut off; fix the file here or just before"});
  EXPECT_EQ(
      faults("<world>\n<surface>"),
      Lines{"a.xml:2: an element is closed by another's tag, or not at all (was the file cut off?); fix the file here "
            "or just before"});
  EXPECT_EQ(faults("<!DOCTYPE a [<!ENTITY b \"c\">]><world/>"),
            Lines{"a.xml:1: a DOCTYPE (and with it entities) is not accepted; take it out"});

  ErrorList errors;
  readWorld(ROBOSIM_SOURCE_DIR "/tests", errors);
  readWorld(ROBOSIM_SOURCE_DIR "/tests/none.xml", errors);
  EXPECT_EQ(errors.errors(), (Lines{ROBOSIM_SOURCE_DIR "/tests: is a directory; name a file in it",
                                    ROBOSIM_SOURCE_DIR "/tests/none.xml: no such file; check the path"}));
}

TEST(WorldReader, RejectsTwoHundredMegabytes) {
  const TemporaryDirectory folder;
  const auto file = folder / "two_hundred_megabytes.xml";
  std::ofstream(file) << "<world>";
  std::filesystem::resize_file(file, 200'000'000);
  ErrorList errors;
  readWorld(file, errors);
  EXPECT_EQ(errors.errors(),
            Lines{file.string() + ": is larger than 128 MiB, the most that is read; is it a world file?"});
}

TEST(WorldReader, HandlesRandomlyDamagedFiles) {
  ErrorList none;
  const std::string text = toXml(readWorld(ROBOSIM_SOURCE_DIR "/tests/data/legacy_world.xml", none));
  const std::string strange = "<>/&\"'=-!?[]\n0e9.\xff";
  Rng rng(1);
  const auto below = [&](std::size_t n) { return rng.below(static_cast<std::uint32_t>(n)); };
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = text;
    for (auto hits = 1 + rng.below(4); hits > 0; --hits) {
      const std::size_t at = below(damaged.size());
      switch (rng.below(4)) {
        case 0:
          damaged[at] = strange[below(strange.size())];
          break;
        case 1:
          damaged.erase(at, 1 + rng.below(40));
          break;
        case 2:
          damaged.insert(at, 1, strange[below(strange.size())]);
          break;
        default:
          damaged.insert(at, damaged.substr(below(damaged.size()), rng.below(200)));
      }
    }
    ErrorList errors;
    const World world = parseWorld(damaged, "legacy_world.xml", errors);
    if (!errors.empty()) continue;  // rejected, as expected
    EXPECT_EQ(parseWorld(toXml(world), "legacy_world.xml", errors), world) << damaged;
    EXPECT_TRUE(errors.empty()) << errors.errors()[0] << damaged;
  }
}

TEST(WorldReader, ReadsAHundredThousandRobots) {
  const auto name = [](int i) { return std::to_string(i % 100'000); };
  std::vector<std::string> robots;
  for (int i = 0; i < 100'000; ++i) robots.push_back(scout(name(i), "<neighbour>" + name(i + 1) + "</neighbour>"));
  const World world = parsed(worldOf(robots));
  ASSERT_EQ(world.robots.size(), 100'000u);
  EXPECT_EQ(world.robots.back().neighbour, "0");
}

}  // namespace
}  // namespace robosim
