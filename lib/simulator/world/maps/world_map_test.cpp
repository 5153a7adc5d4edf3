// Maps in a world file.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/testing/test_folder.h"
#include "world/maps/map_formats.h"
#include "world/maps/testing/map_samples.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;
using mrpt::math::TPose2D;

/// The tree of .bt from its root down to two voxels below the origin: each level has two bytes, two bits for each of
/// the children, which are numbered by x + 2 y + 4 z.
std::string voxelsBelowOrigin() {
  std::string tree("\x0f\0", 2);   // the root's children 0 and 1, on both sides of x = 0
  for (const int last : {7, 6}) {  // child 7 is the upper corner, 6 that with the lowest x
    for (int level = 1; level < 15; ++level) {
      const auto bits = static_cast<unsigned>(3 << (2 * last));
      tree += {static_cast<char>(bits & 0xff), static_cast<char>(bits >> 8)};
    }
    const auto leaf = static_cast<unsigned>((last == 7 ? 2 : 1) << (2 * last));
    tree += {static_cast<char>(leaf & 0xff), static_cast<char>(leaf >> 8)};
  }
  return tree;
}

/// Voxels of 0.5 m: one with x from -0.5 to 0 is occupied, one with x from 0 to 0.5 is free; both up to z = 0.
const std::string kVoxels = "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.5\ndata\n" + voxelsBelowOrigin();

const FileTexts kFiles{{"lab.pgm", "P2 3 2 255  0 205 254  254 254 0"},
                       {"maps/lab.yaml", rosYaml("../lab.pgm")},
                       {"maps/../lab.pgm", "P2 3 2 255  0 205 254  254 254 0"},
                       {"lab.gridmap", gridmapBytes(mrpt::maps::COccupancyGridMap2D(0, 1, 0, 1, 0.25f))},
                       {"voxels.bt", kVoxels},
                       {"home.map",
                        "2D-Map\nCairn: RobotHome 1000 2000 90 \"\" ICON \"\"\nCairn: Dock 0 0 0 \"\" ICON \"\"\n"
                        "LINES\n-3000 0 5000 0\n0 -1000 0 4000\n"}};

World parsedWithMaps(const std::string& text, ErrorList& errors) {
  useMapFormats();
  return parseWorld(text, "some/a.xml", makeProvider("some/a.xml", kFiles), errors);
}
World parsedWithMaps(const std::string& text) {
  ErrorList errors;
  World world = parsedWithMaps(text, errors);
  EXPECT_EQ(errors.errors(), Lines{});
  return world;
}
Lines faultsOfMaps(const std::string& text) {
  ErrorList errors;
  parsedWithMaps(text, errors);
  return errors.errors();
}

std::string worldWithMaps(const std::string& inside) { return "<world><surface>" + inside + "</surface></world>"; }
std::string robot(const std::string& name, const std::string& more = "") {
  return "<object><shape><robot><model>scout</model><name>" + name + "</name>" + more + "</robot></shape></object>";
}

TEST(WorldMap, IsASliceOfVoxelsBetweenTheGivenHeights) {
  const World world = parsedWithMaps(worldWithMaps("<map file='voxels.bt' z_min='-0.3' z_max='-0.1' x='2'/>"));
  EXPECT_EQ(world.maps[0].reading.slice, (HeightSpan{-0.3, -0.1}));
  EXPECT_EQ(world.bounds, (Bounds2D{1.5, 2.5, -0.5, 0}));
  EXPECT_EQ(world.maps[0].plan.occupied, (std::vector<CellRectangle>{{0, 0, 1, 1}}));
  EXPECT_EQ(parsedWithMaps(toXml(world)), world);
  const std::string at = "some/a.xml:1: ";
  EXPECT_EQ(faultsOfMaps(worldWithMaps("<map file='voxels.bt' z_min='1' z_max='1'/>")),
            Lines{at + "<map z_max=\"1\">: is not above z_min, 1 m; fix one of them"});
  EXPECT_EQ(faultsOfMaps(worldWithMaps("<map file='voxels.bt' threshold='1'/>")),
            Lines{at + "<map>: unknown attribute threshold=\"1\"; accepted here are: color, direction, file, height, "
                       "unknown, x, y, z_max, z_min"});
  EXPECT_EQ(faultsOfMaps(worldWithMaps("<map file='voxels.bt'/>")),
            Lines{at + "<map file=\"voxels.bt\">: some/voxels.bt: has no voxels between 0.1 m and 1 m; they reach from "
                       "-0.5 m to 0 m: write a world with z_min and z_max in its <map>"});
}

