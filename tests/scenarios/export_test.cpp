// `robosim export` from the command line, and the results in the programs that the formats are for.
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/serialization/CArchive.h>
#include <opencv2/imgcodecs.hpp>

#include "base/angle_units.h"
#include "geometry/scene.h"
#include "rendering/plan.h"
#include "robots/fleet.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/screen.h"
#include "tests/stock_tools.h"
#include "world/raster.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;

COccupancyGridMap2D gridmapIn(const fs::path& file) {
  mrpt::io::CFileGZInputStream in(file.string());
  COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(in) >> grid;
  return grid;
}

void exportWorld(const std::string& arguments) {
  const Ended ended = runProgram("export " + arguments);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
}

/// Compares every cell of a grid with the scene used for collisions.
void expectAgreesWithScene(const COccupancyGridMap2D& grid, const std::string& world_file) {
  const LoadedWorld loaded = loadWorld(ROBOSIM_SOURCE_DIR "/" + world_file, {});
  const Scene scene(startSolids(loaded.world), 0, loaded.world.bounds);
  std::vector<Solid> unknown;
  for (const auto& map : loaded.world.maps) {
    for (const auto& solid : unknownSolids(map)) unknown.push_back(solid);
  }
  std::vector<HeightSpan> robots;
  for (const auto& robot : loaded.fleet.robots) robots.push_back(robot.body().heights());
  const HeightSpan heights = robotHeights(robots);
  const double cell_m = grid.getResolution();
  std::vector<BodyId> near;
  std::size_t occupied = 0;
  for (unsigned row = 0; row < grid.getSizeY(); ++row) {
    for (unsigned column = 0; column < grid.getSizeX(); ++column) {
      // MRPT stores positions in single precision; cells are at multiples of their size.
      const double x = std::round(grid.getXMin() / cell_m + column) * cell_m + cell_m / 2;
      const double y = std::round(grid.getYMin() / cell_m + row) * cell_m + cell_m / 2;
      const Solid cell{OrientedBox{{x, y}, {1, 0}, cell_m / 2 - 1e-6, cell_m / 2 - 1e-6}, heights};
      near.clear();
      scene.findBodies(boundsOf(cell.outline), near);
      const bool stands =
          std::any_of(near.begin(), near.end(), [&](BodyId body) { return overlap(cell, scene.solid(body)); });
      const float free = grid.getCell(static_cast<int>(column), static_cast<int>(row));
      ASSERT_EQ(free < 0.1f, stands) << world_file << ": at " << x << ", " << y;
      const bool is_unknown = std::any_of(unknown.begin(), unknown.end(), [&](const Solid& solid) {
        return distance(solid.outline, {x, y}) == 0;
      });
      if (!stands && loaded.world.bounds.contains({x, y})) {
        ASSERT_EQ(free > 0.9f, !is_unknown) << world_file << ": at " << x << ", " << y;
      }
      occupied += stands ? 1 : 0;
    }
  }
  EXPECT_GT(occupied, 500u);
}

TEST(Export, WritesAGridmapThatMatchesTheSceneCellByCell) {
  const auto folder = emptyFolder();
  for (const std::string world : {"opho2_1", "open_100", "lab_map", "courtyard_and_office"}) {
    const std::string file = "worlds/" + world + ".xml";
    exportWorld(file + " --resolution 0.05 '" + (folder / (world + ".gridmap")).string() + "'");
    expectAgreesWithScene(gridmapIn(folder / (world + ".gridmap")), file);
  }
}

TEST(Export, WritesTheSameGridForRos) {
  const auto folder = emptyFolder();
  exportWorld("worlds/opho2_1.xml --resolution 0.1 '" + (folder / "a.gridmap").string() + "' '" +
              (folder / "b.yaml").string() + "' '" + (folder / "c.png").string() + "'");
  const COccupancyGridMap2D grid = gridmapIn(folder / "a.gridmap");
  for (const char* name : {"b.yaml", "c.yaml"}) {
    COccupancyGridMap2D for_ros;
    ASSERT_TRUE(for_ros.loadFromROSMapServerYAML((folder / name).string())) << name;
    ASSERT_EQ(for_ros.getSizeX(), grid.getSizeX());
    ASSERT_EQ(for_ros.getSizeY(), grid.getSizeY());
    EXPECT_NEAR(for_ros.getXMin(), grid.getXMin(), 1e-5);
    EXPECT_NEAR(for_ros.getYMin(), grid.getYMin(), 1e-5);
    for (int row = 0; row < static_cast<int>(grid.getSizeY()); ++row) {
      for (int column = 0; column < static_cast<int>(grid.getSizeX()); ++column) {
        ASSERT_EQ(for_ros.getCell(column, row) > 0.5f, grid.getCell(column, row) > 0.5f) << column << " " << row;
      }
    }
  }
}

