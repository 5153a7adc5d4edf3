#include "stage/stage_world.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/xml_parser.h"
#include "geometry/shapes/ray.h"
#include "stage/stage_properties.h"
#include "world/map_reader.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// A picture as text: '#' is dark.
FloorPlan readTextPicture(const std::string& name, const FileProvider& files, const MapReading& reading) {
  std::istringstream lines(files.read(name));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  OccupancyGrid grid;
  grid.columns = static_cast<std::uint32_t>(rows.at(0).size());
  grid.rows = static_cast<std::uint32_t>(rows.size());
  grid.cell_m = reading.pixel_m;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) grid.cells.push_back(c == '#' ? Occupancy::occupied : Occupancy::free);
  }
  FloorPlan plan = toFloorPlan(grid, false);
  if (reading.pixel_y_m == 0) return plan;
  FloorPlan boxes;
  for (const auto& cells : plan.occupied) {
    boxes.boxes.push_back({{(cells.column + cells.columns / 2.0) * reading.pixel_m,
                            (cells.row + cells.rows / 2.0) * reading.pixel_y_m, 0},
                           cells.columns * reading.pixel_m,
                           cells.rows * reading.pixel_y_m});
  }
  return boxes;
}

class StageWorld : public testing::Test {
 protected:
  void SetUp() override { setMapReaders({.read = readTextPicture}); }
  void TearDown() override { setMapReaders({}); }

  TranslatedStageWorld translate(const std::string& text) {
    return translateStageWorld(text, "w.world", makeProvider("w.world", files_));
  }
  World worldOf(const std::string& text) {
    translated_ = translate(text);
    ErrorList errors;
    World world = parseWorld(translated_.text, "w.world", makeProvider("w.world", files_), errors);
    errors.throwIfAny();
    return world;
  }
  std::string faultOf(const std::string& text) {
    try {
      translate(text);
      return "";
    } catch (const ConfigError& error) {
      return error.what();
    }
  }
  /// Element of a robot type, as its text.
  std::string typeText(const std::string& text) { return translate(text).robot_types.begin()->second; }

  FileTexts files_;
  TranslatedStageWorld translated_;
};

/// Range of a ray that meets nothing.
constexpr double kFar_m = 100;

/// Distance along a ray to the nearest solid of the world.
double range(const World& world, const TPoint2D& from, double azimuth_rad, double height_m = 0.3) {
  double nearest_m = kFar_m;
  const Ray ray = Ray::towards({from.x, from.y, height_m}, azimuth_rad);
  for (const auto& solid : startSolids(world)) {
    if (const auto hit = intersect(ray, solid)) nearest_m = std::min(nearest_m, *hit);
  }
  return nearest_m;
}

/// Distance along a ray to the nearest edge of polygons in the world: solves origin + t · direction = a + s · (b - a).
double slowRange(const std::vector<std::vector<TPoint2D>>& polygons, const TPoint2D& from, double azimuth_rad) {
  const double dx = std::cos(azimuth_rad), dy = std::sin(azimuth_rad);
  double nearest_m = kFar_m;
  for (const auto& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const TPoint2D a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double ex = b.x - a.x, ey = b.y - a.y, det = ex * dy - ey * dx;
      if (det == 0) continue;
      const double t = (ex * (a.y - from.y) - ey * (a.x - from.x)) / det;
      const double s = (dx * (a.y - from.y) - dy * (a.x - from.x)) / det;
      if (t >= 0 && s >= 0 && s <= 1) nearest_m = std::min(nearest_m, t);
    }
  }
  return nearest_m;
}

/// Corners turned by an angle about the origin, then moved.
std::vector<TPoint2D> placed(const std::vector<TPoint2D>& corners, double x, double y, double angle_rad) {
  std::vector<TPoint2D> placed;
  for (const auto& p : corners) {
    placed.emplace_back(x + std::cos(angle_rad) * p.x - std::sin(angle_rad) * p.y,
                        y + std::sin(angle_rad) * p.x + std::cos(angle_rad) * p.y);
  }
  return placed;
}

