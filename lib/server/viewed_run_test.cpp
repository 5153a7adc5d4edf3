#include "server/viewed_run.h"

#include <functional>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "net/wire_error.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

const WorldSource& smallMaze() {
  static const WorldSource source = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  return source;
}

/// The first frame of the small maze, with a Pioneer and a Scout.
wire::Frame firstFrame() {
  wire::Frame frame;
  encode(smallMaze(), *frame.mutable_world());
  frame.set_world_version("v");
  frame.set_period_s(0.1);
  for (std::size_t i = 0; i < 2; ++i) encode(RobotSnapshot{}, i, *frame.add_robots());
  return frame;
}

ViewedRun runAfter(const wire::Frame& frame) {
  ViewedRun run;
  update(run, frame);
  return run;
}

std::vector<Readings> readingsOfTheMaze() {
  LoadedWorld world = loadWorld(smallMaze(), {});
  return Environment(std::move(world.world), std::move(world.fleet), {}).state().readings;
}

TEST(ViewedRun, HasTheReadingsOfAFrameForThatFrameOnly) {
  const std::vector<Readings> measured = readingsOfTheMaze();
  ViewedRun run = runAfter(firstFrame());
  EXPECT_EQ(run.readingsOf(0), nullptr);
  wire::Frame frame;
  frame.set_step(7);
  encode(measured, ReadingsSelection{.of_all = false, .of = {1}}, frame);
  EXPECT_FALSE(update(run, frame));
  EXPECT_EQ(run.readingsOf(0), nullptr);
  ASSERT_NE(run.readingsOf(1), nullptr);
  EXPECT_EQ(run.readingsOf(1)->measurements, measured[1].measurements);
  EXPECT_DOUBLE_EQ(run.readingsOf(1)->time.seconds(), 0.7);
  update(run, wire::Frame());
  EXPECT_EQ(run.readingsOf(1), nullptr);
}

TEST(ViewedRun, OfAllRobotsHasTheReadingsOfEach) {
  const std::vector<Readings> measured = readingsOfTheMaze();
  wire::Frame frame = firstFrame();
  encode(measured, ReadingsSelection{.of_all = true, .of = {}}, frame);
  const ViewedRun run = runAfter(frame);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_NE(run.readingsOf(i), nullptr);
    EXPECT_EQ(run.readingsOf(i)->measurements, measured[i].measurements);
  }
}

TEST(ViewedRun, DecodesASelectionWithoutDuplicatesAndUnknownRobots) {
  wire::FrameRequest request;
  encode(ReadingsSelection{.of_all = false, .of = {1, 0, 1, 99}}, request);
  const ReadingsSelection wish = decode(request, 2);
  EXPECT_EQ(wish.of, (std::vector<std::uint32_t>{0, 1}));
  wire::Frame frame;
  encode(readingsOfTheMaze(), wish, frame);
  ASSERT_EQ(frame.readings_size(), 2);
  EXPECT_EQ(frame.readings(1).robot(), 1u);
}

TEST(ViewedRun, RefusesInvalidFrames) {
  const auto complaint = [](const std::function<void(wire::Frame&)>& spoil) {
    wire::Frame frame = firstFrame();
    encode(readingsOfTheMaze(), ReadingsSelection{.of_all = true, .of = {}}, frame);
    spoil(frame);
    try {
      runAfter(frame);
    } catch (const WireError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](wire::Frame&) {}), "");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.mutable_robots(0)->set_robot(2); }),
            "a frame with a robot that the world does not have");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.mutable_readings(0)->set_robot(2); }),
            "a frame with a robot that the world does not have");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.mutable_robots(0)->set_x_m(NAN); }),
            "a frame in which a robot is nowhere: its pose is not finite");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.mutable_robots(0)->set_activity(static_cast<wire::Activity>(9)); }),
            "a frame with the unknown activity 9");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.mutable_robots()->RemoveLast(); }),
            "a first frame that does not show every robot");
  EXPECT_EQ(complaint([](wire::Frame& f) { f.set_period_s(0); }), "a frame whose time step is not in (0, 1] s");
  EXPECT_NE(complaint([](wire::Frame& f) { f.mutable_readings(0)->mutable_readings()->clear_measurements(); }), "");
}

}  // namespace
}  // namespace robosim
