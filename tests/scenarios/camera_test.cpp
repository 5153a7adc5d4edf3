// Robots with cameras, in local runs, over the network and in recordings.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/angle_units.h"
#include "client/network_hardware.h"
#include "client/viewer.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Ann faces along x; 2 m ahead and 0.3 m to the left of her is the gold, 0.2 m across and 0.3 m high. Bob is behind
/// her.
fs::path writeTestWorld(const fs::path& folder) {
  std::ofstream(folder / "camera_world.xml") << R"(<world><surface>
    <size><xmin>-4</xmin><xmax>4</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><primitive><cylinder><name>Gold</name><x>2</x><y>0.3</y><z>0.15</z><radius>0.1</radius>
      <height>0.3</height><color>1 0.8 0.1</color><hot>20</hot></cylinder></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Bob</name><x>-2</x><y>0</y></robot></shape></object>
  </surface></world>)";
  return folder / "camera_world.xml";
}

std::string bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Index of a robot's camera among its sensors.
std::size_t cameraOf(const ServedWorld& world, std::size_t robot) {
  const auto& measurements = world.state().readings[robot].measurements;
  return static_cast<std::size_t>(std::find_if(measurements.begin(), measurements.end(),
                                               [](const Measurement& m) { return std::holds_alternative<Image>(m); }) -
                                  measurements.begin());
}

// The camera of a pioneer3dx_camera is 0.12 m ahead of the centre; its picture of 320 pixels covers 48°.
const double kFocal_px = 160 / std::tan(toRadians(24));
const double kGoldColumn = 160 - kFocal_px * 0.3 / 1.88;

TEST(Camera, RecordsPicturesAtItsRate) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.rawlog";
  const Ended run =
      runProgram("run " + quoted(writeTestWorld(folder)) + " --controller still --time 10 --record " + quoted(rawlog));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, int> count;
  forEachObservation(rawlog, [&](const mrpt::obs::CObservation::Ptr& observation) {
    ++count[observation->sensorLabel];
    if (observation->sensorLabel == "Ann/camera") {
      const auto& seen = dynamic_cast<const mrpt::obs::CObservationImage&>(*observation);
      EXPECT_EQ(seen.image.getWidth(), 320u);
      EXPECT_EQ(seen.image.getHeight(), 240u);
      // Gold has much more red than blue, unlike the background to its left. Its centre is 0.17 m below the camera,
      // which is pitched down by 8°.
      const auto column = static_cast<unsigned>(kGoldColumn);
      const auto row = static_cast<unsigned>(120 + kFocal_px * std::tan(std::atan(0.17 / 1.88) - toRadians(8)));
      EXPECT_GT(*seen.image(column, row, 2) - *seen.image(column, row, 0), 80);
      EXPECT_LT(*seen.image(column - 30, row, 2) - *seen.image(column - 30, row, 0), 40);
    }
    if (observation->sensorLabel == "Ann/blob_finder") {
      const auto& blob = dynamic_cast<const mrpt::obs::CObservationRawDAQ&>(*observation).AIN_double;
      ASSERT_EQ(blob.size(), 7u);
      EXPECT_NEAR(blob[1], kGoldColumn, 2) << "its middle";
      EXPECT_NEAR(blob[5], kFocal_px * 0.2 / 1.88, 4) << "its width";
    }
    if (observation->sensorLabel == "Bob/blob_finder") {
      const auto& blob = dynamic_cast<const mrpt::obs::CObservationRawDAQ&>(*observation).AIN_double;
      EXPECT_LT(blob.at(5), kFocal_px * 0.2 / 1.88) << "Bob is further away";
    }
  });
  // 5 pictures per second: one at the start, and one in every second step.
  for (const char* label : {"Ann/camera", "Ann/blob_finder", "Bob/camera", "Bob/blob_finder"}) {
    EXPECT_EQ(count[label], 51) << label;
  }
  EXPECT_EQ(count["Ann/sonar"], 101);
  const std::string printed = runProgram("replay --print --sensor blob_finder " + quoted(rawlog)).out;
  EXPECT_EQ(countOf("/blob_finder  gold ", printed), 2 * 51) << printed;
}

TEST(Camera, WritesExternalPicturesThatRawlogEditLists) {
  const auto folder = emptyFolder();
  const Ended run = runProgram("run " + quoted(writeTestWorld(folder)) + " --controller still --time 1 --record " +
                               quoted(folder / "run.rawlog") + " --record-images external");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const cv::Mat picture = cv::imread((folder / "run_Images" / "Bob_camera_00000010.jpg").string());
  EXPECT_EQ(picture.size(), cv::Size(320, 240));
  const ToolRun listed = runTool("rawlog-edit -i run.rawlog --list-images --text-file-output list.txt", folder);
  EXPECT_EQ(listed.exit_code, 0) << listed.output;
  const std::string list = textOf(folder / "list.txt");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2 * 6);
  EXPECT_NE(list.find("Ann_camera_00000008.jpg"), std::string::npos) << list;
}

