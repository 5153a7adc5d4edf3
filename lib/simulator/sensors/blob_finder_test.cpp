#include "sensors/blob_finder.h"

#include <gtest/gtest.h>

#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// ImageSource whose pictures contain their camera's width, which is also the width of the blobs found in them.
class WidthImages : public ImageSource {
 public:
  void take(const CameraView& camera, const SeenWorld&, std::span<const std::uint32_t>,
            std::span<std::string> jpegs) override {
    for (auto& jpeg : jpegs) jpeg = std::to_string(camera.info.width_px);
  }
  std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors,
                              unsigned pixels_min) override {
    std::vector<Blob> blobs;
    for (const auto& color : colors) {
      blobs.push_back({.color = color.name, .pixels = pixels_min});
      blobs.back().width_px = static_cast<std::uint32_t>(std::stoul(jpeg));
    }
    return blobs;
  }
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
  WidthImages images;
  const Blobs seen = mounted.sense(2, images);
  EXPECT_TRUE(seen.taken);
  ASSERT_EQ(seen.of_color.size(), 1u);
  EXPECT_EQ(seen.of_color[0], (Blob{.color = "gold", .pixels = 4, .width_px = 100}));
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
  EXPECT_EQ(errorOf(kFinder),
            "sensor.xml:1: <blob_finder camera=\"left\">: is not the label of a camera with colours that is mounted "
            "before it; mount one, or fix the label");
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
    EXPECT_STREQ(error.what(), "sensor.xml:1: <blob_finder>: has no camera with colours; mount one before it");
  }
}

}  // namespace
}  // namespace robosim
