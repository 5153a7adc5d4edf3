#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sensors/blob_finder.h"
#include "sensors/blob_regions.h"
#include "sensors/camera.h"
#include "sensors/camera_head.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

std::string raycastFault(const std::string& xml) {
  try {
    sensorFrom(xml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(RaycastSensor, ReportsItsLayersAndRange) {
  const auto camera = sensorFrom("<camera model='raycast' layers='depth rgb' range_max_m='7'/>");
  const SensorInfo& info = camera->info();
  EXPECT_EQ(info.kind, SensorKind::camera);
  EXPECT_EQ(info.camera.layers, (PictureLayers{true, true, false}));
  EXPECT_EQ(info.camera.layers, (PictureLayers{.rgb = true, .depth = true}));
  EXPECT_EQ(info.range_max_m, 7);
  EXPECT_EQ(sensorFrom("<camera model='raycast'/>")->info().camera.layers, (PictureLayers{true, false, false}));
  EXPECT_FALSE(sensorFrom("<camera/>")->info().camera.isRaycast());
}

TEST(RaycastSensor, ReachesToTheCornersOfItsPictureAtItsRange) {
  // Focal length 32 px: the corner is 31.5 px aside and 23.5 px above the axis.
  const auto camera = sensorFrom(
      "<camera model='raycast' x_m='0.3' y_m='0.4' width_px='64' height_px='48' field_of_view_deg='90' "
      "range_max_m='2'/>");
  EXPECT_NEAR(camera->robotReach(1), 2 * std::sqrt(1 + (31.5 * 31.5 + 23.5 * 23.5) / (32 * 32)) + 0.5, 1e-12);
}

TEST(RaycastSensor, TakesPicturesAtItsRate) {
  const auto camera = sensorFrom("<camera model='raycast' width_px='4' height_px='4' rate_hz='2.5'/>");
  SingleRobotScene robot({});
  std::string taken;
  for (int step = 1; step <= 9; ++step) taken += std::get<Image>(robot.sense(*camera)).isEmpty() ? '-' : 'x';
  EXPECT_EQ(taken, "---x---x-");
}

/// A camera that faces a block, which fills its picture, with the default colour of 128.
std::vector<std::uint8_t> raycastColorsWith(const std::string& noise, std::uint64_t seed = 1) {
  const auto camera = sensorFrom(
      "<camera model='raycast' width_px='50' height_px='40' field_of_view_deg='20' z_m='0.5'>" + noise + "</camera>");
  SingleRobotScene robot({block(2, 0, 1, 9, 0, 5)});
  robot.seed = seed;
  return std::get<Image>(robot.sense(*camera)).raw->rgb;
}

TEST(RaycastSensor, HasErrorsOfExposureAndNoise) {
  const auto exact = raycastColorsWith("");
  const std::uint8_t red = exact[0];
  EXPECT_EQ(red, 97) << "128 · 0.7602";
  EXPECT_EQ(raycastColorsWith("<noise exposure='0.5'/>")[0], 49);
  const auto noisy = raycastColorsWith("<noise std='6'/>");
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    const double error = noisy[i] - exact[i];
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(noisy.size());
  EXPECT_NEAR(sum / count, 0, 0.3);
  EXPECT_NEAR(std::sqrt(squares / count), 6, 0.3);
  EXPECT_EQ(raycastColorsWith("<noise std='6'/>"), noisy);
  EXPECT_NE(raycastColorsWith("<noise std='6'/>", 2), noisy);
  EXPECT_TRUE(sensorFrom("<camera model='raycast'><noise std='6'/></camera>")->isNoisy());
}

TEST(RaycastSensor, RefusesSettingsOfTheOtherModel) {
  EXPECT_EQ(raycastFault("<camera layers='depth'/>"),
            "sensor.xml:1: <camera layers=\"depth\">: is only of model=\"raycast\"; drop it, or change the model");
  EXPECT_EQ(raycastFault("<camera range_max_m='3'/>"),
            "sensor.xml:1: <camera range_max_m=\"3\">: is only of model=\"raycast\"; drop it, or change the model");
  EXPECT_EQ(raycastFault("<camera model='raycast' antialias='1'/>"),
            "sensor.xml:1: <camera antialias=\"1\">: is only of model=\"opengl\"; drop it, or change the model");
  EXPECT_EQ(raycastFault("<camera model='raycast' jpeg_quality='80'/>"),
            "sensor.xml:1: <camera jpeg_quality=\"80\">: is only of model=\"opengl\"; drop it, or change the model");
  EXPECT_EQ(raycastFault("<camera model='raycast'><noise rolling_shutter_s='0.1'/></camera>"),
            "sensor.xml:1: <camera>: has a rolling_shutter_s in its <noise>, which is only of model=\"opengl\"; drop "
            "it, or change the model");
}

TEST(RaycastSensor, RefusesImpossibleSettings) {
  EXPECT_EQ(raycastFault("<camera model='pinhole'/>"),
            "sensor.xml:1: <camera model=\"pinhole\">: is unknown; accepted are: opengl, raycast");
  for (const char* layers : {"rgb rgb", "rgb heat"}) {
    EXPECT_EQ(raycastFault("<camera model='raycast' layers='" + std::string(layers) + "'/>"),
              "sensor.xml:1: <camera layers=\"" + std::string(layers) +
                  "\">: must be some of the words rgb, depth and identity, each once; drop it for the default, rgb");
  }
  EXPECT_EQ(raycastFault("<camera model='raycast' range_max_m='0'/>"),
            "sensor.xml:1: <camera range_max_m=\"0\">: must lie in (0, 1000] metres; drop it for the default, 20");
  EXPECT_EQ(raycastFault("<camera model='raycast' width_px='2048' height_px='1024'/>"),
            "sensor.xml:1: <camera>: has 2097152 pixels; a ray-cast picture may have 1048576, so make it smaller");
  EXPECT_EQ(raycastFault("<camera model='raycast' layers='depth'><noise std='2'/></camera>"),
            "sensor.xml:1: <camera>: has errors of colours in its <noise>, but no layer rgb; add it to layers, or drop "
            "them");
}

TEST(RaycastSensor, RefusesMorePixelsThanARobotMayHave) {
  std::vector<std::shared_ptr<const Sensor>> mounted;
  for (int i = 0; i < 4; ++i) {
    mounted.push_back(sensorFrom("<camera model='raycast' width_px='1024' height_px='1024'/>", {1, 0.2, 0.3, mounted}));
  }
  try {
    sensorFrom("<camera model='raycast' width_px='1' height_px='1'/>", {1, 0.2, 0.3, mounted});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "sensor.xml:1: <camera>: has 1 pixels, and the ray-cast cameras before it 4194304; a robot may have "
                 "4194304 in all, so use fewer");
  }
  EXPECT_FALSE(sensorFrom("<camera/>", {1, 0.2, 0.3, mounted})->info().camera.isRaycast());
}

TEST(RaycastSensor, AndItsHeadAndBlobFinderKeepTheReachOfTheirRobotsFinite) {
  std::vector<std::shared_ptr<const Sensor>> mounted{sensorFrom("<camera model='raycast' range_max_m='2'/>")};
  EXPECT_TRUE(std::isfinite(mounted[0]->robotReach(1)));
  const auto finder =
      sensorFrom("<blob_finder><color name='gold' rgb='1 0.8 0.1'/></blob_finder>", {1, 0.2, 0.3, mounted});
  EXPECT_EQ(finder->robotReach(1), 0);
  EXPECT_EQ(makeCameraHead({})->robotReach(1), 0);
}

/// A picture of columns × rows in which characters are pixels: 'r' red, 'g' a golden orange, others gray.
RawPicture pictureOfRows(const std::vector<std::string>& rows) {
  RawPicture picture;
  picture.width_px = static_cast<std::uint32_t>(rows[0].size());
  picture.height_px = static_cast<std::uint32_t>(rows.size());
  for (const auto& row : rows) {
    for (const char pixel : row) {
      const Rgb rgb = pixel == 'r' ? Rgb{200, 20, 10} : pixel == 'g' ? Rgb{255, 204, 25} : Rgb{90, 90, 90};
      picture.rgb.insert(picture.rgb.end(), rgb.begin(), rgb.end());
    }
  }
  return picture;
}

const TargetColor kRedTarget{"red", 0}, kGoldTarget{"gold", 0.8};

TEST(BlobRegions, FindTheLargestRegionThatTouchesAtSidesOrCorners) {
  const RawPicture picture = pictureOfRows({"r.r..r",  //
                                            ".r...r",  //
                                            "r.r..r",  //
                                            "...gg.",  //
                                            "...gg."});
  const auto blobs = findBlobs(picture, {kRedTarget, kGoldTarget}, 1);
  // The cross of five pixels about (1, 1), and the square of four about (3.5, 3.5).
  EXPECT_EQ(blobs[0], (Blob{"red", 5, 1, 1, 0, 0, 3, 3}));
  EXPECT_EQ(blobs[1], (Blob{"gold", 4, 3.5f, 3.5f, 3, 3, 2, 2}));
}

TEST(BlobRegions, JoinBranchesThatMeetFartherDown) {
  const RawPicture picture = pictureOfRows({"r.r.r",  //
                                            "r.r.r",  //
                                            "rrr.r",  //
                                            "....r",  //
                                            "rrrrr"});
  EXPECT_EQ(findBlobs(picture, {kRedTarget}, 1)[0].pixels, 9U) << "the right one, along the bottom";
}

TEST(BlobRegions, IgnoreSmallOnesAndPicturesWithoutColours) {
  const RawPicture picture = pictureOfRows({"rr.", "..."});
  EXPECT_EQ(findBlobs(picture, {kRedTarget}, 2)[0].pixels, 2U);
  EXPECT_EQ(findBlobs(picture, {kRedTarget}, 3)[0], (Blob{.color = "red"}));
  RawPicture depths;
  depths.width_px = depths.height_px = 1;
  depths.depth_m = {1};
  EXPECT_EQ(findBlobs(depths, {kRedTarget}, 1)[0], (Blob{.color = "red"}));
}

TEST(BlobFinder, SearchesThePicturesOfARaycastCamera) {
  const auto camera = std::shared_ptr<const Sensor>(
      sensorFrom("<camera model='raycast' width_px='64' height_px='64' field_of_view_deg='90' z_m='0.5'/>"));
  EXPECT_EQ(raycastFault("<blob_finder><color name='red' rgb='1 0 0'/></blob_finder>"),
            "sensor.xml:1: <blob_finder>: has no camera with colours; mount one before it");
  const std::shared_ptr<const Sensor> depths = sensorFrom("<camera model='raycast' layers='depth'/>");
  EXPECT_THROW(sensorFrom("<blob_finder><color name='red' rgb='1 0 0'/></blob_finder>", {.mounted = {&depths, 1}}),
               ConfigError);
  const auto finder =
      sensorFrom("<blob_finder><color name='red' rgb='1 0 0'/></blob_finder>", {.mounted = {&camera, 1}});
  EXPECT_EQ(finder->slotRead(), 0U);
  EXPECT_TRUE(finder->info().camera.isRaycast());
}

}  // namespace
}  // namespace robosim
