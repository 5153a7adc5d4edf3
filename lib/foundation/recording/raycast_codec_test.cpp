#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>

#include "recording/testing/recorded_steps_test.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;

/// Of 6 × 4 pixels and a range of 8 m, at the pose of sampleCamera().
SensorInfo raycastCamera(const std::string& label, const PictureLayers& layers) {
  SensorInfo camera = sampleCamera();
  camera.label = label;
  camera.range_max_m = 8;
  camera.camera = {6, 4, M_PI / 2, 10};
  camera.camera.layers = layers;
  return camera;
}

/// A picture whose pixels all differ.
Image pictureOf(const SensorInfo& camera, std::uint64_t seed) {
  Rng rng(seed);
  RawPicture raw;
  raw.width_px = camera.camera.width_px;
  raw.height_px = camera.camera.height_px;
  raw.range_max_m = static_cast<float>(camera.range_max_m);
  for (std::size_t i = 0; i < raw.pixels(); ++i) {
    for (int channel = 0; channel < 3 && camera.camera.layers.rgb; ++channel) {
      raw.rgb.push_back(static_cast<std::uint8_t>(rng.below(256)));
    }
    if (camera.camera.layers.depth) raw.depth_m.push_back(i == 5 ? 0 : static_cast<float>(rng.uniform(0, 8)));
    if (camera.camera.layers.identity) raw.identity.push_back(i == 7 ? RawPicture::kSky : rng());
  }
  return {"", std::make_shared<const RawPicture>(std::move(raw))};
}

class RaycastRecordingTest : public TestFolder {
 protected:
  RaycastRecordingTest() {
    robot_.name = "a";
    robot_.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{
        plainSensor(SensorKind::odometry, "odometry"), raycastCamera("colors", {true, false, false}),
        raycastCamera("kinect", {true, true, true}), raycastCamera("depths", {false, true, false}), sampleCamera()});
    const std::vector<RobotInfo> robots{robot_};
    const std::vector<mrpt::math::TPose2D> truth{{1, 2, 3}};
    const std::vector<Command> commands(1);
    RawlogWriter writer(in("run.rawlog"), robots, RawlogFormat::observations, RawlogImages::embedded, "first note");
    for (std::uint64_t step = 0; step < 4; ++step) {
      Readings readings = sampleReadings(robot_, step);
      for (std::size_t slot = 1; slot <= 3; ++slot) {
        readings.measurements[slot] = pictureOf((*robot_.sensors)[slot], 10 * step + slot);
      }
      written_.push_back(readings);
      writer.write(std::vector{readings}, truth, commands);
    }
    writer.close("last note");
  }

  RobotInfo robot_;
  std::vector<Readings> written_;
};

TEST_F(RaycastRecordingTest, KeepsEveryBitOfEveryLayer) {
  for (const Pictures pictures : {Pictures::keep, Pictures::leave_out}) {
    RawlogReader reader(in("run.rawlog"));
    RecordedSteps steps(reader, {robot_}, 0.1, pictures);
    for (const Readings& written : written_) {
      const auto read = steps.next();
      ASSERT_TRUE(read);
      for (std::size_t slot = 1; slot <= 3; ++slot) {
        EXPECT_EQ((*read)[0].readings.measurements[slot], written.measurements[slot]) << slot;
      }
    }
    EXPECT_FALSE(reader.isDamaged());
  }
}

/// The first observations of each label, as MRPT itself reads them.
std::map<std::string, mrpt::obs::CObservation::Ptr> readByMrpt(const std::filesystem::path& file) {
  mrpt::obs::CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(file.string()));
  std::map<std::string, mrpt::obs::CObservation::Ptr> first;
  for (std::size_t i = 0; i < rawlog.size(); ++i) {
    if (rawlog.getType(i) != mrpt::obs::CRawlog::etObservation) continue;
    const auto observation = rawlog.getAsObservation(i);
    first.emplace(observation->sensorLabel, observation);
  }
  return first;
}

TEST_F(RaycastRecordingTest, IsReadByStockMrpt) {
  const auto observations = readByMrpt(in("run.rawlog"));
  const auto colors = std::dynamic_pointer_cast<CObservationImage>(observations.at("a/colors"));
  ASSERT_TRUE(colors);
  const RawPicture& seen = *std::get<Image>(written_[0].measurements[1]).raw;
  ASSERT_EQ(colors->image.getWidth(), 6u);
  for (unsigned channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(*colors->image(5, 3, 2 - channel), seen.rgb[3 * 23 + channel]) << "MRPT's colours begin with blue";
  }
  EXPECT_NEAR(colors->cameraParams.fx(), 3, 1e-12);

  const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observations.at("a/kinect"));
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->hasRangeImage && scan->hasIntensityImage && scan->range_is_depth);
  EXPECT_EQ(scan->maxRange, 8);
  const RawPicture& raw = *std::get<Image>(written_[0].measurements[2]).raw;
  EXPECT_EQ(*scan->intensityImage(5, 3, 2), raw.rgb[3 * 23]);
  for (std::size_t i = 0; i < raw.pixels(); ++i) {
    EXPECT_NEAR(scan->rangeImage(static_cast<int>(i / 6), static_cast<int>(i % 6)) * scan->rangeUnits, raw.depth_m[i],
                8 / 65000.0);
  }
  // Points lie along the camera's x axis by their depth, in the robot's frame.
  mrpt::obs::T3DPointsProjectionParams projection;
  projection.takeIntoAccountSensorPoseOnRobot = false;
  scan->unprojectInto(*scan, projection);
  ASSERT_EQ(scan->points3D_x.size(), raw.pixels() - 1) << "one pixel has nothing within range";
  EXPECT_NEAR(scan->points3D_x[0], raw.depth_m[0], 8 / 65000.0);
  EXPECT_NEAR(scan->sensorPose.x(), 0.15, 1e-9);

  const auto depths = std::dynamic_pointer_cast<CObservation3DRangeScan>(observations.at("a/depths"));
  ASSERT_TRUE(depths);
  EXPECT_TRUE(depths->hasRangeImage && !depths->hasIntensityImage);
  const auto jpeg = std::dynamic_pointer_cast<CObservationImage>(observations.at("a/camera"));
  ASSERT_TRUE(jpeg);
  EXPECT_EQ(jpeg->image.getWidth(), 48u) << "a camera of the other model beside them";
}

TEST_F(RaycastRecordingTest, RefusesPicturesOfAnotherCamera) {
  auto sensors = *robot_.sensors;
  sensors[2].camera.width_px = 7;
  robot_.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  RawlogReader reader(in("run.rawlog"));
  RecordedSteps steps(reader, {robot_}, 0.1);
  EXPECT_EQ(
      refusal(steps),
      "recorded observation \"a/kinect\" (mrpt::obs::CObservation3DRangeScan) is not of the camera \"kinect\": it "
      "has no picture of the camera's size; give the robots that the recording was made with");
}

}  // namespace
}  // namespace robosim