TEST(WorldMap, IsPlacedByTheWorldFile) {
  const World world = parsedWithMaps(
      "<world unit_m='0.1'><surface><map file='lab.pgm' resolution='0.5' x='10' y='20' direction='1' "
      "height='8' color='1 0 0'/></surface></world>");
  ASSERT_EQ(world.maps.size(), 1u);
  const WorldMap& map = world.maps[0];
  EXPECT_EQ(map.file, "lab.pgm");
  EXPECT_EQ(map.plan.cell_m, 0.05);
  EXPECT_EQ(map.world_from_map, TPose2D(1, 2, 1));
  EXPECT_DOUBLE_EQ(map.height_m, 0.8);
  EXPECT_EQ(map.color, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(map.plan.occupiedCells(), 2u);
}

TEST(WorldMap, IsGrayAndOneMetreHighByDefault) {
  const World world = parsedWithMaps("<world unit_m='0.1'><surface><map file='lab.gridmap'/></surface></world>");
  EXPECT_EQ(world.maps[0].height_m, 1);
  EXPECT_EQ(world.maps[0].color, (std::array<float, 3>{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(world.maps[0].world_from_map, TPose2D(0, 0, 0));
}

TEST(WorldMap, DefinesTheSurfacesSizeByDefault) {
  // The .yaml's origin is (-1.5, 2); 3 × 2 cells of 5 cm. The other map is 1 m × 1 m.
  const std::string maps = "<map file='maps/lab.yaml'/><map file='lab.gridmap' x='2'/>";
  const World world = parsedWithMaps(worldWithMaps(maps));
  EXPECT_NEAR(world.bounds.x_min, -1.5, 1e-12);
  EXPECT_NEAR(world.bounds.x_max, 3, 1e-12);
  EXPECT_NEAR(world.bounds.y_min, 0, 1e-12);
  EXPECT_NEAR(world.bounds.y_max, 2.1, 1e-12);
  const std::string size = "<size><xmin>0</xmin><xmax>9</xmax><ymin>0</ymin><ymax>8</ymax></size>";
  EXPECT_EQ(parsedWithMaps(worldWithMaps(size + maps)).bounds, (Bounds2D{0, 9, 0, 8}));
  EXPECT_EQ(faultsOfMaps("<world><surface/></world>"), Lines{"some/a.xml:1: <surface>: <size> is missing; add it"})
      << "without a map";
}

TEST(WorldMap, SupportsUnknownAsFreeOrOccupied) {
  const auto occupied = [](const std::string& map) {
    return parsedWithMaps(worldWithMaps(map)).maps[0].plan.occupiedCells();
  };
  EXPECT_EQ(occupied("<map file='maps/lab.yaml'/>"), 2u);
  EXPECT_EQ(occupied("<map file='maps/lab.yaml' unknown='occupied'/>"), 3u);
  EXPECT_EQ(occupied("<map file='lab.gridmap' unknown='free'/>"), 0u);
  EXPECT_EQ(occupied("<map file='lab.gridmap' unknown='occupied'/>"), 16u);
  EXPECT_EQ(occupied("<map file='lab.pgm' resolution='1' threshold='0.19'/>"), 3u);
  EXPECT_EQ(occupied("<map file='lab.pgm' resolution='1' negate='1'/>"), 4u);
}

TEST(WorldMap, HasThePixelsOfStageAndOnesThatAreNotSquare) {
  // Two rows of three: black, 205, white; white, white, black. 205 is free in Stage.
  const World world = parsedWithMaps(worldWithMaps(
      "<map file='lab.pgm' map_server='stage' unknown='occupied' resolution='2' resolution_y='0.5' x='10'/>"));
  const FloorPlan& plan = world.maps[0].plan;
  EXPECT_EQ(plan.columns, 0u) << "walls in place of cells";
  const PlanBox upper_left{{1, 0.75, 0}, 2, 0.5}, lower_right{{5, 0.25, 0}, 2, 0.5};
  EXPECT_EQ(plan.boxes, (std::vector<PlanBox>{lower_right, upper_left}));
  EXPECT_EQ(world.bounds, (Bounds2D{10, 16, 0, 1}));
  EXPECT_EQ(parsedWithMaps(toXml(world)), world);
  const World square = parsedWithMaps(worldWithMaps("<map file='lab.pgm' map_server='stage' resolution='2'/>"));
  EXPECT_EQ(square.maps[0].plan.occupiedCells(), 2u);
  EXPECT_TRUE(square.maps[0].plan.unknown.empty());
}

TEST(WorldMap, ProvidesTheStartPoseOfARobotWithoutOne) {
  const World world =
      parsedWithMaps(worldWithMaps("<map file='home.map' x='10'/>" + robot("A") + robot("B", "<x>1</x><y>1</y>") +
                                   robot("C", "<direction>1</direction>")));
  EXPECT_EQ(world.robots[0].world_from_robot, TPose2D(11, 2, M_PI / 2));
  EXPECT_EQ(world.robots[1].world_from_robot, TPose2D(1, 1, 0));
  EXPECT_EQ(world.robots[2].world_from_robot, TPose2D(10, 0, 1));
  EXPECT_EQ(faultsOfMaps(worldWithMaps("<map file='home.map'/>" + robot("A") + robot("B") + "\n" + robot("C"))),
            (Lines{"some/a.xml:2: <robot>: <x> is missing; add it", "some/a.xml:2: <robot>: <y> is missing; add it"}));
}

TEST(WorldMap, ReportsFaultsOfItsElementAtTheWorldsLine) {
  const auto fault = [](const std::string& map) {
    return faultsOfMaps("<world>\n<surface>\n" + map + "</surface></world>");
  };
  const std::string at = "some/a.xml:3: ";
  EXPECT_EQ(fault("<map/>"), Lines{at + "<map>: <file> is missing; add it"});
  EXPECT_EQ(fault("<map file='none.yaml'/>"),
            Lines{at + "<map file=\"none.yaml\">: some/none.yaml: did not come with the world"});
  EXPECT_EQ(fault("<map file='lab.gif'/>"),
            Lines{at + "<map file=\"lab.gif\">: lab.gif: is not a map by its name; maps end in .gridmap, .simplemap, "
                       ".bt, .ot, .yaml (of ROS), .png, .jpg, .bmp, .pgm, .ppm, .pbm or .map"});
  EXPECT_EQ(fault("<map file='lab.pgm'/>"), Lines{at + "<map>: <resolution> is missing; add it"});
  EXPECT_EQ(fault("<map file='lab.pgm' resolution='nan'/>"),
            Lines{at + "<map resolution=\"nan\">: must be a finite number; write a number there"});
  EXPECT_EQ(fault("<map file='lab.pgm' resolution='1000'/>"),
            Lines{at + "<map resolution=\"1000\">: must lie in (0, 100]; write a number there"});
  EXPECT_EQ(fault("<map file='maps/lab.yaml' resolution='1'/>"),
            Lines{at + "<map>: unknown attribute resolution=\"1\"; accepted here are: color, direction, file, height, "
                       "map_server, unknown, x, y"});
  EXPECT_EQ(fault("<map file='home.map' height='-1'/>"),
            Lines{at + "<map height=\"-1\">: must be at least 0; drop it for the default, 1"});
  EXPECT_EQ(fault("<map file='lab.gridmap' unknown='perhaps'/>"),
            Lines{at + "<map unknown=\"perhaps\">: is unknown; accepted are: free, occupied"});
}

TEST(WorldMap, WithoutHeightIsAPictureOnTheFloor) {
  useMapFormats();
  const FileTexts files{{"track.pbm", "P1\n2 1\n0 1\n"}};
  const auto read = [&](const std::string& text) {
    ErrorList errors;
    World world = parseWorld(text, "a.xml", makeProvider("a.xml", files), errors);
    EXPECT_EQ(errors.errors(), Lines{});
    return world;
  };
  const auto track = [](const std::string& height) {
    return "<world><surface><map file='track.pbm' resolution='0.5' height='" + height + "'/></surface></world>";
  };
  const World world = read(track("0"));
  EXPECT_TRUE(world.maps[0].isFloor());
  EXPECT_EQ(world.maps[0].plan.occupiedCells(), 1u);
  EXPECT_TRUE(startSolids(world).empty());
  EXPECT_EQ(world.bounds, (Bounds2D{0, 1, 0, 0.5}));
  EXPECT_EQ(startSolids(read(track("0.2"))).size(), 1u);
  EXPECT_TRUE(read(toXml(world)).maps[0].isFloor());
}

TEST(WorldMap, ReportsFaultsOfItsFileAtTheFilesLine) {
  useMapFormats();
  const FileTexts files{{"b.yaml",
                         "image: a.pgm\nresolution: nan\norigin: [0, 0, 0]\nnegate: 0\n"
                         "occupied_thresh: 0.65\nfree_thresh: 0.196"}};
  ErrorList errors;
  parseWorld(worldWithMaps("<map file='b.yaml'/>"), "some/a.xml", makeProvider("some/a.xml", files), errors);
  EXPECT_EQ(errors.errors(), Lines{"some/b.yaml:2: resolution: nan: must be a number in (0, 100] metres per pixel"});
}

TEST(WorldMap, ReportsFaultsOfBinaryFilesAtTheWorldsLine) {
  useMapFormats();
  const FileTexts files{{"a.png", "no picture"}, {"a.gridmap", "no grid"}, {"a.yaml", rosYaml("a.png")}};
  const auto fault = [&](const std::string& map) {
    ErrorList errors;
    parseWorld("<world><surface>\n" + map + "</surface></world>", "a.xml", makeProvider("a.xml", files), errors);
    return errors.errors();
  };
  const std::string no_picture = "a.png: is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these";
  EXPECT_EQ(fault("<map file='a.png' resolution='1'/>"), Lines{"a.xml:2: <map file=\"a.png\">: " + no_picture});
  EXPECT_EQ(fault("<map file='a.gridmap'/>"),
            Lines{"a.xml:2: <map file=\"a.gridmap\">: a.gridmap: is not an MRPT grid map: it does not begin with a "
                  "COccupancyGridMap2D"});
  EXPECT_EQ(fault("<map file='a.yaml'/>"), Lines{"a.yaml:1: image: " + no_picture})
      << "which has lines, and the path once";
}

TEST(WorldMap, MayBeEmptyOnlyIfTheWorldHasASize) {
  useMapFormats();
  const FileTexts files{{"a.map", "2D-Map\n"}};
  const auto faults_with = [&](const std::string& size) {
    ErrorList errors;
    parseWorld(worldWithMaps(size + "<map file='a.map'/>"), "a.xml", makeProvider("a.xml", files), errors);
    return errors.errors();
  };
  EXPECT_EQ(faults_with(""), Lines{"a.xml:1: <surface>: has no <size>, and its maps are empty; add a <size>"});
  EXPECT_EQ(faults_with("<size xmin='0' xmax='1' ymin='0' ymax='1'/>"), Lines{});
}

TEST(WorldMap, RoundTrips) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed, RandomPurpose::test);
    const auto number = [&](double low, double high) { return toText(rng.uniform(low, high)); };
    std::string maps;
    for (const char* file : {"lab.pgm", "maps/lab.yaml", "lab.gridmap", "home.map"}) {
      if (rng.below(2)) continue;
      maps += std::string("<map file='") + file + "'";
      if (rng.below(2))
        maps += " x='" + number(-9, 9) + "' y='" + number(-9, 9) + "' direction='" + number(-3, 3) + "'";
      if (rng.below(2)) maps += " height='" + number(0.1, 9) + "' color='" + number(0, 1) + " 0.5 1'";
      if (std::string(file) != "home.map" && rng.below(2)) maps += " unknown='occupied'";
      if (std::string(file) == "lab.pgm") maps += " negate='1' resolution='" + number(0.01, 9) + "'";
      if (std::string(file).starts_with("lab.") && rng.below(2)) maps += " threshold='" + number(0, 1) + "'";
      maps += "/>";
    }
    if (maps.empty()) continue;
    const World world =
        parsedWithMaps("<world unit_m='" + number(0.1, 1) + "'><surface>" + maps + "</surface></world>");
    World again = parsedWithMaps(toXml(world));
    again.name = world.name;
    ASSERT_EQ(again, world) << "seed " << seed << "\n" << toXml(world);
  }
}

class MapAsWorld : public TestFolder {
 protected:
  MapAsWorld() {
    useMapFormats();
    std::filesystem::create_directories(folder_ / "maps");
    for (const auto& [name, text] : kFiles) std::ofstream(folder_ / name, std::ios::binary) << text;
  }
};

TEST_F(MapAsWorld, ConsistsOfTheMap) {
  ErrorList errors;
  const World world = readWorld(folder_ / "maps/lab.yaml", errors);
  EXPECT_EQ(errors.errors(), Lines{});
  EXPECT_EQ(world.name, "lab");
  ASSERT_EQ(world.maps.size(), 1u);
  EXPECT_EQ(world.maps[0].plan.occupiedCells(), 2u);
  EXPECT_TRUE(world.robots.empty());
}

TEST_F(MapAsWorld, PlacesAPioneerAtTheMapsStartPose) {
  ErrorList errors;
  const World world = readWorld(folder_ / "home.map", errors);
  EXPECT_EQ(errors.errors(), Lines{});
  ASSERT_EQ(world.robots.size(), 1u);
  EXPECT_EQ(world.robots[0].model, "pioneer3dx");
  EXPECT_EQ(world.robots[0].world_from_robot, TPose2D(1, 2, M_PI / 2));
}

TEST_F(MapAsWorld, RejectsAPicture) {
  ErrorList errors;
  readWorld(folder_ / "lab.pgm", errors);
  EXPECT_EQ(errors.errors(),
            Lines{(folder_ / "lab.pgm").string() +
                  ": a picture does not say how large it is; write a world around it, <world><surface><map "
                  "file=\"lab.pgm\" resolution=\"0.05\"/></surface></world> for pixels of 5 cm"});
}

TEST_F(MapAsWorld, ReportsFaultsWithoutLinesOfTheGeneratedWorld) {
  const auto fault = [&](const char* name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    ErrorList errors;
    readWorld(folder_ / name, errors);
    return errors.errors();
  };
  const std::string in = folder_.string() + "/";
  EXPECT_EQ(fault("no.gridmap", "no grid"),
            Lines{in + "no.gridmap: is not an MRPT grid map: it does not begin with a COccupancyGridMap2D"});
  EXPECT_EQ(fault("no.yaml", rosYaml("none.pgm")),
            Lines{in + "no.yaml:1: image: none.pgm: " + in + "none.pgm: no such file; check the path"});
  EXPECT_EQ(fault("no.map", "2D-Map\n"),
            Lines{in + "no.map: <surface>: the map is empty; write a world with a <size> around it"});
}

TEST_F(MapAsWorld, IncludesTheMapsPictureAmongItsFiles) {
  using Paths = std::vector<std::filesystem::path>;
  EXPECT_EQ(filesOfMap(folder_ / "maps/lab.yaml"), (Paths{folder_ / "maps/lab.yaml", folder_ / "maps/../lab.pgm"}));
  EXPECT_EQ(filesOfMap(folder_ / "home.map"), Paths{folder_ / "home.map"});
  EXPECT_EQ(filesOfMap(folder_ / "none.yaml"), Paths{folder_ / "none.yaml"});
}

TEST_F(MapAsWorld, ReportsMissingFilesWhereTheyAreReferredTo) {
  std::ofstream(folder_ / "a.xml") << "<world><surface>\n<map file='none.png' resolution='1'/></surface></world>";
  ErrorList errors;
  readWorld(folder_ / "a.xml", errors);
  EXPECT_EQ(errors.errors(), Lines{(folder_ / "a.xml").string() + ":2: <map file=\"none.png\">: " +
                                   (folder_ / "none.png").string() + ": no such file; check the path"});
}

}  // namespace
}  // namespace robosim