TEST(Camera, IsDeterministicForAnyNumberOfThreads) {
  const auto folder = emptyFolder();
  const auto world_file = writeTestWorld(folder);
  std::vector<std::string> digests, recordings;
  for (const char* threads : {"1", "1", "2"}) {
    const auto rawlog = folder / "run.rawlog";
    const Ended run = runProgram("run " + quoted(world_file) + " --controller wander --time 20 --json --threads " +
                                 threads + " --record " + quoted(rawlog));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    digests.push_back(json::parse(run.out)["digest"]);
    recordings.push_back(bytesOf(rawlog));
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
  EXPECT_TRUE(recordings[0] == recordings[1]) << "on one machine pictures are the same, byte for byte";
  EXPECT_TRUE(recordings[0] == recordings[2]);
}

TEST(Camera, SendsPicturesToARobotInAnotherProcess) {
  ServedWorld::Options options;
  options.world = fs::relative(writeTestWorld(emptyFolder()), ROBOSIM_SOURCE_DIR).string();
  options.robots_elsewhere = true;
  options.last_step = 4;
  ServedWorld world(options);
  NetworkHardware robots(world.connectOptions(), {"Ann", "Bob"});
  const auto& sensors = *robots.robot(0).info().sensors;
  const auto slot_of = [&](SensorKind kind) {
    const auto found =
        std::find_if(sensors.begin(), sensors.end(), [&](const SensorInfo& s) { return s.kind == kind; });
    return static_cast<std::size_t>(found - sensors.begin());
  };
  const std::size_t camera = slot_of(SensorKind::camera), finder = slot_of(SensorKind::blob_finder);
  EXPECT_EQ(sensors.at(camera).camera.width_px, 320u);
  EXPECT_EQ(sensors.at(finder).colors, std::vector<std::string>{"gold"});
  std::string taken;
  do {
    const auto& measurements = robots.robot(0).readings().measurements;
    const std::string& jpeg = std::get<Image>(measurements[camera]).jpeg;
    const Blobs& blobs = std::get<Blobs>(measurements[finder]);
    EXPECT_EQ(blobs.taken, !jpeg.empty());
    taken += jpeg.empty() ? '-' : 'x';
    if (jpeg.empty()) continue;
    EXPECT_EQ(cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR).size(), cv::Size(320, 240));
    EXPECT_NEAR(blobs.of_color.at(0).x_px, kGoldColumn, 2);
  } while (robots.nextStep());
  EXPECT_EQ(taken, "x-x-x");
  world.wait();
}

TEST(Camera, TakesPicturesInTheEnvironmentWithGeometryWorkers) {
  const auto world_file = writeTestWorld(emptyFolder());
  const std::string wander = "--controller wander --time 5 --json";
  const auto alone = json::parse(runProgram("run " + quoted(world_file) + " " + wander).out)["digest"];
  Serving serving({"--controller", "wander", "--time", "5", "--json", "--speed", "max"}, world_file.string());
  const auto worker = startWorker(serving.address());
  const auto summary = json::parse(serving.program().wait().out);
  EXPECT_EQ(summary["digest"], alone);
}

/// Runs the program on a machine where EGL finds no driver.
Ended withoutDriver(const std::string& arguments) {
  return runCommand("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent/driver.json '" ROBOSIM_PROGRAM "' " + arguments);
}

TEST(Camera, WithoutADriverNamesThePackagesToInstall) {
  const auto folder = emptyFolder();
  const auto world_file = writeTestWorld(folder);
  const Ended run = withoutDriver("run " + quoted(world_file) + " --time 1 --record " + quoted(folder / "r.rawlog"));
  EXPECT_NE(run.exit_code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("cameras need OpenGL, and this machine has none ("), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("apt-get install libegl1 libgl1-mesa-dri. Worlds without cameras need none"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(countOf("\n", run.err), 1u) << run.err;
}

TEST(Camera, IsNotRequiredForWorldsWithoutCamerasNorForCheck) {
  EXPECT_EQ(withoutDriver("run worlds/small_maze.xml --time 1").exit_code, 0);
  const Ended check = withoutDriver("check " + quoted(writeTestWorld(emptyFolder())));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("camera blob_finder"), std::string::npos) << check.out;
}

TEST(Camera, SendsViewersOnlyPicturesRequestedWhenTaken) {
  const auto folder = emptyFolder();
  ServedWorld::Options options = paused();
  options.world = fs::relative(writeTestWorld(folder), ROBOSIM_SOURCE_DIR);
  options.controller = "still";
  ServedWorld world(options);
  const ReadingsSelection ann{.of_all = false, .of = {0}}, no_robots;
  Viewer viewer(world.connectOptions(), ann);
  const std::size_t camera = cameraOf(world, 0);
  EXPECT_EQ(viewer.run().pictureStep(0, camera), 0u);
  viewer.select(no_robots);
  ASSERT_TRUE(viewer.waitForFrame());
  Panel panel(world);
  panel.step(101);  // one picture every second step: the last at step 100
  viewer.select(ann);
  ASSERT_TRUE(viewer.waitForFrame());
  EXPECT_EQ(viewer.run().snapshot.step, 101u);
  EXPECT_TRUE(std::get<Image>(viewer.run().readingsOf(0)->measurements[camera]).jpeg.empty());
  EXPECT_EQ(viewer.run().pictureStep(0, camera), std::nullopt);
  panel.step(1);
  ASSERT_TRUE(viewer.waitForFrame());
  EXPECT_EQ(viewer.run().pictureStep(0, camera), 102u);
}

}  // namespace
}  // namespace robosim
