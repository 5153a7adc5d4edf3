#include "sensors/blob_finder.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

const cv::Scalar kGold(26, 204, 255), kDarkGold(10, 80, 100), kRed(20, 20, 200), kRosy(70, 20, 200), kBlue(200, 60, 20);

/// A grey picture with rectangles, as a JPEG file.
struct Painting {
  cv::Mat picture{240, 320, CV_8UC3, cv::Scalar(140, 140, 140)};

  Painting& with(const cv::Rect& where, const cv::Scalar& color) {
    cv::rectangle(picture, where, color, cv::FILLED);
    return *this;
  }
  std::string jpeg(int quality = 90) const {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    return {bytes.begin(), bytes.end()};
  }
};

TargetColor gold() { return {.name = "gold", .hue_rad = 47 * M_PI / 180}; }
TargetColor red() { return {.name = "red", .hue_rad = 0}; }

Blob only(const std::string& jpeg, const TargetColor& color, unsigned pixels_min = 4) {
  const auto blobs = findBlobs(jpeg, {color}, pixels_min);
  EXPECT_EQ(blobs.size(), 1u);
  return blobs.at(0);
}

/// Tolerance for JPEG, which blurs colours along edges by a pixel or two.
void expectAt(const Blob& blob, const cv::Rect& where) {
  EXPECT_NEAR(blob.left_px, where.x, 2);
  EXPECT_NEAR(blob.top_px, where.y, 2);
  EXPECT_NEAR(blob.width_px, where.width, 3);
  EXPECT_NEAR(blob.height_px, where.height, 3);
  EXPECT_NEAR(blob.x_px, where.x + (where.width - 1) / 2.0, 1);
  EXPECT_NEAR(blob.y_px, where.y + (where.height - 1) / 2.0, 1);
  EXPECT_NEAR(blob.pixels, where.area(), 0.1 * where.area() + 8);
}

TEST(BlobFinder, FindsABlobAndItsPosition) {
  const cv::Rect where(100, 60, 40, 90);
  const Blob blob = only(Painting().with(where, kGold).jpeg(), gold());
  EXPECT_EQ(blob.color, "gold");
  expectAt(blob, where);
}

TEST(BlobFinder, FindsAColourInTheShade) {
  const cv::Rect where(100, 60, 40, 90);
  expectAt(only(Painting().with(where, kDarkGold).jpeg(), gold()), where);
}

TEST(BlobFinder, ReportsTheLargestBlob) {
  const cv::Rect large(200, 100, 50, 50);
  expectAt(only(Painting().with({20, 20, 30, 30}, kGold).with(large, kGold).jpeg(), gold()), large);
}

TEST(BlobFinder, FindsEachColourAmongOthers) {
  const cv::Rect golden(20, 20, 60, 60), reddish(150, 90, 80, 40);
  const auto blobs = findBlobs(
      Painting().with(golden, kGold).with(reddish, kRed).with({240, 180, 60, 40}, kBlue).jpeg(), {red(), gold()}, 4);
  ASSERT_EQ(blobs.size(), 2u);
  expectAt(blobs[0], reddish);
  expectAt(blobs[1], golden);
}

TEST(BlobFinder, FindsRedOnBothSidesOfHueZero) {
  const cv::Rect where(100, 60, 60, 60);
  expectAt(only(Painting().with(where, kRosy).jpeg(), red()), where);                    // a hue of −17°
  expectAt(only(Painting().with(where, cv::Scalar(20, 60, 200)).jpeg(), red()), where);  // of +13°
}

TEST(BlobFinder, ReportsAnEmptyBlobForAGreyPicture) {
  EXPECT_EQ(only(Painting().jpeg(), gold()), Blob{.color = "gold"});
}

TEST(BlobFinder, IgnoresSmallBlobs) {
  const std::string jpeg = Painting().with({100, 60, 5, 5}, kGold).jpeg(100);
  EXPECT_GT(only(jpeg, gold(), 4).pixels, 10u);
  EXPECT_EQ(only(jpeg, gold(), 100).pixels, 0u);
}

TEST(BlobFinder, FindsNothingInInvalidPictures) {
  EXPECT_EQ(only("", gold()).pixels, 0u);
  EXPECT_EQ(only("\xFF\xD8 no picture \xFF\xD9", gold()).pixels, 0u);
}

/// A camera that always returns the same picture.
class OnePicture : public ImageSource {
 public:
  explicit OnePicture(std::string jpeg) : jpeg_(std::move(jpeg)) {}
  void take(const CameraView&, std::span<const mrpt::math::TPose2D>, std::span<const std::uint32_t>,
            std::span<std::string> jpegs) override {
    for (auto& jpeg : jpegs) jpeg = jpeg_;
  }