TEST_F(StageWorld, HasTheRangesOfAllItsPolygons) {
  const World world = worldOf(R"(
    define hook model ( size [2 1 1] block ( points 6
      point[0] [0 0] point[1] [40 0] point[2] [40 10] point[3] [10 10] point[4] [10 20] point[5] [0 20] z [0 3] ) )
    hook ( pose [3 1 0 30] )
    model ( size [1 2 1] pose [-2 0 0 -45] origin [0.5 0 0 0] )
    model ( size [1 1 1] pose [0 -3 0 0] block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] ) ))");
  // The hook is 40 by 20 of its own units, and is scaled to 2 m by 1 m about its middle: by 1/20.
  const std::vector<std::vector<TPoint2D>> polygons{
      placed({{-1, -0.5}, {1, -0.5}, {1, 0}, {-0.5, 0}, {-0.5, 0.5}, {-1, 0.5}}, 3, 1, M_PI / 6),
      placed({{0, -1}, {1, -1}, {1, 1}, {0, 1}}, -2, 0, -M_PI / 4),
      {{-0.5, -3.5}, {0.5, -3.5}, {-0.5, -2.5}}};
  int hits = 0;
  for (const TPoint2D from : {TPoint2D{0, 0}, TPoint2D{3, -2}, TPoint2D{3.4, 1.7}, TPoint2D{-4, 3}, TPoint2D{1, -4}}) {
    for (int i = 0; i < 720; ++i) {
      const double azimuth_rad = (i + 0.25) * M_PI / 360;
      const double expected_m = slowRange(polygons, from, azimuth_rad);
      const double measured_m = range(world, from, azimuth_rad);
      // Acute corners of walls of 0.1 mm are blunt by less than that; a grazing ray magnifies it.
      EXPECT_NEAR(measured_m, expected_m, 1e-3) << i << " from " << from.x;
      hits += expected_m < kFar_m ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 700);
}

TEST_F(StageWorld, ScalesABitmapByItsDarkPixelsWhateverItsMarginIs) {
  // The dark pixels are 4 columns of 2 m by 1 row of 1 m: the outermost faces are at the size.
  files_["plan.pgm"] = ".....\n.#..#\n.....\n.....\n";
  const std::string text = R"(model ( bitmap "plan.pgm" size [8 1 0.5] pose [10 20 0 0] ))";
  const World world = worldOf(text);
  EXPECT_NEAR(range(world, {10, 20}, 0), 2, 1e-6);
  EXPECT_NEAR(range(world, {10, 20}, M_PI), 2, 1e-6);
  EXPECT_NEAR(range(world, {5, 20.4}, 0), 1, 1e-6);
  EXPECT_NEAR(range(world, {13, 22}, -M_PI / 2), 1.5, 1e-6);
  EXPECT_EQ(range(world, {5, 20.6}, 0), kFar_m) << "above the row";
  EXPECT_EQ(range(world, {10, 20}, 0, 0.6), kFar_m) << "above the walls";
  // With another margin it is the same world.
  files_["plan.pgm"] = "#..#\n";
  const World without_margin = worldOf(text);
  for (int i = 0; i < 100; ++i) {
    EXPECT_NEAR(range(world, {10, 20.2}, i * 0.0628), range(without_margin, {10, 20.2}, i * 0.0628), 1e-6) << i;
  }
}

TEST_F(StageWorld, TurnsABitmapAboutTheMiddleOfItsSize) {
  files_["plan.pgm"] = "....\n.#..\n.###\n";
  const World world = worldOf(R"(model ( bitmap "plan.pgm" size [3 2 1] pose [1 2 0 90] ))");
  // Dark are x of [-1.5, -0.5] with y of [0, 1], and all of y in [-1, 0], turned by 90° about (1, 2).
  const std::vector<std::vector<TPoint2D>> polygons{
      placed({{-1.5, -1}, {1.5, -1}, {1.5, 0}, {-0.5, 0}, {-0.5, 1}, {-1.5, 1}}, 1, 2, M_PI / 2)};
  for (int i = 0; i < 360; ++i) {
    const double azimuth_rad = (i + 0.5) * M_PI / 180;
    EXPECT_NEAR(range(world, {0.5, 3}, azimuth_rad), slowRange(polygons, {0.5, 3}, azimuth_rad), 1e-6) << i;
  }
}

TEST_F(StageWorld, HasWallsOfABoundaryAroundARobot) {
  const World world = worldOf("model ( size [4 2 1] boundary 1 ) position ( pose [1 0 0 0] size [0.2 0.2 0.2] )");
  EXPECT_NEAR(range(world, {1, 0}, 0), 1 - 0.01, 1e-9) << "a wall of a centimetre inside the size";
  EXPECT_NEAR(range(world, {1, 0}, M_PI), 3 - 0.01, 1e-9);
}

