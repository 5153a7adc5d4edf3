// Cameras of the model raycast in runs.
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"
#include "hardware/camera_head.h"
#include "sensors/raycast/picture.h"

namespace robosim {
namespace {

/// A focal length of 32 px, 0.25 m above the floor in the middle of a robot of 0.3 m.
constexpr const char* kEye =
    R"(<camera model="raycast" layers="rgb depth identity" width_px="64" height_px="64" field_of_view_deg="90" z_m="0.25")";

std::unique_ptr<Environment> eyesIn(World world, const std::string& sensors,
                                    const std::vector<mrpt::math::TPose2D>& starts, int threads = 1) {
  for (const auto& start : starts) {
    RobotPlacement& placement = world.robots.emplace_back();
    placement.name = "r" + std::to_string(world.robots.size());
    placement.model = "eye";
    placement.world_from_robot = start;
    placement.color = std::array<float, 3>{0, 1, 0};
  }
  const std::string type = R"(<robot name="eye" help="Sees."><body radius_m="0.2" height_m="0.3"/>
    <limits speed_max_mps="1" accel_mps2="9" decel_mps2="9" turn_max_degps="900" turn_accel_degps2="9000"/><sensors>)" +
                           sensors + "</sensors></robot>";
  ErrorList errors;
  Fleet fleet = buildFleet(world, "eyes.xml", {{"eye", {"eye.xml", type}}}, {}, errors);
  errors.throwIfAny();
  EnvironmentOptions options;
  options.threads = threads;
  return std::make_unique<Environment>(std::move(world), std::move(fleet), options);
}

/// An object whose front face is at x = 2 m, from y = -2 to 0 and from the floor to 2 m.
World worldBeforeEye(const std::array<float, 3>& color) {
  World world = emptyWorld(10);
  addWall(world, 2.5, -1, 1, 2);
  world.objects.back().body.height_m = 2;
  world.objects.back().body.center_z_m = 1;
  world.objects.back().body.color = color;
  return world;
}

const RawPicture& eyePicture(const Environment& environment, std::size_t robot = 0, std::size_t slot = 0) {
  return *std::get<Image>(environment.state().readings[robot].measurements[slot]).raw;
}
std::size_t pixelAt(std::size_t column, std::size_t row) { return 64 * row + column; }
Rgb eyeColor(const RawPicture& picture, std::size_t column, std::size_t row) {
  const std::uint8_t* pixel = &picture.rgb[3 * pixelAt(column, row)];
  return {pixel[0], pixel[1], pixel[2]};
}

TEST(RaycastCamera, ShowsARedBoxInTheRightColumns) {
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), std::string(kEye) + "/>", {{0, 0, 0}});
  const RawPicture& picture = eyePicture(*environment);
  ASSERT_EQ(picture.layers(), (PictureLayers{true, true, true}));
  // Its top is 1.75 m above the camera, 28 px at 2 m; its foot 0.25 m below, 4 px. Column 0 looks 63/64 m left at 1 m.
  for (std::size_t row = 0; row < 64; ++row) {
    for (std::size_t column = 0; column < 64; ++column) {
      const bool is_box = column >= 32 && row >= 4 && row < 36;
      ASSERT_EQ(picture.identity[pixelAt(column, row)], is_box     ? 0
                                                        : row < 32 ? RawPicture::kSky
                                                                   : RawPicture::kFloor)
          << column << ' ' << row;
      if (!is_box) continue;
      ASSERT_EQ(picture.depth_m[pixelAt(column, row)], 2);
      // The face towards -x has the cosine 0.385 to the sun, and a light of 0.7602 in red.
      ASSERT_EQ(eyeColor(picture, column, row), (Rgb{194, 0, 0}));
    }
  }
  EXPECT_EQ(picture.depth_m[pixelAt(10, 10)], 0) << "the sky";
  EXPECT_FLOAT_EQ(picture.depth_m[pixelAt(10, 40)], 0.25f * 32 / 8.5f) << "the floor";
}

