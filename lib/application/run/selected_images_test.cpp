// Pictures of a run are rendered for the robots whose pictures something reads, counted by picture.
#include "run/selected_images.h"

#include <gtest/gtest.h>

#include "maze/controllers.h"
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

TEST_F(PicturesOnRequest, AreAlwaysRenderedForAControllerThatReadsThem) {
  class Looker final : public Controller {
   public:
    void step(Robot&) override {}
  };
  controllers().add(
      {.name = "looker",
       .help = "Looks.",
       .needs = {SensorKind::camera},
       .parameters = {},
       .make = [](const ControllerSetup&, const ParameterValues&) { return std::make_unique<Looker>(); }});
  WorldSource source = worldOfCameras(3, 5);
  for (const char* robot : {"R0", "R1", "R2"}) {
    const std::string name = "<name>" + std::string(robot) + "</name>";
    const std::string controller = robot == std::string("R1") ? "looker" : "still";
    source.text.insert(source.text.find(name), "<controller>" + controller + "</controller>");
  }
  RunOptions options;
  options.pictures_on_request = true;
  LocalRun run(loadWorldToRun(source, ""), options);
  EXPECT_EQ(taken(), (std::vector<int>{0, 1, 0})) << "before its first step";
  for (int i = 0; i < 10; ++i) run.step();
  EXPECT_EQ(taken(), (std::vector<int>{0, 6, 0}));
  run.selectPictures({0, 0, 1});
  for (int i = 0; i < 10; ++i) run.step();
  EXPECT_EQ(taken(), (std::vector<int>{0, 11, 5}));
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

/// Keeps the aims of the cameras whose pictures it should take.
struct AimImages final : ImageSource {
  explicit AimImages(std::vector<CameraAim>& the_aims) : aims(the_aims) {}
  void take(const CameraView& camera, const SeenWorld&, std::span<const std::uint32_t>,
            std::span<std::string>) override {
    aims = camera.aims;
  }
  std::vector<Blob> findBlobs(const std::string&, const std::vector<TargetColor>&, unsigned) override { return {}; }

  std::vector<CameraAim>& aims;
};

TEST(SelectedImages, AreTakenWithTheAimsOfTheirRobots) {
  std::vector<CameraAim> aims;
  SelectedImages images(std::make_unique<AimImages>(aims));
  images.selected = {0, 1, 0, 1};
  const CameraView camera{.info = {}, .robot_from_camera = {}, .aims = {{0.1}, {0.2}, {0.3}}};
  const std::vector<std::uint32_t> robots{1, 2, 3};
  std::vector<std::string> jpegs(3);
  images.take(camera, {}, robots, jpegs);
  EXPECT_EQ(aims, (std::vector<CameraAim>{{0.1}, {0.3}}));
}

}  // namespace
}  // namespace robosim