TEST_F(StageWorld, StacksChildrenAndTurnsThemWithTheirParent) {
  const World world = worldOf(R"(unit_length "cm"
    model ( name "table" size [100 100 80] pose [200 0 0 90]
            model ( name "box" size [20 20 30] pose [10 0 5 0] )
            model ( name "/lamp" size [10 10 10] pose [0 0 0 0] stack_children 0 ) ))");
  ASSERT_EQ(world.objects.size(), 3u);
  const WorldObject& box = world.objects[1];
  EXPECT_EQ(box.name, "table.box");
  EXPECT_NEAR(box.body.world_from_body.x, 2, 1e-9);
  EXPECT_NEAR(box.body.world_from_body.y, 0.1, 1e-9);
  EXPECT_NEAR(box.body.heights().z_min_m, 0.85, 1e-9);
  EXPECT_NEAR(box.body.heights().z_max_m, 1.15, 1e-9);
  EXPECT_EQ(world.objects[2].name, "lamp");
}

TEST_F(StageWorld, LeavesOutWhatIsNeitherVisibleNorAnObstacle) {
  EXPECT_TRUE(worldOf("model ( obstacle_return 0 ranger_return -1 )").objects.empty());
  EXPECT_TRUE(translated_.notes.empty());
  EXPECT_EQ(worldOf("model ( obstacle_return 0 )").objects.size(), 1u);
  EXPECT_EQ(translated_.notes,
            std::vector<std::string>{"w.world:1: 'model' is an obstacle as well as visible, in spite "
                                     "of its obstacle_return 0"});
}

TEST_F(StageWorld, HasMovableObjectsThatAGripperHolds) {
  const World world = worldOf(R"(model ( gripper_return 1 mass 0.5 size [0.1 0.2 0.3] color "DarkGreen" ))");
  ASSERT_TRUE(world.objects.at(0).movable);
  EXPECT_EQ(world.objects[0].movable->mass_kg, 0.5);
  EXPECT_NEAR(world.objects[0].body.color[1], 100 / 255.0, 0.001);
}

TEST_F(StageWorld, HasRobotTypesOfItsMacros) {
  const std::string text = R"(
    define bot position ( size [0.4 0.3 0.2] velocity_bounds [-0.5 0.5 0 0 0 0 -60 60]
      ranger ( pose [0.1 0 0.05 0] sensor ( range [0.1 4] fov 90 samples 91 size [0.1 0.1 0.1] noise [0.0004 0 0] )
               sensor ( pose [0 0.1 0 45] ) ) )
    bot ( name "a" pose [0 0 0 0] ctrl "wander" ) bot ( name "b" pose [2 0 0 90] color "blue" )
    bot ( name "c" pose [4 0 0 0] size [0.5 0.3 0.2] ))";
  const World world = worldOf(text);
  ASSERT_EQ(world.robots.size(), 3u);
  EXPECT_EQ(world.robots[0].model, "bot");
  EXPECT_EQ(world.robots[0].controller, "wander");
  EXPECT_EQ(world.robots[1].model, "bot");
  EXPECT_NEAR(world.robots[1].world_from_robot.phi, M_PI / 2, 1e-12);
  EXPECT_EQ(world.robots[2].model, "bot_2");
  const std::string& type = translated_.robot_types.at("bot");
  // On the robot's top of 0.2 m, at 0.05 m, in the middle of a sensor of 0.1 m, or 0.02 m: 0.3 m and 0.26 m.
  for (
      const char* part :
      {R"(<body length_m="0.4" width_m="0.3" height_m="0.2"/>)",
       R"(speed_max_mps="0.5" accel_mps2="1000" decel_mps2="1000" turn_max_degps="60")",
       R"(<laser x_m="0.1" y_m="0" z_m="0.3" angle_deg="0" beams="91" field_of_view_deg="90" range_max_m="4" range_min_m="0.1">)",
       R"(<noise std_m="0.02" std_per_m="0"/>)", R"(<sonar model="rays" rays="1")",
       R"(<at x_m="0.1" y_m="0.1" z_m="0.26" angle_deg="45"/>)", "<odometry/>"}) {
    EXPECT_NE(type.find(part), std::string::npos) << part << "\n" << type;
  }
}