TEST(Export, ConvertsMapsBetweenFormatsWithoutLoss) {
  const auto folder = emptyFolder();
  exportWorld("maps/lab.yaml '" + (folder / "lab.gridmap").string() + "'");
  exportWorld("'" + (folder / "lab.gridmap").string() + "' '" + (folder / "again.yaml").string() + "'");
  const cv::Mat original = cv::imread(ROBOSIM_SOURCE_DIR "/maps/lab.pgm", cv::IMREAD_GRAYSCALE);
  const cv::Mat again = cv::imread((folder / "again.png").string(), cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(again.size(), original.size());
  EXPECT_EQ(cv::countNonZero((again == 0) != (original == 0)), 0) << "what is occupied";
}

TEST(Export, ResamplesAMapWhoseCornerIsNoMultipleOfItsCellForMrpt) {
  const auto folder = emptyFolder();
  // 4 × 3 cells of 0.5 m from (0.2, -0.3); the lower left one is occupied: [0.2, 0.7] × [-0.3, 0.2]
  std::ofstream(folder / "a.pgm") << "P2 4 3 255  254 254 254 254  254 254 254 254  0 254 254 254\n";
  std::ofstream(folder / "a.yaml") << "image: a.pgm\nresolution: 0.5\norigin: [0.2, -0.3, 0]\nnegate: 0\n"
                                      "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const Ended ended = runProgram("export " + quoted(folder / "a.yaml") + " " + quoted(folder / "a.gridmap"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("a.gridmap: the corner of the map is no multiple of its cell of 0.5 m"), std::string::npos)
      << ended.err;
  const COccupancyGridMap2D grid = gridmapIn(folder / "a.gridmap");
  EXPECT_EQ(grid.getXMin(), 0);
  EXPECT_EQ(grid.getYMin(), -0.5f);
  ASSERT_EQ(grid.getSizeX(), 5u);  // up to 2.2 m
  ASSERT_EQ(grid.getSizeY(), 4u);  // up to 1.2 m
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      EXPECT_EQ(grid.getCell(column, row) < 0.25f, column < 2 && row < 2) << column << " " << row;
    }
  }
}

TEST(Export, WritesGridmapsOfAllShippedMaps) {
  const auto folder = emptyFolder();
  for (const std::string map : {"office.map", "lab.yaml", "opho2_1.gridmap.gz"}) {
    exportWorld("maps/" + map + " " + quoted(folder / (map + ".gridmap")));
    EXPECT_GT(gridmapIn(folder / (map + ".gridmap")).getSizeX(), 10u) << map;
  }
}

TEST(Export, WritesAnOctoMapForItsTools) {
  const auto folder = emptyFolder();
  exportWorld("worlds/opho2_1.xml --resolution 0.1 '" + (folder / "a.bt").string() + "' '" +
              (folder / "a.ot").string() + "'");
  const ToolRun converted = runTool("convert_octree a.bt from_bt.ot", folder);
  EXPECT_EQ(converted.exit_code, 0) << converted.output;
  const ToolRun compared = runTool("compare_octrees a.ot from_bt.ot", folder);
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_NE(compared.output.find("KLD: 0\n"), std::string::npos) << compared.output;
  // 1,491 cells of the grid are occupied, up to 1 m; bt2vrml counts eight merged voxels as one.
  const ToolRun boxes = runTool("bt2vrml a.bt", folder);
  EXPECT_EQ(boxes.exit_code, 0) << boxes.output;
  std::smatch voxels;
  ASSERT_TRUE(std::regex_search(boxes.output, voxels, std::regex("Finished writing ([0-9]+) voxels"))) << boxes.output;
  EXPECT_GT(std::stoi(voxels[1]), 1491);
  EXPECT_LE(std::stoi(voxels[1]), 1491 * 10);
}

TEST(Export, WritesASceneOfMrptClasses) {
  const auto folder = emptyFolder();
  exportWorld("worlds/opho2_1.xml '" + (folder / "maze.3Dscene").string() + "'");
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile((folder / "maze.3Dscene").string()));
  const LoadedWorld loaded = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml", {});
  for (const auto& object : loaded.world.objects) {
    const auto drawn = scene.getByName(object.name);
    ASSERT_TRUE(drawn) << object.name;
    const auto box = drawn->getBoundingBox();
    EXPECT_NEAR((box.min.x + box.max.x) / 2, object.body.world_from_body.x, 1e-5) << object.name;
    EXPECT_NEAR((box.min.y + box.max.y) / 2, object.body.world_from_body.y, 1e-5) << object.name;
    EXPECT_NEAR(box.max.z, object.body.heights().z_max_m, 1e-5) << object.name;
  }
  for (const auto& robot : loaded.fleet.robots) {
    const auto drawn = scene.getByName(robot.info.name);
    ASSERT_TRUE(drawn) << robot.info.name;
    EXPECT_NEAR(drawn->getPose().x, robot.world_from_start.x, 1e-9);
    EXPECT_NEAR(drawn->getPose().y, robot.world_from_start.y, 1e-9);
    EXPECT_NEAR(drawn->getPose().yaw, robot.world_from_start.phi, toRadians(1e-5));
  }
}

