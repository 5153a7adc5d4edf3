// Views and cameras show the objects as interventions have changed them.
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "rendering/offscreen_renderer.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"
#include "world/changed_objects.h"

namespace robosim {
namespace {

/// A square of 8 m with a red box in the middle.
World worldWithBox() {
  World world;
  world.bounds = {-4, 4, -4, 4};
  WorldObject box;
  box.name = "box";
  box.body = {Cube{1, 1}, {0, 0, 0}, 0.5, 1, {1, 0, 0}};
  world.objects = {box};
  return world;
}

/// Number of red pixels in the left and the right half of a picture.
std::pair<int, int> redPixels(const cv::Mat& picture) {
  std::pair<int, int> red{0, 0};
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto& pixel = picture.at<cv::Vec3b>(y, x);
      if (pixel[2] > 100 && pixel[1] < 60 && pixel[0] < 60) ++(2 * x < picture.cols ? red.first : red.second);
    }
  }
  return red;
}

const ChangedObjects kMoved(withChange(worldWithBox().objects, PlaceBody{"box", 2, 0}));
const ChangedObjects kRemoved(withChange(worldWithBox().objects, RemoveBody{"box"}));

TEST(ChangedObjectsView, IsThatOfTheTopView) {
  const World world = worldWithBox();
  const Fleet fleet;
  TopView view(world, fleet);
  const TopViewCamera camera = TopViewCamera::showing(world.bounds, 200, 200);
  const auto draw = [&](const ChangedObjects& objects) {
    RunSnapshot snapshot;
    snapshot.objects = objects;
    return redPixels(view.draw(snapshot, RunPaths(), camera, {}));
  };
  // The second picture of the same objects is of layers that are kept.
  for (int i = 0; i < 2; ++i) EXPECT_GT(draw({}).first, 100);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(draw(kMoved).first, 0);
    EXPECT_GT(draw(kMoved).second, 200);
  }
  EXPECT_EQ(draw(kRemoved), std::pair(0, 0));
  EXPECT_GT(draw({}).first, 100);
}

TEST(ChangedObjectsView, IsThatOfCameras) {
  const World world = worldWithBox();
  OffscreenRenderer renderer(world, Fleet());
  CameraInfo camera;
  camera.width_px = camera.height_px = 100;
  camera.field_of_view_rad = 1.2;
  const mrpt::math::TPose3D from_the_south(0, -6, 0.5, M_PI_2, 0, 0);
  const std::vector<mrpt::math::TPose2D> no_robots;
  const auto draw = [&](const ChangedObjects& objects) {
    return redPixels(renderer.picture(camera, from_the_south, {no_robots, objects}));
  };
  EXPECT_GT(draw({}).first, 30);
  EXPECT_EQ(draw(kMoved).first, 0);
  EXPECT_GT(draw(kMoved).second, 60);
  EXPECT_EQ(draw(kRemoved), std::pair(0, 0));
  EXPECT_GT(draw({}).first, 30);
}

}  // namespace
}  // namespace robosim
