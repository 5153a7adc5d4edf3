// A served run renders the pictures that a viewer, a recording or a controller asks for, counted by picture.
#include <atomic>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "client/network_hardware.h"
#include "client/viewer.h"
#include "rendering/offscreen_renderer.h"
#include "run/testing/counting_images.h"
#include "server/environment_server.h"
#include "serving/world_run.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// Ten robots with cameras of a picture per step, served by this process.
class ServedCameras {
 public:
  static constexpr std::size_t kRobots = 10;

  /// @param has_robots_elsewhere whether other processes drive the robots; otherwise they stand still
  explicit ServedCameras(bool has_robots_elsewhere, const std::string& record = "", bool is_paused = false)
      : run_(optionsOf(has_robots_elsewhere, record)) {
    ServerOptions options;
    options.listen = ListenAddresses::parse("127.0.0.1:0");
    options.is_paused = is_paused;
    options.step_deadline = std::chrono::minutes(10);  // no robot is disconnected on slow machines
    server_ = std::make_unique<EnvironmentServer>(options, run_.runInfo());
    thread_ = std::thread([this] { server_->serve(run_, [this] { return must_end_.load(); }); });
  }
  ~ServedCameras() { end(); }

  /// Ends the run, or waits for its end by itself.
  void end(bool by_itself = false) {
    must_end_ = !by_itself;
    if (thread_.joinable()) thread_.join();
  }
  ConnectOptions connectOptions() const {
    ConnectOptions options;
    options.address = "127.0.0.1:" + std::to_string(server_->ports().front());
    return options;
  }
  /// Number of pictures, by robot. After end().
  const std::vector<int>& taken() const { return pictures_.taken(); }
  std::uint64_t steps() { return run_.environment().time().step; }

 private:
  static WorldRunOptions optionsOf(bool has_robots_elsewhere, const std::string& record) {
    const auto folder = emptyFolder();
    const WorldSource source = worldOfCameras(kRobots, 10);
    std::filesystem::create_directory(folder / "robots");
    std::ofstream(folder / "robots" / "eye.xml") << source.robot_types.at("eye").text.value();
    std::ofstream(folder / "w.xml") << source.text;
    WorldRunOptions options;
    options.of_run.world = (folder / "w.xml").string();
    options.of_run.time_s = has_robots_elsewhere ? 1000 : 2;
    options.of_run.run.controller = has_robots_elsewhere ? "" : "still";
    options.of_run.record = record;
    options.of_run.json = true;
    options.wait_for_robots = has_robots_elsewhere;
    return options;
  }

  CountedPictures pictures_{kRobots, makeOffscreenRenderer};
  std::atomic<bool> must_end_ = false;
  WorldRun run_;
  std::unique_ptr<EnvironmentServer> server_;
  std::thread thread_;
};

std::vector<std::string> namesOfAll() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < ServedCameras::kRobots; ++i) names.push_back("R" + std::to_string(i));
  return names;
}

const std::string& pictureOf(NetworkHardware& robots, std::size_t i) {
  return std::get<Image>(robots.robot(i).readings().measurements[0]).jpeg;
}

TEST(RequestedPictures, OfTenRobotsAreThoseOfTheOneThatItsProcessShowsAtEachStep) {
  ServedCameras served(true);
  constexpr int steps_after = 20;
  {
    NetworkHardware robots(served.connectOptions(), namesOfAll());
    for (std::size_t i = 0; i < ServedCameras::kRobots; ++i) {
      EXPECT_EQ(pictureOf(robots, i), CountedPictures::pictureOf(i)) << "in the first step";
      robots.setPictures(i, i == 3);
    }
    for (int step = 0; step < steps_after; ++step) {
      ASSERT_TRUE(robots.nextStep());
      for (std::size_t i = 0; i < ServedCameras::kRobots; ++i) {
        EXPECT_EQ(pictureOf(robots, i), i == 3 ? CountedPictures::pictureOf(3) : "") << step;
      }
    }
  }
  served.end();
  std::vector<int> expected(ServedCameras::kRobots, 1);
  expected[3] += steps_after;
  EXPECT_EQ(served.taken(), expected);
}

TEST(RequestedPictures, OfARobotThatAProcessDrivesAreInAllItsReadings) {
  ServedCameras served(true);
  const std::vector<std::string> names = namesOfAll();
  NetworkHardware robots(served.connectOptions(), names);
  for (int step = 0; step < 5; ++step) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_EQ(pictureOf(robots, i), CountedPictures::pictureOf(i));
    }
    ASSERT_TRUE(robots.nextStep());
  }
}

TEST(RequestedPictures, AreNoneForARunWithoutViewers) {
  ServedCameras served(false);
  served.end(true);
  EXPECT_EQ(served.steps(), 20u);
  EXPECT_EQ(served.taken(), std::vector<int>(ServedCameras::kRobots, 0));
}

TEST(RequestedPictures, OfAPausedRunAreThoseOfTheRobotThatAViewerSelects) {
  ServedCameras served(false, "", true);
  {
    Viewer viewer(served.connectOptions(), ReadingsSelection{.of_all = true, .of = {2}});
    const Readings* readings = viewer.run().readingsOf(2);
    ASSERT_TRUE(readings);
    EXPECT_EQ(std::get<Image>(readings->measurements[0]).jpeg, CountedPictures::pictureOf(2));
  }
  served.end();
  std::vector<int> expected(ServedCameras::kRobots, 0);
  expected[2] = 1;
  EXPECT_EQ(served.taken(), expected);
}

TEST(RequestedPictures, OfARecordedRunAreAll) {
  ServedCameras served(false, (emptyFolder() / "run.rawlog").string());
  served.end(true);
  EXPECT_EQ(served.taken(), std::vector<int>(ServedCameras::kRobots, 21)) << "of steps 0 to 20";
}

}  // namespace
}  // namespace robosim