 private:
  std::string jpeg_;
};

/// Two cameras and a blob finder on one of them, in the order of `xml`; returns the last sensor's measurements over
/// some steps.
class Mounted {
 public:
  explicit Mounted(const std::vector<std::string>& xml) {
    for (const auto& element : xml) {
      sensors_.push_back(sensorFrom(element, {1, 0.2, 0.3, sensors_}));
      readings_.resize(1);
      readings_[0].measurements.push_back(sensors_.back()->blank());
    }
  }
  Blobs sense(std::uint64_t step, ImageSource& images) {
    const Scene scene({}, 1, {-1, 1, -1, 1});
    const mrpt::math::TPose2D pose;
    const std::uint32_t robot = 0;
    const Snapshot now{.scene = scene,
                       .heat_sources = {},
                       .world_from_robot = {&pose, 1},
                       .frames = {},
                       .last_motion = {},
                       .laser_pan_rad = {},
                       .time = {step, 0.1},
                       .images = &images};
    for (std::size_t slot = 0; slot < sensors_.size(); ++slot) sensors_[slot]->sense(now, {&robot, 1}, slot, readings_);
    return std::get<Blobs>(readings_[0].measurements.back());
  }
  const SensorInfo& info() const { return sensors_.back()->info(); }

 private:
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<Readings> readings_;
};

const std::string kFinder = "<blob_finder camera='left'><color name='gold' rgb='1 0.8 0.1'/></blob_finder>";

TEST(BlobFinder, UsesTheCameraWithTheGivenLabel) {
  Mounted mounted({"<camera label='left' width_px='100' rate_hz='5'/>", "<camera label='right'/>", kFinder});
  EXPECT_EQ(mounted.info().camera.width_px, 100u);
  EXPECT_EQ(mounted.info().colors, std::vector<std::string>{"gold"});
  OnePicture images(Painting().with({100, 60, 40, 90}, kGold).jpeg());
  const Blobs seen = mounted.sense(2, images);
  EXPECT_TRUE(seen.taken);
  ASSERT_EQ(seen.of_color.size(), 1u);
  expectAt(seen.of_color[0], {100, 60, 40, 90});
  // Its camera takes a picture every second step; the other camera's pictures are ignored.
  EXPECT_EQ(mounted.sense(3, images), (Blobs{false, {{.color = "gold"}}}));
}

TEST(BlobFinder, UsesTheLastCameraBeforeItByDefault) {
  Mounted mounted({"<camera width_px='100'/>", "<camera width_px='200'/>",
                   "<blob_finder><color name='gold' rgb='1 0.8 0.1'/></blob_finder>"});
  EXPECT_EQ(mounted.info().camera.width_px, 200u);
}

std::string errorOf(const std::string& xml) {
  const std::vector<std::shared_ptr<const Sensor>> mounted{sensorFrom("<camera/>")};
  try {
    sensorFrom(xml, {1, 0.2, 0.3, mounted});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(BlobFinder, RejectsInvalidColoursAndCameras) {
  EXPECT_EQ(errorOf("<blob_finder><color name='gold' rgb='1 0.8 0.1'/></blob_finder>"), "none");
  EXPECT_EQ(
      errorOf(kFinder),
      "sensor.xml:1: <blob_finder camera=\"left\">: is not the label of a camera that is mounted before it; mount "
      "one, or fix the label");
  EXPECT_EQ(errorOf("<blob_finder/>"),
            "sensor.xml:1: <blob_finder>: has 0 colours; give 1 to 32, such as <color name=\"gold\" rgb=\"1 0.8 "
            "0.1\"/>");
  EXPECT_EQ(errorOf("<blob_finder><color name='grey' rgb='0.5 0.5 0.5'/></blob_finder>"),
            "sensor.xml:1: <color rgb=\"0.5 0.5 0.5\">: is a grey, which has no hue; give a colour");
  EXPECT_EQ(errorOf("<blob_finder><color name='gold'/></blob_finder>"),
            "sensor.xml:1: <color>: <rgb> is missing; add red, green and blue, such as rgb=\"1 0.8 0.1\"");
  EXPECT_EQ(errorOf("<blob_finder><color name='a' rgb='1 0 0'/><color name='a' rgb='0 1 0'/></blob_finder>"),
            "sensor.xml:1: <color name=\"a\">: is taken by another colour; change one");
}

TEST(BlobFinder, CannotBeMountedWithoutACamera) {
  try {
    sensorFrom("<blob_finder><color name='gold' rgb='1 0.8 0.1'/></blob_finder>");
    FAIL() << "a blob finder without a camera";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "sensor.xml:1: <blob_finder>: has no camera; mount one before it");
  }
}

}  // namespace
}  // namespace robosim