TEST(RaycastCamera, ShowsRobotsAfterTheObjectsAndTheirLeds) {
  World world = emptyWorld(10);
  addWall(world, 8, 0, 0.2, 9);
  addBox(world, {5, 3, 0}, 0.2, 0.2);
  const auto environment = eyesIn(std::move(world), std::string(kEye) + "/>", {{0, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(eyePicture(*environment).identity[pixelAt(32, 32)], 3U) << "two objects, then the robots";
  EXPECT_EQ(eyeColor(eyePicture(*environment), 32, 32)[0], 0);
  environment->setCommand(1, {.led_color = 0x102030});
  environment->step();
  EXPECT_EQ(eyeColor(eyePicture(*environment), 32, 32), (Rgb{0x10, 0x20, 0x30})) << "glows";
  environment->setCommand(1, {});
  environment->step();
  EXPECT_EQ(eyeColor(eyePicture(*environment), 32, 32)[0], 0);
}

TEST(RaycastCamera, ShowsHotObjectsWithoutShades) {
  World world = worldBeforeEye({1, 0.8f, 0.2f});
  world.objects.back().body.heat_celsius = 30;
  const auto environment = eyesIn(std::move(world), std::string(kEye) + "/>", {{0, 0, 0}});
  EXPECT_EQ(eyeColor(eyePicture(*environment), 40, 20), (Rgb{255, 204, 51}));
}

TEST(RaycastCamera, ShowsWhatInterventionsChange) {
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), std::string(kEye) + "/>", {{0, 0, 0}});
  const auto apply = [&](const std::string& change) {
    EXPECT_EQ(environment->apply({"test", parseChange(change, "test")}), "");
    environment->step();
  };
  apply("<change name='wall0' color='0 0 1'/>");
  EXPECT_EQ(eyeColor(eyePicture(*environment), 40, 20)[0], 0);
  EXPECT_GT(eyeColor(eyePicture(*environment), 40, 20)[2], 150);
  apply("<remove name='wall0'/>");
  EXPECT_EQ(eyePicture(*environment).identity[pixelAt(40, 20)], RawPicture::kSky);
}

/// After ten steps.
std::string eyeDigest(const std::string& sensors, const std::array<float, 3>& color) {
  const auto environment = eyesIn(worldBeforeEye(color), sensors, {{0, 0, 0}});
  for (int i = 0; i < 10; ++i) environment->step();
  return environment->digest();
}

TEST(RaycastCamera, IsPartOfTheDigest) {
  const std::string raycast = std::string(kEye) + "/>", opengl = "<camera/>";
  EXPECT_EQ(eyeDigest(raycast, {1, 0, 0}), eyeDigest(raycast, {1, 0, 0}));
  EXPECT_NE(eyeDigest(raycast, {1, 0, 0}), eyeDigest(raycast, {0, 0, 1}));
  EXPECT_EQ(eyeDigest(opengl, {1, 0, 0}), eyeDigest(opengl, {0, 0, 1})) << "its pictures are no part of it";
}

TEST(RaycastCamera, HasTheSameDigestOnAnyNumberOfThreads) {
  const auto digest = [](int threads) {
    std::vector<mrpt::math::TPose2D> starts;
    for (int i = 0; i < 300; ++i) starts.push_back({i % 20 * 0.9 - 9, i / 20 * 0.9 - 9, 0.3 * i});
    World world = emptyWorld(10);
    const auto environment = eyesIn(
        std::move(world),
        R"(<camera model="raycast" layers="rgb depth identity" width_px="12" height_px="8" z_m="0.2" range_max_m="5">
             <noise std="4" exposure_std="0.1"/></camera>)",
        starts, threads);
    for (std::size_t i = 0; i < 300; ++i) environment->setCommand(i, {.speed_mps = 0.3, .turn_radps = 1});
    for (int i = 0; i < 5; ++i) environment->step();
    return environment->digest();
  };
  EXPECT_EQ(digest(1), digest(3));
}

TEST(RaycastCamera, TurnsAndZoomsWithItsHead) {
  // Panned by 30° to the right and zoomed twice, it shows what a fixed camera does that is mounted so.
  const std::string head = std::string(kEye) + R"(><ptz pan_degps="3000" zoom_per_s="900"/></camera>)";
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), head, {{0, 0, 0}});
  environment->setCommand(0, {.camera_head = CameraHeadCommand{{-M_PI / 6, 0, 2}}});
  environment->step();
  const CameraInfo zoomed_camera = zoomed({64, 64, M_PI / 2, 10}, 2);
  const auto fixed = eyesIn(
      worldBeforeEye({1, 0, 0}),
      "<camera model='raycast' layers='rgb depth identity' width_px='64' height_px='64' z_m='0.25' angle_deg='-30' "
      "field_of_view_deg='" +
          std::to_string(zoomed_camera.field_of_view_rad * 180 / M_PI) + "'/>",
      {{0, 0, 0}});
  EXPECT_EQ(eyePicture(*environment, 0, 1).identity, eyePicture(*fixed).identity);
}

TEST(RaycastCamera, IsSavedWithTheState) {
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), std::string(kEye) + "/>", {{0, 0, 0}});
  environment->step();
  const State& state = environment->state();
  const State read = stateFromBytes(*environment->model(), toBytes(*environment->model(), state));
  EXPECT_EQ(read.readings[0].measurements, state.readings[0].measurements);
}

TEST(RaycastCamera, RefusesAStateWithAPictureOfAnotherCamera) {
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), std::string(kEye) + "/>", {{0, 0, 0}});
  environment->step();
  const auto fault_with = [&](const Image& image) -> std::string {
    State state = environment->state();
    state.readings[0].measurements[0] = image;
    try {
      stateFromBytes(*environment->model(), toBytes(*environment->model(), state));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  RawPicture longer = eyePicture(*environment);
  longer.height_px = 128;
  longer.rgb.resize(2 * longer.rgb.size());
  longer.depth_m.resize(2 * longer.depth_m.size());
  longer.identity.resize(2 * longer.identity.size());
  EXPECT_EQ(fault_with({"", std::make_shared<const RawPicture>(longer)}),
            "the contents of a saved state are invalid: a picture of another size, range or other layers than its "
            "camera's; save the state again");
  EXPECT_EQ(fault_with({"\xFF\xD8\xFF\xD9"}),
            "the contents of a saved state are invalid: a picture of another model of camera; save the state again");
  EXPECT_EQ(fault_with({}), "none");
}

TEST(RaycastCamera, SharesAPictureWithCopiesOfTheStateAndThenTakesAnotherOne) {
  const auto environment = eyesIn(worldBeforeEye({1, 0, 0}), std::string(kEye) + "/>", {{0, 0, 0}});
  const State before = environment->state();
  const RawPicture then = eyePicture(*environment);
  environment->setCommand(0, {.turn_radps = 3});
  environment->step();
  EXPECT_EQ(*std::get<Image>(before.readings[0].measurements[0]).raw, then);
  EXPECT_NE(eyePicture(*environment), then);
}

}  // namespace
}  // namespace robosim