TEST_F(StageWorld, ReadsTheShortTuplesAndLasersOfStage2) {
  const std::string type = typeText("position ( pose [1 2 90] size [0.4 0.3] laser ( range_max 6 samples 181 ) )");
  EXPECT_NE(type.find(R"(beams="181" field_of_view_deg="180" range_max_m="6")"), std::string::npos) << type;
  EXPECT_NEAR(worldOf("position ( pose [1 2 90] size [0.4 0.3] )").robots.at(0).world_from_robot.phi, M_PI / 2, 1e-12);
  const std::string sonars =
      typeText("position ( pose [0 0 0] ranger ( scount 2 spose[0] [0.1 0 0] spose[1] [0 0.1 90] sview [0.1 3 20] ) )");
  EXPECT_NE(sonars.find(R"(range_max_m="3" range_min_m="0.1")"), std::string::npos) << sonars;
}

TEST_F(StageWorld, HasTheOtherDevicesOfARobotOrNotesThem) {
  const std::string type = typeText(R"(position ( size [0.4 0.3 0.2] localization "odom" odom_error [0 0 0 2]
    joules 36000 watts 5
    camera ( name "eye" resolution [64 48] fov [60 40] pantilt [10 -5] update_interval 200 )
    blobfinder ( name "blobs" colors [ "red" "gray" ] ) gripper ( ) gripper ( ) bumper ( bcount 6 ) fiducial ( )
    ranger ( sensor ( noise [0.01 0 0] ) ) ))");
  // 2° are 0.0349 of a turn; 36 kJ last 2 hours at 5 W.
  for (const char* part :
       {R"(wheelbase_ratio="1.034906585")",
        R"(angle_deg="10" width_px="64" height_px="48" field_of_view_deg="60" rate_hz="5" tilt_deg="-5" label="eye")",
        R"(<blob_finder label="blobs">)", R"(<color name="red" rgb="1 0 0"/>)",
        R"(<gripper opening_m="0.24" reach_m="0.132")", R"(<bumper segments="6"/>)",
        R"(range_max_m="8" id_range_max_m="5" field_of_view_deg="180")",
        R"(<noise std_m="0.1" std_per_m="0" specular_deg="180"/>)", R"(<battery standing_h="2" driving_h="2"/>)"}) {
    EXPECT_NE(type.find(part), std::string::npos) << part << "\n" << type;
  }
  EXPECT_EQ(type.find("<gripper"), type.rfind("<gripper"));
  worldOf("position ( drive \"car\" ptz ( ) ctrl \"fasr\" )");
  EXPECT_EQ(translated_.notes,
            (std::vector<std::string>{"w.world:1: 'ptz' on a robot has no equivalent",
                                      "w.world:1: ctrl \"fasr\" is left out, because it is a library of Stage"}));
}

TEST_F(StageWorld, HasTheDriveOfARobot) {
  EXPECT_EQ(typeText("position ( )").find("<drive"), std::string::npos);
  EXPECT_NE(typeText(R"(position ( drive "omni" velocity_bounds [-1 1 -0.4 0.3 0 0 -90 90] ))")
                .find(R"(<drive type="omni" lateral_max_mps="0.4"/>)"),
            std::string::npos);
  EXPECT_NE(typeText(R"(position ( drive "car" wheelbase 0.6 ))")
                .find(R"(<drive type="car" wheelbase_m="0.6" steering_max_deg="45"/>)"),
            std::string::npos);
  worldOf(R"(position ( drive "rocket" ))");
  EXPECT_EQ(translated_.notes, std::vector<std::string>{"w.world:1: drive \"rocket\" is driven as differential"});
}

TEST_F(StageWorld, TakesTheFirstDefinitionTheLastValueAndLateMacros) {
  files_["a.inc"] = "define thing model ( size [1 1 1] )\ndefine rack model ( shelf() )\n";
  const World world = worldOf(R"(include "a.inc" all else on this line is dropped
    define thing model ( size [9 9 9] ) define shelf model ( size [2 2 2] noblocks 1 )
    thing ( pose [0 0 0 0] pose [5 0 0 0] ) rack ( noblocks 1 ))");
  ASSERT_EQ(world.objects.size(), 1u);
  EXPECT_EQ(std::get<Cube>(world.objects[0].body.shape).length_m, 1);
  EXPECT_EQ(world.objects[0].body.world_from_body.x, 5);
}

