#include "rendering/plan.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "robots/robot_colors.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

using PlanFile = TestFolder;

WorldObject object(const std::string& name, std::variant<Cylinder, Cube> shape, const TPose2D& pose,
                   const std::array<float, 3>& color, double heat_celsius = 0) {
  WorldObject object;
  object.name = name;
  object.body = {shape, pose, 0.5, 1, color, heat_celsius};
  return object;
}

/// 10 m × 5 m: a blue wall, a green cylinder, gold, and two robots.
struct Scene10x5 {
  World world;
  Fleet fleet;
  std::vector<std::vector<TPoint2D>> paths{{{1.5, 1.25}, {4.5, 1.25}}, {{6.5, 4.25}, {6.5, 4.25}}};
  std::vector<std::optional<TPose2D>> world_from_robot{TPose2D(4.5, 1.25, 0), TPose2D(6.5, 4.25, std::numbers::pi / 2)};

  Scene10x5() {
    world.name = "scene";
    world.bounds = {0, 10, 0, 5};
    world.objects = {object("wall", Cube{4, 0.5}, {3, 3.5, 0}, {0, 0, 1}),
                     object("post", Cylinder{0.4}, {8.5, 1.5, 0}, {0, 0.6f, 0}),
                     object("gold", Cylinder{0.3}, {8.5, 3.5, 0}, {1, 1, 0}, 20)};
    for (const char* name : {"Ann", "Bob"}) {
      FleetRobot robot;
      robot.info.name = name;
      robot.info.radius_m = 0.3;
      robot.color = paletteColor(fleet.robots.size());
      fleet.robots.push_back(robot);
    }
  }

  /// Draws to the file, and reads it back.
  cv::Mat draw(const fs::path& file) const {
    writePlan(file, world, fleet, run());
    return cv::imread(file.string());
  }
  DrawnRun run() const { return {.paths = paths, .world_from_robot = world_from_robot}; }
  PlanView view() const { return planView(world, {.paths = paths}); }
  cv::Vec3b at(const cv::Mat& picture, const TPoint2D& place) const {
    const auto pixel = view().toPixel(place);
    return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
  }
};

void expectColor(const cv::Vec3b& bgr, int red, int green, int blue) {
  EXPECT_NEAR(bgr[2], red, 3) << bgr;
  EXPECT_NEAR(bgr[1], green, 3) << bgr;
  EXPECT_NEAR(bgr[0], blue, 3) << bgr;
}

bool light(const cv::Vec3b& bgr) { return bgr[0] > 220 && bgr[1] > 220 && bgr[2] > 220; }
bool colorful(const cv::Vec3b& bgr) {
  return std::max({bgr[0], bgr[1], bgr[2]}) - std::min({bgr[0], bgr[1], bgr[2]}) > 80;
}

TEST_F(PlanFile, MatchesTheSizeOfItsView) {
  const cv::Mat picture = Scene10x5().draw(folder_ / "plan.png");
  EXPECT_EQ(picture.cols, 1200);
  EXPECT_EQ(picture.rows, 676);
}

TEST_F(PlanFile, DrawsMapsWithoutSeamsBetweenCells) {
  Scene10x5 scene;
  WorldMap map;
  map.color = {1, 0, 0};
  map.world_from_map = {0.3, 0.3, 0};
  map.plan.columns = map.plan.rows = 2;
  map.plan.cell_m = 0.4;
  map.plan.occupied = {{0, 0, 1, 1}, {1, 0, 1, 1}, {0, 1, 1, 1}};
  map.plan.boxes = {{{5, 2.2, 0}, 4, 0.002}};
  scene.world.maps = {map};
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  for (double x = 0.35; x < 1.05; x += 0.01) expectColor(scene.at(picture, {x, 0.5}), 255, 0, 0);
  for (double y = 0.35; y < 1.05; y += 0.01) expectColor(scene.at(picture, {0.5, y}), 255, 0, 0);
  EXPECT_TRUE(light(scene.at(picture, {0.95, 0.95})));
  EXPECT_TRUE(colorful(scene.at(picture, {5.3, 2.5}))) << "a wall of 2 mm is visible";
}

