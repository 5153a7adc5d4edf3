// Pictures of a run are rendered for the robots whose pictures something reads, counted by picture.
#include "run/selected_images.h"

#include <gtest/gtest.h>

#include "run/local_run.h"
#include "run/testing/counting_images.h"

namespace robosim {
namespace {

/// Three robots, each with a camera of 5 pictures per second: one in every second step of 0.1 s.
struct PicturesOnRequest : testing::Test {
  static LoadedWorld threeRobots() { return loadWorldToRun(worldOfCameras(3, 5), "still"); }
  static RunOptions onRequest() {
    RunOptions options;
    options.controller = "still";
    options.pictures_on_request = true;
    return options;
  }
  static const std::string& pictureOf(const LocalRun& run, std::size_t robot) {
    return std::get<Image>(run.environment().state().readings[robot].measurements[0]).jpeg;
  }
  const std::vector<int>& taken() const { return pictures.taken(); }

  CountedPictures pictures{3};
};

TEST_F(PicturesOnRequest, AreRenderedForTheSelectedRobotsOnly) {
  LocalRun run(threeRobots(), onRequest());
  EXPECT_EQ(taken(), (std::vector<int>{0, 0, 0}));
  run.selectPictures({0, 1, 0});
  for (int i = 0; i < 10; ++i) run.step();
  EXPECT_EQ(taken(), (std::vector<int>{0, 5, 0}));
  EXPECT_EQ(pictureOf(run, 1), CountedPictures::pictureOf(1));
  EXPECT_EQ(pictureOf(run, 2), "");
}

TEST_F(PicturesOnRequest, OfThePresentStepAreTakenOnceForARobotThatIsSelectedAfterIt) {
  LocalRun run(threeRobots(), onRequest());
  run.takePictures({1, 0, 1});
  run.takePictures({1, 0, 1});
  EXPECT_EQ(taken(), (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(pictureOf(run, 0), CountedPictures::pictureOf(0));
  EXPECT_EQ(pictureOf(run, 1), "");
  run.selectPictures({1, 0, 0});
  run.step();
  run.step();
  run.takePictures({1, 1, 0});
  EXPECT_EQ(taken(), (std::vector<int>{2, 1, 1})) << "robot 0 has taken its picture in the step";
  run.step();
  run.takePictures({1, 1, 1});
  EXPECT_EQ(taken(), (std::vector<int>{2, 1, 1})) << "no picture is due in this step";
}

TEST_F(PicturesOnRequest, DoNotChangeTheDigest) {
  LocalRun with(threeRobots(), onRequest()), without(threeRobots(), onRequest());
  with.takePictures({1, 1, 1});
  with.selectPictures({1, 1, 1});
  for (int i = 0; i < 4; ++i) {
    with.step();
    without.step();
  }
  EXPECT_EQ(with.environment().digest(), without.environment().digest());
}

}  // namespace
}  // namespace robosim