TEST(Export, WritesASceneForSceneViewer3D) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "hall.xml") << R"(<world><surface>
    <size><xmin>-4</xmin><xmax>4</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><primitive><cube><name>Box</name><x>0</x><y>0</y><z>1</z><length>4</length><width>4</width>
      <height>2</height><color>0 0 1</color></cube></primitive></shape></object></surface></world>)";
  exportWorld("'" + (folder / "hall.xml").string() + "' '" + (folder / "hall.3Dscene").string() + "'");
  const Screen screen;
  StartedProgram viewer = startStockWindow("SceneViewer3D", folder / "hall.3Dscene");
  const auto dark_blues_in = [](const cv::Mat& seen) { return pixelsBetween(seen, {61, 0, 0}, {255, 19, 19}); };
  EXPECT_GE(screen.waitForPixels(4000, dark_blues_in, viewer), 4000) << viewer.error();
}

TEST(Export, WritesAPlanToScale) {
  const auto folder = emptyFolder();
  exportWorld("worlds/lab_map.xml '" + (folder / "plan.svg").string() + "' '" + (folder / "plan.pdf").string() + "'");
  const PlanView view = planView(loadWorld(ROBOSIM_SOURCE_DIR "/worlds/lab_map.xml", {}).world, {});
  for (const char* command : {"rsvg-convert plan.svg -o plan.png", "pdftoppm -r 96 -png -singlefile plan.pdf plan"}) {
    const ToolRun drawn = runTool(command, folder);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
    const cv::Mat picture = cv::imread((folder / "plan.png").string());
    ASSERT_EQ(picture.size(), cv::Size(view.width(), view.height()));
    const auto at = [&](double x, double y) {
      const auto pixel = view.toPixel({x, y});
      return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
    };
    const cv::Vec3b wall(94, 117, 140), floor(255, 255, 255), gold(26, 204, 255), crate(153, 102, 51);
    const auto expect = [&](double x, double y, const cv::Vec3b& color, const char* what) {
      // Cairo and poppler round half a level of a colour in different directions.
      EXPECT_LE(cv::norm(at(x, y), color, cv::NORM_INF), 1) << what << " by " << command;
    };
    expect(0.05, 2.7, wall, "a wall");
    expect(2.4, 7.9, wall, "a round table of the map");
    expect(6.72, 2.42, wall, "a slanting bench of the map");
    expect(2.3, 4.1, floor, "a door");
    expect(12.9, 1.9, gold, "the gold");
    expect(5.6, 5.4, crate, "the crate");
    expect(5.6 + 0.28 * std::cos(0.4), 5.4 + 0.28 * std::sin(0.4), crate, "the crate, turned as in the world");
    expect(5.6 + 0.35 * std::cos(0.4), 5.4 + 0.35 * std::sin(0.4), floor, "beside the crate");
  }
}

TEST(Export, ReportsErrorsAndLeavesFilesUnchanged) {
  const auto folder = emptyFolder();
  const std::string in = "'" + folder.string() + "/";
  std::ofstream(folder / "old.gridmap") << "as it was";
  const struct {
    std::string arguments, complaint;
  } cases[] = {
      {"", "WORLD is required"},
      {"worlds/opho2_1.xml", "OUT is required"},
      {"worlds/none.xml " + in + "old.gridmap'", "worlds/none.xml: no such file; check the path"},
      {"worlds/opho2_1.xml " + in + "a.jpg'",
       "unknown format; use a name that ends in one of: .gridmap, .gridmap.gz, .yaml, .png, .bt, .ot, "
       ".3Dscene, "
       ".svg, .pdf"},
      {"worlds/opho2_1.xml " + in + "old.gridmap' " + in + "none/a.svg'", "none/a.svg: cannot be created: the folder "},
      {"worlds/opho2_1.xml " + in + "old.gridmap' --resolution 0.001",
       "cells of 0.001 m make a grid of 20200 × 20200; a map may have 67108864 at most, so make them larger"},
      {"worlds/opho2_1.xml " + in + "old.gridmap' --resolution nan", "--resolution: nan: must be a number"},
      {"worlds/opho2_1.xml " + in + "old.gridmap' --heights 2 1", "--heights 2 1: the first must be below the second"},
      {"worlds/opho2_1.xml " + in + "old.gridmap' --heights 2", "--heights"},
      {"maps/lab.yaml maps/lab.yaml", "is both WORLD and OUT; name two files"},
      {"maps/lab.yaml maps/lab.png", "is both WORLD and companion file of maps/lab.png; name two files"},
  };
  for (const auto& [arguments, complaint] : cases) {
    const Ended ended = runProgram("export " + arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_NE(ended.err.find(complaint), std::string::npos) << arguments << "\n" << ended.err;
  }
  // The disk is full when the second of two files is written: neither is renamed.
  const Ended full = runCommand("trap '' XFSZ; ulimit -f 40; '" ROBOSIM_PROGRAM "' export worlds/opho2_1.xml " + in +
                                "a.gridmap.gz' " + in + "old.gridmap'");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.err.find("old.gridmap: cannot be written (File too large); choose another place"), std::string::npos)
      << full.err;
  EXPECT_TRUE(textOf(folder / "old.gridmap") == "as it was");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  EXPECT_FALSE(fs::exists(ROBOSIM_SOURCE_DIR "/maps/lab.png"));
}

