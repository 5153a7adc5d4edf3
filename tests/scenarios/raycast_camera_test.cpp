// Robots with cameras of the model raycast: runs without OpenGL, recordings, and programs.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <nlohmann/json.hpp>

#include "client/network_hardware.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Two robots that wander among boxes, with a colour and depth camera and a blob finder.
fs::path writeRaycastWorld(const fs::path& folder) {
  std::ofstream file(folder / "raycast_world.xml");
  file << R"(<world><surface><size><xmin>-4</xmin><xmax>4</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><primitive><cylinder><name>Gold</name><x>2</x><y>0.3</y><z>0.15</z><radius>0.1</radius>
      <height>0.3</height><color>1 0.8 0.1</color><hot>20</hot></cylinder></primitive></shape></object>)";
  for (const char* name : {"Ann", "Bob"}) {
    file << "<object><shape><robot><model>pioneer3dx</model><name>" << name << "</name><x>0</x><y>"
         << (name[0] == 'A' ? 0 : 2) << R"(</y><sensors>
      <camera model="raycast" layers="rgb depth identity" width_px="48" height_px="32" x_m="0.3" z_m="0.3" rate_hz="5"/>
      <blob_finder><color name="gold" rgb="1 0.8 0.1"/></blob_finder></sensors></robot></shape></object>)";
  }
  file << "</surface></world>";
  return folder / "raycast_world.xml";
}

/// On a machine where EGL finds no driver.
Ended withoutOpenGl(const std::string& arguments) {
  return runCommand("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent/driver.json '" ROBOSIM_PROGRAM "' " + arguments);
}

TEST(RaycastCameras, RunWithoutOpenGlAndHaveTheSameDigestOnAnyNumberOfThreads) {
  const std::string run = "run " + quoted(writeRaycastWorld(emptyFolder())) + " --controller wander --time 5 --json";
  const Ended one = withoutOpenGl(run), two = withoutOpenGl(run + " --threads 2");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(json::parse(one.out)["digest"], json::parse(two.out)["digest"]);
}

TEST(RaycastCameras, AreRecordedAndRepeated) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  const Ended run = withoutOpenGl("run " + quoted(writeRaycastWorld(folder)) +
                                  " --controller wander --time 3 --record " + quoted(rawlog));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  int pictures = 0;
  forEachObservation(rawlog, [&](const mrpt::obs::CObservation::Ptr& observation) {
    if (observation->sensorLabel != "Ann/camera") return;
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*observation);
    EXPECT_TRUE(scan.hasRangeImage && scan.hasIntensityImage);
    EXPECT_EQ(scan.intensityImage.getWidth(), 48u);
    ++pictures;
  });
  EXPECT_EQ(pictures, 16) << "one at the start, and one in every second step";
  const Ended check = withoutOpenGl("replay --check " + quoted(folder / "raycast_world.xml") + " " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("The same run: 30 steps"), std::string::npos) << check.out;
  // Pixels that differ are found: of another colour of the gold.
  const auto changed = folder / "changed.xml";
  std::string text = textOf(folder / "raycast_world.xml");
  text.replace(text.find("1 0.8 0.1"), 9, "1 0.7 0.1");
  std::ofstream(changed) << text;
  const Ended other = withoutOpenGl("replay " + quoted(rawlog) + " --check " + quoted(changed));
  EXPECT_NE(other.exit_code, 0);
  EXPECT_NE(other.out.find("camera, its picture"), std::string::npos) << other.out << other.err;
}

TEST(RaycastCameras, SendTheirPixelsToARobotInAnotherProcess) {
  ServedWorld::Options options;
  options.world = fs::relative(writeRaycastWorld(emptyFolder()), ROBOSIM_SOURCE_DIR).string();
  options.robots_elsewhere = true;
  options.last_step = 4;
  ServedWorld world(options);
  NetworkHardware robots(world.connectOptions(), {"Ann", "Bob"});
  const auto& sensors = *robots.robot(0).info().sensors;
  const auto camera = static_cast<std::size_t>(
      std::find_if(sensors.begin(), sensors.end(),
                   [](const SensorInfo& sensor) { return sensor.kind == SensorKind::camera; }) -
      sensors.begin());
  EXPECT_EQ(sensors.at(camera).camera.layers, (PictureLayers{true, true, true}));
  std::string taken;
  do {
    const auto& raw = std::get<Image>(robots.robot(0).readings().measurements[camera]).raw;
    taken += raw ? 'x' : '-';
    if (!raw) continue;
    EXPECT_EQ(raw->layers(), (PictureLayers{true, true, true}));
    EXPECT_EQ(raw->rgb.size(), 3u * 48 * 32);
  } while (robots.nextStep());
  EXPECT_EQ(taken, "x-x-x");
  world.wait();
}

}  // namespace
}  // namespace robosim