TEST_F(PlanFile, DrawsObjectsInTheirColoursAtTheirPositions) {
  const Scene10x5 scene;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  expectColor(scene.at(picture, {3, 3.5}), 0, 0, 255);
  expectColor(scene.at(picture, {1.05, 3.3}), 0, 0, 255);  // 5 cm inside its western and southern face
  EXPECT_TRUE(light(scene.at(picture, {0.95, 3.3})));      // 5 cm outside
  EXPECT_TRUE(light(scene.at(picture, {1.05, 3.2})));
  expectColor(scene.at(picture, {8.5, 1.5}), 0, 153, 0);
  EXPECT_TRUE(light(scene.at(picture, {8.5 - 0.38, 1.5 - 0.38})));  // a corner that a square would have
}

TEST_F(PlanFile, RotatesBoxesLikeTheWorld) {
  Scene10x5 scene;
  scene.world.objects[0].body.world_from_body.phi = std::numbers::pi / 6;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  const double along_x = 1.8 * std::cos(std::numbers::pi / 6), along_y = 1.8 * std::sin(std::numbers::pi / 6);
  expectColor(scene.at(picture, {3 + along_x, 3.5 + along_y}), 0, 0, 255);
  EXPECT_TRUE(light(scene.at(picture, {3 + along_x, 3.5 - along_y})));
}

TEST_F(PlanFile, DrawsTheHigherOfTwoObjects) {
  Scene10x5 scene;
  scene.world.objects.push_back(object("rug", Cube{6, 2}, {3, 3.5, 0}, {1, 0, 0}));
  scene.world.objects.back().body.height_m = 0.1;
  scene.world.objects.back().body.center_z_m = 0.05;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  expectColor(scene.at(picture, {3, 3.5}), 0, 0, 255);
  expectColor(scene.at(picture, {3, 2.75}), 255, 0, 0);
}

TEST_F(PlanFile, DrawsAGlowAroundHotObjectsOnly) {
  const Scene10x5 scene;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  const auto by_gold = scene.at(picture, {8.5 + 0.36, 3.5}), by_post = scene.at(picture, {8.5 + 0.46, 1.5});
  EXPECT_GT(by_gold[2] - by_gold[0], 60) << by_gold;  // more red than blue
  EXPECT_TRUE(light(by_post)) << by_post;
}

TEST_F(PlanFile, DrawsEachRobotAndItsPathInADistinctColour) {
  const Scene10x5 scene;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  const auto ann = scene.at(picture, {4.5 - 0.15, 1.25}), bob = scene.at(picture, {6.5, 4.25 - 0.15});  // behind
  EXPECT_TRUE(colorful(ann)) << ann;
  EXPECT_TRUE(colorful(bob)) << bob;
  EXPECT_GT(cv::norm(ann, bob), 80);
  const auto path = scene.at(picture, {3.25, 1.25});
  EXPECT_TRUE(colorful(path)) << path;
  EXPECT_LT(cv::norm(path, ann), 40) << path << ann;
  EXPECT_TRUE(light(scene.at(picture, {3.25, 1.35})));  // next to the path
}

TEST_F(PlanFile, MarksStartsAndHeadings) {
  const Scene10x5 scene;
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  EXPECT_TRUE(light(scene.at(picture, {1.5, 1.25})));         // the middle of the start ring
  EXPECT_TRUE(light(scene.at(picture, {4.5 + 0.15, 1.25})));  // Ann faces east
  EXPECT_TRUE(light(scene.at(picture, {6.5, 4.25 + 0.15})));  // Bob faces north
  EXPECT_TRUE(colorful(scene.at(picture, {4.5, 1.25 + 0.15})));
}

TEST_F(PlanFile, FadesPathsThatWouldCoverMuchOfTheFloor) {
  Scene10x5 scene;
  for (int i = 0; i < 400; ++i) scene.paths[0].push_back({i % 2 ? 1.5 : 4.5, 1.25});
  const auto path = scene.at(scene.draw(folder_ / "plan.png"), {3.25, 1.25});
  EXPECT_TRUE(path[0] > 180 && path[1] > 180 && path[2] > 180) << path;
  EXPECT_FALSE(light(path)) << path;
}