TEST(PfLocalization, FindsADriftingRobotOnAnExportedGridmap) {
  const auto folder = emptyFolder();
  const Ended run = runProgram("run tests/data/localization.xml --seed 8 --time 40 --record '" +
                               (folder / "run.rawlog").string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  exportWorld("tests/data/localization.xml '" + (folder / "lab.gridmap").string() + "'");
  // Debian 13's rawlog-edit (MRPT 2.14) writes all observations, whatever --keep-label says.
  const Ended kept =
      runProgram("replay '" + (folder / "run.rawlog").string() + "' --sensor laser --sensor odometry --output '" +
                 (folder / "scans.rawlog").string() + "'");
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  const Ended path = runProgram("replay '" + (folder / "run.rawlog").string() + "' --ground-truth '" +
                                (folder / "truth.txt").string() + "'");
  ASSERT_EQ(path.exit_code, 0) << path.err;
  const ToolRun localized =
      runTool("pf-localization '" ROBOSIM_SOURCE_DIR "/doc/examples/slam/pf-localization.ini'", folder);
  ASSERT_EQ(localized.exit_code, 0) << localized.output;

  TPose2D start, end, odom_from_end;
  bool is_first = true;
  forEachObservation(folder / "run.rawlog", [&](const mrpt::obs::CObservation::Ptr& observation) {
    if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get())) {
      end = TPose2D(truth->pose.mean.asTPose());
      if (is_first) start = end;
      is_first = false;
    }
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get())) {
      odom_from_end = odometry->odometry.asTPose();
    }
  });
  const TPose2D odometry_pose = start + odom_from_end;
  const double odometry_off_m = std::hypot(odometry_pose.x - end.x, odometry_pose.y - end.y);

  // The last of its estimates: "PDF estimation: (9.337,5.323,170.86deg), …".
  const auto at = localized.output.rfind("PDF estimation: (");
  ASSERT_NE(at, std::string::npos) << localized.output;
  double x = 0, y = 0;
  ASSERT_EQ(std::sscanf(localized.output.c_str() + at, "PDF estimation: (%lf,%lf", &x, &y), 2);
  const double off_m = std::hypot(x - end.x, y - end.y);
  std::printf("pf-localization ends %.3f m from the truth, where the wheels are %.3f m off\n", off_m, odometry_off_m);
  EXPECT_GT(odometry_off_m, 1) << "or the wheels alone would do";
  EXPECT_LT(off_m, 0.2);

  // Its own evaluation uses the same ground truth.
  const auto truth_at = localized.output.rfind("Ground truth: (");
  ASSERT_NE(truth_at, std::string::npos) << localized.output;
  ASSERT_EQ(std::sscanf(localized.output.c_str() + truth_at, "Ground truth: (%lf,%lf", &x, &y), 2);
  EXPECT_NEAR(x, end.x, 0.001);
  EXPECT_NEAR(y, end.y, 0.001);
  std::istringstream errors(textOf(folder / "log_000_0005000" / "GT_error.txt"));
  double last_error_m = 1;
  for (double error_m = 0; errors >> error_m;) last_error_m = error_m;
  EXPECT_LT(last_error_m, 0.2);
}

TEST(Export, ReportsAnEmptyWorldFileAsAWorld) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "empty.xml").flush();
  const Ended ended = runProgram("export " + quoted(folder / "empty.xml") + " " + quoted(folder / "plan.svg"));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("empty.xml:1: "), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("rawlog"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace robosim