TEST_F(StageWorld, CountsItsPropertiesAndNotesThoseThatItIgnores) {
  worldOf("resolution 0.1\nwindow ( size [1 1] )\nmodel ( blah 1 )\nmodel ( blah 1 blah 2 )\nmodel ( friction 0 )\n");
  EXPECT_EQ(translated_.properties.all, 5u);
  EXPECT_EQ(translated_.properties.display, 2u);
  EXPECT_EQ(translated_.properties.ignored, 3u);
  EXPECT_EQ(translated_.notes,
            (std::vector<std::string>{
                "w.world:3: blah is ignored, because 'model' has no such property in Stage; 1 line more",
                "w.world:5: friction is ignored, because in Stage it has no effect either"}));
}

TEST_F(StageWorld, NamesTheLineOfEveryFault) {
  files_["cycle.inc"] = "include \"cycle.inc\"\n";
  files_["cut.inc"] = "\n\ndefine a model (";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"\nmodle ( )", "w.world:2: there is no model or macro 'modle'; did you mean model?"},
      {"include \"none.inc\"", "w.world:1: include \"none.inc\": none.inc: "},
      {"include \"cycle.inc\"", "cycle.inc:1: include \"cycle.inc\": the file includes itself"},
      {"include \"cut.inc\"", "cut.inc:3: the '(' of 'a' is not closed before the end of the file"},
      {"model (\n pose [0 0 0", "w.world:2: the '[' of 'pose' is not closed by ']'"},
      {"model ( name \"a\n )", "w.world:1: a string has no closing '\"' on its line"},
      {"model ( size [99999999999 1 1] )", "w.world:1: '99999999999' is too large; numbers are at most 1e9"},
      {"model ( size [1..2 1 1] )", "w.world:1: '1..2' is not a number; write it as in -1.5"},
      {"model ( pose [1e9 0 0 0] )", "w.world:1: 'pose' is more than 1,000 km away"},
      {"model ( size [1] )", "w.world:1: 'size' has too few numbers; it must have 2 or more, as in [1 2]"},
      {"model ( size \"big\" )", "w.world:1: 'size' must consist of numbers"},
      {"model ( bitmap \"none.txt\" )", "w.world:1: bitmap \"none.txt\": none.txt: "},
      {"define a a ( ) a ( )", "w.world:1: macros and entities are nested more than 64 deep; does one contain itself?"},
      {")", "w.world:1: ')' closes nothing"},
      {"unit_length \"miles\"", "w.world:1: 'unit_length' is 'miles'; it must be one of: m, cm, mm"},
      {"model ( block ( points 3 point[0] [0 0] ) )",
       "w.world:1: 'points' is more than there are points: add point[1]"},
      {"model { }", "w.world:1: "}};
  for (const auto& [text, expected] : faults) {
    const std::string fault = faultOf(text);
    EXPECT_EQ(fault.substr(0, expected.size()), expected) << text << "\n" << fault;
  }
}

TEST_F(StageWorld, RefusesMacrosThatMultiply) {
  std::string text = "define a0 model ( )\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "a" + std::to_string(i - 1) + "() ";
    text += "define a" + std::to_string(i) + " model ( " + before + before + ")\n";
  }
  EXPECT_NE(faultOf(text + "a39()").find("w.world:"), std::string::npos);
}

TEST_F(StageWorld, HasTheTableOfPropertiesThatItsPageHas) {
  std::ifstream page(ROBOSIM_SOURCE_DIR "/doc/from_stage.md");
  std::vector<std::string> rows;
  bool is_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## Properties")) is_table = true;
    if (is_table && line.starts_with("| ") && line.find("| `") != std::string::npos) rows.push_back(line);
  }
  std::vector<std::string> expected;
  for (const auto& rule : stage::propertyRules()) {
    std::string names;
    std::istringstream words(rule.names);
    for (std::string word; words >> word;) names += (names.empty() ? "`" : ", `") + word + "`";
    const char* effect = rule.effect == stage::Effect::ignored   ? "ignored, because "
                         : rule.effect == stage::Effect::display ? "left out: "
                                                                 : "";
    expected.push_back("| " + std::string(rule.where) + " | " + names + " | " + effect + rule.text + " |");
  }
  EXPECT_EQ(rows, expected) << "doc/from_stage.md must have the rows of stage_properties.cpp";
}

}  // namespace
}  // namespace robosim