TEST_F(PlanFile, WritesEachRobotsNameBesideItsDisc) {
  Scene10x5 scene;
  const cv::Mat named = scene.draw(folder_ / "named.png");
  for (auto& robot : scene.fleet.robots) robot.info.name.clear();
  cv::Mat difference;
  cv::absdiff(named, scene.draw(folder_ / "nameless.png"), difference);
  for (const auto& pose : scene.world_from_robot) {
    const auto pixel = scene.view().toPixel({pose->x, pose->y});
    const cv::Point center(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    const cv::Rect disc(center - cv::Point(24, 24), cv::Size(48, 48)),
        near(center - cv::Point(90, 60), cv::Size(180, 120));
    EXPECT_EQ(cv::norm(difference(disc)), 0);
    EXPECT_GT(cv::norm(difference(near)), 0);
  }
}

TEST_F(PlanFile, DrawsObjectsOutsideTheBounds) {
  Scene10x5 scene;
  scene.paths[0].push_back({12, 1.25});
  scene.world_from_robot[0] = TPose2D(12, 1.25, 0);
  const cv::Mat picture = scene.draw(folder_ / "plan.png");
  EXPECT_EQ(picture.cols, 1200);
  EXPECT_TRUE(colorful(scene.at(picture, {11, 1.25})));
}

TEST_F(PlanFile, DrawsAnEmptyWorldAndARunWithoutPaths) {
  Scene10x5 scene;
  scene.paths.clear();
  EXPECT_TRUE(colorful(scene.at(scene.draw(folder_ / "no_paths.png"), {4.35, 1.25})));
  World empty;
  empty.bounds = {0, 1, 0, 1};
  writePlan(folder_ / "empty.png", empty, {}, {});
  EXPECT_FALSE(cv::imread((folder_ / "empty.png").string()).empty());
}

TEST_F(PlanFile, AcceptsItsEndingInUpperCase) { EXPECT_EQ(Scene10x5().draw(folder_ / "PLAN.PNG").cols, 1200); }

TEST_F(PlanFile, IsCompact) {
  Scene10x5().draw(folder_ / "plan.png");
  EXPECT_LT(fs::file_size(folder_ / "plan.png"), 60'000u);
}

TEST_F(PlanFile, IsDeterministic) {
  const auto bytes = [&](const char* name) {
    Scene10x5().draw(folder_ / name);
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
}

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(PlanFile, IsWrittenInTheFormatOfItsName) {
  const auto beginning = [&](const char* name) {
    const Scene10x5 scene;
    writePlan(folder_ / name, scene.world, scene.fleet, scene.run());
    std::string text(5, ' ');
    std::ifstream(folder_ / name).read(text.data(), 5);
    return text;
  };
  EXPECT_EQ(beginning("a.svg"), "<?xml");
  EXPECT_EQ(beginning("a.PDF"), "%PDF-");
  EXPECT_EQ(beginning("a.png").substr(1, 3), "PNG");
}

TEST_F(PlanFile, RejectsInvalidNamesBeforeAndAfterARun) {
  fs::create_directory(folder_ / "folder.png");
  struct Case {
    fs::path file;
    std::string what;
  };
  const Case cases[] = {
      {folder_ / "plan.jpg", ": a picture is a PNG, SVG or PDF file; give it a name that ends in .png, .svg or .pdf"},
      {folder_ / "folder.png", ": is a folder; name a file in it"},
      {folder_ / "none" / "plan.png", ": cannot be created: the folder " + (folder_ / "none").string() +
                                          " does not exist; create it, or choose another"}};
  const Scene10x5 scene;
  for (const Case& c : cases) {
    EXPECT_EQ(errorOf([&] { checkPlanFile(c.file); }), c.file.string() + c.what);
    EXPECT_EQ(errorOf([&] { scene.draw(c.file); }), c.file.string() + c.what);
  }
}

TEST_F(PlanFile, IsNotChangedByTheCheck) {
  std::ofstream(folder_ / "plan.png") << "as it was";
  checkPlanFile(folder_ / "plan.png");
  checkPlanFile(folder_ / "new.png");
  std::string text;
  std::getline(std::ifstream(folder_ / "plan.png"), text);
  EXPECT_EQ(text, "as it was");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(PlanFile, LeavesNoPartialFileOnAFullDisk) {
  const FileSizeLimit full(10);
  EXPECT_EQ(errorOf([&] { Scene10x5().draw(folder_ / "plan.png"); }),
            (folder_ / "plan.png").string() + ": cannot be written (File too large); choose another place");
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace robosim
